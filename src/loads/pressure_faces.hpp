// Follower pressure on faces of elements: the load integrates the current normal, so its tangent is exact too.
#pragma once

#include <span>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// The faces of one surface that belong to a rank's elements. Triangles repeat their last node (degenerate quadrilaterals).
class PressureFaces {
 public:
  static constexpr int nodes_per_face = 4;

  /// `local_node`: model row -> local node, negative where the rank does not have it. A face belongs to the rank that owns its
  /// element, told by `element_is_local`.
  PressureFaces(const Model& model, const Surface& surface, std::span<const std::int32_t> local_node,
                const std::vector<std::vector<bool>>& element_is_local, std::int32_t scratch_node);

  std::int32_t size() const { return size_; }
  /// Local nodes of a face; a triangle's fourth equals its third.
  std::span<const std::int32_t, nodes_per_face> nodes(std::int32_t face) const;

  /// Adds f_I = -pressure * integral of N_I n dA to `force` (4 doubles a node, the fourth is the rounding constant), rounded.
  void add_forces(double pressure, const double* position, double* force) const;

  /// Force of one face (12) and its derivative with respect to the nodes' positions (12 x 12 row-major, not symmetric in general).
  void linearize(std::int32_t face, double pressure, const double* position, std::span<double, 12> force,
                 std::span<double, 144> stiffness) const;

 private:
  std::int32_t size_ = 0, padded_size_ = 0;
  std::vector<std::int32_t> gather_, scatter_;
};

}  // namespace balocco
