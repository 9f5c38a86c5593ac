#include <gtest/gtest.h>

#include <cmath>

#include "elements/springs/force_curve.hpp"
#include "membrane_fixture.hpp"
#include "model/diagnostics.hpp"

namespace balocco::test {
namespace {

using Table = std::vector<std::array<double, 2>>;

/// Bump and rebound differ, and the ends are flat.
const Table bump_and_rebound{{-2.0, -7.0}, {-1.0, -3.0}, {0.0, 0.0}, {1.0, 1.0}, {3.0, 2.0}};

Sheet connection(const std::string& type, SpringProperty property) {
  Sheet sheet = type.back() == '1' ? Sheet(type, {{1.0, 2.0, 3.0}}, {0}) : Sheet(type, {{1.0, 2.0, 3.0}, {1.6, 2.0, 3.8}}, {0, 1});
  sheet.model.sections[0].spring = std::move(property);
  sheet.build();
  return sheet;
}

/// Internal forces and history after an increment of that length, from the undeformed state.
Eigen::VectorXd force_of(const Sheet& sheet, double increment, std::vector<double>& history, Eigen::MatrixXd* stiffness = nullptr) {
  const auto old = history;
  const int n = sheet.dofs();
  std::vector<double> f(n), k(n * n);
  const NodalMotion motion{.position = sheet.position.data(), .increment = increment};
  EXPECT_TRUE(sheet.group->linearize(0, motion, old, history, f, k));
  if (stiffness != nullptr) *stiffness = Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(k.data(), n, n);
  return Eigen::Map<Eigen::VectorXd>(f.data(), n);
}

const std::vector<std::string> spring_types{"SPRINGA", "SPRING1", "SPRING2", "DASHPOTA", "DASHPOT1", "DASHPOT2"};

SpringProperty property_of(const std::string& type, const Table& table) {
  SpringProperty property{.slope = table.empty() ? 40.0 : 0.0, .table = table};
  if (type.back() != 'A') property.freedom = {0, 2};
  if (type.back() == '1') property.freedom[1] = -1;
  return property;
}

TEST(ForceCurve, IsStraightBetweenPointsAndConstantBeyond) {
  const ForceCurve curve(0.0, bump_and_rebound);
  EXPECT_DOUBLE_EQ(curve.at(-9.0).force, -7.0);
  EXPECT_DOUBLE_EQ(curve.at(-1.5).force, -5.0);
  EXPECT_DOUBLE_EQ(curve.at(0.5).force, 1.0 * 0.5);
  EXPECT_DOUBLE_EQ(curve.at(2.0).force, 1.5);
  EXPECT_DOUBLE_EQ(curve.at(5.0).force, 2.0);
  EXPECT_DOUBLE_EQ(curve.at(5.0).slope, 0.0);
  EXPECT_DOUBLE_EQ(curve.at(0.0).slope, 1.0);   // the piece on the right
  EXPECT_DOUBLE_EQ(curve.at(-2.0).slope, 4.0);
  EXPECT_DOUBLE_EQ(curve.at(3.0).slope, 0.5);   // the piece that ends there
  EXPECT_DOUBLE_EQ(curve.steepest(), 4.0);
  EXPECT_DOUBLE_EQ(curve.largest_force(), 7.0);
}

TEST(ForceCurve, IntegralIsTheWorkFromRest) {
  for (const Table& table : {Table{}, bump_and_rebound, Table{{1.0, 2.0}, {2.0, 5.0}}, Table{{-3.0, 1.0}, {-2.0, 5.0}}}) {
    const ForceCurve curve(table.empty() ? 3.0 : 0.0, table);
    EXPECT_DOUBLE_EQ(curve.integral(0.0), 0.0);
    for (const double at : {-4.0, -1.5, -1.0, 0.3, 1.0, 2.5, 3.0, 6.0}) {
      const int steps = 4000;
      double sum = 0.0;
      for (int i = 0; i < steps; ++i) sum += curve.at(at * (i + 0.5) / steps).force * at / steps;
      EXPECT_NEAR(curve.integral(at), sum, 2e-6 * (1.0 + std::abs(sum)) + 1e-5) << at;
    }
  }
}

TEST(ForceCurve, TautnessBoundsForcePerLength) {
  const ForceCurve curve(0.0, Table{{-0.5, 10.0}, {1.0, 12.0}});
  EXPECT_DOUBLE_EQ(curve.tautness(1.0), 20.0);
  EXPECT_DOUBLE_EQ(ForceCurve(5.0, {}).tautness(2.0), 5.0);  // k (l - L) / l stays below k
}

TEST(Spring, ForceIsTheCurveOfTheRelativeDisplacement) {
  for (const auto& type : spring_types) {
    if (type[0] != 'S') continue;
    Sheet sheet = connection(type, property_of(type, bump_and_rebound));
    EXPECT_EQ(force_of(sheet, 0.0, sheet.history).norm(), 0.0) << type;
    sheet.position[0] += 0.7;  // of the first node along x
    std::vector<double> history(3);
    const auto f = force_of(sheet, 0.0, history);
    if (type == "SPRINGA") {  // (0.6, 0, 0.8) becomes (-0.1, 0, 0.8): shorter by 1 - sqrt(0.65)
      const double l = std::sqrt(0.65), pull = 3.0 * (l - 1.0);
      EXPECT_NEAR(f[3], pull * -0.1 / l, 1e-14);
      EXPECT_NEAR(f[5], pull * 0.8 / l, 1e-14);
      EXPECT_NEAR((f.head<3>() + f.tail<3>()).norm(), 0.0, 1e-14);
    } else {
      EXPECT_NEAR(f[0], 0.7, 1e-14) << type;
      if (type == "SPRING2") EXPECT_NEAR(f[5], -0.7, 1e-14);
    }
    EXPECT_NEAR(sheet.group->energies(0, {}, history).strain, type == "SPRINGA" ? 1.5 * std::pow(1.0 - std::sqrt(0.65), 2) : 0.245, 1e-14);
  }
}

TEST(Spring, RotationOfTheLineStrainsNothingAndDirectionsFollowOrientationAndTransform) {
  Sheet axial = connection("SPRINGA", {.slope = 40.0});
  axial.position = axial.positions([](const Point& x) { return Point{x[2], x[0] + 5.0, x[1]}; });
  std::vector<double> history(3);
  EXPECT_LT(force_of(axial, 0.0, history).norm(), 1e-13);

  Sheet turned("SPRING1", {{1.0, 2.0, 3.0}}, {0});
  turned.model.sections[0].spring = {.freedom = {0, -1}, .slope = 40.0};
  turned.model.transforms.push_back({{0}, {.axes = {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}}});
  turned.build();
  turned.position[1] += 0.5;
  history.assign(3, 0.0);
  EXPECT_DOUBLE_EQ(force_of(turned, 0.0, history)[1], 20.0);
  turned.model.orientations.push_back({.axes = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}});
  turned.model.sections[0].orientation = 0;  // goes before the node's own directions
  turned.build();
  turned.position[2] += 0.5;
  history.assign(3, 0.0);
  EXPECT_DOUBLE_EQ(force_of(turned, 0.0, history)[2], 20.0);
}

TEST(Spring, TangentIsTheDerivativeOfTheForce) {
  for (const auto& type : spring_types)
    for (const Table& table : {Table{}, bump_and_rebound}) {
      Sheet sheet = connection(type, property_of(type, table));
      sheet.disturb(0.3, 5);
      std::vector<double> history(3, 0.0);
      Eigen::MatrixXd k;
      force_of(sheet, 0.25, history, &k);
      const double step = 1e-6;
      for (int j = 0; j < sheet.dofs(); ++j) {
        double& x = sheet.position[4 * (j / 3) + j % 3];
        const double at = x;
        const auto moved = [&](double by) {
          x = at + by;
          std::vector<double> other(3, 0.0);
          const auto f = force_of(sheet, 0.25, other);
          x = at;
          return f;
        };
        EXPECT_LT(((moved(step) - moved(-step)) / (2.0 * step) - k.col(j)).norm(), 1e-7 * (1.0 + k.norm())) << type;
      }
    }
}

TEST(Spring, ExplicitAndStaticIncrementsAreOneAndTheSame) {
  for (const auto& type : spring_types) {
    Sheet sheet = connection(type, property_of(type, bump_and_rebound));
    sheet.disturb(0.3, 9);
    std::vector<double> history(3, 0.0);
    const auto f = force_of(sheet, 0.25, history);
    const auto explicit_force = sheet.explicit_forces({.increment = 0.25});
    for (int i = 0; i < sheet.dofs(); ++i) EXPECT_NEAR(explicit_force[4 * (i / 3) + i % 3], -f[i], 1e-8) << type;
    std::vector<double> own(3);
    sheet.group->gather_history(0, sheet.history, own);
    EXPECT_EQ(own, history) << type;
    EXPECT_NE(history[1], 0.0) << type;
  }
}

// A damper that is pulled at a constant speed takes c v per second of every metre: energy c v^2 t.
TEST(Dashpot, DissipatesForceTimesWay) {
  Sheet sheet = connection("DASHPOT1", {.freedom = {1, -1}, .slope = 40.0});
  const double speed = 0.2, increment = 0.25;
  for (int i = 1; i <= 10; ++i) {
    sheet.position[1] = 2.0 + speed * increment * i;
    sheet.explicit_forces({.increment = increment});
  }
  std::vector<double> own(3), values(6);
  sheet.group->gather_history(0, sheet.history, own);
  EXPECT_NEAR(sheet.group->energies(0, {}, own).viscous, 40.0 * speed * speed * (2.5 - 0.5 * increment), 1e-12);
  EXPECT_EQ(sheet.group->energies(0, {}, own).strain, 0.0);
  sheet.group->output("S", 0, 0, {}, own, values);
  EXPECT_NEAR(values[0], 40.0 * speed, 1e-12);
  sheet.group->output("E", 0, 0, {}, own, values);
  EXPECT_NEAR(values[0], speed * 2.5, 1e-12);
}

TEST(Spring, OfRotationsExertsMoments) {
  Sheet sheet = connection("SPRING2", {.freedom = {4, 4}, .slope = 40.0});
  ASSERT_EQ(sheet.group->freedoms_per_node(), 6);
  const std::vector<double> rotation{9.0, 0.3, 9.0, 0.0, 9.0, -0.2, 9.0, 0.0};
  const NodalMotion motion{.position = sheet.position.data(), .rotation = rotation.data()};
  std::vector<double> history(3), force(12), stiffness(144);
  ASSERT_TRUE(sheet.group->linearize(0, motion, std::vector<double>(3), history, force, stiffness));
  for (int i = 0; i < 12; ++i) {
    EXPECT_DOUBLE_EQ(force[i], i == 4 ? 20.0 : i == 10 ? -20.0 : 0.0);
    for (int j = 0; j < 12; ++j)
      EXPECT_DOUBLE_EQ(stiffness[12 * i + j], i % 6 == 4 && j % 6 == 4 ? (i == j ? 40.0 : -40.0) : 0.0);
  }
}

TEST(Spring, WithoutLengthIsRefusedWhereItNeedsOne) {
  Sheet sheet("SPRINGA", {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}, {0, 1});
  EXPECT_THROW(sheet.build(), InputError);
  Sheet fixed("SPRING2", {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}, {0, 1});
  fixed.model.sections[0].spring = {.freedom = {0, 0}, .slope = 1.0};
  EXPECT_NO_THROW(fixed.build());
}

}  // namespace
}  // namespace balocco::test
