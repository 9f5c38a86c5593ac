#include "loads/body_load.hpp"

#include <gtest/gtest.h>

namespace balocco::test {

namespace {

BodyLoad centrifugal() {
  BodyLoad load;
  load.kind = BodyLoad::Kind::centrifugal;
  load.direction = {0.6, 0.0, 0.8};
  load.point = {1.0, -2.0, 0.5};
  return load;
}

TEST(BodyLoad, CentrifugalForcePointsAwayFromTheAxis) {
  const auto load = centrifugal();
  const double share = 2.0, square = 9.0, along = 3.0;
  // Four across the axis, along (0, 1, 0), and some way along it, which does not matter.
  const double position[3] = {1.0 + along * 0.6, 2.0, 0.5 + along * 0.8};
  const auto force = body_force(load, square, share, position);
  EXPECT_NEAR(force[0], 0.0, 1e-13);
  EXPECT_NEAR(force[1], share * square * 4.0, 1e-13);
  EXPECT_NEAR(force[2], 0.0, 1e-13);
}

TEST(BodyLoad, DerivativeIsThatOfTheForce) {
  auto load = centrifugal();
  for (const auto kind : {BodyLoad::Kind::centrifugal, BodyLoad::Kind::gravity, BodyLoad::Kind::volume_force}) {
    load.kind = kind;
    const auto derivative = body_force_derivative(load, 7.0, 0.3);
    for (int j = 0; j < 3; ++j) {
      double ahead[3] = {0.3, 0.4, -0.2}, behind[3] = {0.3, 0.4, -0.2};
      ahead[j] += 0.5;  // linear in the position: a wide difference is exact
      behind[j] -= 0.5;
      const auto up = body_force(load, 7.0, 0.3, ahead), down = body_force(load, 7.0, 0.3, behind);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(derivative(i, j), up[i] - down[i], 1e-13);
    }
  }
}

}  // namespace

}  // namespace balocco::test
