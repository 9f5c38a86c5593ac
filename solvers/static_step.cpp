// A static step: automatic increments (Abaqus's rules) around Newton's method, and linear steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "constraint_report.hpp"
#include "materials/flow_stress.hpp"
#include "model/diagnostics.hpp"
#include "procedures.hpp"
#include "implicit_linear_solver.hpp"
#include "implicit_newton.hpp"
#include "implicit_prescribed.hpp"
#include "implicit_system.hpp"
#include "linear_statics.hpp"

namespace balocco {

namespace {

/// Increments that converge within this many iterations are easy: two in a row, and the next is longer.
constexpr int easy_iterations = 5;
constexpr double growth = 1.5, cutback = 0.25;

std::vector<std::int32_t> slots_of(const std::vector<PrescribedMotion>& motions) {
  std::vector<std::int32_t> slots;
  for (const auto& motion : motions) slots.push_back(motion.slot);
  return slots;
}

class StaticStep {
 public:
  StaticStep(Analysis& analysis, const Step& step, Observer& observer)
      : analysis_(analysis),
        step_(step),
        procedure_(std::get<StaticProcedure>(step.procedure)),
        observer_(observer),
        drive_{prescribed_motions(analysis, step), {}},
        system_(analysis, step, slots_of(drive_.motions)),
        solver_(system_.stiffness().matrix(), analysis, system_.map()),
        newton_(analysis, step, system_, solver_, drive_, observer),
        linear_(analysis, step, system_, solver_, drive_) {
    total_start_ = analysis.current.total_time - analysis.current.step_time;
  }

  Outcome run();

 private:
  void find_start();
  bool follows_geometry() const { return !analysis_.current.linear; }
  NewtonResult attempt(double time_increment);
  Outcome march();
  double next_increment(double suggested) const;
  [[noreturn]] void fail(double time_increment, const std::string& reason) const;
  void finish_increment(const IncrementGoal& goal);
  void add_work(const IncrementGoal& goal);
  void guess_damping(double time_increment);
  void choose_damping(std::span<const double> motion, double time_increment);
  void choose_damping_again();
  bool chooses_damping() const {
    return fresh_ && !taken_up_ && procedure_.stabilize && follows_geometry();
  }
  void find_applied_forces(const IncrementGoal& goal, std::vector<double>& applied) const;
  void store_reactions();
  void log_totals(double seconds);
  IncrementGoal goal_of(double time_increment) const;
  double remaining_time() const { return step_.duration() - analysis_.current.step_time; }

  Analysis& analysis_;
  const Step& step_;
  const StaticProcedure& procedure_;
  Observer& observer_;
  ImplicitDrive drive_;
  ImplicitSystem system_;
  ImplicitLinearSolver solver_;
  ImplicitNewton newton_;
  LinearStatics linear_;
  double total_start_ = 0.0;
  bool fresh_ = true;                                      // no increment of this step has been made in this run
  const bool taken_up_ = analysis_.current.increment > 0;  // from a checkpoint inside the step
  double damping_ = 0.0;
  std::vector<double> applied_;      // per slot: loads, reactions and fading forces at the end of the last increment
  std::vector<double> last_motion_;  // per slot, over the last increment of `last_increment_`
  double last_increment_ = 0.0;
  std::vector<std::int32_t> dependent_rows_;  // of State::multiplier
  std::vector<double> residual_;  // per slot, at the end of the last increment; reactions where prescribed
};

/// Where prescribed motions start, and which forces are out of balance because the step removed what balanced them.
void StaticStep::find_start() {
  const auto& state = analysis_.current;
  for (auto& motion : drive_.motions) {
    const auto law = motion_law(analysis_.model, step_, *motion.condition, state.step_time, state.total_time);
    const double reached = system_.displacement(motion.slot);
    const bool begun = state.step_time > 0.0 && law.persistence > 0.0;
    motion.start = begun ? (reached - law.motion) / law.persistence : reached;
  }
  const std::vector<double> still(system_.map().slots(), 0.0);
  const AssemblyRequest request{.step_time = state.step_time,
                                .total_time = state.total_time,
                                .initial_loads = state.step_time == 0.0,
                                .motion = still};
  const bool sound = follows_geometry() ? system_.assemble(request) : linear_.find_residual(request);
  if (!sound) throw AnalysisError(fmt::format("step '{}' cannot start: {}", step_.name, system_.trouble()));
  residual_ = follows_geometry() ? system_.residual() : linear_.residual();
  drive_.fading.assign(system_.map().slots(), 0.0);
  const double left = 1.0 - state.step_time / step_.duration();
  for (std::int32_t slot = 0; slot < system_.map().slots(); ++slot)
    if (system_.map().role(slot) == ImplicitDofMap::Role::free) drive_.fading[slot] = residual_[slot] / left;
  find_applied_forces({.step_time = state.step_time, .total_time = state.total_time}, applied_);
  system_.begin_increment();
}

Outcome StaticStep::run() {
  const double begin = MPI_Wtime();
  find_start();
  observer_.log(fmt::format("step {} '{}': static, {}, {} equations", analysis_.current.step + 1, step_.name,
                            follows_geometry() ? "finite displacements" : "linear geometry",
                            system_.map().equations()));
  dependent_rows_ = of_all_ranks(analysis_, system_.map().dependent_constraint_rows());
  log_dependent_constraints(analysis_, dependent_rows_, observer_);
  if (!procedure_.nonlinear_geometry && follows_geometry())
    observer_.log(system_.has_contact() ? "  contact needs iterations: the step runs as if NLGEOM=YES"
                                        : "  laws that remember, springs with tables or large displacements before need "
                                          "iterations: the step runs as if NLGEOM=YES");
  for (const auto& material : analysis_.model.materials)
    if (FlowStress::of(material).depends_on_rate())
      observer_.log(fmt::format("  note: material {} yields as at rate zero: static steps do not follow strain rates", material.name));
  if (procedure_.stabilize && !follows_geometry())
    observer_.log("  STABILIZE has nothing to stabilise in a linear step");
  if (taken_up_ && procedure_.stabilize) choose_damping_again();
  const auto outcome = march();
  log_totals(MPI_Wtime() - begin);
  return outcome;
}

Outcome StaticStep::march() {
  auto& state = analysis_.current;
  // A step taken up again goes on with the increment that it had come to.
  const bool told = taken_up_ && state.time_increment != 0.0;
  double suggested = told ? state.time_increment : procedure_.initial_increment;
  int easy = told && state.easy ? 1 : 0, failures = 0;
  while (remaining_time() > 0.0) {
    if (state.increment >= procedure_.maximum_increments)
      fail(suggested,
           fmt::format("all {} increments are used up; allow more with *STEP, INC=", procedure_.maximum_increments));
    const double time_increment = next_increment(suggested);
    const auto result = attempt(time_increment);
    if (!result.converged) {
      suggested = cutback * time_increment;
      easy = 0;
      if (!newton_.mechanism().empty() && ++failures >= 3)
        throw AnalysisError(mechanism_message(step_, newton_.mechanism()));
      if (procedure_.direct || suggested < procedure_.minimum_increment) fail(time_increment, result.reason);
      observer_.log(
          fmt::format("  increment {}: {}; tried again with {:.4g}", state.increment + 1, result.reason, suggested));
      continue;
    }
    const auto goal = goal_of(time_increment);
    finish_increment(goal);
    observer_.log(fmt::format("  increment {}: step time {:.6g} of {:.6g}, {} iterations", state.increment,
                              state.step_time, step_.duration(), result.iterations));
    easy = result.iterations <= easy_iterations ? easy + 1 : 0;
    if (easy >= 2 && !procedure_.direct)
      suggested =
          std::min({std::max(suggested, time_increment) * growth, procedure_.maximum_increment, step_.duration()});
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

/// The suggested increment, or all that is left of the step where the rest would not be worth an increment.
double StaticStep::next_increment(double suggested) const {
  const double rest = remaining_time();
  const double least = std::max(procedure_.minimum_increment, 1e-9 * step_.duration());
  return rest - suggested < least ? rest : suggested;
}

IncrementGoal StaticStep::goal_of(double time_increment) const {
  IncrementGoal goal;
  goal.ends_step = time_increment >= remaining_time();
  goal.step_time = goal.ends_step ? step_.duration() : analysis_.current.step_time + time_increment;
  goal.total_time = total_start_ + goal.step_time;
  goal.time_increment = time_increment;
  goal.starts_step = fresh_;
  goal.damping = damping_ * (1.0 - goal.step_time / step_.duration());
  return goal;
}

NewtonResult StaticStep::attempt(double time_increment) {
  auto goal = goal_of(time_increment);
  if (!follows_geometry()) return linear_.solve(goal);
  if (chooses_damping()) {
    guess_damping(time_increment);
    goal = goal_of(time_increment);
  }
  std::vector<double> guess;
  if (last_increment_ > 0.0) {
    guess = last_motion_;
    for (auto& q : guess) q *= time_increment / last_increment_;
    goal.guess = guess;
  }
  auto result = newton_.converge(goal);
  if (!result.converged) {
    system_.restore(system_.start_of_increment());
    system_.begin_increment();
  }
  return result;
}

/// Stabilising viscosity of the first increment: the given fraction of the average stiffness resists.
void StaticStep::guess_damping(double time_increment) {
  const std::vector<double> still(system_.map().slots(), 0.0);
  system_.assemble(
      {.step_time = analysis_.current.step_time, .total_time = analysis_.current.total_time, .motion = still});
  std::array<double, 2> mass{};
  for (const auto slot : system_.map().owned_free_slots()) {
    if (system_.map().is_multiplier(slot)) continue;
    mass[0] += system_.stabilizing_mass(slot) / (system_.lever(slot) * system_.lever(slot));
    mass[1] += 1.0;
  }
  analysis_.communicator.sum(std::span<double>(mass));
  if (mass[1] > 0.0)
    damping_ = procedure_.dissipated_energy_fraction * solver_.average_diagonal() * time_increment *
               mass[1] / mass[0];
}

/// Viscosity of the rest of the step: had it acted over the first increment alone, which moved the slots by `motion`,
/// it would have dissipated the given fraction of the work done on the structure.
void StaticStep::choose_damping(std::span<const double> motion, double time_increment) {
  std::array<double, 2> sums{};  // work, and sum of mass * motion^2
  for (const auto slot : system_.map().owned_slots()) {
    if (system_.map().role(slot) == ImplicitDofMap::Role::absent || system_.map().is_multiplier(slot)) continue;
    sums[0] += 0.5 * std::abs(applied_[slot] * motion[slot]);
    sums[1] += system_.stabilizing_mass(slot) * motion[slot] * motion[slot];
  }
  analysis_.communicator.sum(std::span<double>(sums));
  if (sums[0] > 0.0 && sums[1] > 0.0)
    damping_ = procedure_.dissipated_energy_fraction * sums[0] * time_increment / sums[1];
  observer_.log(
      fmt::format("  stabilised by viscous forces {:.4g} * mass * velocity, which fade over the step", damping_));
}

/// The first increment of a step that was taken up is gone. Work / (mass * motion^2) of a straight path does not depend
/// on how far it went: that of the whole way so far stands for it.
void StaticStep::choose_damping_again() {
  std::vector<double> way(system_.map().slots());
  for (std::int32_t slot = 0; slot < system_.map().slots(); ++slot) way[slot] = system_.displacement(slot);
  choose_damping(way, procedure_.initial_increment);
}

/// What acts on each slot from outside, in its directions: loads, reactions of prescribed motions, fading forces. On
/// carried nodes (whose slots are absent) loads in global directions.
void StaticStep::find_applied_forces(const IncrementGoal& goal, std::vector<double>& applied) const {
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
    applied[slot] += (1.0 - goal.step_time / step_.duration()) * drive_.fading[slot];
  }
}

/// Work of the applied forces over the increment, by the trapezoidal rule, and what stabilisation dissipated.
void StaticStep::add_work(const IncrementGoal& goal) {
  const auto& map = system_.map();
  std::vector<double> applied;
  find_applied_forces(goal, applied);
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
}

void StaticStep::store_reactions() {
  const auto& map = system_.map();
  std::ranges::fill(analysis_.reaction, 0.0);
  std::ranges::fill(analysis_.acceleration, 0.0);
  std::ranges::fill(analysis_.reaction_moment, 0.0);
  std::ranges::fill(analysis_.angular_acceleration, 0.0);
  std::ranges::fill(analysis_.body_angular_acceleration, Point{});
  std::ranges::fill(analysis_.body_reaction, std::array<double, 6>{});
  for (std::int32_t slot = 0; slot < map.first_multiplier(); ++slot) {
    if (map.role(slot) != ImplicitDofMap::Role::prescribed) continue;
    const auto node = map.node_of(slot);
    const auto body = analysis_.reference_of(node);
    for (int i = 0; i < 3; ++i) {
      const double component = map.directions(node)(slot % 3, i) * residual_[slot];
      if (!map.is_rotation(slot)) analysis_.reaction[4 * node + i] += component;
      if (map.is_rotation(slot) && body < 0) analysis_.reaction_moment[4 * node + i] += component;
      if (body >= 0) analysis_.body_reaction[body][map.is_rotation(slot) ? 3 + i : i] += component;
    }
  }
}

void StaticStep::finish_increment(const IncrementGoal& goal) {
  auto& state = analysis_.current;
  if (follows_geometry()) {
    residual_ = system_.residual();
    last_motion_ = newton_.increment();
    last_increment_ = goal.time_increment;
    system_.commit();
  } else {
    residual_ = linear_.residual();
  }
  refuse_contradictions(analysis_, dependent_rows_, system_.model_size());
  add_work(goal);
  store_reactions();
  if (chooses_damping()) choose_damping(newton_.increment(), goal.time_increment);
  fresh_ = false;
  state.step_time = goal.step_time;
  state.total_time = goal.total_time;
  ++state.increment;
  system_.begin_increment();
}

void StaticStep::fail(double time_increment, const std::string& reason) const {
  throw AnalysisError(fmt::format("step '{}', increment {} of {:.4g} at step time {:.6g}: {}", step_.name,
                                  analysis_.current.increment + 1, time_increment, analysis_.current.step_time,
                                  reason));
}

void StaticStep::log_totals(double seconds) {
  observer_.log(fmt::format("  {:.2f} s: {:.2f} s assembly, {:.2f} s linear solver ({} matrix)", seconds,
                            newton_.assembly_seconds(), solver_.seconds(), solver_.symmetric() ? "symmetric" : "unsymmetric"));
}

}  // namespace

Outcome run_static_step(Analysis& analysis, const Step& step, Observer& observer) {
  if (analysis.current.step_time == 0.0 && analysis.current.increment == 0) analysis.start_step(step);
  observer.step_started(analysis, analysis.current.step);
  return StaticStep(analysis, step, observer).run();
}

namespace {
const RegisterProcedure<StaticProcedure> registered(run_static_step);
}  // namespace

}  // namespace balocco
