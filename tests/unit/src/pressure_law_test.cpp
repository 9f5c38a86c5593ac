#include "model/pressure_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace balocco {
namespace {

const PressureLaw exponential_law{.kind = PressureLaw::Kind::exponential, .clearance = 0.2, .pressure = 3.0};
const PressureLaw table_law{.kind = PressureLaw::Kind::table, .rows = {{-0.1, 0.0}, {0.1, 2.0}, {0.3, 3.0}}};
const PressureLaw linear_law{.kind = PressureLaw::Kind::linear, .slope = 7.0};
constexpr double never = std::numeric_limits<double>::infinity();

TEST(PressureLaw, HasThePressuresThatTheDeckGives) {
  EXPECT_EQ(exponential_law.at(-0.2).pressure, 0.0);
  EXPECT_NEAR(exponential_law.at(0.0).pressure, 3.0, 1e-14);
  EXPECT_NEAR(exponential_law.at(0.2).pressure, 3.0 * 2.0 * (std::exp(2.0) - 1.0) / (std::numbers::e - 1.0), 1e-12);
  EXPECT_EQ(table_law.at(-0.11).pressure, 0.0);
  EXPECT_NEAR(table_law.at(0.0).pressure, 1.0, 1e-15);
  EXPECT_NEAR(table_law.at(0.2).pressure, 2.5, 1e-15);
  EXPECT_NEAR(table_law.at(0.5).pressure, 4.0, 1e-15);  // on with the last slope
  EXPECT_EQ(table_law.steepest(), 10.0);
}

TEST(PressureLaw, SlopeAndWorkBelongToThePressure) {
  constexpr double h = 1e-5;
  for (const auto& law : {exponential_law, table_law, linear_law})
    for (const double d : {-0.15, -0.02, 0.05, 0.21, 0.6})
      for (const double straight_from : {never, 0.04}) {
        if (law.kind == PressureLaw::Kind::linear && straight_from < never) continue;
        const double slope = (law.at(d + h, straight_from).pressure - law.at(d - h, straight_from).pressure) / (2 * h);
        EXPECT_NEAR(law.at(d, straight_from).slope, slope, 1e-6 * (1.0 + slope)) << d;
        const double pressure = (law.energy(d + h, straight_from) - law.energy(d - h, straight_from)) / (2 * h);
        EXPECT_NEAR(law.at(d, straight_from).pressure, pressure, 1e-6 * (1.0 + pressure)) << d;
      }
}

TEST(PressureLaw, MeanPressureGivesTheWorkAndIsSmoothWhereItIsShort) {
  for (const auto& law : {exponential_law, table_law, linear_law}) {
    EXPECT_NEAR(law.mean_pressure(-0.5, 0.25, never) * 0.75, law.energy(0.25), 1e-14);
    EXPECT_NEAR(law.mean_pressure(0.15, 0.15 + 1e-9, never), law.at(0.15).pressure, 1e-7);
    EXPECT_NEAR(law.mean_pressure(0.15, 0.15 + 3e-6, never), law.at(0.15).pressure, 5e-4);
    EXPECT_EQ(law.mean_pressure(-0.5, -0.4, never), 0.0);
  }
}

TEST(PressureLaw, ExponentialFindsWhereItHasASlope) {
  for (const double d : {-0.19, -0.1, 0.0, 0.7, 3.0}) EXPECT_NEAR(exponential_law.where_slope_is(exponential_law.at(d).slope), d, 1e-12);
  EXPECT_GE(exponential_law.where_slope_is(0.0), exponential_law.start());
}

}  // namespace
}  // namespace balocco
