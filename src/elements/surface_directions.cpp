#include "elements/surface_directions.hpp"

#include <cmath>

namespace balocco {

namespace {

using Vector = Vector3<double>;

double length(const Vector& v) {
  return std::sqrt(dot(v, v));
}
Vector vector_of(const Point& p) {
  return {{p[0], p[1], p[2]}};
}

/// The axis of an orientation that becomes local direction 1 once projected.
Vector orientation_axis(const Orientation& orientation, const Vector& point) {
  const int axis = (orientation.rotation_axis + 1) % 3;
  if (orientation.system == Orientation::System::rectangular || axis == 2) return vector_of(orientation.axes[axis]);
  const Vector line = vector_of(orientation.axes[2]);
  const Vector arm = point - vector_of(orientation.origin);
  const Vector radial = arm - dot(arm, line) * line;
  return axis == 0 ? radial : cross(line, radial);
}

}  // namespace

std::optional<SurfaceDirections> surface_directions(const Orientation* orientation, const Vector& point,
                                                    const Vector& normal) {
  Vector axis{{1.0, 0.0, 0.0}};
  double angle = 0.0;
  if (orientation != nullptr) {
    axis = orientation_axis(*orientation, point);
    angle = orientation->additional_rotation;
  } else if (std::hypot(normal[1], normal[2]) < std::sin(0.1 * M_PI / 180.0)) {
    axis = {{0.0, 0.0, 1.0}};
  }
  const Vector projected = axis - dot(axis, normal) * normal;
  if (!(length(projected) > 1e-6 * length(axis))) return std::nullopt;
  const Vector first = (1.0 / length(projected)) * projected, second = cross(normal, first);
  const Vector turned = std::cos(angle) * first + std::sin(angle) * second;
  return SurfaceDirections{turned, cross(normal, turned)};
}

}  // namespace balocco
