#include "loads/tractions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "membrane_fixture.hpp"

namespace balocco::test {
namespace {

using Kind = SurfaceLoad::Kind;

struct Case {
  const char* name;
  const char* type;
  SurfaceLoad load;
};

class Traction : public testing::TestWithParam<Case> {};

constexpr std::array<double, 3> askew{0.48, -0.6, 0.64};

INSTANTIATE_TEST_SUITE_P(
    Kinds, Traction,
    testing::Values(Case{"Turning", "M3D4", {.kind = Kind::traction, .direction = askew}},
                    Case{"TurningByReferenceArea", "M3D4", {.kind = Kind::traction, .direction = askew, .of_reference = true}},
                    Case{"Staying", "M3D4", {.kind = Kind::traction, .direction = askew, .follows = false}},
                    Case{"Shearing", "M3D3", {.kind = Kind::shear, .direction = askew}},
                    Case{"AlongEdge", "M3D4", {.kind = Kind::edge_shear}}, Case{"IntoSheet", "M3D4", {.kind = Kind::edge_normal}},
                    Case{"IntoTriangle", "M3D3", {.kind = Kind::edge_normal}}, Case{"AcrossEdge", "M3D3", {.kind = Kind::edge_transverse}},
                    Case{"TurningWithEdge", "M3D4", {.kind = Kind::edge_traction, .direction = askew}},
                    Case{"StayingOnEdge", "M3D4", {.kind = Kind::edge_traction, .direction = askew, .follows = false, .of_reference = true}}),
    [](const auto& info) { return info.param.name; });

/// Row of a sheet's node for each of its nodes: all are local.
std::vector<std::int32_t> all_local(const Sheet& sheet) {
  std::vector<std::int32_t> local(sheet.model.nodes.size());
  std::iota(local.begin(), local.end(), 0);
  return local;
}

Tractions tractions_on(Sheet& sheet, SurfaceLoad load) {
  Surface surface;
  (acts_on_edges(load.kind) ? surface.edges : surface.faces).push_back({{0, 0}, 1});
  sheet.model.surfaces = {surface};
  load.surface = 0;
  const std::vector<std::vector<bool>> mine{std::vector<bool>(sheet.model.elements[0].size(), true)};
  sheet.build();
  return Tractions(sheet.model, load, all_local(sheet), mine);
}

TEST_P(Traction, TangentIsTheDerivativeOfTheForce) {
  Sheet sheet = rectangle(GetParam().type, 2.0, 1.0);
  const Tractions tractions = tractions_on(sheet, GetParam().load);
  sheet.disturb(0.2, 9);
  const auto nodes = tractions.nodes(0);
  const std::size_t size = 3 * nodes.size();
  std::vector<double> force(size), stiffness(size * size), up(size), down(size), unused(size * size);
  tractions.linearize(0, 5.0, sheet.position.data(), force, stiffness);
  EXPECT_GT(Eigen::Map<Eigen::VectorXd>(force.data(), static_cast<Eigen::Index>(size)).norm(), 0.1);
  const double step = 1e-5;
  for (std::size_t j = 0; j < size; ++j) {
    double& x = sheet.position[4 * nodes[j / 3] + j % 3];
    const double at = x;
    x = at + step;
    tractions.linearize(0, 5.0, sheet.position.data(), up, unused);
    x = at - step;
    tractions.linearize(0, 5.0, sheet.position.data(), down, unused);
    x = at;
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR((up[i] - down[i]) / (2.0 * step), stiffness[size * i + j], 1e-7);
  }
}

// A motion without strain turns what follows with it, and leaves the rest.
TEST_P(Traction, TurnsWithARigidMotionOrStays) {
  Sheet sheet = rectangle(GetParam().type, 2.0, 1.0);
  const Tractions tractions = tractions_on(sheet, GetParam().load);
  const auto nodes = tractions.nodes(0);
  const std::size_t size = 3 * nodes.size();
  std::vector<double> before(size), after(size), unused(size * size);
  tractions.linearize(0, 5.0, sheet.position.data(), before, unused);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.6, 0.0, 0.8)).toRotationMatrix();
  for (std::size_t node = 0; node < sheet.model.nodes.size(); ++node) {
    Eigen::Map<Eigen::Vector3d> x(&sheet.position[4 * node]);
    x = turn * x + Eigen::Vector3d(3.0, -2.0, 1.0);
  }
  tractions.linearize(0, 5.0, sheet.position.data(), after, unused);
  for (std::size_t i = 0; i < size; i += 3) {
    const Eigen::Vector3d at_first = Eigen::Map<Eigen::Vector3d>(&before[i]);
    const Eigen::Vector3d expected = GetParam().load.follows ? Eigen::Vector3d(turn * at_first) : at_first;
    EXPECT_LT((Eigen::Map<Eigen::Vector3d>(&after[i]) - expected).norm(), 1e-12);
  }
}

// Edge E2 of the rectangle 2 x 1 is the one at its end, 1 long: into the sheet is -x, along the edge +y, against the normal -z.
TEST(Tractions, OfEdgesHaveAbaqusDirections) {
  const auto force_of = [](Kind kind) {
    Sheet sheet = rectangle("M3D4", 2.0, 1.0);
    const Tractions tractions = tractions_on(sheet, {.kind = kind});
    std::array<double, 12> force{};
    std::array<double, 144> unused{};
    tractions.linearize(0, 3.0, sheet.position.data(), force, unused);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(force[i], force[3 + i]);
    return Eigen::Vector3d(force[0] + force[3], force[1] + force[4], force[2] + force[5]);
  };
  EXPECT_LT((force_of(Kind::edge_normal) - Eigen::Vector3d(-3.0, 0.0, 0.0)).norm(), 1e-14);
  EXPECT_LT((force_of(Kind::edge_shear) - Eigen::Vector3d(0.0, 3.0, 0.0)).norm(), 1e-14);
  EXPECT_LT((force_of(Kind::edge_transverse) - Eigen::Vector3d(0.0, 0.0, -3.0)).norm(), 1e-14);
}

}  // namespace
}  // namespace balocco::test
