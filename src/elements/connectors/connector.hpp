// CONN3D2: what resists the relative motions that a connector leaves. What it holds is a constraint (constraints/joint.hpp).
// Relative motions are functions of the frames of the two nodes; forces are their gradients times the component's force, so they do
// the same work and balance each other with their moments. Source of the kinds and their components: Abaqus Analysis User's Guide,
// "Connector elements".
#pragma once

#include <optional>

#include "constraints/relative_motion.hpp"
#include "elements/element_group.hpp"
#include "elements/springs/force_curve.hpp"

namespace balocco {

/// Whether the nodes of such a connector turn: it measures or holds something in their frames.
bool turns_nodes(const Connector& connector);

class ConnectorGroup : public ElementGroup {
 public:
  explicit ConnectorGroup(const GroupInput& input);

  int history_size() const override { return 20; }
  void initialize_history(std::span<double> history) const override;
  void lumped_volume(std::int32_t element, std::span<double> volume) const override;
  double density() const override { return 0.0; }
  void lumped_rotary_inertia(std::int32_t element, std::span<double> inertia) const override;
  void material_rotary_inertia(std::int32_t element, std::span<double> tensors) const override;
  StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle, std::span<double> history) const override;
  bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history, std::span<double> new_history,
                 std::span<double> force, std::span<double> stiffness) const override;
  /// Components along the first node's axes alone put no moment on the second.
  bool turns_node(int end) const override { return end == 0 ? freedoms_per_node_ == 6 : connector_.rotation != Connector::Rotation::none; }
  Restraint restraint(std::int32_t element) const override;
  Restraint rotary_restraint(std::int32_t element) const override;
  void set_reach(const NodalMotion& motion, std::span<double> history) override;
  void restore_reach(std::span<const double> history) override;
  bool is_beyond_reach(const NodalMotion& motion) const override;
  ElementEnergies energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history) const override;
  int integration_points() const override { return 1; }
  std::size_t bytes_per_element() const override { return sizeof(Reference) + 2 * sizeof(std::int32_t); }

 private:
  using Six = std::array<double, 6>;
  struct Reference {
    RelativeMotion relative;
    Six stretched{};  // relative motion at the start from where there is no force
  };
  /// Relative motions and their gradients by the 12 motions of the nodes.
  struct Kinematics {
    Six motion{};
    std::array<std::array<double, 12>, 6> gradient{};
  };
  struct Pull {
    Six force{};                                 // elastic and viscous
    Six elastic{};
    std::array<Six, 6> slope{};                  // by the relative motions at the end of the increment
  };
  struct Rate {
    Six velocity{};
    double slope = 0.0;  // by the relative motions; 0: no rate is known
  };

  std::array<NodePlace, 2> places(std::int32_t element, const NodalMotion& motion) const;
  Kinematics kinematics(std::int32_t element, const NodalMotion& motion, std::span<const double> old_motion) const;
  void add_curvature(std::int32_t element, const NodalMotion& motion, const Six& force, std::span<double> stiffness) const;
  Six stretch(std::int32_t element, const Six& motion) const;
  static Rate mean_rate(const Six& motion, std::span<const double> old_motion, double increment);
  Rate rate(std::int32_t element, const Kinematics& now, const NodalMotion& motion, std::span<const double> old_motion) const;
  Pull pull(std::int32_t element, const Six& motion, const Rate& rate) const;
  void update(const Kinematics& now, const Pull& pulled, std::span<const double> old_history, std::span<double> new_history) const;
  Restraint bound(std::int32_t element, int first) const;
  double arm(std::int32_t element, int component) const;
  double distance(std::int32_t element, const NodalMotion& motion) const;
  bool has_growing_arm() const;
  void add_force(std::int32_t element, const ExplicitCycle& cycle, std::span<double> history) const;
  bool turns() const { return freedoms_per_node_ == 6; }
  Six coupled(const std::vector<double>& matrix, const Six& motion) const;

  int point_components(std::string_view variable) const override;
  void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                    std::span<const double> history, std::span<double> values) const override;

  const Connector& connector_;
  std::vector<Reference> references_;
  std::vector<double> reach_;  // distances of the nodes up to which the restraints hold; empty: they hold anywhere
  double least_reach_ = 0.0;
  std::array<std::optional<ForceCurve>, 6> elasticity_, damping_;
  bool pulls_ = false;  // by some law; else it is measured alone
};

}  // namespace balocco
