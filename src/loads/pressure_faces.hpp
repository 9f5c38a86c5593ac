// Follower pressure on faces of elements: the load integrates the current normal, so its tangent is exact too.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "loads/surface_loading.hpp"

namespace balocco {

/// The faces of one surface that belong to a rank's elements: those of four nodes first (linear triangles repeat their last node),
/// then those of eight and of six.
class PressureFaces final : public SurfaceLoading {
 public:
  /// As make_surface_loading().
  PressureFaces(const Model& model, const Surface& surface, std::span<const std::int32_t> local_node,
                const std::vector<std::vector<bool>>& element_is_local, std::int32_t scratch_node);

  std::int32_t size() const override { return families_[0].size + families_[1].size + families_[2].size; }
  /// Of a linear triangle the fourth equals the third.
  std::span<const std::int32_t> nodes(std::int32_t face) const override;
  /// f_I = -pressure * integral of N_I n dA.
  void add_forces(double pressure, const double* position, double* force) const override;
  void linearize(std::int32_t face, double pressure, const double* position, std::span<double> force,
                 std::span<double> stiffness) const override;

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
