// Tractions on the faces of elements and on the edges of sheets, in directions that stay or turn with the surface.
#pragma once

#include <array>
#include <vector>

#include "elements/face_shapes.hpp"
#include "loads/surface_loading.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Every SurfaceLoad but pressure. A direction that turns with its surface turns with Q of the surface's motion F = Q U, U its stretch;
/// that of an edge with the triad of the edge, the direction into the sheet, and the sheet's normal there.
class Tractions final : public SurfaceLoading {
 public:
  /// As make_surface_loading().
  Tractions(const Model& model, const SurfaceLoad& load, std::span<const std::int32_t> local_node,
            const std::vector<std::vector<bool>>& element_is_local);

  std::int32_t size() const override { return static_cast<std::int32_t>(first_.size()) - 1; }
  std::span<const std::int32_t> nodes(std::int32_t item) const override;
  void add_forces(double magnitude, const double* position, double* force) const override;
  void linearize(std::int32_t item, double magnitude, const double* position, std::span<double> force,
                 std::span<double> stiffness) const override;

 private:
  template <class T>
  using Places = std::array<Vector3<T>, most_nodes>;

  void add(const ElementTable& table, const FaceRef& face, std::span<const std::int32_t> local_node, const Model& model);
  /// Forces on the nodes of a face or edge; of an edge they follow each other from its first node round the element.
  template <class T>
  Places<T> forces(std::int32_t item, double magnitude, const Places<T>& place) const;
  template <class T>
  Places<T> forces_on_face(std::int32_t item, double magnitude, const Places<T>& place) const;
  template <class T>
  Places<T> forces_on_edge(std::int32_t item, double magnitude, const Places<T>& place) const;

  SurfaceLoad load_;
  std::vector<std::int32_t> first_{0}, node_;  // of each face or edge, and one more
  std::vector<Vector3<double>> reference_;     // places of node_ in the reference configuration
  std::array<std::vector<FaceStation>, most_nodes + 1> stations_;  // of faces, by their number of nodes
};

}  // namespace balocco
