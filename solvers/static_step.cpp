// A static step: equilibrium at the end of every increment, where *STATIC, STABILIZE says so against viscous forces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "implicit_step.hpp"
#include "materials/flow_stress.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

class StaticStep : public ImplicitStep {
 public:
  StaticStep(Analysis& analysis, const Step& step, Observer& observer)
      : ImplicitStep(analysis, step, observer), procedure_(std::get<StaticProcedure>(step.procedure)) {}

 private:
  void find_start() override;
  void log_notes() override;
  NewtonResult attempt(double time_increment) override;
  std::vector<double> expected_motion(double time_increment) const override;
  double viscosity(double step_time) const override { return damping_ * (1.0 - step_time / step_.duration()); }
  void conclude(const IncrementGoal& goal) override;
  void guess_damping(double time_increment);
  void choose_damping(std::span<const double> motion, double time_increment);
  void choose_damping_again();
  bool chooses_damping() const { return fresh_ && !taken_up_ && procedure_.stabilize && follows_geometry(); }

  const StaticProcedure& procedure_;
  double damping_ = 0.0;
  std::vector<double> last_motion_;  // per slot, over the last increment of `last_increment_`
  double last_increment_ = 0.0;
};

/// Where prescribed motions start, and which forces are out of balance because the step removed what balanced them.
void StaticStep::find_start() {
  const auto& state = analysis_.current;
  find_starts_of_motions();
  const std::vector<double> still(system_.map().slots(), 0.0);
  const AssemblyRequest request{.step_time = state.step_time,
                                .total_time = state.total_time,
                                .initial_loads = state.step_time == 0.0,
                                .motion = still};
  const bool sound = follows_geometry() ? system_.assemble(request) : linear_.find_residual(request);
  if (!sound) throw AnalysisError(fmt::format("step '{}' cannot start: {}", step_.name, system_.trouble()));
  residual_ = follows_geometry() ? system_.residual() : linear_.residual();
  const double left = 1.0 - state.step_time / step_.duration();
  for (std::int32_t slot = 0; slot < system_.map().slots(); ++slot)
    if (system_.map().role(slot) == ImplicitDofMap::Role::free && !system_.is_guided(slot)) drive_.fading[slot] = residual_[slot] / left;
  find_applied_forces(state.step_time, applied_);
  system_.begin_increment();
}

void StaticStep::log_notes() {
  for (const auto& material : analysis_.model.materials)
    if (FlowStress::of(material).depends_on_rate())
      observer_.log(fmt::format("  note: material {} yields as at rate zero: static steps do not follow strain rates", material.name));
  if (procedure_.stabilize && !follows_geometry())
    observer_.log("  STABILIZE has nothing to stabilise in a linear step");
  if (taken_up_ && procedure_.stabilize) choose_damping_again();
}

NewtonResult StaticStep::attempt(double time_increment) {
  if (chooses_damping()) guess_damping(time_increment);
  return solve(goal_of(time_increment));
}

std::vector<double> StaticStep::expected_motion(double time_increment) const {
  std::vector<double> guess;
  if (last_increment_ <= 0.0) return guess;
  guess = last_motion_;
  for (auto& q : guess) q *= time_increment / last_increment_;
  return guess;
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

void StaticStep::conclude(const IncrementGoal& goal) {
  if (follows_geometry()) {
    last_motion_ = newton_.increment();
    last_increment_ = goal.time_increment;
  }
  add_work(goal);
  store_reactions();
  if (chooses_damping()) choose_damping(newton_.increment(), goal.time_increment);
}

}  // namespace

Outcome run_static_step(Analysis& analysis, const Step& step, Observer& observer) {
  if (analysis.current.step_time == 0.0 && analysis.current.increment == 0) analysis.start_step(step);
  return StaticStep(analysis, step, observer).run();
}

namespace {
const RegisterProcedure<StaticProcedure> static_procedure(run_static_step);
}  // namespace

}  // namespace balocco
