// The tangent of a place on a deformable master: its foot moves over the face as slave and master move, which dual numbers carry through
// the force; how it moves follows from the condition that the arm stays normal to the face.
#include <algorithm>
#include <cmath>

#include "mesh_contact.hpp"

namespace balocco {

namespace {

/// Values of the shape functions of a face at a foot and their first and second derivatives.
struct FootShapes {
  AnyFaceShapes at;
  std::array<double, most_face_nodes> by_xi_xi{}, by_xi_eta{}, by_eta_eta{};

  /// The slopes are polynomials of the second degree at most, so that central differences are exact.
  FootShapes(std::size_t nodes, double xi, double eta) : at(face_shapes(nodes, xi, eta)) {
    const auto right = face_shapes(nodes, xi + 0.5, eta), left = face_shapes(nodes, xi - 0.5, eta);
    const auto above = face_shapes(nodes, xi, eta + 0.5), below = face_shapes(nodes, xi, eta - 0.5);
    for (std::size_t a = 0; a < nodes; ++a) {
      by_xi_xi[a] = right.by_xi[a] - left.by_xi[a];
      by_xi_eta[a] = above.by_xi[a] - below.by_xi[a];
      by_eta_eta[a] = above.by_eta[a] - below.by_eta[a];
    }
  }
};

/// A place over a face with N nodes, all that moves as dual numbers: the place itself (derivatives 0-2), the anchor (3-5), the nodes of
/// the face (from 6).
template <int N>
struct MovingFoot {
  using Scalar = Dual<6 + 3 * N>;
  Vector3<Scalar> place, foot, normal;
  std::array<Vector3<Scalar>, N> node;
  std::array<Scalar, N> weight;
  Scalar xi, eta, gap;

  MovingFoot(const FacePlace& found, std::span<const std::int32_t> nodes, const double* position, const Vector3<double>& at, double edge)
      : xi(found.xi), eta(found.eta) {
    for (int i = 0; i < 3; ++i) {
      place[i] = Scalar(at[i], i);
      for (int a = 0; a < N; ++a) node[a][i] = Scalar(position[4 * static_cast<std::ptrdiff_t>(nodes[a]) + i], 6 + 3 * a + i);
    }
    const FootShapes shapes(N, found.xi, found.eta);
    move_foot(found, shapes);
    std::array<Scalar, N> by_xi, by_eta;
    const Scalar along_xi = xi - found.xi, along_eta = eta - found.eta;
    for (int a = 0; a < N; ++a) {
      weight[a] = shapes.at.value[a] + shapes.at.by_xi[a] * along_xi + shapes.at.by_eta[a] * along_eta;
      by_xi[a] = shapes.at.by_xi[a] + shapes.by_xi_xi[a] * along_xi + shapes.by_xi_eta[a] * along_eta;
      by_eta[a] = shapes.at.by_eta[a] + shapes.by_xi_eta[a] * along_xi + shapes.by_eta_eta[a] * along_eta;
    }
    foot = sum(weight);
    const auto arm = place - foot;
    const Scalar square = dot(arm, arm);
    constexpr double no_direction = 1e-9;  // of the edge: below that the direction of the arm is round-off
    const Vector3<Scalar> fixed{Scalar(found.normal[0]), Scalar(found.normal[1]), Scalar(found.normal[2])};
    if (found.freedoms == 2) {
      normal = cross(sum(by_xi), sum(by_eta));
      normal = (1.0 / square_root(dot(normal, normal))) * normal;
      gap = dot(arm, normal);
    } else if (square.value > no_direction * no_direction * edge * edge) {
      const double side = found.distance < 0.0 ? -1.0 : 1.0;
      gap = side * square_root(square);
      normal = (1.0 / gap) * arm;
    } else {
      normal = fixed;
      gap = dot(arm, normal);
    }
  }

  template <class Weight>
  Vector3<Scalar> sum(const std::array<Weight, N>& weights) const {
    Vector3<Scalar> total{};
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < 3; ++i) total[i] += weights[a] * node[a][i];
    return total;
  }

 private:
  /// Gives xi and eta their derivatives, from (place - foot) . (foot by each way) = 0.
  void move_foot(const FacePlace& found, const FootShapes& shapes) {
    std::array<double, N> value{};
    std::copy_n(shapes.at.value.begin(), N, value.begin());
    const auto arm = place - sum(value);
    std::array<Vector3<double>, 2> tangent{};
    std::array<Scalar, 2> right;
    std::array<std::array<double, 2>, 2> matrix{};
    for (int k = 0; k < found.freedoms; ++k) {
      const auto& way = found.way[k];
      std::array<double, N> slope{};
      for (int a = 0; a < N; ++a) slope[a] = way[0] * shapes.at.by_xi[a] + way[1] * shapes.at.by_eta[a];
      const auto along = sum(slope);
      tangent[k] = {along[0].value, along[1].value, along[2].value};
      right[k] = dot(along, arm);
    }
    for (int k = 0; k < found.freedoms; ++k)
      for (int l = 0; l < found.freedoms; ++l) {
        const auto &p = found.way[k], &q = found.way[l];
        matrix[k][l] = dot(tangent[k], tangent[l]);
        for (int a = 0; a < N; ++a) {
          const double second =
              p[0] * q[0] * shapes.by_xi_xi[a] + (p[0] * q[1] + p[1] * q[0]) * shapes.by_xi_eta[a] + p[1] * q[1] * shapes.by_eta_eta[a];
          for (int i = 0; i < 3; ++i) matrix[k][l] -= second * node[a][i].value * arm[i].value;
        }
      }
    // The value of the right-hand side is the rounding of the search: only its derivatives count.
    for (auto& each : right) each.value = 0.0;
    if (found.freedoms == 1) move_by(found.way[0], (1.0 / matrix[0][0]) * right[0]);
    if (found.freedoms != 2) return;
    const double determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
    move_by(found.way[0], (matrix[1][1] / determinant) * right[0] - (matrix[0][1] / determinant) * right[1]);
    move_by(found.way[1], (matrix[0][0] / determinant) * right[1] - (matrix[1][0] / determinant) * right[0]);
  }

  void move_by(const std::array<double, 2>& way, const Scalar& by) {
    xi += way[0] * by;
    eta += way[1] * by;
  }
};

/// Hands the derivatives of one row, by place, anchor and face, to the nodes that these move with.
template <class Scalar>
class Spread {
 public:
  Spread(std::span<const double> slave, int face_nodes, std::span<const double> anchor, MeshTangent& tangent)
      : slave_(slave), face_nodes_(face_nodes), anchor_(anchor), tangent_(tangent) {}

  void add(std::size_t node, int axis, double factor, const Scalar& force) {
    const std::size_t row = 3 * node + static_cast<std::size_t>(axis);
    tangent_.force[row] = factor * force.value;
    double* const out = &tangent_.derivative[row * tangent_.force.size()];
    std::size_t column = 0;
    for (const double weight : slave_)
      for (int i = 0; i < 3; ++i) out[column++] = factor * weight * force.derivative[i];
    for (int i = 0; i < 3 * face_nodes_; ++i) out[column++] = factor * force.derivative[6 + i];
    for (const double weight : anchor_)
      for (int i = 0; i < 3; ++i) out[column++] = factor * weight * force.derivative[3 + i];
  }

 private:
  std::span<const double> slave_;
  int face_nodes_;
  std::span<const double> anchor_;
  MeshTangent& tangent_;
};

/// Friction of the same force whose derivative is that of its spring, wherever its anchor is.
template <int N>
void stick(const MovingFoot<N>& moving, ContactForce<typename MovingFoot<N>::Scalar>& contact) {
  std::array<double, N> weight{};
  for (int a = 0; a < N; ++a) weight[a] = moving.weight[a].value;
  auto motion = moving.place - moving.sum(weight);
  for (int i = 0; i < 3; ++i) motion[i].value = 0.0;
  const Vector3<double> normal{moving.normal[0].value, moving.normal[1].value, moving.normal[2].value};
  const auto across = motion[0] * normal[0] + motion[1] * normal[1] + motion[2] * normal[2];
  for (int i = 0; i < 3; ++i)
    contact.friction[i] = contact.friction[i].value - contact.tangential_stiffness * (motion[i] - across * normal[i]);
}

}  // namespace

template <int N>
void MeshContact::linearize_on(std::int32_t index, const FacePlace& found, const NormalSpring& spring, const double* position,
                               const ContactPoint& old, ContactPoint& updated, bool sticks, const Vector3<double>& last_slip,
                               MeshTangent& tangent) const {
  using Scalar = typename MovingFoot<N>::Scalar;
  const auto& place = places_[index];
  const auto law = parameters(place, old);
  const MovingFoot<N> moving(found, faces_.nodes(found.face), position, at(place, position), faces_.edge());
  ContactForce<Scalar> contact;
  contact.pressure = Scalar::chain(spring.force, spring.slope, moving.gap);
  tangent.closed = spring.closed;
  if (spring.closed)
    updated.closed = 1.0;
  else
    open(found, updated);
  contact.normal = contact.pressure * moving.normal;

  std::vector<double> anchor_weights;
  if (holds_across(spring.force) && has_anchor(old)) {
    const auto face = static_cast<std::int32_t>(old.anchor[0]);
    const auto nodes = faces_.nodes(face);
    const auto shapes = face_shapes(nodes.size(), old.anchor[1], old.anchor[2]);
    Vector3<Scalar> anchor;
    if (face == found.face) {
      std::array<double, N> weights{};
      std::copy_n(shapes.value.begin(), N, weights.begin());
      anchor = moving.sum(weights);
    } else {
      anchor_weights.assign(shapes.value.begin(), shapes.value.begin() + static_cast<std::ptrdiff_t>(nodes.size()));
      const auto there = anchor_of(position, old);
      for (int i = 0; i < 3; ++i) anchor[i] = Scalar(there[i], 3 + i);
    }
    auto stretch = moving.place - anchor;
    stretch = stretch - dot(stretch, moving.normal) * moving.normal;
    const double kept = add_across(law, stretch, updated, contact);
    tangent.slip = contact.slip;
    if (kept < 1.0) {
      Vector3<double> where;
      for (int i = 0; i < 3; ++i) where[i] = moving.foot[i].value - kept * stretch[i].value;
      slide(position, contact.slip, where, found, updated);
    }
    if (sticks || dot(last_slip, tangent.slip) < 0.0) stick(moving, contact);
  } else if (tangent.closed) {
    updated.anchor = {static_cast<double>(found.face), found.xi, found.eta};
  }

  const auto force = contact.normal + contact.friction;
  Spread<Scalar> spread(place.weights, N, anchor_weights, tangent);
  for (std::size_t i = 0; i < place.nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) spread.add(i, axis, place.weights[i], force[axis]);
  for (int a = 0; a < N; ++a)
    for (int axis = 0; axis < 3; ++axis) spread.add(place.nodes.size() + a, axis, -1.0, moving.weight[a] * force[axis]);
}

void MeshContact::linearize(std::int32_t index, const MeshPairing& pairing, const double* position, const ContactPoint& old,
                            ContactPoint& updated, bool sticks, const Vector3<double>& last_slip, MeshTangent& tangent) const {
  const auto& place = places_[index];
  coupled_nodes(index, pairing, tangent.nodes);
  tangent.slave_shares.assign(place.nodes.size(), 1.0);
  tangent.slave_shares.resize(tangent.nodes.size(), 0.0);
  tangent.force.assign(3 * tangent.nodes.size(), 0.0);
  tangent.derivative.assign(tangent.force.size() * tangent.force.size(), 0.0);
  tangent.closed = false;
  tangent.slip = {};
  updated = old;
  const auto foot = faces_.nearest(position, at(place, position));
  const auto spring = spring_at(place, foot, old);
  if (foot.face != pairing.face || !spring) return open(foot, updated);
  switch (faces_.nodes(foot.face).size()) {
    case 3: return linearize_on<3>(index, foot, *spring, position, old, updated, sticks, last_slip, tangent);
    case 6: return linearize_on<6>(index, foot, *spring, position, old, updated, sticks, last_slip, tangent);
    case 8: return linearize_on<8>(index, foot, *spring, position, old, updated, sticks, last_slip, tangent);
    default: return linearize_on<4>(index, foot, *spring, position, old, updated, sticks, last_slip, tangent);
  }
}

}  // namespace balocco
