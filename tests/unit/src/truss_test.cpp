#include <gtest/gtest.h>

#include <cmath>

#include "membrane_fixture.hpp"

namespace balocco::test {
namespace {

Sheet bar(double length) { return Sheet("T3D2", {{1.0, 2.0, 3.0}, {1.0 + 0.6 * length, 2.0, 3.0 + 0.8 * length}}, {0, 1}); }

// VERIFY DT-T3D2: E 210e9, rho 7850, L 0.1 give L / c = 1.933415e-5 with lumped masses (closed form, 7 digits given).
TEST(Truss, StableIncrementIsTheClosedForm) {
  Sheet sheet = bar(0.1);
  sheet.model.materials[0].density = 7850.0;
  sheet.set_law("elastic", {210e9, 0.3});
  sheet.build();
  StableIncrement stable;
  sheet.explicit_forces({}, &stable, 1e12);
  EXPECT_NEAR(stable.increment, 0.1 / std::sqrt(210e9 / 7850.0), 1e-12 * stable.increment);
  EXPECT_NEAR(stable.increment, 1.933415e-5, 1e-6 * 1.933415e-5);
  EXPECT_NEAR(stable.increment, sheet.exact_increment(), 1e-9 * stable.increment);
}

TEST(Truss, StableIncrementIsSafeWhenStretched) {
  for (const double stretch : {0.7, 1.0, 1.5, 2.5})
    for (const auto& [law, parameters] : std::vector<std::pair<std::string, std::vector<double>>>{
             {"elastic", {100.0, 0.3}}, {"neo-hooke", {15.0, 0.01}}}) {
      Sheet sheet = bar(2.0);
      sheet.set_law(law, parameters);
      sheet.build();
      sheet.position = sheet.positions([&](const Point& x) { return Point{stretch * x[0], stretch * x[1], stretch * x[2]}; });
      StableIncrement stable;
      sheet.explicit_forces({}, &stable);
      EXPECT_LE(stable.increment, sheet.exact_increment() * (1.0 + 1e-9)) << law << stretch;
      EXPECT_GT(stable.increment, sheet.exact_increment() * 0.5) << law << stretch;
    }
}

TEST(Truss, ForceIsTheAxialForceAndRotationsAreFree) {
  Sheet sheet = bar(2.0);
  sheet.build();
  const double stretch = 1.1;  // S = E (l^2 - 1) / 2 on the reference area; axial force S A l
  sheet.position = sheet.positions([&](const Point& x) { return Point{stretch * x[2], stretch * x[0], -stretch * x[1]}; });
  const Eigen::VectorXd f = sheet.force();
  const double axial = 100.0 * 0.5 * (stretch * stretch - 1.0) * 2.0 * stretch;
  EXPECT_NEAR(f.tail<3>().norm(), axial, 1e-12 * axial);
  EXPECT_NEAR((f.head<3>() + f.tail<3>()).norm(), 0.0, 1e-13 * axial);
  std::array<double, 6> stress{};
  sheet.group->output("S", 0, 0, {sheet.position.data()}, sheet.initial_history(), stress);
  EXPECT_GT(stress[0], 0.0);
  sheet.position = sheet.positions([&](const Point& x) { return Point{x[2], x[0], x[1]}; });
  EXPECT_LT(sheet.force().norm(), 1e-12);
}

TEST(Truss, TangentIsTheDerivativeOfTheForceAndForceOfTheEnergy) {
  Sheet sheet = bar(2.0);
  sheet.set_law("mooney-rivlin", {10.0, 3.0, 0.02});
  sheet.build();
  sheet.disturb(0.3, 1);
  const Eigen::MatrixXd k = sheet.stiffness();
  const Eigen::VectorXd force = sheet.force();
  const double step = 1e-5;
  for (int j = 0; j < 6; ++j) {
    double& x = sheet.position[4 * (j / 3) + j % 3];
    const double at = x;
    x = at + step;
    const Eigen::VectorXd up = sheet.force();
    const double energy_up = sheet.energies().strain;
    x = at - step;
    const Eigen::VectorXd difference = (up - sheet.force()) / (2.0 * step);
    EXPECT_LT((difference - k.col(j)).norm(), 1e-8 * k.norm());
    EXPECT_NEAR((energy_up - sheet.energies().strain) / (2.0 * step), force[j], 1e-8 * force.norm());
    x = at;
  }
}

TEST(Truss, ExplicitForceEqualsStaticForceAndMassIsHalfEach) {
  Sheet sheet = bar(2.0);
  sheet.build();
  sheet.disturb(0.3, 1);
  const auto force = sheet.explicit_forces({});
  const Eigen::VectorXd f = sheet.force();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(force[4 * (i / 3) + i % 3], -f[i], 1e-8);
  std::array<double, 2> mass{};
  sheet.group->lumped_mass(0, mass);
  EXPECT_DOUBLE_EQ(mass[0], 0.5 * 2e-3 * 2.0 * 2.0);
  EXPECT_DOUBLE_EQ(mass[1], mass[0]);
}

TEST(PointElements, CarryInertiaOnly) {
  for (const char* name : {"MASS", "ROTARYI"}) {
    const ElementType* type = find_element_type(name);
    ASSERT_NE(type, nullptr);
    EXPECT_EQ(type->nodes, 1);
    EXPECT_EQ(type->make_group, nullptr);
  }
}

}  // namespace
}  // namespace balocco::test
