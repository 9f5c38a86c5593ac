#include "profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace balocco {
namespace {

using Kind = ProfileSegment::Kind;

ProfileSegment segment(PlanePoint start, PlanePoint end) {
  return {Kind::line, start, end, {}, false};
}
ProfileSegment arc(PlanePoint start, PlanePoint end, PlanePoint centre, bool counter_clockwise) {
  return {Kind::arc, start, end, centre, counter_clockwise};
}

/// Road running in +x (outward +y) over an obstacle 25 high with fillets of radius 5 at its foot (concave) and edges
/// (convex).
std::vector<ProfileSegment> road_with_obstacle() {
  return {segment({-200, 0}, {-55, 0}), arc({-55, 0}, {-50, 5}, {-55, 5}, true),
          segment({-50, 5}, {-50, 20}), arc({-50, 20}, {-45, 25}, {-45, 20}, false),
          segment({-45, 25}, {45, 25}), arc({45, 25}, {50, 20}, {45, 20}, false),
          segment({50, 20}, {50, 5}),   arc({50, 5}, {55, 0}, {55, 5}, true),
          segment({55, 0}, {200, 0})};
}

/// Points along the chain, `count` a piece, the ends extended by straight lines.
std::vector<PlanePoint> sampled_road(int count) {
  std::vector<PlanePoint> samples;
  for (const auto& segment : road_with_obstacle()) {
    for (int i = 0; i <= count; ++i) {
      const double s = static_cast<double>(i) / count;
      if (segment.kind == Kind::line) {
        samples.push_back({segment.start[0] + s * (segment.end[0] - segment.start[0]),
                           segment.start[1] + s * (segment.end[1] - segment.start[1])});
      } else {  // quarter circles
        const PlanePoint a{segment.start[0] - segment.centre[0], segment.start[1] - segment.centre[1]};
        const double angle = (segment.counter_clockwise ? 0.5 : -0.5) * std::numbers::pi * s;
        samples.push_back({segment.centre[0] + std::cos(angle) * a[0] - std::sin(angle) * a[1],
                           segment.centre[1] + std::sin(angle) * a[0] + std::cos(angle) * a[1]});
      }
    }
  }
  return samples;
}

double distance(const Profile& profile, double x, double y) {
  return profile.nearest<double>({x, y}).distance;
}

TEST(Profile, DistanceToALineIsSignedAndTheLineGoesOnWithoutEnd) {
  const Profile road(std::vector{segment({0, 1}, {10, 1})});
  EXPECT_EQ(distance(road, 5.0, 3.0), 2.0);
  EXPECT_EQ(distance(road, 5.0, 0.25), -0.75);
  EXPECT_EQ(distance(road, -1e4, 0.25), -0.75);
  EXPECT_EQ(distance(road, 1e4, 3.0), 2.0);
  const auto at = road.nearest<double>({20.0, 0.0});
  EXPECT_EQ(at.normal[0], 0.0);
  EXPECT_EQ(at.normal[1], 1.0);
}

TEST(Profile, OutwardIsLeftOfTheRunningDirection) {
  const Profile up(std::vector{segment({0, 0}, {0, 10})}), down(std::vector{segment({0, 10}, {0, 0})});
  EXPECT_EQ(distance(up, -2.0, 5.0), 2.0);
  EXPECT_EQ(distance(down, -2.0, 5.0), -2.0);
}

TEST(Profile, ArcsTurningRightAreConvexAndTurningLeftConcave) {
  const Profile hill(std::vector{arc({-3, 0}, {3, 0}, {0, 0}, false)});   // over the top
  const Profile hollow(std::vector{arc({-3, 0}, {3, 0}, {0, 0}, true)});  // through the bottom
  EXPECT_DOUBLE_EQ(distance(hill, 0.0, 4.0), 1.0);
  EXPECT_DOUBLE_EQ(distance(hill, 0.0, 2.0), -1.0);
  EXPECT_DOUBLE_EQ(distance(hollow, 0.0, -2.0), 1.0);
  EXPECT_DOUBLE_EQ(distance(hollow, 0.0, -4.0), -1.0);
  EXPECT_DOUBLE_EQ(hollow.nearest<double>({0.0, -4.0}).normal[1], 1.0);
}

TEST(Profile, BeyondTheFreeEndOfAnArcThereIsNoBody) {
  const Profile hill(std::vector{arc({-3, 0}, {0, 3}, {0, 0}, false)});
  EXPECT_DOUBLE_EQ(distance(hill, 4.0, 3.0), 4.0);
  EXPECT_GT(distance(hill, 1.0, -2.0), 0.0);
}

TEST(Profile, FullCircleAndArcBeyondHalfATurn) {
  const Profile circle(std::vector{arc({3, 0}, {3, 0}, {0, 0}, false)});
  const Profile most(std::vector{arc({0, -3}, {-3, 0}, {0, 0}, true)});  // 270 degrees through +x and +y
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.1 + i * std::numbers::pi / 6, x = std::cos(angle), y = std::sin(angle);
    EXPECT_NEAR(distance(circle, 2 * x, 2 * y), -1.0, 1e-15);
    EXPECT_NEAR(distance(circle, 5 * x, 5 * y), 2.0, 2e-15);
    const bool in_gap = x < 0 && y < 0;
    if (!in_gap) {
      EXPECT_NEAR(distance(most, 4 * x, 4 * y), -1.0, 2e-15);
    }
    if (in_gap) {
      EXPECT_GT(distance(most, 4 * x, 4 * y), 1.0);
    }
  }
  const auto centre = circle.nearest<double>({0.0, 0.0});
  EXPECT_DOUBLE_EQ(centre.distance, -3.0);
  EXPECT_NEAR(std::hypot(centre.normal[0], centre.normal[1]), 1.0, 1e-15);
}

TEST(Profile, ClosedChainHasNoEnds) {
  const Profile square(
      std::vector{segment({0, 0}, {0, 4}), segment({0, 4}, {4, 4}), segment({4, 4}, {4, 0}), segment({4, 0}, {0, 0})});
  EXPECT_EQ(distance(square, 2.0, 1.0), -1.0);
  EXPECT_EQ(distance(square, 2.0, 7.0), 3.0);
  EXPECT_DOUBLE_EQ(distance(square, -3.0, -4.0), 5.0);
  EXPECT_DOUBLE_EQ(distance(square, 7.0, 8.0), 5.0);
}

TEST(Profile, SharpCornersKeepTheSignOfTheSideOnWhichThePointLies) {
  const Profile step(std::vector{segment({-9, 0}, {0, 0}), segment({0, 0}, {0, 5}), segment({0, 5}, {9, 5})});
  EXPECT_DOUBLE_EQ(distance(step, -3.0, 9.0), 5.0);   // above and before the upper edge
  EXPECT_DOUBLE_EQ(distance(step, 3.0, -4.0), -5.0);  // in the ground behind the foot
  const auto deep = step.nearest<double>({3.0, -4.0});
  EXPECT_DOUBLE_EQ(deep.normal[0], -0.6);  // the shortest way out
  EXPECT_DOUBLE_EQ(deep.normal[1], 0.8);
}

TEST(Profile, NearestEqualsBruteForce) {
  const Profile road(road_with_obstacle());
  const auto samples = sampled_road(4000);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(-120, 120), y(-20, 50);
  for (int i = 0; i < 300; ++i) {
    const double px = x(random), py = y(random);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& s : samples) least = std::min(least, std::hypot(px - s[0], py - s[1]));
    // The longest piece is sampled every 145/4000; a sample is off the foot by half of that at most, the distance by
    // its square over twice the distance, or by half of it close to the surface.
    ASSERT_NEAR(std::abs(distance(road, px, py)), least, 0.5 * 145.0 / 4000) << px << " " << py;
    const bool in_ground = py < 0.0 && std::abs(px) > 60.0, in_air = py > 25.0;
    if (in_ground) {
      ASSERT_LT(distance(road, px, py), 0.0);
    }
    if (in_air) {
      ASSERT_GT(distance(road, px, py), 0.0);
    }
  }
}

// Along a path a little inside the surface, over all joints, the distance is the path's depth and the normal turns
// continuously.
TEST(Profile, DistanceAndNormalAreContinuousAcrossTangentJoints) {
  const Profile road(road_with_obstacle());
  const auto samples = sampled_road(500);
  PlanePoint previous{};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto on = road.nearest<double>(samples[i]);
    EXPECT_NEAR(on.distance, 0.0, 1e-13);
    const auto inside = road.nearest<double>({samples[i][0] - 0.5 * on.normal[0], samples[i][1] - 0.5 * on.normal[1]});
    EXPECT_NEAR(inside.distance, -0.5, 1e-13);
    if (i > 0) {
      const double turn = std::hypot(inside.normal[0] - previous[0], inside.normal[1] - previous[1]);
      EXPECT_LT(turn, 1.01 * 0.5 * std::numbers::pi / 500) << "at " << samples[i][0] << " " << samples[i][1];
    }
    previous = inside.normal;
  }
}

// A node that lies a rounding error beyond both pieces of a tangent joint must not change side.
TEST(Profile, RoundOffAtAJointDoesNotFlipTheSign) {
  const Profile road(road_with_obstacle());
  for (const PlanePoint joint :
       {PlanePoint{-55, 0}, {-50, 5}, {-50, 20}, {-45, 25}, {45, 25}, {50, 20}, {50, 5}, {55, 0}}) {
    const auto on = road.nearest<double>(joint);
    for (const double along : {-1e-15, -1e-16, 0.0, 1e-16, 1e-15})
      for (const double depth : {-3.0, -1e-3, 1e-3, 3.0}) {
        const double x = joint[0] + depth * on.normal[0] - along * on.normal[1];
        const double y = joint[1] + depth * on.normal[1] + along * on.normal[0];
        EXPECT_NEAR(distance(road, x, y), depth, 1e-13);
      }
  }
}

// The gradient of a signed distance is its normal; central differences of step h err by h^2 / (6 r^2).
TEST(Profile, DualDerivativeOfTheDistanceIsTheNormal) {
  const Profile road(road_with_obstacle());
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> x(-100, 100), y(-3, 30);
  for (int i = 0; i < 200; ++i) {
    const double px = x(random), py = y(random);
    const auto at = road.nearest<Dual<2>>({Dual<2>(px, 0), Dual<2>(py, 1)});
    EXPECT_EQ(at.distance.value, distance(road, px, py));
    EXPECT_NEAR(at.distance.derivative[0], at.normal[0].value, 1e-14);
    EXPECT_NEAR(at.distance.derivative[1], at.normal[1].value, 1e-14);
  }
}

TEST(Profile, DualDerivativeOfTheNormalIsTheCurvature) {
  const Profile hill(std::vector{arc({-3, 0}, {3, 0}, {0, 0}, false)});
  const auto at = hill.nearest<Dual<2>>({Dual<2>(0.0, 0), Dual<2>(2.0, 1)});
  EXPECT_DOUBLE_EQ(at.normal[0].derivative[0], 0.5);  // 1 / distance from the centre
  EXPECT_DOUBLE_EQ(at.normal[1].derivative[1], 0.0);
}

TEST(Profile, AtASharpCornerTheDerivativeIsThatOfTheDistanceToIt) {
  const Profile step(std::vector{segment({-9, 0}, {0, 0}), segment({0, 0}, {0, 5}), segment({0, 5}, {9, 5})});
  const auto at = step.nearest<Dual<2>>({Dual<2>(3.0, 0), Dual<2>(-4.0, 1)});
  EXPECT_DOUBLE_EQ(at.distance.derivative[0], at.normal[0].value);
  EXPECT_DOUBLE_EQ(at.distance.derivative[1], at.normal[1].value);
}

TEST(Profile, WhatIsSurelyOutsideIsOutside) {
  const Profile road(road_with_obstacle());
  EXPECT_TRUE(road.surely_outside({0, 25.001}));
  EXPECT_FALSE(road.surely_outside({0, 25.0}));
  EXPECT_FALSE(road.surely_outside({100, 20.0}));  // above the road, but the obstacle is higher
  const Profile hill(std::vector{segment({-9, 0}, {-3, 0}), arc({-3, 0}, {3, 0}, {0, 0}, false), segment({3, 0}, {9, 0})});
  EXPECT_FALSE(hill.surely_outside({0, 3.0}));
  EXPECT_TRUE(hill.surely_outside({0, 3.001}));
  const Profile step(std::vector{segment({-9, 0}, {0, 0}), segment({0, 0}, {0, -5}), segment({0, -5}, {9, -5})});
  EXPECT_TRUE(step.surely_outside({5, 0.001}));
  const Profile roof(
      std::vector{segment({-9, -9}, {0, 0}), segment({0, 0}, {9, -9})});  // ends that are not parallel: no bound
  EXPECT_FALSE(roof.surely_outside({0, 100.0}));
}

TEST(Profile, TiesGoToTheLowerPiece) {
  const Profile ditch(std::vector{segment({0, 5}, {0, 0}), segment({0, 0}, {4, 0}), segment({4, 0}, {4, 5})});
  const auto middle = ditch.nearest<double>({2.0, 3.0});
  EXPECT_DOUBLE_EQ(middle.distance, 2.0);
  EXPECT_DOUBLE_EQ(middle.normal[0], 1.0);  // the left wall, not the right one
}

}  // namespace
}  // namespace balocco
