// One law for both solvers: its tangent, and the same force from the explicit and the implicit side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact_fixture.hpp"

namespace balocco {
namespace {

using namespace test;

struct TangentCase {
  const char* name;
  AnalyticalSurface surface;
  std::optional<double> elastic_slip;
  double stretch;     // of the tangential spring, in units of its limit
  double lift = 0.0;  // above the surface when the increment began, for a point that closes in it
};

class TangentOrder : public testing::TestWithParam<TangentCase> {};

/// Largest error of the central difference of step `h` in any direction of the node, the master and its spin.
double difference_error(const Contact& contact, double h) {
  ContactPoint updated;
  const auto exact = contact.tangent(updated);
  double error = 0.0;
  for (int direction = 0; direction < 9; ++direction) {
    std::array<double, 3> forces[2];
    for (const int side : {0, 1}) {
      std::vector<double> position = contact.position;
      RigidBodyState master = contact.master;
      const double step = side == 0 ? -h : h;
      if (direction < 3) position[direction] += step;
      if (direction >= 3 && direction < 6) master.position[direction - 3] += step;
      Point spin{};
      if (direction >= 6) spin[direction - 6] = step;
      rotate(master, spin);
      forces[side] = contact.pair.linearize(0, position.data(), master, contact.points[0], updated).force;
    }
    for (int i = 0; i < 3; ++i) {
      const double slope = (forces[1][i] - forces[0][i]) / (2 * h);
      error = std::max(error, std::abs(slope - exact.derivative[9 * i + direction]));
    }
  }
  return error;
}

TEST_P(TangentOrder, DifferencesApproachTheTangentQuadratically) {
  const TangentCase& c = GetParam();
  Contact contact(c.surface, friction, c.elastic_slip);
  rotate(contact.master, {0.25, -0.15, 0.3});
  contact.start_at({4.0, 3.0, -3.0});
  ContactPoint closed;
  ASSERT_TRUE(contact.tangent(closed).closed);
  contact.points[0] = closed;
  contact.points[0].multiplier = 0.7;
  const auto at = contact.pair.output(0, contact.position.data(), contact.master, closed);
  const double limit = c.elastic_slip.value_or(friction * at.pressure * contact.pair.area(0) / contact.k());
  contact.points[0].anchor[0] += 0.8 * c.stretch * limit;
  contact.points[0].anchor[1] -= 0.6 * c.stretch * limit;
  if (c.lift > 0.0) {
    contact.points[0].closed = 0.0;
    const auto normal = contact.pair.output(0, contact.position.data(), contact.master, closed).normal_force;
    const auto local = transpose(rotation_matrix(contact.master)) * Vector3<double>{normal};
    for (int i = 0; i < 3; ++i) contact.points[0].anchor[i] += c.lift / norm(normal) * local[i];
  }
  ContactPoint updated;
  contact.tangent(updated);
  ASSERT_EQ(updated.slip > 0.0, c.stretch > 1.0);

  const double coarse = difference_error(contact, 4e-3), fine = difference_error(contact, 2e-3);
  const double roundoff = 1e-9 * contact.k() * 10;
  EXPECT_LT(fine, 1e-3 * contact.k());
  EXPECT_LT(fine, std::max(0.27 * coarse, roundoff)) << coarse << " " << fine;
}

INSTANTIATE_TEST_SUITE_P(Cases, TangentOrder,
                         testing::Values(TangentCase{"FlatStick", road({line({-300, 0}, {300, 0})}), {}, 0.5},
                                         TangentCase{"FlatSlip", road({line({-300, 0}, {300, 0})}), {}, 3.0},
                                         TangentCase{"HillStick", hilly_road(), {}, 0.5},
                                         TangentCase{"HillSlip", hilly_road(), {}, 3.0},
                                         TangentCase{"HillElasticSlipStick", hilly_road(), 9.0, 0.5},
                                         TangentCase{"HillElasticSlipSlip", hilly_road(), 9.0, 1.5},
                                         TangentCase{"HillClosingStick", hilly_road(), {}, 0.5, 2.0},
                                         TangentCase{"HillClosingSlip", hilly_road(), {}, 3.0, 2.0}),
                         [](const auto& info) { return std::string(info.param.name); });

/// Above the surface, below it and behind where an explicit step goes on straight.
TEST(RigidContact, DifferencesApproachTheTangentOfACurvedLaw) {
  for (const double height : {0.6, -1.0, -4.0}) {
    Contact contact(hilly_road());
    auto interaction = contact.model.interactions[0];
    interaction.behavior = {.kind = PressureLaw::Kind::exponential, .clearance = 2.0, .pressure = 0.4, .greatest_slope = 0.8};
    contact.pair.set_interaction(interaction);
    rotate(contact.master, {0.25, -0.15, 0.3});
    contact.start_at({28.0, 3.0, height});
    ContactPoint closed;
    const auto tangent = contact.tangent(closed);
    ASSERT_TRUE(tangent.closed);
    contact.points[0] = closed;
    contact.points[0].anchor[0] += 0.05;
    EXPECT_LT(difference_error(contact, 2e-3), std::max(0.27 * difference_error(contact, 4e-3), 1e-8)) << height;
  }
}

// What makes the import of contact exact.
TEST(RigidContact, ExplicitAndImplicitForcesAreTheSameBits) {
  Contact contact(hilly_road());
  rotate(contact.master, {0.1, 0.2, -0.3});
  contact.start_at({4.0, 3.0, -2.0});
  contact.force();
  contact.place({-6.0, 13.0, -2.1});
  contact.points[0].multiplier = 0.3;
  std::vector<double> sum(contact.position.size(), 0.0);  // constant 0: rounding changes nothing
  ContactPoint updated;
  const auto implicit = contact.tangent(updated);
  auto points = contact.points;
  contact.pair.add_forces(contact.position.data(), contact.master, points, sum.data());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(sum[i], implicit.force[i]);
  EXPECT_GT(points[0].slip, 0.0);
  EXPECT_EQ(points[0].slip, updated.slip);
  EXPECT_EQ(points[0].anchor, updated.anchor);
  EXPECT_EQ(points[0].frictional_dissipation, updated.frictional_dissipation);
}

TEST(RigidContact, ForceStaysWhereNothingMoves) {
  Contact contact(hilly_road());
  rotate(contact.master, {0.1, 0.2, -0.3});
  contact.start_at({4.0, 3.0, -2.0});
  contact.force();
  contact.place({-6.0, 13.0, -2.1});
  ContactPoint updated;
  const auto implicit = contact.tangent(updated);
  contact.points[0] = updated;
  std::vector<double> sum(contact.position.size(), 0.0);
  for (int cycle = 0; cycle < 100; ++cycle) {
    std::fill(sum.begin(), sum.end(), 0.0);
    contact.pair.add_forces(contact.position.data(), contact.master, contact.points, sum.data());
  }
  // Round-off of an arm of length 16 from the reference node against a stretch of 6.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i], implicit.force[i], 1e-14 * norm(implicit.force));
  EXPECT_NEAR(contact.points[0].slip, updated.slip, 1e-14);
}

}  // namespace
}  // namespace balocco
