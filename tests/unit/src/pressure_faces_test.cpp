#include "loads/pressure_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "membrane_fixture.hpp"

namespace balocco::test {
namespace {

/// A surface of one side of every element of a sheet, all local.
struct Loaded {
  Sheet sheet;
  std::unique_ptr<PressureFaces> faces;

  Loaded(Sheet source, std::int32_t side) : sheet(std::move(source)) {
    Surface surface;
    for (std::int32_t row = 0; row < sheet.model.elements[0].size(); ++row) surface.faces.push_back({{0, row}, side});
    std::vector<std::int32_t> local(sheet.model.nodes.size());
    std::iota(local.begin(), local.end(), 0);
    const std::vector<std::vector<bool>> mine{std::vector<bool>(sheet.model.elements[0].size(), true)};
    sheet.build();
    faces = std::make_unique<PressureFaces>(sheet.model, surface, local, mine, sheet.model.nodes.size());
  }

  std::vector<double> forces(double pressure) const {
    std::vector<double> force(sheet.position.size(), 0.0);
    for (std::size_t n = 0; n < force.size() / 4; ++n) force[4 * n + 3] = rounding_constant(1e3);
    faces->add_forces(pressure, sheet.position.data(), force.data());
    force.resize(force.size() - 4);
    return force;
  }
};

Eigen::Vector3d resultant(const std::vector<double>& force) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < force.size(); ++i)
    if (i % 4 != 3) sum[static_cast<int>(i % 4)] += force[i];
  return sum;
}

/// A unit cube of six membranes (or twelve triangles) with outward normals, its corners moved about.
Sheet box(const std::string& type) {
  std::vector<Point> nodes{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<std::int32_t> quads{0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  std::vector<std::int32_t> connectivity = quads;
  if (type == "M3D3") {
    connectivity.clear();
    for (std::size_t f = 0; f < quads.size(); f += 4)
      connectivity.insert(connectivity.end(), {quads[f], quads[f + 1], quads[f + 2], quads[f], quads[f + 2], quads[f + 3]});
  }
  return Sheet(type, nodes, connectivity);
}

class Pressure : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Types, Pressure, testing::Values("M3D4", "M3D3"), [](const auto& info) { return info.param; });

// Round-off of rounding forces to multiples of 1e3 * 2^-51, 36 addends.
TEST_P(Pressure, OnAClosedBoxSumsToZero) {
  Loaded loaded(box(GetParam()), 0);
  loaded.sheet.disturb(0.2, 4);
  const auto force = loaded.forces(7.0);
  EXPECT_LT(resultant(force).norm(), 1e-10);
  EXPECT_GT(std::fabs(force[0]), 0.1);
}

// The work of the pressure is -p dV: here for a growing cube, seen from its centre.
TEST_P(Pressure, PointsIntoTheBoxFromTheOutside) {
  const Loaded outside(box(GetParam()), 0), inside(box(GetParam()), 1);
  const auto work = [](const Loaded& loaded) {
    const auto force = loaded.forces(2.0);
    double sum = 0.0;
    for (int n = 0; n < 8; ++n)
      for (int c = 0; c < 3; ++c) sum += force[4 * n + c] * loaded.sheet.model.nodes.coordinates[n][c];
    return sum;
  };
  EXPECT_NEAR(work(outside), -2.0 * 3.0, 1e-10);  // x . dV/dx = 3 V
  EXPECT_NEAR(work(inside), 2.0 * 3.0, 1e-10);
}

// Abaqus: positive pressure on SPOS acts against the membrane's normal (connectivity, right-hand rule), on SNEG along it.
TEST_P(Pressure, OnAFlatFaceIsPressureTimesArea) {
  const double area = GetParam() == "M3D3" ? 1.0 : 2.0;
  const Loaded positive(rectangle(GetParam(), 2.0, 1.0), 0), negative(rectangle(GetParam(), 2.0, 1.0), 1);
  EXPECT_LT((resultant(positive.forces(3.0)) - Eigen::Vector3d(0, 0, -3.0 * area)).norm(), 1e-11);
  EXPECT_LT((resultant(negative.forces(3.0)) - Eigen::Vector3d(0, 0, 3.0 * area)).norm(), 1e-11);
  const auto force = positive.forces(3.0);  // equal shares of every corner
  const int corners = positive.sheet.group->nodes_per_element();
  for (int i = 0; i < corners; ++i) EXPECT_NEAR(force[4 * i + 2], -3.0 * area / corners, 1e-11);
}

TEST_P(Pressure, TangentIsTheDerivativeOfTheForce) {
  Loaded loaded(rectangle(GetParam(), 2.0, 1.0), 0);
  loaded.sheet.disturb(0.3, 9);
  std::array<double, 12> force{}, up{}, down{};
  std::array<double, 144> stiffness{}, unused{};
  loaded.faces->linearize(0, 5.0, loaded.sheet.position.data(), force, stiffness);
  const auto added = loaded.forces(5.0);
  const auto node = loaded.faces->nodes(0);
  std::vector<double> summed(added.size(), 0.0);
  for (int i = 0; i < 12; ++i) summed[4 * node[i / 3] + i % 3] += force[i];
  for (std::size_t i = 0; i < added.size(); ++i) {
    if (i % 4 != 3) {
      EXPECT_NEAR(summed[i], added[i], 1e-11);
    }
  }

  const int corners = loaded.sheet.group->nodes_per_element();
  const double step = 1e-4;  // the force is quadratic in each coordinate: central differences are exact
  for (int n = 0; n < corners; ++n)
    for (int c = 0; c < 3; ++c) {
      double& x = loaded.sheet.position[4 * n + c];
      const double at = x;
      x = at + step;
      loaded.faces->linearize(0, 5.0, loaded.sheet.position.data(), up, unused);
      x = at - step;
      loaded.faces->linearize(0, 5.0, loaded.sheet.position.data(), down, unused);
      x = at;
      for (int i = 0; i < 12; ++i) {
        double derivative = 0.0;  // a triangle's last node stands twice
        for (int j = 0; j < 4; ++j)
          if (node[j] == n) derivative += stiffness[12 * i + 3 * j + c];
        EXPECT_NEAR((up[i] - down[i]) / (2.0 * step), derivative, 1e-9);
      }
    }
}

TEST(PressureFaces, SkipsElementsOfOtherRanks) {
  Sheet sheet = box("M3D4");
  Surface surface;
  for (std::int32_t row = 0; row < 6; ++row) surface.faces.push_back({{0, row}, 0});
  const std::vector<std::int32_t> local{0, 1, 2, 3, 4, 5, 6, 7};
  const std::vector<std::vector<bool>> mine{{true, false, true, false, false, false}};
  const PressureFaces faces(sheet.model, surface, local, mine, 8);
  EXPECT_EQ(faces.size(), 2);
  EXPECT_EQ(faces.nodes(1)[2], 5);
}

}  // namespace
}  // namespace balocco::test
