// What a load does that is spread over the faces or edges of a surface: its forces, and their derivative.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// One kind of load on those faces, or edges, of a surface that belong to a rank's elements.
class SurfaceLoading {
 public:
  static constexpr int most_nodes = 8;

  virtual ~SurfaceLoading() = default;

  /// Faces or edges.
  virtual std::int32_t size() const = 0;
  /// Local nodes on whose places the load of a face or edge depends.
  virtual std::span<const std::int32_t> nodes(std::int32_t item) const = 0;
  /// Adds the forces at `position` (4 doubles a node) to `force` (likewise, the fourth is the rounding constant), rounded.
  virtual void add_forces(double magnitude, const double* position, double* force) const = 0;
  /// Force of one face or edge (3 a node) and its derivative with respect to the nodes' positions (square, row-major, not symmetric
  /// in general).
  virtual void linearize(std::int32_t item, double magnitude, const double* position, std::span<double> force,
                         std::span<double> stiffness) const = 0;
};

/// `local_node`: model row -> local node, negative where the rank does not have it. A face belongs to the rank that owns its element,
/// told by `element_is_local`.
std::unique_ptr<SurfaceLoading> make_surface_loading(const Model& model, const SurfaceLoad& load, std::span<const std::int32_t> local_node,
                                                     const std::vector<std::vector<bool>>& element_is_local, std::int32_t scratch_node);

}  // namespace balocco
