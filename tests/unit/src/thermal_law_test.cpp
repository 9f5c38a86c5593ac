// Laws with a thermal strain, at one point: what they share with the law inside, and that stress, tangent, energy and heat go together.
#include "materials/expanding.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "materials/isotropic_elastic.hpp"
#include "materials/plane_elastic.hpp"
#include "math/tensor.hpp"
#include "model/thermal_expansion.hpp"

// A name of its own: short names of other tests stay theirs where files are compiled in batches.
namespace balocco::test::thermal_law {

namespace {

constexpr double young = 200.0, poisson = 0.3;
constexpr std::array<double, 9> stretched{1.03, 0.02, -0.01, 0.015, 0.97, 0.01, 0.005, -0.02, 1.01};
enum { thermal, linear, done, force, work };

std::unique_ptr<Law<PointKind::solid>> plain() { return make_solid_law(IsotropicElastic::from_young(young, poisson)); }

struct Point {
  std::unique_ptr<Law<PointKind::solid>> law = expanding(plain());
  std::vector<double> history = std::vector<double>(5, 0.0);
  std::array<double, 9> stress{};
  std::array<double, 81> tangent{};

  void respond(const std::array<double, 9>& strain) { law->tangent(strain, quasi_static, history, stress, tangent); }
  double energy(const std::array<double, 9>& strain) const { return law->energy_density(strain, history).recoverable; }
};

TEST(Expanding, WithoutThermalStrainIsTheLaw) {
  Point point;
  point.respond(stretched);
  std::array<double, 9> stress;
  plain()->tangent(stretched, quasi_static, {}, stress, {});
  EXPECT_EQ(point.stress, stress);
}

TEST(Expanding, FreeExpansionHasNoStress) {
  Point point;
  point.history[thermal] = 0.02;
  point.respond({1.02, 0, 0, 0, 1.02, 0, 0, 0, 1.02});
  for (const double component : point.stress) EXPECT_NEAR(component, 0.0, 1e-12);
}

TEST(Expanding, CauchyStressIsThatOfTheMechanicalPart) {
  Point point;
  point.history[thermal] = 0.02;
  point.respond(stretched);
  std::array<double, 9> part, inner;
  for (int k = 0; k < 9; ++k) part[k] = stretched[k] / 1.02;
  plain()->tangent(part, quasi_static, {}, inner, {});
  const Matrix3<double> f{stretched}, p{point.stress}, fm{part}, pm{inner};
  const auto cauchy = p * transpose(f), expected = pm * transpose(fm);
  const double j = determinant(f, cofactor(f)), jm = determinant(fm, cofactor(fm));
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(cauchy.component[k] / j, expected.component[k] / jm, 1e-12);
}

/// In both orders of strain: stress is the slope of the energy, and the tangent that of the stress.
TEST(Expanding, StressAndTangentAreDerivatives) {
  for (const double first_order : {0.0, 1.0}) {
    Point point;
    point.history[thermal] = 0.02;
    point.history[linear] = first_order;
    point.respond(stretched);
    constexpr double h = 1e-5;
    for (int k = 0; k < 9; ++k) {
      auto up = stretched, down = stretched;
      up[k] += h;
      down[k] -= h;
      EXPECT_NEAR(point.stress[k], (point.energy(up) - point.energy(down)) / (2 * h), 1e-6);
      Point above, below;
      above.history = below.history = {0.02, first_order, 0.0, 0.0, 0.0};
      above.respond(up);
      below.respond(down);
      for (int i = 0; i < 9; ++i) EXPECT_NEAR(point.tangent[9 * i + k], (above.stress[i] - below.stress[i]) / (2 * h), 1e-6);
    }
  }
}

/// Heated where it stands, all energy that comes is the work of heat: the trapezoidal rule errs by the cube of the step.
TEST(Expanding, HeatIsWhatTheEnergyGains) {
  for (const double first_order : {0.0, 1.0}) {
    Point point;
    point.history[linear] = first_order;
    point.respond(stretched);
    const double before = point.energy(stretched);
    double error = 0.0;
    for (const int steps : {4, 8}) {
      point.history = {0.0, first_order, 0.0, 0.0, 0.0};
      point.respond(stretched);
      for (int i = 1; i <= steps; ++i) {
        point.history[thermal] = 0.02 * i / steps;
        point.respond(stretched);
      }
      const double gained = point.energy(stretched) - before, now = std::abs(point.history[work] - gained);
      EXPECT_NEAR(point.history[work] / gained, 1.0, 1e-3);
      if (steps == 8 && first_order == 0.0) EXPECT_NEAR(error / now, 4.0, 0.1);
      error = now;
    }
  }
}

TEST(Expanding, OfFirstOrderIsAnInitialStress) {
  Point point;
  point.history = {0.02, 1.0, 0.0, 0.0, 0.0};
  point.respond({1, 0, 0, 0, 1, 0, 0, 0, 1});
  const double expected = -0.02 * young / (1.0 - 2.0 * poisson);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(point.stress[k], k % 4 == 0 ? expected : 0.0, 1e-12);
}

/// A batch of the explicit loop gives what single points give, history too, and bounds that hold.
TEST(Expanding, PacksEqualPoints) {
  Point point;
  PointBatch<PointKind::solid> batch{};
  batch.count = pack_size;
  std::vector<double> history(5 * pack_size, 0.0);
  for (int lane = 0; lane < pack_size; ++lane) {
    history[lane] = 0.001 * lane;
    for (int k = 0; k < 9; ++k) batch.strain[k][lane] = stretched[k] + 0.001 * k * lane;
  }
  batch.history = history.data();
  batch.history_stride = pack_size;
  point.law->stress(batch);
  for (int lane = 0; lane < pack_size; ++lane) {
    std::array<double, 9> strain;
    for (int k = 0; k < 9; ++k) strain[k] = stretched[k] + 0.001 * k * lane;
    point.history = {0.001 * lane, 0.0, 0.0, 0.0, 0.0};
    point.respond(strain);
    for (int k = 0; k < 9; ++k) {
      EXPECT_EQ(batch.strain[k][lane], strain[k]) << "what the kernel goes on with";
      EXPECT_NEAR(batch.stress[k][lane], point.stress[k], 1e-12);
    }
    for (int row = 0; row < 5; ++row) EXPECT_NEAR(history[row * pack_size + lane], point.history[row], 1e-12) << row;
  }
}

TEST(Expanding, SheetAndLineAreFreeToExpand) {
  const double free = 0.5 * (1.02 * 1.02 - 1.0);
  std::vector<double> history{0.02, 0.0, 0.0, 0.0, 0.0};
  const auto plane = expanding(make_plane_law(PlaneElastic::from_constants({young, young, poisson, young / (2.0 * (1.0 + poisson)), poisson})));
  std::array<double, 3> stress;
  plane->tangent(std::array{free, free, 0.0}, quasi_static, history, stress, {});
  for (const double component : stress) EXPECT_NEAR(component, 0.0, 1e-12);
  EXPECT_NEAR(plane->transverse_stretch(std::array{free, free, 0.0}, history), 1.02, 1e-12);
}

TEST(ThermalExpansion, SecantsRunFromTheReference) {
  const ThermalExpansion table{10.0, {{1e-5, 0.0}, {2e-5, 100.0}}};
  EXPECT_DOUBLE_EQ(table.coefficient(-5.0), 1e-5);
  EXPECT_DOUBLE_EQ(table.coefficient(50.0), 1.5e-5);
  EXPECT_DOUBLE_EQ(table.coefficient(300.0), 2e-5);
  EXPECT_DOUBLE_EQ(table.strain(300.0, 50.0), 2e-5 * 290.0 - 1.5e-5 * 40.0);
  EXPECT_EQ(table.strain(50.0, 50.0), 0.0);
}

}  // namespace

}  // namespace balocco::test::thermal_law
