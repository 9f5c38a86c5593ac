#include "explicit_time.hpp"

#include <algorithm>
#include <cmath>

#include "elements/bulk_viscosity.hpp"

namespace balocco {

namespace {
constexpr std::int64_t increments_between_looks = 100;
constexpr double least_raise = 1.02, largest_raise = 1.25;  // a smaller one is not worth a change
constexpr double no_limit = 1e299;      // a model without elements has no stable increment
constexpr double increments_without_limit = 1000.0;
// Increments are chosen with a reserve: a change of increment from h to h' at accelerations a creates (h^2 - h'^2) / 8 sum m a^2, and
// that is most in the midst of an impact, in which strain and bulk viscosity lower the limit. So a fall of the limit within the
// reserve waits for the next look. At the very limit the highest mode of a uniform mesh would grow with time, and slightly below it
// any disturbance is magnified by 1 / (1 - (omega dt / 2)^2).
constexpr double chosen = 0.90, highest = 0.98;  // of the limit: what is taken at a look, what is borne between looks
constexpr double increments_to_land = 100.0;  // so long before its end a step begins to share out what remains
constexpr double landing_tolerance = 1e-9;  // of an increment: rounding of accumulated times
}  // namespace

TimeControl::TimeControl(const Step& step)
    : duration_(step.duration()),
      scale_factor_(std::get<ExplicitProcedure>(step.procedure).scale_factor),
      fixed_(std::get<ExplicitProcedure>(step.procedure).fixed_increment.value_or(0.0)) {}

double RestraintBound::increment() const { return neutral_increment(omega_square, rate); }

double combined_limit(double stable, const FrequencyBound& added) {
  return neutral_increment(4.0 / (stable * stable) + added.omega_square, added.rate);
}

double TimeControl::automatic(State& state, double previous, double stable) const {
  const double limit = stable < no_limit ? scale_factor_ * stable : duration_ / (chosen * increments_without_limit);
  if (previous == 0.0) state.least_stable = limit;
  state.least_stable = std::min(state.least_stable, limit);
  double increment = previous > 0.0 ? std::min(previous, highest * limit) : chosen * limit;
  if (state.increment % increments_between_looks == 0) {
    const double wanted = chosen * state.least_stable;
    if (wanted < increment || wanted >= least_raise * increment) increment = std::min(wanted, largest_raise * increment);
    state.least_stable = limit;
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
