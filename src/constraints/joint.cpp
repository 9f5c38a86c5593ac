#include "constraints/joint.hpp"

#include <algorithm>
#include <cmath>

#include "constraints/motion_seeds.hpp"

namespace balocco {

namespace {

int rows_of(const Joint::Piece& piece) {
  switch (piece.part) {
    case Joint::Part::offset:
    case Joint::Part::align:
      return piece.along[0] + piece.along[1] + piece.along[2];
    case Joint::Part::revolute:
    case Joint::Part::slot:
      return 2;
    default:
      return 1;
  }
}

}  // namespace

JointConstraint::JointConstraint(const Model& model, const Joint& joint, double model_size) : pieces_(joint.pieces), lever_(model_size) {
  nodes_.assign(joint.nodes.begin(), joint.nodes.end());
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) {
      axes_[0](i, c) = joint.axes[i][c];
      axes_[1](i, c) = joint.second_axes[i][c];
    }
  const Vector3<double> arm = Vector3<double>{model.nodes.coordinates[nodes_[1]]} - Vector3<double>{model.nodes.coordinates[nodes_[0]]};
  offset_ = axes_[0] * arm;
  length_ = std::sqrt(dot(arm, arm));
  if (length_ > 0.0) lever_ = length_;
  for (const auto& piece : pieces_) {
    rows_ += rows_of(piece);
    const bool of_rotations = piece.part == Joint::Part::align || piece.part == Joint::Part::revolute || piece.part == Joint::Part::universal;
    turns_[1] = turns_[1] || of_rotations;
    // Two nodes in one place that stay together: along which axes does not matter.
    const bool pins = piece.part == Joint::Part::offset && rows_of(piece) == 3 && !(length_ > 1e-9 * model_size);
    turns_[0] = turns_[0] || (piece.part != Joint::Part::distance && !pins);
  }
}

template <class T>
std::array<JointConstraint::Frame<T>, 2> JointConstraint::seeded_frames(std::span<const NodePlace> places,
                                                                        const std::array<MotionSeed<T>, 2>& seeds) const {
  std::array<Frame<T>, 2> result;
  for (int node = 0; node < 2; ++node) {
    for (int c = 0; c < 3; ++c) result[node].position[c] = places[node].position[c] + seeds[node].displacement[c];
    result[node].axes = constant<T>(axes_[node] * transpose(places[node].rotation)) * transpose(seeds[node].turn);
  }
  return result;
}

/// Calls `rows` for each row in turn.
template <class Rows>
void JointConstraint::list_rows(Rows&& rows) const {
  for (const auto& piece : pieces_) switch (piece.part) {
      case Joint::Part::offset:
        for (int i = 0; i < 3; ++i)
          if (piece.along[i]) rows.along(i);
        break;
      case Joint::Part::slot:
        for (int i = 1; i < 3; ++i) rows.along(i);
        break;
      case Joint::Part::plane:
        rows.along(0);
        break;
      case Joint::Part::distance:
        rows.distance();
        break;
      case Joint::Part::align:
        for (int i = 0; i < 3; ++i)
          if (piece.along[i]) rows.sine(i);
        break;
      case Joint::Part::revolute:
        for (int i = 1; i < 3; ++i) rows.right_angle(i, 0);
        break;
      case Joint::Part::universal:
        rows.right_angle(0, 2);
        break;
    }
}

template <class T>
struct JointConstraint::Gaps {
  const JointConstraint& joint;
  const std::array<Frame<T>, 2>& frames;
  T* g;
  Vector3<T> arm = frames[1].position - frames[0].position;

  T product(int i, int j) const { return dot(row_of(frames[0].axes, i), row_of(frames[1].axes, j)); }
  void along(int i) { *g++ = dot(row_of(frames[0].axes, i), arm) - joint.offset_[i]; }
  void distance() { *g++ = square_root(dot(arm, arm)) - joint.length_; }
  void sine(int i) {  // of the angle about an axis
    *g++ = 0.5 * joint.lever_ * (product((i + 2) % 3, (i + 1) % 3) - product((i + 1) % 3, (i + 2) % 3));
  }
  void right_angle(int i, int j) { *g++ = joint.lever_ * product(i, j); }
};

/// A spin s changes an axis e by s x e.
struct JointConstraint::Gradient {
  const JointConstraint& joint;
  const std::array<Frame<double>, 2>& frames;
  double* line;  // 12 values
  Vector3<double> arm = frames[1].position - frames[0].position;

  void put(int first, double factor, const Vector3<double>& direction) {
    for (int c = 0; c < 3; ++c) line[first + c] += factor * direction[c];
  }
  void add_product(double factor, int i, int j) {
    const auto turn = cross(row_of(frames[0].axes, i), row_of(frames[1].axes, j));
    put(3, factor, turn);
    put(9, -factor, turn);
  }
  void put_apart(const Vector3<double>& direction) {
    put(0, -1.0, direction);
    put(6, 1.0, direction);
  }
  void along(int i) {
    const auto axis = row_of(frames[0].axes, i);
    put_apart(axis);
    put(3, 1.0, cross(axis, arm));
    line += 12;
  }
  void distance() {
    put_apart(1.0 / std::sqrt(dot(arm, arm)) * arm);
    line += 12;
  }
  void sine(int i) {
    add_product(0.5 * joint.lever_, (i + 2) % 3, (i + 1) % 3);
    add_product(-0.5 * joint.lever_, (i + 1) % 3, (i + 2) % 3);
    line += 12;
  }
  void right_angle(int i, int j) {
    add_product(joint.lever_, i, j);
    line += 12;
  }
};

std::array<JointConstraint::Frame<double>, 2> JointConstraint::frames(std::span<const NodePlace> places) const {
  std::array<Frame<double>, 2> result;
  for (int node = 0; node < 2; ++node)
    result[node] = {places[node].position, axes_[node] * transpose(places[node].rotation)};
  return result;
}

/// Takes multipliers in turn. Those of rotations are moments / lever where all is in line.
struct JointConstraint::Forces {
  double lever;
  const double* multiplier;
  std::array<double, 6>& force;

  void along(int i) { force[i] += *multiplier++; }
  void distance() { force[0] += *multiplier++; }
  void sine(int i) { force[3 + i] += lever * *multiplier++; }
  void right_angle(int i, int j) {  // a turn of the second frame about e_i x e_j, as it stands, closes it
    const bool positive = (i + 1) % 3 == j;
    force[6 - i - j] += (positive ? -lever : lever) * *multiplier++;
  }
};

std::array<double, 6> JointConstraint::component_forces(std::span<const double> multipliers) const {
  std::array<double, 6> force{};
  list_rows(Forces{lever_, multipliers.data(), force});
  return force;
}

void JointConstraint::find_multipliers(const Vector3<double>& force, const Vector3<double>& moment, const Matrix3<double>& rotation,
                                       std::span<double> multipliers) const {
  const auto axes = axes_[0] * transpose(rotation);
  for (int i = 0; i < 3; ++i) multipliers[i] = dot(row_of(axes, i), force);
  for (int i = 0; i < 3 && rows_ > 3; ++i) multipliers[3 + i] = dot(row_of(axes, i), moment) / lever_;
}

void JointConstraint::gaps(std::span<const NodePlace> places, std::span<double> g) const {
  list_rows(Gaps<double>{*this, frames(places), g.data()});
}

void JointConstraint::gradient(std::span<const NodePlace> places, std::span<double> dg) const {
  std::ranges::fill(dg, 0.0);
  list_rows(Gradient{*this, frames(places), dg.data()});
}

void JointConstraint::add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers,
                                    std::span<double> pairs) const {
  std::array<Curvature, 16> g;
  list_rows(Gaps<Curvature>{*this, seeded_frames<Curvature>(places, {curvature_seed(0), curvature_seed(1)}), g.data()});
  for (int i = 0; i < rows_; ++i)
    for (int k = 0; k < 12; ++k)
      for (int l = 0; l < 12; ++l) pairs[12 * k + l] += multipliers[i] * g[i].derivative[k].derivative[l];
}

}  // namespace balocco
