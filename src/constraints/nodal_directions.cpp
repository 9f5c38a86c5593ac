#include "constraints/nodal_directions.hpp"

#include <cmath>

namespace balocco {

namespace {

Vector3<double> to_vector(const Point& p) { return {{p[0], p[1], p[2]}}; }

Vector3<double> unit(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

Matrix3<double> from_rows(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& c) {
  return {{a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]}};
}

}  // namespace

Matrix3<double> local_axes(const Orientation& orientation, const Point& point) {
  const auto axis1 = to_vector(orientation.axes[0]), axis2 = to_vector(orientation.axes[1]),
             axis3 = to_vector(orientation.axes[2]);
  if (orientation.system == Orientation::System::rectangular) return from_rows(axis1, axis2, axis3);
  const auto offset = to_vector(point) - to_vector(orientation.origin);
  const auto radial = offset - dot(offset, axis3) * axis3;
  // On the axis itself the radial direction is undefined; the system's first axis serves.
  const auto first = dot(radial, radial) > 0.0 ? unit(radial) : axis1;
  return from_rows(first, cross(axis3, first), axis3);
}

NodalDirections::NodalDirections(const Model& model) {
  for (const auto& transform : model.transforms)
    for (const auto node : transform.nodes)
      directions_[node] = local_axes(transform.directions, model.nodes.coordinates[node]);
}

Point NodalDirections::direction(std::int32_t node_row, int axis) const {
  if (const auto* axes = find(node_row)) return {(*axes)(axis, 0), (*axes)(axis, 1), (*axes)(axis, 2)};
  Point global{};
  global[axis] = 1.0;
  return global;
}

}  // namespace balocco
