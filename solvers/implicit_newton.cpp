#include "implicit_newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace balocco {

namespace {

/// Relative residual of the increment that ends a step: the next procedure starts from this state.
constexpr double final_tolerance = 1e-9;
/// Iterations in which contact opened or closed that do not count against the limit.
constexpr int discontinuous_iterations = 12;
/// Penetration that augmentation leaves at the end of a step and before, relative to the edge of a slave node's area.
constexpr double penetration_tolerance = 1e-3, passing_penetration_tolerance = 2e-3;
constexpr int most_augmentations = 12;

/// By how much the residual may grow where friction turns back: the next correction has that stick.
constexpr double turning_growth = 4.0;

/// Corrections of a structure that is held back are at most this part of the model's size.
constexpr double longest_held_back = 0.02;

}  // namespace

std::string mechanism_message(const Step& step, const std::string& where) {
  return fmt::format(
      "step '{}': the stiffness is singular: nothing resists a motion of {}; hold it with *BOUNDARY, let contact "
      "close by a prescribed motion before loads take over, or use *STATIC, STABILIZE",
      step.name, where);
}

ImplicitNewton::ImplicitNewton(Analysis& analysis, const Step& step, ImplicitSystem& system,
                               ImplicitLinearSolver& solver, const ImplicitDrive& drive, Observer& observer)
    : analysis_(analysis),
      step_(step),
      controls_(step.implicit_increments()->controls),
      system_(system),
      solver_(solver),
      drive_(drive),
      observer_(observer) {
  const auto& map = system.map();
  remaining_.resize(map.slots());
  out_of_balance_.resize(map.slots());
  correction_.resize(map.slots());
  increment_.resize(map.slots());
  right_hand_side_.resize(map.owned_free_slots().size());
  solution_.resize(map.owned_free_slots().size());
  contact_length_ = system.contact_length();
}

NewtonResult ImplicitNewton::converge(const IncrementGoal& goal) {
  NewtonResult result;
  start(goal);
  if (!evaluate(goal)) {
    // The guess went too far: start from where the increment begins.
    system_.restore(system_.start_of_increment());
    std::ranges::fill(increment_, 0.0);
    if (!evaluate(goal)) {
      result.reason = system_.trouble();
      return result;
    }
  }
  while (true) {
    const auto now = norms();
    result.largest_residual = now.largest;
    history_.push_back(now.residual);
    greatest_reference_ = std::max(greatest_reference_, now.reference);
    log_iteration(result, now);
    if (accepted(goal, now, result)) {
      if (!stands_alone(goal)) throw AnalysisError(mechanism_message(step_, mechanism_));
      if (!contact_misfits(goal, result)) {
        result.converged = true;
        return result;
      }
      if (!evaluate(goal)) break;
      continue;
    }
    if (gives_up(goal, now, result)) return result;
    keeps_factors_ = !keeps_factors_ && last_factors_suffice(goal, now, result);
    if (!advance(goal, result)) return result;
  }
  result.reason = system_.trouble();
  return result;
}

void ImplicitNewton::start(const IncrementGoal& goal) {
  std::ranges::fill(increment_, 0.0);
  history_.clear();
  keeps_factors_ = descends_ = false;
  discontinuous_ = 0;
  augmentations_ = 0;
  iterations_before_ = 0;
  largest_correction_ = largest_increment_ = 0.0;
  if (goal.guess.empty()) return;
  find_remaining_motion(goal);
  std::ranges::copy(goal.guess, increment_.begin());
  for (const auto& motion : drive_.motions) increment_[motion.slot] = remaining_[motion.slot];
  system_.move(increment_, 1.0);
}

void ImplicitNewton::find_remaining_motion(const IncrementGoal& goal) {
  for (const auto& motion : drive_.motions) {
    if (system_.map().role(motion.slot) != ImplicitDofMap::Role::prescribed) continue;
    const auto law = motion_law(analysis_.model, step_, *motion.condition, goal.step_time, goal.total_time);
    remaining_[motion.slot] = law.persistence * motion.start + law.motion - system_.displacement(motion.slot);
  }
}

/// Assembles at the current positions and forms the right-hand side of the next correction.
bool ImplicitNewton::evaluate(const IncrementGoal& goal) {
  const double begin = MPI_Wtime();
  find_remaining_motion(goal);
  const bool sound = system_.assemble({.step_time = goal.step_time,
                                       .total_time = goal.total_time,
                                       .increment = goal.time_increment,
                                       .motion = remaining_,
                                       .viscosity = goal.damping / goal.time_increment,
                                       .regularization = regularization_});
  if (sound) {
    auto& product = system_.stiffness().product();
    system_.exchange().sum(product);
    if (system_.turned_points() > 0) system_.exchange().sum(system_.sticking());
    const double faded = 1.0 - goal.step_time / step_.duration();
    const auto& map = system_.map();
    for (std::int32_t slot = 0; slot < map.slots(); ++slot)
      out_of_balance_[slot] = system_.residual()[slot] - faded * drive_.fading[slot];
    for (std::size_t i = 0; i < right_hand_side_.size(); ++i) {
      const auto slot = map.owned_free_slots()[i];
      right_hand_side_[i] = -out_of_balance_[slot] - product[slot];
    }
  }
  assembly_seconds_ += MPI_Wtime() - begin;
  return sound;
}

ImplicitNewton::Norms ImplicitNewton::norms() const {
  const auto& map = system_.map();
  std::array<double, 3> squares{};  // residual, loads, reactions
  Norms result;
  for (const auto slot : map.owned_slots()) {
    if (map.is_multiplier(slot)) {
      result.gap = std::max(result.gap, std::abs(out_of_balance_[slot]));
      continue;
    }
    const auto square = [&](double value) { return value * value / (system_.lever(slot) * system_.lever(slot)); };
    squares[1] += square(system_.external()[slot]);
    if (map.role(slot) == ImplicitDofMap::Role::prescribed) {
      squares[2] += square(out_of_balance_[slot]);
      result.remaining = std::max(result.remaining, std::abs(remaining_[slot]) * system_.lever(slot));
    } else {
      squares[0] += square(out_of_balance_[slot]);
      result.largest = std::max(result.largest, std::abs(out_of_balance_[slot]) / system_.lever(slot));
    }
  }
  analysis_.communicator.sum(std::span<double>(squares));
  std::array<double, 3> largest{result.largest, result.remaining, result.gap};
  analysis_.communicator.maximum(std::span<double>(largest));
  result.largest = largest[0];
  result.remaining = largest[1];
  result.gap = largest[2];
  result.residual = std::sqrt(squares[0]);
  result.reference = std::max({std::sqrt(squares[1]), std::sqrt(squares[2]), system_.average_force()});
  return result;
}

bool ImplicitNewton::accepted(const IncrementGoal& goal, const Norms& now, const NewtonResult& result) const {
  const double resolution = 8.0 * std::numeric_limits<double>::epsilon() * system_.model_size();
  if (now.remaining > std::max(1e-10 * largest_increment_, resolution)) return false;
  if (now.gap > std::max(1e-10 * largest_increment_, 16.0 * resolution)) return false;
  // Corrections too small for the positions to hold them: sums cannot be had more exactly.
  const bool resolved = result.iterations > 0 && mechanism_.empty() && largest_correction_ <= resolution;
  // What is left of a structure that has come to rest without any force is judged by the forces it had.
  const double reference = std::max(now.reference, 1e-6 * greatest_reference_);
  if (goal.ends_step) return now.residual <= final_tolerance * reference || resolved || at_round_off(now);
  const double tolerance = controls_.residual_tolerance * system_.average_force();
  if (now.largest > tolerance) return resolved;
  const bool still = largest_correction_ <= controls_.correction_tolerance * largest_increment_;
  return now.largest <= 1e-3 * tolerance || (still && result.iterations > 0);
}

/// Two iterations brought nothing any more, and what is left is small.
bool ImplicitNewton::at_round_off(const Norms& now) const {
  const auto n = history_.size();
  return n >= 3 && now.residual <= 1e-7 * now.reference && now.residual > 0.3 * history_[n - 2] &&
         history_[n - 2] > 0.3 * history_[n - 3];
}

/// Near the end of quadratic convergence the tangent has changed so little that the last factors lead to equilibrium: they leave twice
/// that part of the residual which the last correction left, here with a reserve.
bool ImplicitNewton::last_factors_suffice(const IncrementGoal& goal, const Norms& now, const NewtonResult& result) const {
  constexpr double reserve = 10.0, most_left = 0.01;
  const auto n = history_.size();
  if (n < 2 || !mechanism_.empty() || system_.changed_points() > 0 || system_.turned_points() > 0) return false;
  const double left = reserve * 2.0 * history_[n - 1] / history_[n - 2];
  Norms then = now;
  then.residual *= left;
  then.largest *= left;
  then.gap *= left;
  then.remaining = 0.0;
  return left <= most_left && accepted(goal, then, result);
}

bool ImplicitNewton::gives_up(const IncrementGoal& goal, const Norms& now, NewtonResult& result) {
  if (result.iterations > 0 && system_.changed_points() > 0 && discontinuous_ < discontinuous_iterations)
    ++discontinuous_;
  const int counted = result.iterations - iterations_before_ - discontinuous_;
  const auto n = history_.size();
  const bool grows =
      n >= 4 && history_[n - 1] > history_[n - 2] && history_[n - 2] > history_[n - 3] && system_.changed_points() == 0;
  const bool too_many = counted >= controls_.maximum_iterations + (goal.ends_step ? 4 : 0);
  if (grows && counted > 4 && history_.back() > 10.0 * final_tolerance * now.reference)
    result.reason = fmt::format("the residual grows, most at {}", worst_dof());
  else if (too_many)
    result.reason =
        fmt::format("no equilibrium after {} iterations, residual largest at {}", result.iterations, worst_dof());
  return !result.reason.empty();
}

bool ImplicitNewton::advance(const IncrementGoal& goal, NewtonResult& result) {
  if (system_.map().equations() > 0 && !solve(goal, result)) return false;
  correction_ = remaining_;
  system_.exchange().from_equations(solution_, correction_);
  ++result.iterations;
  system_.begin_iteration();
  if (search_line(goal)) return true;
  result.reason = system_.trouble();
  return false;
}

/// Points whose friction turned back go to where their springs would hold them: next, the law tells whether they do.
bool ImplicitNewton::solve_linear_equations() {
  if (system_.turned_points() == 0) return solver_.solve(right_hand_side_, solution_, keeps_factors_ ? Factors::kept : Factors::fresh);
  auto right_hand_side = right_hand_side_;
  for (std::size_t i = 0; i < right_hand_side.size(); ++i) right_hand_side[i] -= system_.sticking()[system_.map().owned_free_slots()[i]];
  return solver_.solve(right_hand_side, solution_);
}

bool ImplicitNewton::solve(const IncrementGoal& goal, NewtonResult& result) {
  if (!mechanism_.empty()) {
    if (solve_held_back(goal)) return true;
    result.reason = fmt::format("nothing resists a motion of {}", mechanism_);
    return false;
  }
  const bool solved = solve_linear_equations();
  if (solved && !(goal.starts_step && result.iterations == 0)) return true;
  const auto where = solver_.mechanism();
  if (where.empty()) {
    if (!solved) result.reason = "the linear solver did not converge";
    return solved;
  }
  if (!goal.starts_step) {
    result.reason = fmt::format("the stiffness became singular at {}", where);
    return false;
  }
  observer_.log(
      fmt::format("    nothing resists a motion of {}: iterations are held back until something does", where));
  mechanism_ = where;
  regularization_ = 1e-8 * solver_.average_diagonal();
  if (evaluate(goal) && solve_held_back(goal)) return true;
  result.reason = fmt::format("nothing resists a motion of {}", where);
  return false;
}

/// Adds artificial stiffness until the correction is a small part of the model; takes it back as the residual falls.
bool ImplicitNewton::solve_held_back(const IncrementGoal& goal) {
  constexpr int most_trials = 16;
  if (history_.size() >= 2 && history_.back() < history_[history_.size() - 2]) {
    regularization_ *= history_.back() / history_[history_.size() - 2];
    if (!evaluate(goal)) return false;
  }
  for (int trial = 0; trial < most_trials; ++trial) {
    if (solve_linear_equations()) {
      double largest = 0.0;
      for (std::size_t i = 0; i < solution_.size(); ++i)
        if (const auto slot = system_.map().owned_free_slots()[i]; !system_.map().is_multiplier(slot))
          largest = std::max(largest, std::abs(solution_[i]) * system_.lever(slot));
      if (analysis_.communicator.maximum(largest) <= longest_held_back * system_.model_size()) return true;
    }
    regularization_ = std::max(8.0 * regularization_, 1e-9 * solver_.average_diagonal());
    if (!evaluate(goal)) return false;
  }
  return false;
}

/// In equilibrium the structure must do without artificial stiffness.
bool ImplicitNewton::stands_alone(const IncrementGoal& goal) {
  if (mechanism_.empty() || goal.damping > 0.0) return true;
  regularization_ = 0.0;
  evaluate(goal);
  const bool solved = solve_linear_equations();
  const auto where = solver_.mechanism();
  if (!solved || !where.empty()) return false;
  mechanism_.clear();
  return true;
}

/// Two corrections took the residual up and back to where it was: contact points that open and close in turn do that.
bool ImplicitNewton::circles() const {
  const auto n = history_.size();
  return n >= 3 && history_[n - 2] > history_[n - 3] && std::abs(history_[n - 1] / history_[n - 3] - 1.0) < 0.1;
}

/// Goes along the correction as far as it does good: all the way unless that inverts an element or makes things worse.
bool ImplicitNewton::search_line(const IncrementGoal& goal) {
  constexpr int most_trials = 6;
  const auto origin = system_.configuration();
  const auto work = [&] {
    std::array<double, 2> sums{};  // right-hand side * correction, and its square norm
    for (std::size_t i = 0; i < solution_.size(); ++i) {
      const auto slot = system_.map().owned_free_slots()[i];
      if (system_.map().is_multiplier(slot)) {  // with this sign the sum is motion * stiffness * motion, whatever the constraints do
        sums[0] -= right_hand_side_[i] * solution_[i];
        continue;
      }
      sums[0] += right_hand_side_[i] * solution_[i];
      const double force = right_hand_side_[i] / system_.lever(slot);
      sums[1] += force * force;
    }
    analysis_.communicator.sum(std::span<double>(sums));
    return sums;
  };
  const auto before = work();
  descends_ = descends_ || circles();
  const bool lets_stick = system_.turned_points() > 0;  // the residual here does not tell of that
  double factor = 1.0;
  bool sound = false;
  for (int trial = 0; trial < most_trials; ++trial) {
    if (trial > 0) system_.restore(origin);
    system_.move(correction_, factor);
    sound = evaluate(goal);
    if (!sound) {
      factor *= 0.5;
      continue;
    }
    const auto after = work();
    const bool turns = lets_stick || system_.turned_points() > 0;
    if (turns && after[1] <= turning_growth * turning_growth * before[1]) break;
    const double ratio = before[0] != 0.0 ? after[0] / before[0] : 0.0;
    const bool better = after[1] <= before[1];
    if (controls_.line_search ? std::abs(ratio) <= 0.25 : (better || (!descends_ && std::abs(ratio) <= 0.9))) break;
    if (trial + 2 >= most_trials) break;
    // The root of the straight line through the works at the origin and here, if it lies between.
    factor *= ratio < 0.0 ? std::clamp(1.0 / (1.0 - ratio), 0.1, 0.7) : 0.5;
  }
  if (sound) measure_correction(factor);
  return sound;
}

void ImplicitNewton::measure_correction(double factor) {
  std::array<double, 2> largest{};
  for (std::int32_t slot = 0; slot < system_.map().slots(); ++slot) {
    increment_[slot] += factor * correction_[slot];
    if (system_.map().is_multiplier(slot)) continue;
    largest[0] = std::max(largest[0], std::abs(factor * correction_[slot]) * system_.lever(slot));
    largest[1] = std::max(largest[1], std::abs(increment_[slot]) * system_.lever(slot));
  }
  analysis_.communicator.maximum(std::span<double>(largest));
  largest_correction_ = largest[0];
  largest_increment_ = largest[1];
}

/// Augments the contact's multipliers where it penetrates too far, or pushes across a gap: a multiplier from a greater load. In dynamics
/// springs alone press, whose energy has an account.
bool ImplicitNewton::contact_misfits(const IncrementGoal& goal, const NewtonResult& result) {
  if (!system_.has_contact() || system_.dynamics() || augmentations_ >= most_augmentations) return false;
  const double allowed = (goal.ends_step ? penetration_tolerance : passing_penetration_tolerance) * contact_length_;
  const double misfit = system_.greatest_misfit();
  if (misfit <= allowed) return false;
  system_.augment_contact();
  ++augmentations_;
  observer_.log(fmt::format("    penetration, or a gap that contact pushes across, of {:.3e} exceeds {:.3e}: contact forces augmented",
                            misfit, allowed));
  discontinuous_ = 0;
  history_.clear();
  // Each augmentation is a new problem, with its own right to iterate: how small the last correction was says nothing of it.
  iterations_before_ = result.iterations - 1;
  largest_correction_ = std::numeric_limits<double>::infinity();
  return true;
}

void ImplicitNewton::log_iteration(const NewtonResult& result, const Norms& now) const {
  auto line =
      fmt::format("    iteration {:2}: residual {:.3e} ({:.2e} of the forces), correction {:.3e}", result.iterations,
                  now.residual, now.reference > 0.0 ? now.residual / now.reference : 0.0, largest_correction_);
  if (system_.has_contact())
    line += fmt::format(", contact {} closed, {} changed, {} turned back", system_.closed_points(), system_.changed_points(),
                        system_.turned_points());
  observer_.log(line);
}

std::string ImplicitNewton::worst_dof() const {
  const auto& map = system_.map();
  double largest = -1.0;
  PetscInt equation = -1;
  for (const auto slot : map.owned_free_slots())
    if (const double value = std::abs(out_of_balance_[slot]) / system_.lever(slot); value > largest && !map.is_multiplier(slot)) {
      largest = value;
      equation = map.equation(slot);
    }
  const auto worst = analysis_.communicator.minimum(Communicator::Located{-largest, equation});
  return map.describe_equation(static_cast<PetscInt>(worst.payload));
}

}  // namespace balocco
