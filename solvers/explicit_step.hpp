// The phases of an explicit cycle, as the loop (explicit_loop.cpp) names them, and what they share during a step.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "elements/failure.hpp"
#include "explicit_bodies.hpp"
#include "explicit_contact.hpp"
#include "explicit_folding.hpp"
#include "explicit_gyroscopic.hpp"
#include "explicit_linkages.hpp"
#include "explicit_motion.hpp"
#include "explicit_nodes.hpp"
#include "explicit_scale.hpp"
#include "explicit_time.hpp"
#include "explicit_timers.hpp"
#include "mass_scaling.hpp"
#include "rounding_energy.hpp"
#include "thermal_strains.hpp"

namespace balocco {

/// Between cycles the State stands like this: positions, history and contact at `step_time`; velocities in the middle
/// of the increment to come, whose length is State::time_increment. A restart needs nothing else. At the end of the
/// step that increment is zero, so velocities are those of the end.
class ExplicitStep {
 public:
  /// Collective. @throws InputError on every rank alike.
  ExplicitStep(Analysis& analysis, const Step& step, Observer& observer);

  bool starts_afresh() const { return analysis_.current.increment == 0; }
  /// Masses stay what they were when the step began.
  bool fixed_masses() const { return procedure_.variable_mass_scaling.empty(); }
  bool finished() const { return analysis_.current.step_time >= step_.duration(); }

  /// Attachments, initial velocities and everything else that happens once when a step begins.
  void prepare_start();
  /// Tells how far the state is from equilibrium: exactly zero but for the tolerance of the steps before.
  void log_balance();
  void log_resting_elements() const;
  void log_dependent_constraints() const;

  void advance_positions();
  void begin_external_loads();
  void add_interface_elements();
  void begin_halo();
  void add_interior_elements();
  /// Behind the elements: masses that *VARIABLE MASS SCALING changes, and all that follows from them.
  void scale_masses();
  /// Elements that failed in this cycle have no force from the next on.
  void rest_failed_elements();
  void add_mesh_contact();
  void add_soft_contact();
  void finish_halo();
  void add_damping();
  /// Agrees over all ranks on the next increment and on whether the observer wants to be called; finds what is prescribed over it.
  /// @throws AnalysisError where the run has blown up or the increment collapsed.
  void choose_increment();
  /// Behind choose_increment: springs that answer to the motion over the next increment.
  void add_stiff_contact();
  /// Behind choose_increment, which tells what is prescribed over the next increment and whether the observer wants reactions.
  void sum_body_forces();
  /// Forces of constraints, when all others are known.
  void satisfy_constraints();
  void update_velocities();
  /// Calls the observer if it is due, but never with a run that has failed. @return false if it wants the run to stop.
  /// @throws AnalysisError where it has: blown up, or its energy balance lost.
  bool observe();
  void fill_output();
  /// Copies of nodes that took no part in the step move to where their owners' are: steps to come may need them. Collective.
  void bring_idle_copies();
  /// What later energies are compared with.
  void start_energy_balance();
  /// Collective.
  void log_deleted_elements() const;
  void log_mass_scaling() const;
  void log_timers() const;

  PhaseTimers timers;

 private:
  Instant instant() const;
  /// Of connectors without a law, which have no forces.
  bool measures_alone(const ElementGroup& group) const;
  void add_elements(Portion portion);
  void refuse_loads_without_inertia() const;
  bool is_idle_copy(std::int32_t node) const;
  void find_neighbours();
  void find_loaded_nodes();
  /// Of any rank.
  RigidDynamics::Uses uses_of_nodes() const;
  void list_acting_nodes(const RigidDynamics::Uses& uses);
  void list_drifting_nodes();
  /// Of forces and moments, external ones too.
  void set_rounding_constants();
  /// Where connectors have left what their bounds hold for. Collective.
  void renew_restraints();
  /// Takes over masses that have changed.
  void renew_inertia();
  void look_at_mass_scaling(double previous_time);
  /// Tells elements what springs and contact add to them.
  void tell_added_bounds();
  /// The limit of the elements, and that of what moves without any of them, with the springs of contact with free masters, which act on
  /// both. Collective where there are such.
  double limit_beside(double of_elements) const;
  NodalForces forces() { return {force_.data(), moment_.data()}; }
  std::span<const std::int32_t> loaded_turning_nodes() const { return std::span(loaded_nodes_).first(loaded_turning_); }
  /// What the halo sums: forces, and external ones if there are any.
  std::array<NodalForces, 2> summed_forces() { return {forces(), external_forces()}; }
  NodalForces external_forces() { return {external_force_.data(), external_moment_.data()}; }
  /// Adds the work of external and damping forces over half an increment.
  void add_half_work(double increment, std::vector<NodalWork>& work) const;
  void remember_blow_up();
  void report_failure();
  /// @throws AnalysisError where energy came from nowhere or went nowhere. Collective.
  void check_energy_balance();
  /// Collective.
  void find_negligible_energy();
  bool lands() const;
  /// Whether anybody looks at the state when the cycle has ended; alike on all ranks.
  bool is_observed() const { return attention_ || finished() || lands(); }
  /// The new velocities of nodes, without constraints; where nobody looks, their new positions too. @return false: the run has blown up.
  bool move_nodes(const Instant& now);
  [[noreturn]] void report_collapse();
  /// Whenever somebody looks: the first folded element and the first that has turned inside out are told; those that are so when the step
  /// ends make it fail. In between they may recover, as a tyre's do that a blow has crushed.
  void watch_folding();
  /// In regular increments and at the end: the first element that shortens the increments much is told. Collective.
  void watch_increment();
  void tell_first(bool& told, const std::optional<FoldedCorner>& found, const std::function<std::string(std::int64_t)>& text);
  Progress progress() const;

  Analysis& analysis_;
  const Step& step_;
  const ExplicitProcedure& procedure_;
  Observer& observer_;
  double total_time_at_start_ = 0.0;  // of the step
  MassScalingOfStep mass_scaling_;
  RigidDynamics bodies_;
  ElementFailures failures_;
  NodalConstraints constraints_, rotation_constraints_;
  GyroscopicNodes gyroscopic_;
  InverseInertia inverse_;  // zero for nodes that bodies, tensors or linkages move
  ExplicitLinkages linkages_;
  NodalRestraints restraints_;
  RestraintBound restraint_bound_;
  ForceScale scale_;
  TimeControl control_;
  ExplicitContact contact_;
  ThermalStrains thermal_;
  bool temperatures_move_ = false;
  bool has_loads_ = false;  // of any rank
  std::vector<SharedNodes> neighbours_;  // with the nodes at which they need each other's forces
  std::optional<Halo> halo_;             // of forces, and of external forces where there are loads

  std::vector<double> force_, external_force_, damping_force_;  // 4 a node; external, damping: empty where there is none
  // Of nodes that turn; moments as long as forces, so that both have the scratch node in one place, or empty:
  std::vector<double> moment_, external_moment_, damping_moment_;
  std::vector<std::int32_t> loaded_nodes_;  // on which external forces may act, sorted
  std::size_t loaded_turning_ = 0;          // the first of them turn
  std::vector<NodeRun> acting_, acting_turning_;  // nodes that forces may move, and those of them that turn
  std::vector<NodeRun> drifting_;                 // nodes that turn by themselves
  std::vector<Point> moments_;                    // external, per rigid body
  LocalStability stability_;
  double next_increment_ = 0.0, last_increment_ = 0.0;
  RoundingEnergy rounding_energy_;
  double negligible_energy_ = 0.0;       // when the balance was checked last
  bool checked_before_landing_ = false;  // the energy balance
  bool told_folded_ = false, told_inside_out_ = false, told_short_ = false;  // by this run
  bool attention_ = true;               // the observer looks at this increment, and always at the start
  std::vector<bool> measures_alone_;    // by element group
  bool scales_masses_ = false;          // at the end of this increment
  bool nodes_are_ahead_ = false;        // they have moved over the increment to come, and their forces are cleared
  std::int64_t cycles_ = 0;             // computed by this run, which may have been restarted in mid-step
  std::optional<std::string> failure_;  // found by this rank, told to all in the next agreement
};

}  // namespace balocco
