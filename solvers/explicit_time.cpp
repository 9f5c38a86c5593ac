#include "explicit_time.hpp"

#include <algorithm>
#include <cmath>

#include "elements/bulk_viscosity.hpp"

namespace balocco {

namespace {
constexpr std::int64_t increments_between_raises = 100;
constexpr double least_raise = 1.02, largest_raise = 1.25;  // a smaller one is not worth a change
constexpr double no_limit = 1e299;      // a model without elements has no stable increment
constexpr double increments_without_limit = 1000.0;
// At the very limit the highest mode of a uniform mesh grows with time, and slightly below it any disturbance is magnified by
// 1 / (1 - (omega dt / 2)^2).
constexpr double below_limit = 0.95;
constexpr double increments_to_land = 100.0;  // so long before its end a step begins to share out what remains
constexpr double landing_tolerance = 1e-9;  // of an increment: rounding of accumulated times
}  // namespace

TimeControl::TimeControl(const Step& step)
    : duration_(step.duration()),
      scale_factor_(std::get<ExplicitProcedure>(step.procedure).scale_factor),
      fixed_(std::get<ExplicitProcedure>(step.procedure).fixed_increment.value_or(0.0)) {}

double combined_limit(double stable, double contact_frequency_squared, const RestraintBound& restraints) {
  const double omega_square = 4.0 / (stable * stable) + contact_frequency_squared + restraints.omega_square;
  return neutral_increment(omega_square, restraints.rate);
}

double TimeControl::automatic(State& state, double previous, double stable) const {
  const double now = stable < no_limit ? below_limit * scale_factor_ * stable : duration_ / increments_without_limit;
  if (previous == 0.0) state.least_stable = now;
  state.least_stable = std::min(state.least_stable, now);
  double increment = previous > 0.0 ? std::min(previous, now) : now;
  if (state.increment % increments_between_raises == 0) {
    if (state.least_stable >= least_raise * increment) increment = std::min(state.least_stable, largest_raise * increment);
    state.least_stable = now;
  }
  return increment;
}

double TimeControl::next_increment(State& state, double previous, double stable) const {
  const double remaining = duration_ - state.step_time;
  if (remaining <= 0.0) return 0.0;
  const double increment = fixed_ > 0.0 ? fixed_ : automatic(state, previous, stable);
  if (increment * (1.0 + landing_tolerance) >= remaining) return remaining;
  const double left = std::ceil(remaining / increment - landing_tolerance);
  return fixed_ == 0.0 && left <= increments_to_land ? remaining / left : increment;
}

double TimeControl::time_after(double step_time, double increment) const {
  const double time = step_time + increment;
  return duration_ - time < landing_tolerance * increment ? duration_ : time;
}

}  // namespace balocco
