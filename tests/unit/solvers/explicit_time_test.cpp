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

constexpr double chosen = 0.90, highest = 0.98;  // of the stable increment: what an automatic one takes, and bears for a while

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
  EXPECT_NEAR(taken.back(), chosen * 0.9, 0.01);
}

TEST(TimeControl, AFallWithinTheReserveWaitsForTheNextLook) {
  State state;
  const auto taken = increments(automatic(1e6), state, 300, [](double time) { return time < 44.5 ? 1.0 : 0.93; });
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(taken[i], chosen) << i;
  for (std::size_t i = 100; i < 300; ++i) EXPECT_EQ(taken[i], chosen * 0.93) << i;
}

TEST(TimeControl, AFallBeyondTheReserveIsFollowedAtOnce) {
  State state;
  const auto taken = increments(automatic(1e6), state, 300, [](double time) { return time < 44.5 ? 1.0 : 0.8; });
  EXPECT_EQ(taken[49], chosen);
  for (std::size_t i = 50; i < 100; ++i) EXPECT_EQ(taken[i], highest * 0.8) << i;
  EXPECT_EQ(taken[100], chosen * 0.8);
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
  EXPECT_EQ(taken.back(), chosen);
}

TEST(TimeControl, LandsOnTheEndOfTheStep) {
  State state;
  const auto step = automatic(10.0);
  increments(step, state, 14, [](double) { return 0.75 / chosen; });
  EXPECT_NEAR(state.step_time, 10.0, 1e-14);
}

TEST(TimeControl, LandsWithoutAShortIncrementThatWouldChangeWhatTheLongerOnesConserved) {
  State state;
  const auto taken = increments(automatic(1000.1), state, 1001, [](double) { return 1.0 / chosen; });
  EXPECT_NEAR(state.step_time, 1000.1, 1e-9);
  for (const double increment : taken) EXPECT_NEAR(increment, 1.0, 0.01);
}

TEST(TimeControl, SquaresOfFrequenciesAddUp) {
  EXPECT_DOUBLE_EQ(combined_limit(0.5, {}), 0.5);
  const double omega = 4.0;  // 2 / 0.5
  EXPECT_NEAR(combined_limit(0.5, {.omega_square = 9.0}), 2.0 / std::hypot(omega, 3.0), 1e-15);
}

}  // namespace
}  // namespace balocco
