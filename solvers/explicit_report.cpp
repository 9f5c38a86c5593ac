// What an explicit step tells the outside: output arrays, progress, balance at the start, timers at the end.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "explicit_step.hpp"

namespace balocco {

void ExplicitStep::fill_output() {
  timers.measure(Phase::output, [&] {
    auto& acceleration = analysis_.acceleration;
    std::fill(analysis_.reaction.begin(), analysis_.reaction.end(), 0.0);
    for (std::size_t node = 0; node < inverse_mass_.size(); ++node)
      for (std::size_t c = 0; c < 3; ++c) acceleration[4 * node + c] = inverse_mass_[node] * force_[4 * node + c];
    std::fill(analysis_.work_ahead.begin(), analysis_.work_ahead.end(), NodalWork{});
    add_half_work(next_increment_, analysis_.work_ahead);
    constraints_.add_to_output(analysis_, instant());
    bodies_.add_to_output(analysis_, instant(), moments_);
  });
}

Progress ExplicitStep::progress() const {
  const auto& state = analysis_.current;
  const auto governing =
      analysis_.communicator.minimum(Communicator::Located{stability_.increment, stability_.element});
  Progress progress;
  progress.increment = state.increment;
  progress.step_time = state.step_time;
  progress.total_time = state.total_time;
  progress.time_increment = last_increment_;
  progress.critical_element = governing.payload;
  progress.step_finished = finished();
  return progress;
}

bool ExplicitStep::observe() {
  if (!attention_ && !finished()) return true;
  fill_output();
  bool go_on = true;
  timers.measure(Phase::output, [&] { go_on = observer_.advanced(analysis_, progress()); });
  return go_on;
}

void ExplicitStep::log_balance() {
  auto free_force = force_;
  const auto balance = bodies_.balance();
  const double constrained = constraints_.squared_constrained(analysis_.domain, force_.data());
  constraints_.remove_constrained(free_force.data());
  double unbalanced = 0.0, loads = 0.0;
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    if (!analysis_.domain.owned[node]) continue;
    const bool free = inverse_mass_[node] > 0.0;
    for (int c = 0; c < 3; ++c) {
      if (free) unbalanced += free_force[4 * node + c] * free_force[4 * node + c];
      loads += external_force_[4 * node + c] * external_force_[4 * node + c];
    }
  }
  std::array<double, 2> sums{unbalanced, constrained + loads};
  analysis_.communicator.sum(std::span<double>(sums));
  const double residual = std::sqrt(sums[0] + balance.unbalanced);
  const double external = std::sqrt(sums[1] + balance.reactions);
  if (external == 0.0) return;
  observer_.log(
      fmt::format("step {} starts with |f_int + f_contact - f_ext| / |f_ext| = {:.3e} (|f_ext| = {:.6g}, loads and "
                  "reactions)",
                  step_.name, residual / external, external));
}

void ExplicitStep::log_timers() const {
  std::int64_t elements = 0;
  for (const auto& group : analysis_.element_groups) elements += group->size();
  const double cycles = static_cast<double>(cycles_), total = timers.total();
  std::array<double, PhaseTimers::count + 1> largest{};
  for (std::size_t i = 0; i < PhaseTimers::count; ++i) largest[i] = timers.seconds(static_cast<Phase>(i));
  largest.back() = elements > 0 ? timers.seconds(Phase::elements) / (cycles * static_cast<double>(elements)) : 0.0;
  const double longest = analysis_.communicator.maximum(total);
  analysis_.communicator.maximum(std::span<double>(largest));
  std::string line = fmt::format(
      "explicit: {} increments in {:.2f} s, {:.1f} ns per element-cycle in elements; slowest rank:", cycles_, longest,
      1e9 * largest.back());
  for (std::size_t i = 0; i < PhaseTimers::count; ++i)
    line += fmt::format(" {} {:.1f} %", PhaseTimers::names[i], 100.0 * largest[i] / longest);
  observer_.log(line);
}

}  // namespace balocco
