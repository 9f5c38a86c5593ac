// The rigid master of a contact pair, whatever it is made of: it answers how far a place in the frame of its body is, and in which
// direction.
#pragma once

#include <variant>

#include "rigid_mesh.hpp"
#include "rigid_surface.hpp"

namespace balocco {

class MasterSurface {
 public:
  MasterSurface() = default;
  /// `reference`: initial place of the reference node of the body, the origin of its frame.
  MasterSurface(const Model& model, const Surface& surface, const Point& reference);

  bool empty() const {
    return std::visit([](const auto& shape) { return shape.empty(); }, shape_);
  }
  /// True only if no force can act there; far cheaper than the distance.
  bool surely_outside(const Vector3<double>& place) const {
    return std::visit([&](const auto& shape) { return shape.surely_outside(place); }, shape_);
  }
  /// Whether a profile had ended where it is nearest to `place`, and only its continuation is there. Meshes end where they end.
  bool past_end(const Vector3<double>& place) const {
    const auto* const profile = std::get_if<RigidSurface>(&shape_);
    return profile != nullptr && profile->past_end(place);
  }
  /// `place` in the body frame. T: double or Dual.
  template <class T>
  SurfacePoint<T> nearest(const Vector3<T>& place) const {
    return std::visit([&](const auto& shape) { return shape.template nearest<T>(place); }, shape_);
  }

 private:
  std::variant<RigidSurface, RigidMesh> shape_;
};

}  // namespace balocco
