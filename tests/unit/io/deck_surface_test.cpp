// Surfaces of faces and analytical profiles.
#include <gtest/gtest.h>

#include <cmath>

#include "deck_support.hpp"

namespace balocco {
namespace {

using test::brick;
using test::read;

Surface surface_of(const std::string& deck, const std::string& more = "") {
  return read(brick + deck + more).model.surfaces.back();
}

TEST(DeckSurface, FaceLabels) {
  const auto surface = surface_of("*SURFACE, NAME=S\nALL, S2\n1, S6\n");
  ASSERT_EQ(surface.faces.size(), 2u);
  EXPECT_EQ(surface.faces[0].face, 1);
  EXPECT_EQ(surface.faces[1].face, 5);
}

TEST(DeckSurface, FreeFacesOfTwoBricks) {
  const auto model = read(brick +
                          "*NODE\n9, 0., 0., 2.\n10, 1., 0., 2.\n11, 1., 1., 2.\n12, 0., 1., 2.\n"
                          "*ELEMENT, TYPE=C3D8R, ELSET=ALL\n2, 5, 6, 7, 8, 9, 10, 11, 12\n*SURFACE, NAME=SKIN\nALL\n"
                          "*SURFACE, NAME=LOWER\n1\n")
                         .model;
  EXPECT_EQ(model.surfaces[0].faces.size(), 10u);
  EXPECT_EQ(model.surfaces[1].faces.size(), 5u);  // its face towards element 2 is inside the body
}

TEST(DeckSurface, ExtrudedAxes) {
  // The generator a -> c is the negative third axis: with c along +y the second axis of the profile points up.
  const auto surface = surface_of(
      "*SURFACE, TYPE=CYLINDER, NAME=ROAD\n1., 2., 3., 2., 2., 3.\n1., 3., 3.\nSTART, -1., 0.\nLINE, 4., 0.\n");
  ASSERT_TRUE(surface.analytical);
  EXPECT_EQ(surface.analytical->origin, (Point{1, 2, 3}));
  EXPECT_EQ(surface.analytical->axes[0], (Point{1, 0, 0}));
  EXPECT_EQ(surface.analytical->axes[1], (Point{0, 0, 1}));
  EXPECT_EQ(surface.analytical->axes[2], (Point{0, -1, 0}));
  EXPECT_EQ(surface.analytical->profile[0].end[0], 4.0);
}

TEST(DeckSurface, RevolvedAxes) {
  const auto surface =
      surface_of("*SURFACE, TYPE=REVOLUTION, NAME=RIM\n0., 0., 0., 0., 2., 0.\nSTART, 1., 0.\nLINE, 1., 3.\n");
  const auto& axes = surface.analytical->axes;
  EXPECT_EQ(surface.analytical->kind, AnalyticalSurface::Kind::revolved);
  EXPECT_EQ(axes[1], (Point{0, 1, 0}));
  for (int i = 0; i < 3; ++i) {  // right-handed
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    EXPECT_NEAR(axes[0][j] * axes[1][k] - axes[0][k] * axes[1][j], axes[2][i], 1e-15);
  }
}

TEST(DeckSurface, CornersAreRounded) {
  // A step up: right angles of radius 0.5 to the left, then to the right.
  const auto profile =
      surface_of(
          "*SURFACE, TYPE=SEGMENTS, NAME=STEP, FILLET RADIUS=0.5\nSTART, 0., 0.\nLINE, 2., 0.\nLINE, 2., 3.\n"
          "LINE, 4., 3.\n")
          .analytical->profile;
  ASSERT_EQ(profile.size(), 5u);
  const auto expect = [](const std::array<double, 2>& p, double x, double y) {
    EXPECT_NEAR(p[0], x, 1e-15);
    EXPECT_NEAR(p[1], y, 1e-15);
  };
  EXPECT_EQ(profile[1].kind, ProfileSegment::Kind::arc);
  EXPECT_TRUE(profile[1].counter_clockwise);
  expect(profile[1].centre, 1.5, 0.5);
  expect(profile[1].start, 1.5, 0.0);
  expect(profile[1].end, 2.0, 0.5);
  EXPECT_FALSE(profile[3].counter_clockwise);
  expect(profile[3].centre, 2.5, 2.5);
  for (std::size_t k = 1; k < profile.size(); ++k) EXPECT_EQ(profile[k].start, profile[k - 1].end);
}

TEST(DeckSurface, FilletBetweenLineAndArcIsTangentToBoth) {
  // A half-round bump of radius 1 on a flat road; fillets of radius r touch the road at sqrt((1 + r)^2 - r^2) from its
  // centre.
  const double r = 0.25, touch = std::sqrt((1 + r) * (1 + r) - r * r);
  const auto profile = surface_of(
                           "*SURFACE, TYPE=SEGMENTS, NAME=BUMP, FILLET RADIUS=0.25\nSTART, -3., 0.\nLINE, -1., 0.\n"
                           "CIRCL, 0., 1., 0., 0.\nCIRCL, 1., 0., 0., 0.\nLINE, 3., 0.\n")
                           .analytical->profile;
  ASSERT_EQ(profile.size(), 6u);
  EXPECT_NEAR(profile[1].start[0], -touch, 1e-14);
  EXPECT_NEAR(profile[1].centre[1], r, 1e-14);
  EXPECT_NEAR(std::hypot(profile[1].end[0], profile[1].end[1]), 1.0, 1e-14);
  EXPECT_NEAR(profile[4].end[0], touch, 1e-14);
  EXPECT_TRUE(profile[1].counter_clockwise);
  EXPECT_FALSE(profile[2].counter_clockwise);
}

TEST(DeckSurface, SlipToleranceIsAFractionOfTheFaces) {
  const auto model =
      read(brick +
           "*NODE\n100, 0., 0., -1.\n*SURFACE, NAME=BOTTOM\nALL, S1\n*SURFACE, TYPE=SEGMENTS, NAME=ROAD\n"
           "START, -5., 0.\nLINE, 5., 0.\n*RIGID BODY, REF NODE=100, ANALYTICAL SURFACE=ROAD\n"
           "*SURFACE INTERACTION, NAME=I\n*FRICTION, SLIP TOLERANCE=0.005\n0.3\n*CONTACT PAIR, INTERACTION=I\nBOTTOM, "
           "ROAD\n")
          .model;
  EXPECT_DOUBLE_EQ(model.interactions[0].elastic_slip.value(), 0.005);  // unit edges
  EXPECT_EQ(model.interactions[0].friction, 0.3);
}

}  // namespace
}  // namespace balocco
