#include "rolling_start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace balocco {
namespace {

using Vector = Vector3<double>;

constexpr double turn = 2.0 * std::numbers::pi;

Vector about_y(double radius, double angle, double y) {
  return {{radius * std::cos(angle), y, -radius * std::sin(angle)}};
}

double length(const Vector& v) { return std::sqrt(dot(v, v)); }

/// Angles of a circle's nodes, a part of it refined.
std::vector<double> angles(int coarse, int fine) {
  std::vector<double> result;
  for (int i = 0; i < coarse; ++i) result.push_back(0.75 * turn * i / coarse);
  for (int i = 0; i < fine; ++i) result.push_back(0.75 * turn + 0.25 * turn * i / fine);
  return result;
}

const RotationAxis axle{{{1.0, 2.0, 3.0}}, {{0.0, 1.0, 0.0}}}, moved{{{0.5, 2.5, 2.0}}, {{0.0, 0.8, 0.6}}};

/// From the frame of the axle to that of the moved one, which leans about x.
Vector lean(const Vector& v) { return {{v[0], 0.8 * v[1] - 0.6 * v[2], 0.6 * v[1] + 0.8 * v[2]}}; }

TEST(RollingStart, WhatIsRoundSpinsRigidly) {
  std::vector<Vector> undeformed, deformed;
  for (const auto angle : angles(20, 30)) {
    undeformed.push_back(axle.point + about_y(300.0, angle, 40.0));
    deformed.push_back(moved.point + lean(about_y(310.0, angle + 0.2, 45.0)));  // it has grown, turned and leant
  }
  for (const auto& velocity : flow_through_shape(undeformed, deformed, axle, moved)) {
    ASSERT_TRUE(velocity);
    EXPECT_LT(length(*velocity), 1e-11);
  }
}

TEST(RollingStart, MaterialRunsThroughAnOvalWithItsSlope) {
  const auto oval = [](double angle) { return about_y(300.0 + 20.0 * std::cos(2.0 * angle), angle, 40.0 + std::sin(angle)); };
  const auto worst_error = [&](int refinement) {
    std::vector<Vector> undeformed, deformed;
    const auto all = angles(36 * refinement, 24 * refinement);
    for (const auto angle : all) {
      undeformed.push_back(axle.point + about_y(290.0, angle, 40.0));
      deformed.push_back(axle.point + oval(angle));
    }
    const auto flow = flow_through_shape(undeformed, deformed, axle, axle);
    double worst = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto slope = (0.5 / 1e-5) * (oval(all[i] + 1e-5) - oval(all[i] - 1e-5));
      const auto velocity = cross(axle.direction, oval(all[i])) + *flow[i];
      worst = std::max(worst, length(velocity - slope));
    }
    return worst;
  };
  EXPECT_LT(worst_error(1), 1.2);  // of a change of 40
  EXPECT_NEAR(worst_error(1) / worst_error(2), 4.0, 0.4);
}

TEST(RollingStart, NodesOnNoCircleAreLeftToTheRigidSpin) {
  std::vector<Vector> undeformed{axle.point};
  for (int spoke = 0; spoke < 5; ++spoke) undeformed.push_back(axle.point + about_y(200.0, turn * spoke / 5, 0.0));
  for (int i = 0; i < 16; ++i) undeformed.push_back(axle.point + about_y(200.0, turn * i / 16, 10.0));
  undeformed.push_back(undeformed[6]);  // two nodes in one place
  const auto flow = flow_through_shape(undeformed, undeformed, axle, axle);
  for (std::size_t i = 0; i < undeformed.size(); ++i) {
    EXPECT_EQ(flow[i].has_value(), i >= 6) << i;
    if (flow[i]) EXPECT_LT(length(*flow[i]), 1e-11);
  }
}

}  // namespace
}  // namespace balocco
