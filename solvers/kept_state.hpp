// What a procedure that shows a response about the state leaves as it was.
#pragma once

#include <array>
#include <optional>
#include <tuple>
#include <vector>

#include "analysis.hpp"

namespace balocco {

/// What is shown beside the state.
inline auto outputs_of(Analysis& analysis) {
  return std::tie(analysis.acceleration, analysis.reaction, analysis.angular_acceleration, analysis.reaction_moment, analysis.body_reaction,
                  analysis.body_angular_acceleration, analysis.kinetic_energy);
}

/// Copies of that.
using ShownBeside = std::tuple<std::vector<double>, std::vector<double>, std::vector<double>, std::vector<double>,
                               std::vector<std::array<double, 6>>, std::vector<Point>, std::optional<double>>;

/// The state and all that is shown with it, as they are when this is made.
class KeptState {
 public:
  explicit KeptState(Analysis& analysis) : analysis_(analysis), state_(analysis.current), outputs_(outputs_of(analysis)) {}

  const State& state() const { return state_; }

  /// Puts all back but the increment and the times to which the analysis has come since.
  void restore() {
    State& current = analysis_.current;
    const auto [increment, step_time, total_time] = std::tuple(current.increment, current.step_time, current.total_time);
    current = state_;
    outputs_of(analysis_) = outputs_;
    current.increment = increment;
    current.step_time = step_time;
    current.total_time = total_time;
  }

 private:
  Analysis& analysis_;
  const State state_;
  const ShownBeside outputs_;
};

}  // namespace balocco
