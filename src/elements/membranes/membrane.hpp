// Membranes M3D4 (2 x 2 points), M3D4R (one point, hourglass control) and M3D3: finite membrane strain, no bending stiffness.
#pragma once

#include <vector>

#include "elements/aligned_vector.hpp"
#include "elements/element_group.hpp"
#include "elements/membranes/membrane_kernel.hpp"
#include "sections/membrane_section.hpp"

namespace balocco {

/// History of an element: the law's (point by point), the area ratio of each point, the energy dissipated by viscosity, and with
/// stiffness-proportional damping the strain E11 E22 2E12 of each point.
template <int corners, int points>
class MembraneGroup final : public ElementGroup {
 public:
  explicit MembraneGroup(const GroupInput& input);

  int history_size() const override;
  int law_field_row(std::string_view field, int point) const override {
    const int row = field_row(*section_data_.law, field);
    return row < 0 ? row : point * section_data_.law->history_size() + row;
  }
  void initialize_history(std::span<double> history) const override;
  void lumped_volume(std::int32_t element, std::span<double> volume) const override;
  double density() const override { return section_data_.density; }
  StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                             std::span<double> history) const override;
  bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                 std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const override;
  ElementEnergies energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history) const override;
  int point_components(std::string_view variable) const override;
  void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                    std::span<const double> history, std::span<double> values) const override;
  int integration_points() const override { return points; }
  std::size_t bytes_per_element() const override;

 private:
  using Layout = MembraneLayout<corners, points>;
  struct Block;

  int area_ratio_row(int point) const { return points * section_data_.law->history_size() + point; }
  int dissipation_row() const { return area_ratio_row(points); }
  int viscous_row(int point) const { return dissipation_row() + 1 + point; }
  int strain_row(int point) const { return viscous_row(points) + 3 * point; }
  bool damped() const { return section_data_.damping_beta > 0.0; }
  const double* pack_reference(std::int32_t element) const {
    return reference_.data() + static_cast<std::size_t>(element / pack_size) * (Layout::size * pack_size);
  }
  const double* reference(std::int32_t element) const { return pack_reference(element) + element % pack_size; }

  void add_point(int point, Block& block, const ExplicitCycle& cycle, std::span<double> history) const;
  std::array<Pack, 3> viscous_stress(Block& block, int pack, int point, const Metric<Pack>& stretch,
                                     const ExplicitCycle& cycle, std::span<double> history) const;
  Pack stable_increment(const Block& block, int pack, const ExplicitCycle& cycle) const;
  void begin(Block& block, const ExplicitCycle& cycle) const;
  void finish(const Block& block, const ExplicitCycle& cycle, std::span<double> history, StableIncrement& stable) const;

  template <class T>
  bool internal_force(std::int32_t element, double increment, const typename MembraneKernel<T, corners, points>::Edges& edge,
                      std::span<double> history, typename MembraneKernel<T, corners, points>::Edges& force) const;

  MembraneSection section_data_;
  AlignedVector<double> reference_;  // Layout::size packs per pack of elements
  std::vector<double> nodal_area_;   // of each element
};

}  // namespace balocco
