// J2 plasticity in plane stress against the condensation of the solid law, which iterates over the thickness.
#include "materials/j2_plane_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "steel.hpp"

namespace balocco::test {

namespace {

/// Two laws along the same path of stretching, shearing and going back.
void expect_alike(const Material& material, double size, int steps, double increment) {
  const auto solid = J2Plasticity::of(material);
  const LawOf<PointKind::plane, J2PlaneStress> closed{J2PlaneStress(solid)};
  const auto iterated = make_condensed_law<PointKind::plane>(solid);
  std::vector<double> a(closed.history_size(), 0.0), b(iterated->history_size(), 0.0);
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const std::array<double, 3> strain{size * std::sin(4.0 * t), -0.3 * size * t, 1.3 * size * std::sin(7.0 * t)};
    std::array<double, 3> s{}, expected{};
    std::array<double, 9> tangent{}, expected_tangent{};
    closed.tangent(strain, increment, a, s, tangent);
    iterated->tangent(strain, increment, b, expected, expected_tangent);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(s[k], expected[k], 1e-10) << "step " << i << " component " << k;
    for (int k = 0; k < 9; ++k) EXPECT_NEAR(tangent[k], expected_tangent[k], 1e-7) << "step " << i << " entry " << k;
    const auto energy = closed.energy_density(strain, a), same = iterated->energy_density(strain, b);
    EXPECT_NEAR(energy.recoverable, same.recoverable, 1e-12);
    EXPECT_NEAR(energy.plastic, same.plastic, 1e-12);
    if (s != std::array<double, 3>{})  // the thickness of what has failed means nothing
      EXPECT_NEAR(closed.transverse_stretch(strain, a), iterated->transverse_stretch(strain, b), 1e-12);
  }
}

TEST(PlaneStress, EqualsTheCondensedSolid) {
  expect_alike(steel({table()}), 0.03, 40, quasi_static);
  expect_alike(steel({table()}), 0.4, 40, quasi_static);  // large strains, large increments
  expect_alike(steel({{"plastic", {0.0}, {{0.4, 0.0}}}}), 0.03, 7, quasi_static);
  expect_alike(steel({table(), {"rate-power-law", {}, {{40.0, 5.0}}}}), 0.03, 40, 1e-4);
  expect_alike(steel({{"plastic-johnson-cook", {}, {{0.4, 0.3, 0.3}}}, {"rate-johnson-cook", {}, {{0.02, 1.0}}}}), 0.03, 40, 1e-4);
  expect_alike(steel({table(), {"shear-failure", {}, {{0.05}}}}), 0.05, 40, 1e-4);
}

}  // namespace

}  // namespace balocco::test
