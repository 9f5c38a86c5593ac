#include "sections/lamination.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "membrane_fixture.hpp"

namespace balocco::test {
namespace {

/// Two plies of VERIFY CLT (E1 3000, E2 10, G12 3.3, nu12 0.45) at +-20 degrees, 0.5 thick each.
Sheet angle_ply(const std::string& type = "M3D4R") {
  Sheet sheet = rectangle(type, 2.0, 1.0);
  sheet.set_law("lamina", {3000.0, 10.0, 0.45, 3.3, 3.3, 3.3});
  const double angle = 20.0 * M_PI / 180.0;
  sheet.model.sections[0].material = -1;
  sheet.model.sections[0].thickness = 1.0;
  sheet.model.sections[0].plies = {{0.5, 0, angle}, {0.5, 0, -angle}};
  return sheet;
}

TEST(Lamination, AnglePlyStiffnessIsTheClosedForm) {
  const Sheet sheet = angle_ply();
  const Laminate stack = laminate(sheet.model, sheet.model.sections[0]);
  const auto& q = stack.stiffness;
  // VERIFY CLT, closed form with seven digits; the row asks for 0.1 %
  EXPECT_NEAR(q[0], 2343.195, 1e-3);
  EXPECT_NEAR(q[4], 51.1754, 1e-4);
  EXPECT_NEAR(q[1], 313.334, 1e-3);
  EXPECT_NEAR(q[8], 312.131, 1e-3);
  EXPECT_NEAR(q[2], 0.0, 1e-10);
  const PlaneStiffness s = compliance(q);
  EXPECT_NEAR(1.0 / s[0], 424.730, 1e-3);
  EXPECT_NEAR(-s[1] / s[0], 6.12275, 1e-5);
  EXPECT_DOUBLE_EQ(stack.thickness, 1.0);
  EXPECT_DOUBLE_EQ(stack.density, 2e-3);
}

TEST(Lamination, DensityIsThicknessWeighted) {
  Sheet sheet = angle_ply();
  sheet.model.materials.push_back(sheet.model.materials[0]);
  sheet.model.materials[1].density = 8e-3;
  sheet.model.sections[0].plies = {{0.5, 0, 0.0}, {0.25, 1, 0.0}};
  EXPECT_DOUBLE_EQ(laminate(sheet.model, sheet.model.sections[0]).density, 4e-3);
}

TEST(Lamination, TurningThereAndBackChangesNothing) {
  const PlaneStiffness q{7.0, 2.0, 0.5, 2.0, 5.0, -0.3, 0.5, -0.3, 1.5};
  const PlaneStiffness back = rotated_stiffness(rotated_stiffness(q, 0.7), -0.7);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(back[i], q[i], 1e-14);
  EXPECT_NEAR(greatest_modulus(q), greatest_modulus(rotated_stiffness(q, 0.7)), 1e-13);
}

TEST(Lamination, CompositeMembraneStretchesAsThePliesSay) {
  for (const char* type : {"M3D4", "M3D4R", "M3D3"}) {
    Sheet sheet = angle_ply(type);
    sheet.build();
    const double strain = 1e-5;
    sheet.position = sheet.positions([&](const Point& x) { return Point{(1.0 + strain) * x[0], x[1], x[2]}; });
    std::array<double, 6> stress{};
    sheet.group->output("S", 0, 0, {sheet.position.data()}, sheet.initial_history(), stress);
    EXPECT_NEAR(stress[0] / strain, 2343.195, 0.1);  // second order in the strain
    EXPECT_NEAR(stress[1] / strain, 313.334, 0.02);
  }
}

TEST(Lamination, StableIncrementKnowsTheDirectionsOfThePlies) {
  for (const char* type : {"M3D4", "M3D4R", "M3D3"})
    for (const double width : {0.2, 1.0, 5.0}) {
      Sheet sheet = angle_ply(type);
      for (Point& x : sheet.model.nodes.coordinates) x[1] *= width;
      sheet.build();
      StableIncrement stable;
      sheet.explicit_forces({}, &stable);
      EXPECT_LE(stable.increment, sheet.exact_increment() * (1.0 + 1e-9)) << type << width;
      EXPECT_GE(stable.increment, sheet.exact_increment() * 0.9) << type << width;
    }
}

TEST(Lamination, RubberPlyIsRefused) {
  Sheet sheet = angle_ply();
  sheet.set_law("neo-hooke", {1.0, 0.0});
  try {
    laminate(sheet.model, sheet.model.sections[0]);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("not linear elastic"), std::string::npos);
  }
}

}  // namespace
}  // namespace balocco::test
