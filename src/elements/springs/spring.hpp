// SPRINGA, SPRING1, SPRING2 and DASHPOTA, DASHPOT1, DASHPOT2: a force over one relative displacement or its rate.
//
//   SPRINGA, DASHPOTA   along the line between two nodes, wherever it turns: u = l - L, tension positive
//   SPRING1, DASHPOT1   a degree of freedom of one node against the ground:  u = a1 . u1
//   SPRING2, DASHPOT2   degrees of freedom of two nodes:                     u = a1 . u1 - a2 . u2
// with unit vectors a along *ORIENTATION, or else the node's *TRANSFORM directions. Degrees of freedom 4 to 6 are components of the
// accumulated rotation vector UR, and f is a moment. Springs exert f(u), dashpots f(du/dt), where the
// rate is the mean over the increment in both procedures (Abaqus Analysis User's Guide, "Springs" and "Dashpots").
#pragma once

#include <array>
#include <vector>

#include "elements/element_group.hpp"
#include "elements/springs/force_curve.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// History of an element: its relative displacement, its force, and the energy that it has dissipated.
class SpringGroup final : public ElementGroup {
 public:
  /// @throws InputError if the nodes of an axial element coincide.
  explicit SpringGroup(const GroupInput& input);

  int history_size() const override { return 3; }
  void initialize_history(std::span<double> history) const override;
  void lumped_volume(std::int32_t element, std::span<double> volume) const override;
  double density() const override { return 0.0; }
  StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                             std::span<double> history) const override;
  bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                 std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const override;
  ElementEnergies energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history) const override;
  Restraint restraint(std::int32_t element) const override { return turns() ? Restraint{} : bound(element); }
  Restraint rotary_restraint(std::int32_t element) const override { return turns() ? bound(element) : Restraint{}; }
  int integration_points() const override { return 1; }
  /// Whether it may act along `direction` (unit; about it where it turns its nodes) on its node number `end`.
  bool acts_along(std::int32_t element, int end, const std::array<double, 3>& direction) const;
  std::size_t bytes_per_element() const override;

 private:
  /// The relative displacement, and its first and second derivative with respect to the places (rotations) of the nodes.
  struct Elongation {
    double value = 0.0;
    std::array<Vector3<double>, 2> gradient{};
    double curvature = 0.0;  // 1 / length of an axial element, whose line turns; else 0
  };
  struct Pull {
    double force = 0.0, slope = 0.0;  // slope with respect to the relative displacement at the end of the increment
  };

  bool turns() const { return freedoms_per_node_ == 6; }
  Restraint bound(std::int32_t element) const;
  int first_freedom() const { return turns() ? 3 : 0; }
  void find_axial_lengths(const GroupInput& input);
  void find_directions(const GroupInput& input);
  Elongation elongation(std::int32_t element, const NodalMotion& motion) const;
  void add_force(std::int32_t element, const ExplicitCycle& cycle, std::span<double> history) const;
  Pull pull(double elongation, double old_elongation, double increment) const;
  /// Implicit dynamics know the rate itself, other procedures its mean over the increment.
  Pull pull(std::int32_t element, const Elongation& now, const NodalMotion& motion, double old_elongation) const;
  int point_components(std::string_view variable) const override;
  void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                    std::span<const double> history, std::span<double> values) const override;

  ForceCurve curve_;
  bool viscous_, axial_;
  std::vector<double> origin_;  // axial: reference length; translations: a1 . X1 - a2 . X2; rotations: 0
  std::vector<std::array<Vector3<double>, 2>> direction_;  // a1 and -a2; empty for axial elements
};

}  // namespace balocco
