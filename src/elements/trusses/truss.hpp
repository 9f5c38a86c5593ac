// Truss T3D2: a straight bar of uniaxial stress between two nodes, any stretch and rotation.
#pragma once

#include <vector>

#include "elements/aligned_vector.hpp"
#include "elements/element_group.hpp"
#include "materials/initial_stress.hpp"

namespace balocco {

/// History of an element: the law's, its stretch l / L, the energy dissipated by viscosity, and with stiffness-proportional damping
/// its Green strain.
class TrussGroup final : public ElementGroup {
 public:
  /// @throws InputError if the material is missing or has no uniaxial law, the area is not positive or the nodes coincide.
  explicit TrussGroup(const GroupInput& input);

  int history_size() const override;
  int law_field_row(std::string_view field, int) const override { return field_row(*law_, field); }
  void initialize_history(std::span<double> history) const override;
  void lumped_volume(std::int32_t element, std::span<double> volume) const override;
  double density() const override { return density_; }
  StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                             std::span<double> history) const override;
  bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                 std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const override;
  ElementEnergies energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history) const override;
  int point_components(std::string_view variable) const override;
  void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                    std::span<const double> history, std::span<double> values) const override;
  int integration_points() const override { return 1; }
  std::size_t bytes_per_element() const override;

 private:
  using Batch = PointBatch<PointKind::line>;
  struct Pulled;  // stress of a pack and what it does to the stable increment

  int stretch_row() const { return law_->history_size(); }
  int dissipation_row() const { return stretch_row() + 1; }
  int viscous_row() const { return dissipation_row() + 1; }
  int strain_row() const { return viscous_row() + 1; }
  bool damped() const { return damping_beta_ > 0.0; }
  double reference_length(std::int32_t element) const { return length_[element]; }
  double strain_at(std::int32_t element, const double* position) const;
  void set_undeformed_moduli();
  void add_block(const PackRun& block, const ExplicitCycle& cycle, std::span<double> history, StableIncrement& stable) const;
  Pulled pull(const Batch& batch, std::int32_t first, int slot, const ExplicitCycle& cycle, std::span<double> history) const;

  std::unique_ptr<Law<PointKind::line>> law_;
  double area_ = 0.0, density_ = 0.0, damping_beta_ = 0.0;
  double initial_modulus_ = 0.0;  // dS/dE in the undeformed state
  double initial_bound_ = 0.0;    // what the law bounds it with
  AlignedVector<double> length_;   // reference lengths, padded
};

}  // namespace balocco
