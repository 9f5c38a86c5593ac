#include "explicit_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "elements/bulk_viscosity.hpp"
#include "explicit_nodes.hpp"
#include "explicit_restraint_bound.hpp"
#include "explicit_start.hpp"
#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

/// Sum of the durations of the steps before, the same after a restart.
double time_before(const Model& model, std::int32_t step) {
  double time = 0.0;
  for (std::int32_t i = 0; i < step; ++i) time += model.steps[i].duration();
  return time;
}

/// What a constructor refuses on one rank is refused on all.
template <class T, class... Arguments>
T make_together(const Analysis& analysis, Arguments... arguments) {
  std::optional<T> made;
  analysis.communicator.together([&] { made.emplace(analysis, arguments...); });
  return std::move(*made);
}

void find_inverse(const Analysis& analysis, const GyroscopicNodes& gyroscopic, InverseInertia& inverse) {
  const auto of = [](double inertia) { return inertia > 0.0 ? 1.0 / inertia : 0.0; };
  const auto& inertia = analysis.scaled_inertia();
  inverse.mass.resize(inertia.mass.size());
  inverse.rotary.resize(inertia.rotary.size());
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node) {
    const bool moved_by_body = analysis.carrier(node) >= 0 || analysis.reference_of(node) >= 0;
    inverse.mass[node] = moved_by_body ? 0.0 : of(inertia.mass[node]);
  }
  for (std::int32_t node = 0; node < analysis.domain.turning; ++node) {
    const bool turned_otherwise = analysis.turning_body(node) >= 0 || gyroscopic.contains(node);
    inverse.rotary[node] = turned_otherwise ? 0.0 : of(inertia.rotary[node]);
  }
}

InverseInertia inverse_inertia(const Analysis& analysis, const GyroscopicNodes& gyroscopic) {
  InverseInertia inverse;
  find_inverse(analysis, gyroscopic, inverse);
  return inverse;
}

/// How far bodies and linkages give way to springs depends on where they stand: what was found when the step began, or masses were
/// scaled last, holds on, also after a restart.
RestraintBound bound_of_step(Analysis& analysis, const NodalRestraints& restraints, const RigidDynamics& bodies, ExplicitLinkages& linkages) {
  auto& state = analysis.current;
  if (state.increment > 0) return {{state.restraint_omega_square, state.restraint_rate}};
  const auto bound = find_restraint_bound(analysis, restraints, bodies, linkages);
  state.restraint_increment = bound.increment();
  return bound;
}

/// Attachments come first of all: what follows depends on who carries which node.
const Step& started(Analysis& analysis, const Step& step) {
  const bool afresh = analysis.current.increment == 0;
  afresh ? analysis.start_step(step) : analysis.apply_interactions();
  afresh ? place_restraints(analysis) : replace_restraints(analysis);
  return step;
}

}  // namespace

ExplicitStep::ExplicitStep(Analysis& analysis, const Step& step, Observer& observer)
    : analysis_(analysis),
      step_(started(analysis, step)),
      procedure_(std::get<ExplicitProcedure>(step.procedure)),
      observer_(observer),
      total_time_at_start_(time_before(analysis.model, analysis.current.step)),
      mass_scaling_(analysis, step),
      bodies_(analysis, step),
      failures_(analysis.element_groups),
      constraints_(make_together<NodalConstraints>(analysis, std::ref(step), NodalFreedom::translation)),
      rotation_constraints_(make_together<NodalConstraints>(analysis, std::ref(step), NodalFreedom::rotation)),
      gyroscopic_(make_together<GyroscopicNodes>(analysis, std::ref(step))),
      inverse_(inverse_inertia(analysis, gyroscopic_)),
      linkages_(analysis, step, constraints_, rotation_constraints_, gyroscopic_, bodies_, inverse_),
      restraints_(nodal_restraints(analysis)),
      restraint_bound_(bound_of_step(analysis, restraints_, bodies_, linkages_)),
      scale_(force_scale(analysis, step, restraints_)),
      control_(step),
      contact_(analysis, step, constraints_, bodies_, inverse_.mass),
      thermal_(analysis),
      moments_(analysis.model.rigid_bodies.size()),
      rounding_energy_(analysis) {
  temperatures_move_ = thermal_.move_in(step);
  const auto nodes = static_cast<std::size_t>(analysis.domain.size());
  force_.assign(4 * (nodes + 1), 0.0);
  if (analysis.domain.turning > 0) moment_.assign(force_.size(), 0.0);
  set_rounding_constants();
  const bool damped = std::any_of(analysis.scaled_inertia().damping.begin(), analysis.scaled_inertia().damping.end(),
                                  [](double c) { return c > 0.0; });
  if (analysis.communicator.any(damped)) {
    damping_force_.assign(4 * nodes, 0.0);
    damping_moment_.assign(analysis.current.rotation.size(), 0.0);
  }
  analysis.communicator.together([&] {
    refuse_loads_without_inertia();
    refuse_massless_restraints(analysis, step, linkages_);
  });
  tell_added_bounds();
  constexpr int most_passes = 4;  // masses change what is added to them
  for (int pass = 0; starts_afresh() && pass < most_passes && mass_scaling_.allow_for_added_bounds(analysis); ++pass) renew_inertia();
  for (const auto& group : analysis.element_groups) measures_alone_.push_back(measures_alone(*group));
  find_neighbours();
  find_loaded_nodes();
  const auto uses = uses_of_nodes();
  bodies_.rest_nodes(analysis, uses);
  list_acting_nodes(uses);
  list_drifting_nodes();
  if (has_loads_) {
    external_force_ = force_;
    external_moment_ = moment_;
  }
  halo_.emplace(analysis.communicator, neighbours_, analysis.domain.turning, Halo::Tag::step, has_loads_ ? 2 : 1);
}

Instant ExplicitStep::instant() const {
  const auto& state = analysis_.current;
  return {state.step_time, state.total_time, last_increment_, next_increment_};
}

void ExplicitStep::prepare_start() {
  auto& state = analysis_.current;
  state.time_increment = 0.0;
  last_increment_ = next_increment_ = 0.0;
  const auto before = analysis_.model.general_step_before(state.step);
  const bool follows_static =  // an import may bring motion along
      before < 0 ? !state.dynamic : !analysis_.model.steps[before].is_dynamic();
  if (follows_static) {
    std::fill(state.velocity.begin(), state.velocity.end(), 0.0);
    std::fill(state.angular_velocity.begin(), state.angular_velocity.end(), 0.0);
    for (auto& body : state.rigid_bodies) body.velocity = body.angular_velocity = {};
  }
  analysis_.communicator.together([&] {
    constraints_.refuse_jumps(analysis_);
    rotation_constraints_.refuse_jumps(analysis_);
    bodies_.refuse_jumps(analysis_);
  });
  if (!state.dynamic) apply_initial_velocities(analysis_, step_, observer_);
  if (!state.dynamic || follows_static) {
    constraints_.set_initial_velocities(analysis_, step_, instant());
    rotation_constraints_.set_initial_velocities(analysis_, step_, instant());
    bodies_.set_initial_velocities(analysis_, instant());
  }
  analysis_.communicator.together([&] { linkages_.make_velocities_consistent(analysis_); });
  contact_.choose_springs(analysis_);
  thermal_.set(analysis_, step_, state.step_time, state.total_time);
  if (!state.dynamic) contact_.report_overclosure(analysis_, observer_);
  if (!state.dynamic) check_rolling_radius(analysis_, step_, observer_);
  state.dynamic = true;
}

void ExplicitStep::advance_positions() {
  auto& state = analysis_.current;
  const double increment = state.time_increment;
  timers.measure(Phase::update, [&] {
    if (!nodes_are_ahead_)
      for (const auto run : acting_) drift(run.of(state.position), run.of(state.velocity), increment);
    for (const auto run : drifting_) drift_rotations(run.of(state.orientation), run.of(state.rotation), run.of(state.angular_velocity), increment);
  });
  timers.measure(Phase::bodies, [&] { bodies_.advance(analysis_, increment); });
  const double previous_time = state.step_time;
  state.step_time = control_.time_after(state.step_time, increment);
  state.total_time = total_time_at_start_ + state.step_time;
  ++state.increment;
  if (temperatures_move_)
    timers.measure(Phase::loads, [&] { thermal_.set(analysis_, step_, state.step_time, state.total_time); });
  look_at_mass_scaling(previous_time);
  ++cycles_;
  last_increment_ = increment;
}

void ExplicitStep::begin_external_loads() {
  const auto& state = analysis_.current;
  timers.measure(Phase::loads, [&] {
    if (!nodes_are_ahead_)
      for (const auto run : acting_) clear_vectors(run.of(force_));
    clear_vectors(std::span(force_).last(4));  // of the scratch node
    nodes_are_ahead_ = false;
    for (const auto run : acting_turning_) clear_vectors(run.of(moment_));
    stability_ = {};
    if (!has_loads_) return;
    std::fill(moments_.begin(), moments_.end(), Point{});
    clear_vectors(external_force_, loaded_nodes_);
    clear_vectors(std::span(external_force_).last(4));  // of the scratch node
    clear_vectors(external_moment_, loaded_turning_nodes());
    add_external_forces(analysis_, step_, state.step_time, state.total_time, state.position.data(), external_forces(),
                        moments_, CarriedGravity::left_out);
  });
}

void ExplicitStep::add_elements(Portion portion) {
  auto& state = analysis_.current;
  const ExplicitCycle cycle{.motion = state.motion(),
                            .forces = forces(),
                            .increment = last_increment_,
                            .linear_bulk_viscosity = procedure_.linear_bulk_viscosity,
                            .quadratic_bulk_viscosity = procedure_.quadratic_bulk_viscosity};
  for (std::size_t index = 0; index < analysis_.element_groups.size(); ++index) {
    const auto& group = *analysis_.element_groups[index];
    const auto stable = group.add_forces(portion, cycle, state.element_history[index]);
    if (stable.element >= 0)
      stability_.merge(stable.increment, analysis_.model.elements[group.table()].id[group.row(stable.element)]);
  }
}

void ExplicitStep::add_interface_elements() {
  timers.measure(Phase::elements, [&] { add_elements(Portion::interface); });
}

void ExplicitStep::begin_halo() {
  timers.measure(Phase::halo, [&] { halo_->begin_sum(summed_forces()); });
}

void ExplicitStep::add_interior_elements() {
  timers.measure(Phase::elements, [&] { add_elements(Portion::interior); });
}

void ExplicitStep::renew_inertia() {
  bodies_.renew_inertia(analysis_);
  gyroscopic_.renew_inertia(analysis_);
  find_inverse(analysis_, gyroscopic_, inverse_);
  linkages_.renew_inertia(analysis_, inverse_);
  contact_.renew_inertia(analysis_, bodies_, inverse_.mass);
  restraint_bound_ = find_restraint_bound(analysis_, restraints_, bodies_, linkages_);
  tell_added_bounds();
}

void ExplicitStep::add_mesh_contact() {
  timers.measure(Phase::contact, [&] { contact_.add_mesh_forces(analysis_, {.previous = last_increment_, .next = last_increment_}, force_.data()); });
}

void ExplicitStep::add_soft_contact() {
  timers.measure(Phase::contact, [&] { contact_.add_forces(analysis_, force_.data()); });
}

void ExplicitStep::add_stiff_contact() {
  timers.measure(Phase::contact, [&] {
    contact_.add_stiff_forces(analysis_, instant(), force_.data());
  });
}

void ExplicitStep::finish_halo() {
  timers.measure(Phase::halo, [&] { halo_->finish_sum(summed_forces()); });
  timers.measure(Phase::loads, [&] {
    if (!has_loads_) return;
    add_vectors(force_, external_force_, loaded_nodes_);
    add_vectors(moment_, external_moment_, loaded_turning_nodes());
  });
}

void ExplicitStep::add_damping() {
  if (damping_force_.empty()) return;
  timers.measure(Phase::update, [&] {
    add_mass_damping(force_, damping_force_, analysis_.scaled_inertia().damping, analysis_.current.velocity);
    add_mass_damping(moment_, damping_moment_, analysis_.scaled_inertia().rotary_damping, analysis_.current.angular_velocity);
  });
}

void ExplicitStep::sum_body_forces() {
  using Which = RigidDynamics::Which;
  const Which which = attention_ || finished() ? Which::all : Which::that_need_it;
  timers.measure(Phase::bodies, [&] { bodies_.sum_forces(analysis_, forces(), moments_, instant(), which); });
}

void ExplicitStep::satisfy_constraints() {
  if (linkages_.empty()) return;
  timers.measure(Phase::bodies, [&] {
    rotation_constraints_.find_velocities(analysis_, step_, instant());
    try {
      linkages_.find_motion(analysis_, instant(), forces());
    } catch (const AnalysisError& error) {  // of this rank's linkages: told to all in the next agreement
      failure_ = error.what();
    }
  });
}

void ExplicitStep::choose_increment() {
  timers.measure(Phase::increment, [&] {
    auto& state = analysis_.current;
    const bool attention = observer_.next_due() <= state.step_time || state.increment % regular_increments == 0;
    std::array<double, 4> agreed{-stability_.increment, attention ? 1.0 : 0.0, failure_ ? 1.0 : 0.0,
                                 restraints_are_left(analysis_) ? 1.0 : 0.0};
    analysis_.communicator.maximum(std::span<double>(agreed));
    if (agreed[2] > 0.0) report_failure();
    if (-agreed[0] < collapsing * analysis_.undeformed_increment) report_collapse();
    attention_ = agreed[1] > 0.0;
    if (agreed[3] > 0.0) renew_restraints();
    const double limit = limit_beside(-agreed[0]);
    next_increment_ = control_.next_increment(state, last_increment_, limit);
    constraints_.find_velocities(analysis_, step_, instant());
  });
}

double ExplicitStep::limit_beside(double of_elements) const {
  const double of_masters = contact_.frequency_squared_of_masters(analysis_);
  const FrequencyBound alone{restraint_bound_.omega_square + contact_.largest_nodal_frequency_squared() + of_masters,
                             restraint_bound_.rate};
  return std::min(combined_limit(of_elements, {.omega_square = of_masters}), neutral_increment(alone.omega_square, alone.rate));
}

void ExplicitStep::add_half_work(double increment, std::vector<NodalWork>& work) const {
  const double half = 0.5 * increment;
  const auto& state = analysis_.current;
  const auto power = [](const std::vector<double>& force, const std::vector<double>& velocity, std::size_t node) {
    const double *f = &force[4 * node], *v = &velocity[4 * node];
    return f[0] * v[0] + f[1] * v[1] + f[2] * v[2];
  };
  for (const auto node : loaded_nodes_) {
    work[node].external += half * power(external_force_, state.velocity, node);
    if (node < analysis_.domain.turning)
      work[node].external += half * power(external_moment_, state.angular_velocity, node);
  }
  for (std::size_t node = 0; 4 * node < damping_force_.size(); ++node)
    work[node].damping += half * power(damping_force_, state.velocity, node);
  for (std::size_t node = 0; 4 * node < damping_moment_.size(); ++node)
    work[node].damping += half * power(damping_moment_, state.angular_velocity, node);
}

void ExplicitStep::update_velocities() {
  auto& state = analysis_.current;
  const Instant now = instant();
  timers.measure(Phase::update, [&] {
    add_half_work(now.previous, state.nodal_work);
    linkages_.add_guide_work(analysis_, ExplicitLinkages::Half::last, now.previous, state.nodal_work);
    constraints_.find_reactions(analysis_, now, force_.data());
    rotation_constraints_.find_velocities(analysis_, step_, now);
    rotation_constraints_.find_reactions(analysis_, now, moment_.data());
    linkages_.add_to_reactions(constraints_, rotation_constraints_);
    linkages_.set_velocities(analysis_);
    bool sound = move_nodes(now);
    for (const auto run : acting_turning_)
      if (!kick(run.of(state.angular_velocity), run.of(moment_), run.of<1>(inverse_.rotary), now.average())) sound = false;
    if (!sound) remember_blow_up();
    linkages_.add_gyroscopic_moments(moment_.data());
    constraints_.enforce(analysis_, now);
    if (nodes_are_ahead_) constraints_.move_again(analysis_, now);
    rotation_constraints_.enforce(analysis_, now);
    gyroscopic_.accelerate(analysis_, step_, now, moment_.data());
  });
  timers.measure(Phase::bodies, [&] { bodies_.accelerate(analysis_, now, moments_); });
  timers.measure(Phase::update, [&] {
    add_half_work(now.next, state.nodal_work);
    linkages_.add_guide_work(analysis_, ExplicitLinkages::Half::next, now.next, state.nodal_work);
  });
  state.time_increment = next_increment_;
}

bool ExplicitStep::move_nodes(const Instant& now) {
  auto& state = analysis_.current;
  nodes_are_ahead_ = !is_observed();
  bool sound = true;
  for (const auto run : acting_) {
    const NodalPass nodes{run.of(state.position), run.of(state.velocity), run.of(force_), run.of<1>(inverse_.mass)};
    if (!(nodes_are_ahead_ ? kick_and_drift(nodes, now.average(), now.next) : kick(nodes.velocity, nodes.force, nodes.inverse_mass, now.average())))
      sound = false;
  }
  return sound;
}

}  // namespace balocco
