#include "explicit_time.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace balocco {
namespace {

Step automatic(double duration) {
  Step step;
  step.procedure = ExplicitProcedure{.duration = duration};
  return step;
}

constexpr double below_limit = 0.95;  // of the stable increment an automatic one takes

/// Runs `limit(time)` as the stable increment for `count` increments; returns the increments taken.
template <class Limit>
std::vector<double> increments(const Step& step, State& state, int count, Limit limit) {
  const TimeControl control(step);
  std::vector<double> taken;
  double previous = 0.0;
  for (int i = 0; i < count; ++i) {
    previous = control.next_increment(state, previous, limit(state.step_time));
    taken.push_back(previous);
    state.step_time += previous;
    ++state.increment;
  }
  return taken;
}

TEST(TimeControl, FollowsAVibratingLimitDownButNotUp) {
  State state;
  const auto taken = increments(automatic(1e6), state, 1000, [](double time) { return 1.0 + 0.1 * std::sin(3.0 * time); });
  for (std::size_t i = 1; i < taken.size(); ++i) EXPECT_LE(taken[i], taken[i - 1]);
  EXPECT_NEAR(taken.back(), below_limit * 0.9, 0.01);
}

TEST(TimeControl, RaisesInStepsToWhatWasStableAllAlong) {
  State state;
  const auto taken = increments(automatic(1e6), state, 1000, [](double time) { return time < 5.0 ? 0.5 : 1.0; });
  int raises = 0;
  for (std::size_t i = 1; i < taken.size(); ++i) {
    if (taken[i] == taken[i - 1]) continue;
    EXPECT_EQ(i % 100, 0u);
    EXPECT_LE(taken[i], 1.25 * taken[i - 1] * (1.0 + 1e-14));
    ++raises;
  }
  EXPECT_EQ(raises, 4);  // 0.5 x 1.25^3 < 1 < 0.5 x 1.25^4
  EXPECT_EQ(taken.back(), below_limit);
}

TEST(TimeControl, LandsOnTheEndOfTheStep) {
  State state;
  const auto step = automatic(10.0);
  increments(step, state, 14, [](double) { return 0.75 / below_limit; });
  EXPECT_NEAR(state.step_time, 10.0, 1e-14);
}

TEST(TimeControl, LandsWithoutAShortIncrementThatWouldChangeWhatTheLongerOnesConserved) {
  State state;
  const auto taken = increments(automatic(1000.1), state, 1001, [](double) { return 1.0 / below_limit; });
  EXPECT_NEAR(state.step_time, 1000.1, 1e-9);
  for (const double increment : taken) EXPECT_NEAR(increment, 1.0, 0.01);
}

TEST(TimeControl, SquaresOfFrequenciesAddUp) {
  EXPECT_DOUBLE_EQ(combined_limit(0.5, 0.0, {}), 0.5);
  const double omega = 4.0;  // 2 / 0.5
  EXPECT_NEAR(combined_limit(0.5, 9.0, {}), 2.0 / std::hypot(omega, 3.0), 1e-15);
}

}  // namespace
}  // namespace balocco
