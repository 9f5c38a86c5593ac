// Follower pressure on faces of elements: the load integrates the current normal, so its tangent is exact too.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// The faces of one surface that belong to a rank's elements: those of four nodes first (linear triangles repeat their last node),
/// then those of eight and of six.
class PressureFaces {
 public:
  static constexpr int most_nodes = 8;

  /// `local_node`: model row -> local node, negative where the rank does not have it. A face belongs to the rank that owns its
  /// element, told by `element_is_local`.
  PressureFaces(const Model& model, const Surface& surface, std::span<const std::int32_t> local_node,
                const std::vector<std::vector<bool>>& element_is_local, std::int32_t scratch_node);

  std::int32_t size() const { return families_[0].size + families_[1].size + families_[2].size; }
  /// Local nodes of a face; a linear triangle's fourth equals its third.
  std::span<const std::int32_t> nodes(std::int32_t face) const;

  /// Adds f_I = -pressure * integral of N_I n dA to `force` (4 doubles a node, the fourth is the rounding constant), rounded.
  void add_forces(double pressure, const double* position, double* force) const;

  /// Force of one face (3 a node) and its derivative with respect to the nodes' positions (square, row-major, not symmetric in
  /// general).
  void linearize(std::int32_t face, double pressure, const double* position, std::span<double> force,
                 std::span<double> stiffness) const;

 private:
  /// Faces of as many nodes.
  struct Family {
    int nodes;
    std::int32_t size = 0;
    std::vector<std::int32_t> gather = {}, scatter = {};  // padded to whole packs
  };
  void add(Family& family, const std::vector<std::int32_t>& nodes);

  std::array<Family, 3> families_{Family{4}, Family{8}, Family{6}};
};

}  // namespace balocco
