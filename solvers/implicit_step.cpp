#include "implicit_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraint_report.hpp"
#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

/// Increments that converge within this many iterations are easy: two in a row, and the next is longer.
constexpr int easy_iterations = 5;
constexpr double growth = 1.5, cutback = 0.25;

}  // namespace

ImplicitStep::ImplicitStep(Analysis& analysis, const Step& step, Observer& observer)
    : analysis_(analysis),
      step_(step),
      increments_(*step.implicit_increments()),
      observer_(observer),
      drive_{prescribed_motions(analysis, step), {}},
      system_(analysis, step, slots_of(drive_.motions)),
      solver_(system_.stiffness(), analysis, system_.map()),
      newton_(analysis, step, system_, solver_, drive_, observer),
      linear_(analysis, step, system_, solver_, drive_),
      thermal_(analysis),
      total_start_(analysis.current.total_time - analysis.current.step_time),
      failures_(analysis.element_groups) {
  drive_.fading.assign(system_.map().slots(), 0.0);
  time_points_ = asked_times(step);
  some_can_fail_ = analysis.communicator.any(failures_.any());
  if (some_can_fail_) failed_at_start_ = count_failures();
}

Outcome ImplicitStep::run() {
  const double begin = MPI_Wtime();
  find_start();
  observer_.step_started(analysis_, analysis_.current.step);
  observer_.log(fmt::format("step {} '{}': {}, {}, {} equations", analysis_.current.step + 1, step_.name, step_.procedure_name(),
                            follows_geometry() ? "finite displacements" : "linear geometry", system_.map().equations()));
  dependent_rows_ = of_all_ranks(analysis_, system_.map().dependent_constraint_rows());
  log_dependent_constraints(analysis_, dependent_rows_, observer_);
  if (!increments_.nonlinear_geometry && follows_geometry())
    observer_.log(system_.has_contact() ? "  warning: contact needs iterations: the step runs as if NLGEOM=YES"
                                        : "  warning: laws that remember, ropes, springs with tables or large displacements before need "
                                          "iterations: the step runs as if NLGEOM=YES");
  log_notes();
  const auto outcome = march();
  observer_.log(fmt::format("  {:.2f} s: {:.2f} s assembly, {:.2f} s linear solver ({} factorisations, {} matrix)", MPI_Wtime() - begin,
                            newton_.assembly_seconds(), solver_.seconds(), solver_.factorizations(),
                            solver_.symmetric() ? "symmetric" : "unsymmetric"));
  return outcome;
}

Outcome ImplicitStep::march() {
  auto& state = analysis_.current;
  // A step taken up again goes on with the increment that it had come to.
  const bool told = taken_up_ && state.time_increment != 0.0;
  double suggested = told ? state.time_increment : increments_.initial_increment;
  int easy = told && state.easy ? 1 : 0, failures = 0;
  while (remaining_time() > 0.0) {
    if (state.increment >= increments_.maximum_increments)
      fail(suggested,
           fmt::format("all {} increments are used up; allow more with *STEP, INC=", increments_.maximum_increments));
    const double time_increment = next_increment(suggested);
    thermal_.set(analysis_, step_, goal_of(time_increment).step_time, goal_of(time_increment).total_time);
    const auto result = attempt(time_increment);
    if (!result.converged) {
      suggested = cutback * time_increment;
      easy = 0;
      if (!newton_.mechanism().empty() && ++failures >= 3)
        throw AnalysisError(mechanism_message(step_, newton_.mechanism()));
      if (increments_.direct || suggested < increments_.minimum_increment) fail(time_increment, result.reason);
      observer_.log(
          fmt::format("  increment {}: {}; tried again with {:.4g}", state.increment + 1, result.reason, suggested));
      continue;
    }
    const auto goal = goal_of(time_increment);
    finish_increment(goal);
    observer_.log(fmt::format("  increment {}: step time {:.6g} of {:.6g}, {} iterations", state.increment,
                              state.step_time, step_.duration(), result.iterations));
    easy = result.iterations <= easy_iterations ? easy + 1 : 0;
    if (easy >= 2 && !increments_.direct)
      suggested =
          std::min({std::max(suggested, time_increment) * growth, increments_.maximum_increment, step_.duration()});
    state.time_increment = goal.ends_step ? 0.0 : suggested;
    state.easy = !goal.ends_step && easy > 0;
    const bool go_on = observer_.advanced(analysis_, {.increment = state.increment,
                                                      .step_time = state.step_time,
                                                      .total_time = state.total_time,
                                                      .time_increment = time_increment,
                                                      .iterations = result.iterations,
                                                      .largest_residual = result.largest_residual,
                                                      .step_finished = goal.ends_step});
    if (!go_on) return Outcome::stopped;
  }
  return Outcome::finished;
}

/// The suggested increment, or all that is left of the step, or up to the next time point, where the rest would not be worth an
/// increment.
double ImplicitStep::next_increment(double suggested) const {
  const double now = analysis_.current.step_time, rest = remaining_time();
  const double least = std::max(increments_.minimum_increment, 1e-9 * step_.duration());
  const auto mark = std::ranges::find_if(time_points_, [&](double time) { return time > now + 1e-9 * step_.duration(); });
  if (!increments_.direct && mark != time_points_.end() && *mark - now < rest - least && *mark - now - suggested < least)
    return *mark - now;
  return rest - suggested < least ? rest : suggested;
}

IncrementGoal ImplicitStep::goal_of(double time_increment) const {
  IncrementGoal goal;
  goal.ends_step = time_increment >= remaining_time();
  goal.step_time = goal.ends_step ? step_.duration() : analysis_.current.step_time + time_increment;
  goal.total_time = total_start_ + goal.step_time;
  goal.time_increment = time_increment;
  goal.starts_step = fresh_;
  goal.damping = viscosity(goal.step_time);
  return goal;
}

NewtonResult ImplicitStep::solve(IncrementGoal goal) {
  if (!follows_geometry()) return linear_.solve(goal);
  const auto guess = expected_motion(goal.time_increment);
  goal.guess = guess;
  auto result = newton_.converge(goal);
  if (!result.converged) {
    system_.restore(system_.start_of_increment());
    system_.begin_increment();
  }
  return result;
}

void ImplicitStep::find_starts_of_motions() {
  const auto& state = analysis_.current;
  for (auto& motion : drive_.motions) {
    const auto law = motion_law(analysis_.model, step_, *motion.condition, state.step_time, state.total_time);
    const double reached = system_.displacement(motion.slot);
    const bool begun = state.step_time > 0.0 && law.persistence > 0.0;
    motion.start = begun ? (reached - law.motion) / law.persistence : reached;
  }
}

/// What acts on each slot from outside, in its directions: loads, reactions of prescribed motions, fading forces. On
/// carried nodes (whose slots are absent) loads in global directions.
void ImplicitStep::find_applied_forces(double step_time, std::vector<double>& applied) const {
  const auto& map = system_.map();
  applied = system_.external();
  for (std::int32_t slot = 0; slot < map.first_multiplier(); ++slot) {
    if (map.role(slot) == ImplicitDofMap::Role::absent) continue;
    const auto first = slot - slot % 3;
    const auto& axes = map.directions(map.node_of(slot));
    const auto& load = system_.external();
    applied[slot] =
        axes(slot % 3, 0) * load[first] + axes(slot % 3, 1) * load[first + 1] + axes(slot % 3, 2) * load[first + 2];
    if (map.role(slot) == ImplicitDofMap::Role::prescribed) applied[slot] += residual_[slot];
    applied[slot] += (1.0 - step_time / step_.duration()) * drive_.fading[slot];
  }
}

/// Work of the applied forces over the increment, by the trapezoidal rule, and what stabilisation dissipated.
void ImplicitStep::add_work(const IncrementGoal& goal) {
  const auto& map = system_.map();
  std::vector<double> applied;
  find_applied_forces(goal.step_time, applied);
  for (std::int32_t slot = 0; slot < map.first_multiplier(); ++slot) {
    const auto node = map.node_of(slot);
    const auto& axes = map.directions(node);
    const bool absent = map.role(slot) == ImplicitDofMap::Role::absent;
    const auto motion = system_.moved(slot);
    double moved = absent ? motion[slot % 3] : 0.0;
    for (int i = 0; i < 3 && !absent; ++i) moved += axes(slot % 3, i) * motion[i];
    analysis_.current.nodal_work[node].external += 0.5 * (applied_[slot] + applied[slot]) * moved;
    if (!absent && goal.damping > 0.0)
      analysis_.current.nodal_work[node].damping +=
          goal.damping / goal.time_increment * system_.stabilizing_mass(slot) * moved * moved;
  }
  applied_ = std::move(applied);
  system_.add_guide_work();
}

void ImplicitStep::finish_increment(const IncrementGoal& goal) {
  auto& state = analysis_.current;
  if (follows_geometry()) {
    residual_ = system_.residual();
    system_.commit();
  } else {
    residual_ = linear_.residual();
  }
  refuse_contradictions(analysis_, dependent_rows_, system_.model_size());
  refuse_failures();
  conclude(goal);
  fresh_ = false;
  state.step_time = goal.step_time;
  state.total_time = goal.total_time;
  ++state.increment;
  system_.begin_increment();
}

/// Only the explicit loop goes on without what fails.
void ImplicitStep::refuse_failures() const {
  const auto failed = some_can_fail_ ? count_failures() : 0;
  if (failed > failed_at_start_)
    throw AnalysisError(fmt::format("step '{}', increment {}: the plastic strain of *SHEAR FAILURE is reached in {} element{}, which {} "
                                    "does not delete; go on by *DYNAMIC, EXPLICIT from before that",
                                    step_.name, analysis_.current.increment + 1, failed - failed_at_start_,
                                    failed - failed_at_start_ == 1 ? "" : "s", step_.procedure_name()));
}

void ImplicitStep::fail(double time_increment, const std::string& reason) const {
  throw AnalysisError(fmt::format("step '{}', increment {} of {:.4g} at step time {:.6g}: {}", step_.name,
                                  analysis_.current.increment + 1, time_increment, analysis_.current.step_time,
                                  reason));
}

}  // namespace balocco
