#include "linear_statics.hpp"

namespace balocco {

LinearStatics::LinearStatics(Analysis& analysis, const Step& step, ImplicitSystem& system, ImplicitLinearSolver& solver,
                             const ImplicitDrive& drive)
    : analysis_(analysis),
      step_(step),
      system_(system),
      solver_(solver),
      drive_(drive),
      reference_(system.reference()),
      residual_(system.map().slots()) {}

/// residual = internal - external forces of the reference configuration + stiffness * displacement.
bool LinearStatics::assemble(AssemblyRequest request, std::span<const double> displacement) {
  const auto here = system_.configuration();
  system_.restore(reference_);
  request.load_stiffness = false;
  request.arms_turn = !analysis_.current.linear;  // a perturbation feels the forces of its base
  request.motion = displacement;
  const bool sound = system_.assemble(request);
  system_.restore(here);
  if (!sound) return false;
  auto& product = system_.stiffness().product();
  system_.exchange().sum(product);
  for (std::size_t slot = 0; slot < residual_.size(); ++slot) residual_[slot] = system_.residual()[slot] + product[slot];
  return true;
}

bool LinearStatics::find_residual(const AssemblyRequest& loads) {
  std::vector<double> displacement(system_.map().slots());
  for (std::int32_t slot = 0; slot < system_.map().slots(); ++slot) displacement[slot] = system_.displacement(slot);
  return assemble(loads, displacement);
}

NewtonResult LinearStatics::solve(const IncrementGoal& goal) {
  const auto& map = system_.map();
  std::vector<double> displacement(map.slots(), 0.0);
  for (const auto& prescribed : drive_.motions) {
    if (map.role(prescribed.slot) != ImplicitDofMap::Role::prescribed) continue;
    const auto law = motion_law(analysis_.model, step_, *prescribed.condition, goal.step_time, goal.total_time);
    displacement[prescribed.slot] = law.persistence * prescribed.start + law.motion;
  }
  NewtonResult result{.converged = false, .reason = {}, .iterations = 1, .largest_residual = 0.0};
  const auto assemble_all = [&] {
    const bool sound = assemble({.step_time = goal.step_time, .total_time = goal.total_time}, displacement);
    if (!sound) result.reason = system_.trouble();
    return sound;
  };
  if (!assemble_all()) return result;
  const double faded = 1.0 - goal.step_time / step_.duration();
  std::vector<double> right_hand_side, solution(map.owned_free_slots().size());
  for (const auto slot : map.owned_free_slots()) right_hand_side.push_back(faded * drive_.fading[slot] - residual_[slot]);
  if (map.equations() > 0) {
    const bool solved = solver_.solve(right_hand_side, solution);
    if (!solved || goal.starts_step)
      if (const auto where = solver_.mechanism(); !where.empty()) throw AnalysisError(mechanism_message(step_, where));
    result.reason = "the linear solver did not converge";
    if (!solved) return result;
  }
  system_.exchange().from_equations(solution, displacement);
  if (!assemble_all()) return result;
  system_.displace(displacement);
  result.converged = true;
  return result;
}

}  // namespace balocco
