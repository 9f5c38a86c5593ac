#include "explicit_time.hpp"

#include <algorithm>
#include <cmath>

namespace balocco {

namespace {
constexpr double largest_growth = 1.1;  // of an increment over the one before
constexpr double no_limit = 1e299;      // a model without elements has no stable increment
constexpr double increments_without_limit = 1000.0;
constexpr double landing_tolerance = 1e-9;  // of an increment: rounding of accumulated times
}  // namespace

TimeControl::TimeControl(const Analysis& analysis, const Step& step)
    : duration_(step.duration()),
      scale_factor_(std::get<ExplicitProcedure>(step.procedure).scale_factor),
      fixed_(std::get<ExplicitProcedure>(step.procedure).fixed_increment.value_or(0.0)) {
  double largest = 0.0;
  for (const auto pair : step.active_contact_pairs)
    largest = std::max(largest, analysis.contacts[pair].largest_spring_frequency_squared(analysis.nodal_mass));
  spring_frequency_squared_ = analysis.communicator.maximum(largest);
}

double TimeControl::combined(double stable) const {
  // The largest eigenvalue of a sum is at most the sum of the largest: omega^2 = (2 / stable)^2 + spring frequency^2.
  return 1.0 / std::sqrt(1.0 / (stable * stable) + 0.25 * spring_frequency_squared_);
}

double TimeControl::next_increment(double step_time, double previous, double stable) const {
  const double remaining = duration_ - step_time;
  if (remaining <= 0.0) return 0.0;
  double increment = fixed_;
  if (fixed_ == 0.0) {
    const double limit = combined(stable);
    increment = limit < no_limit ? scale_factor_ * limit : duration_ / increments_without_limit;
    if (previous > 0.0) increment = std::min(increment, largest_growth * previous);
  }
  if (increment * (1.0 + landing_tolerance) >= remaining) return remaining;
  return fixed_ == 0.0 && increment > 0.5 * remaining ? 0.5 * remaining : increment;
}

double TimeControl::time_after(double step_time, double increment) const {
  const double time = step_time + increment;
  return duration_ - time < landing_tolerance * increment ? duration_ : time;
}

}  // namespace balocco
