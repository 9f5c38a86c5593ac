#include "loads/tractions.hpp"

#include <algorithm>

#include "elements/any_face.hpp"
#include "elements/element_type.hpp"
#include "math/dual.hpp"
#include "math/exact_sum.hpp"

namespace balocco {

namespace {

template <class T>
using Triad = std::array<Vector3<T>, 3>;

template <class T>
Vector3<T> times(const T& factor, const Vector3<double>& v) {
  return {{factor * v[0], factor * v[1], factor * v[2]}};
}

template <class T>
Vector3<T> weighted(double weight, const Vector3<T>& v) {
  return {{weight * v[0], weight * v[1], weight * v[2]}};
}

template <class T>
T length(const Vector3<T>& v) {
  return square_root(dot(v, v));
}

template <class T>
Vector3<T> direction_of(const Vector3<T>& v) {
  return T(1.0) / length(v) * v;
}

/// The direction (along the axes of `before`) that `direction` has become by their turning into those of `after`.
template <class T>
Vector3<T> turned(const Vector3<double>& direction, const Triad<double>& before, const Triad<T>& after) {
  Vector3<T> result{};
  for (int axis = 0; axis < 3; ++axis) result = result + weighted(dot(direction, before[axis]), after[axis]);
  return result;
}

/// Tangents of a face at a station.
template <class T>
struct Tangents {
  Vector3<T> by_xi{}, by_eta{};
};

template <class T, class Places>
Tangents<T> tangents_of(const AnyFaceShapes& shapes, std::size_t nodes, const Places& place) {
  Tangents<T> tangents;
  for (std::size_t i = 0; i < nodes; ++i) {
    tangents.by_xi = tangents.by_xi + weighted(shapes.by_xi[i], place[i]);
    tangents.by_eta = tangents.by_eta + weighted(shapes.by_eta[i], place[i]);
  }
  return tangents;
}

/// Orthonormal, the first along by_xi, the third the normal.
template <class T>
Triad<T> axes_of(const Tangents<T>& tangents) {
  const Vector3<T> first = direction_of(tangents.by_xi), normal = direction_of(cross(tangents.by_xi, tangents.by_eta));
  return {first, cross(normal, first), normal};
}

/// What the axes of the reference have become by the rotation Q of the surface's motion F = Q U: in the plane of the surface now, the
/// images of the two axes are symmetric about those turned ones.
template <class T>
Triad<T> axes_now(const Tangents<double>& before, const Triad<double>& axes, const Tangents<T>& now) {
  const double along = 1.0 / dot(before.by_xi, axes[0]), across = 1.0 / dot(before.by_eta, axes[1]);
  const Vector3<T> image = weighted(along, now.by_xi);
  const Vector3<T> other = weighted(across, now.by_eta - weighted(dot(before.by_eta, axes[0]), image));
  const Triad<T> plane = axes_of(now);
  const T sine = T(0.0) - dot(other, plane[0]), cosine = dot(image, plane[0]) + dot(other, plane[1]);
  const T scale = T(1.0) / square_root(sine * sine + cosine * cosine);
  const T s = scale * sine, c = scale * cosine;
  return {c * plane[0] + s * plane[1], c * plane[1] - s * plane[0], plane[2]};
}

/// Along an edge, into the sheet and along its normal; the sheet's corners from the edge's first one on, a triangle's last one twice.
template <class T, class Places>
Triad<T> axes_of_edge(const Places& place, std::size_t corners) {
  const Vector3<T> normal = cross(place[2] - place[0], place[corners - 1] - place[1]);
  const Vector3<T> along = direction_of(place[1] - place[0]), inward = direction_of(cross(normal, along));
  return {along, inward, cross(along, inward)};
}

}  // namespace

Tractions::Tractions(const Model& model, const SurfaceLoad& load, std::span<const std::int32_t> local_node,
                     const std::vector<std::vector<bool>>& element_is_local)
    : load_(load) {
  const Surface& surface = model.surfaces[load.surface];
  for (const FaceRef& face : acts_on_edges(load.kind) ? surface.edges : surface.faces)
    if (element_is_local[face.element.table][face.element.row]) add(model.elements[face.element.table], face, local_node, model);
}

void Tractions::add(const ElementTable& table, const FaceRef& face, std::span<const std::int32_t> local_node, const Model& model) {
  const std::int32_t* const of_element = table.connectivity.data() + static_cast<std::size_t>(face.element.row) * table.type->nodes;
  const auto push = [&](int local) {
    node_.push_back(local_node[of_element[local]]);
    const Point& place = model.nodes.coordinates[of_element[local]];
    reference_.push_back({{place[0], place[1], place[2]}});
  };
  if (acts_on_edges(load_.kind)) {
    for (int i = 0; i < table.type->nodes; ++i) push((face.face + i) % table.type->nodes);
  } else {
    for (const int local : nodes_of_face(*table.type, face.face)) push(local);
  }
  first_.push_back(static_cast<std::int32_t>(node_.size()));
  const std::size_t count = nodes(size() - 1).size();
  if (stations_[count].empty()) stations_[count] = face_stations(count);
}

std::span<const std::int32_t> Tractions::nodes(std::int32_t item) const {
  return std::span(node_).subspan(first_[item], first_[item + 1] - first_[item]);
}

template <class T>
Tractions::Places<T> Tractions::forces(std::int32_t item, double magnitude, const Places<T>& place) const {
  return acts_on_edges(load_.kind) ? forces_on_edge(item, magnitude, place) : forces_on_face(item, magnitude, place);
}

template <class T>
Tractions::Places<T> Tractions::forces_on_face(std::int32_t item, double magnitude, const Places<T>& place) const {
  const std::size_t count = nodes(item).size();
  const auto reference = std::span(reference_).subspan(first_[item], count);
  const Vector3<double> given{load_.direction};
  Places<T> force{};
  for (const FaceStation& station : stations_[count]) {
    const auto shapes = face_shapes(count, station.xi, station.eta);
    const auto before = tangents_of<double>(shapes, count, reference);
    const auto now = tangents_of<T>(shapes, count, place);
    const auto axes = axes_of(before);
    Vector3<double> direction = given;
    if (load_.kind == SurfaceLoad::Kind::shear) {
      direction = given - dot(given, axes[2]) * axes[2];
      const double size = length(direction);
      if (size < 1e-9) continue;  // along the normal: nothing to shear with
      direction = 1.0 / size * direction;
    }
    const T area = load_.of_reference ? T(length(cross(before.by_xi, before.by_eta))) : length(cross(now.by_xi, now.by_eta));
    const T resultant = magnitude * station.weight * area;
    const Vector3<T> vector = load_.follows ? resultant * turned(direction, axes, axes_now(before, axes, now)) : times(resultant, direction);
    for (std::size_t i = 0; i < count; ++i) force[i] = force[i] + weighted(shapes.value[i], vector);
  }
  return force;
}

template <class T>
Tractions::Places<T> Tractions::forces_on_edge(std::int32_t item, double magnitude, const Places<T>& place) const {
  using Kind = SurfaceLoad::Kind;
  const std::size_t corners = nodes(item).size();
  const auto reference = std::span(reference_).subspan(first_[item], corners);
  const auto axes = axes_of_edge<T>(place, corners);
  const T span = load_.of_reference ? T(length(reference[1] - reference[0])) : length(place[1] - place[0]);
  const T half = 0.5 * magnitude * span;
  Places<T> force{};
  switch (load_.kind) {
    case Kind::edge_shear: force[0] = half * axes[0]; break;
    case Kind::edge_normal: force[0] = half * axes[1]; break;
    case Kind::edge_transverse: force[0] = T(-1.0) * half * axes[2]; break;
    default: {
      const Vector3<double> direction{load_.direction};
      force[0] = load_.follows ? half * turned(direction, axes_of_edge<double>(reference, corners), axes) : times(half, direction);
    }
  }
  force[1] = force[0];
  return force;
}

void Tractions::add_forces(double magnitude, const double* position, double* force) const {
  for (std::int32_t item = 0; item < size(); ++item) {
    const auto of_item = nodes(item);
    Places<double> place{};
    for (std::size_t i = 0; i < of_item.size(); ++i) std::copy_n(position + 4 * std::ptrdiff_t{of_item[i]}, 3, place[i].component.data());
    const auto each = forces<double>(item, magnitude, place);
    for (std::size_t i = 0; i < of_item.size(); ++i) {
      double* const sum = force + 4 * std::ptrdiff_t{of_item[i]};
      for (int c = 0; c < 3; ++c) sum[c] += rounded(each[i][c], sum[3]);
    }
  }
}

void Tractions::linearize(std::int32_t item, double magnitude, const double* position, std::span<double> force,
                          std::span<double> stiffness) const {
  using Scalar = Dual<3 * most_nodes>;
  const auto of_item = nodes(item);
  Places<Scalar> place{};
  for (std::size_t i = 0; i < of_item.size(); ++i)
    for (int c = 0; c < 3; ++c) place[i][c] = Scalar(position[4 * std::ptrdiff_t{of_item[i]} + c], static_cast<int>(3 * i) + c);
  const auto each = forces<Scalar>(item, magnitude, place);
  const std::size_t freedoms = 3 * of_item.size();
  for (std::size_t i = 0; i < freedoms; ++i) {
    const Scalar& component = each[i / 3][static_cast<int>(i % 3)];
    force[i] = component.value;
    std::copy_n(component.derivative.begin(), freedoms, stiffness.begin() + static_cast<std::ptrdiff_t>(freedoms * i));
  }
}

}  // namespace balocco
