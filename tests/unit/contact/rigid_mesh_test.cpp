#include "rigid_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace balocco::test {
namespace {

using Facets = std::vector<std::vector<std::int32_t>>;

/// A cube of side 2 about the origin, its quadrilaterals counter-clockwise seen from outside.
RigidMesh cube() {
  std::vector<Vector3<double>> vertices;
  for (int i = 0; i < 8; ++i) vertices.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  const Facets facets{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return RigidMesh(vertices, facets);
}

double distance_to_cube(const Vector3<double>& x) {
  double outside = 0.0, inside = -1e300;
  for (int i = 0; i < 3; ++i) {
    const double excess = std::abs(x[i]) - 1.0;
    outside += excess > 0.0 ? excess * excess : 0.0;
    inside = std::max(inside, excess);
  }
  return outside > 0.0 ? std::sqrt(outside) : inside;
}

TEST(RigidMesh, DistanceToACubeIsTheClosedForm) {
  const RigidMesh mesh = cube();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-6.0, 6.0);
  for (int i = 0; i < 20000; ++i) {
    const double size = i % 2 ? 1.0 : 0.25;
    const Vector3<double> place{size * any(random), size * any(random), size * any(random)};
    const auto at = mesh.nearest(place);
    ASSERT_NEAR(at.distance, distance_to_cube(place), 1e-12);
    ASSERT_NEAR(dot(at.normal, at.normal), 1.0, 1e-12);
    const auto foot = place - at.distance * at.normal;
    ASSERT_NEAR(std::max({std::abs(foot[0]), std::abs(foot[1]), std::abs(foot[2])}), 1.0, 1e-12);
    if (mesh.surely_outside(place)) ASSERT_GT(at.distance, 0.0);
  }
}

TEST(RigidMesh, AtACornerTheMeanNormalServes) {
  const RigidMesh mesh = cube();
  const auto corner = mesh.nearest(Vector3<double>{1.0 + 1e-11, 1.0 + 1e-11, 1.0 + 1e-11});
  EXPECT_NEAR(corner.distance, 1e-11 * std::sqrt(3.0), 1e-15);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(corner.normal[i], std::sqrt(1.0 / 3.0), 1e-9);
  const auto edge = mesh.nearest(Vector3<double>{1.0, 1.0, 0.3});
  EXPECT_NEAR(dot(edge.normal, edge.normal), 1.0, 1e-12);
}

// An L of two squares: in its inner corner both facets are as near, and just beyond the outer one the edge is.
TEST(RigidMesh, TellsInsideFromOutsideAtFoldedEdges) {
  const std::vector<Vector3<double>> vertices{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {0, 1, 1}};
  const Facets valley{{0, 2, 3, 1}, {0, 1, 5, 4}}, ridge{{0, 1, 3, 2}, {0, 4, 5, 1}};
  EXPECT_NEAR(RigidMesh(vertices, valley).nearest(Vector3<double>{0.2, 0.5, 0.1}).distance, 0.1, 1e-14);
  EXPECT_NEAR(RigidMesh(vertices, valley).nearest(Vector3<double>{-0.1, 0.5, -0.2}).distance, -std::sqrt(0.05), 1e-14);
  EXPECT_NEAR(RigidMesh(vertices, ridge).nearest(Vector3<double>{-0.1, 0.5, -0.2}).distance, std::sqrt(0.05), 1e-14);
  EXPECT_NEAR(RigidMesh(vertices, ridge).nearest(Vector3<double>{0.2, 0.5, 0.1}).distance, -0.1, 1e-14);
}

TEST(RigidMesh, BeyondAFreeEdgeThereIsNoBody) {
  const std::vector<Vector3<double>> vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const RigidMesh sheet(vertices, Facets{{0, 1, 2, 3}});
  EXPECT_NEAR(sheet.nearest(Vector3<double>{0.5, 0.4, -0.2}).distance, -0.2, 1e-14);
  EXPECT_NEAR(sheet.nearest(Vector3<double>{1.3, 0.4, -0.4}).distance, 0.5, 1e-14);
  EXPECT_NEAR(sheet.nearest(Vector3<double>{1.3, 1.4, 0.0}).distance, 0.5, 1e-14);
  EXPECT_TRUE(sheet.surely_outside({0.5, 0.5, -9.0}));   // passed by
  EXPECT_FALSE(sheet.surely_outside({0.5, 0.5, -0.2}));
}

/// Nodes along a free edge stay over their facet whatever rounding does to them.
TEST(RigidMesh, RoundingDoesNotCarryOverAFreeEdge) {
  const RigidMesh sheet({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, Facets{{0, 1, 2, 3}});
  for (const double beyond : {-1e-12, 0.0, 1e-12, 1e-8}) {
    const auto at = sheet.nearest(Vector3<double>{1.0 + beyond, 0.4, -1e-3});
    EXPECT_NEAR(at.distance, -1e-3, 1e-15) << beyond;
    EXPECT_NEAR(at.normal[2], 1.0, 1e-15) << beyond;
  }
  EXPECT_GT(sheet.nearest(Vector3<double>{1.001, 0.4, -1e-3}).distance, 0.0);
}

TEST(RigidMesh, DerivativeIsTheNormal) {
  const RigidMesh mesh = cube();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int i = 0; i < 200; ++i) {
    const Vector3<double> place{any(random), any(random), any(random)};
    Vector3<Dual<3>> moving;
    for (int c = 0; c < 3; ++c) moving[c] = Dual<3>(place[c], c);
    const auto at = mesh.nearest(moving);
    const double step = 1e-6;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(at.distance.derivative[c], at.normal[c].value, 1e-12);
      Vector3<double> up = place, down = place;
      up[c] += step;
      down[c] -= step;
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR((mesh.nearest(up).normal[k] - mesh.nearest(down).normal[k]) / (2.0 * step), at.normal[k].derivative[c], 1e-5);
    }
  }
}

// Facets of one sphere by latitude and longitude: no place is further from the sphere than their own sag.
TEST(RigidMesh, AFineSphereIsNearlyASphere) {
  const int n = 40;
  std::vector<Vector3<double>> vertices;
  Facets facets;
  const double pi = std::acos(-1.0);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double a = pi * i / n, b = pi * j / n;
      vertices.push_back({std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const int k = (j + 1) % (2 * n);
      facets.push_back({2 * n * i + j, 2 * n * (i + 1) + j, 2 * n * (i + 1) + k, 2 * n * i + k});
    }
  const RigidMesh mesh(vertices, facets);
  std::mt19937 random(8);
  std::normal_distribution<double> any;
  for (int i = 0; i < 2000; ++i) {
    Vector3<double> place{any(random), any(random), any(random)};
    const double wanted = 0.95 + 0.1 * (i % 11) / 10.0;
    place = (wanted / std::sqrt(dot(place, place))) * place;
    const double sag = 1.0 - std::cos(0.5 * pi / n);
    EXPECT_NEAR(mesh.nearest(place).distance, wanted - 1.0, 2.5 * sag);
  }
}

}  // namespace
}  // namespace balocco::test
