#include "rigid_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "contact_fixture.hpp"

namespace balocco {
namespace {

using namespace test;

TEST(RigidContact, PenetrationPushesBackAndAGapDoesNothing) {
  Contact contact;
  contact.place({3, 4, 0.01});
  EXPECT_EQ(contact.force(), (Point{0, 0, 0}));
  EXPECT_EQ(contact.points[0].closed, 0.0);
  contact.start_at({3, 4, -0.002});
  const Point force = contact.force();
  EXPECT_NEAR(force[2], 0.002 * contact.k(), 1e-12);
  EXPECT_NEAR(std::hypot(force[0], force[1]), 0.0, 1e-15);
  EXPECT_EQ(contact.points[0].closed, 1.0);
  EXPECT_NEAR(contact.points[0].anchor[0], 3 - reference[0], 1e-15);
  EXPECT_NEAR(contact.points[0].anchor[2], 0 - reference[2], 1e-15);  // on the surface
}

TEST(RigidContact, OpeningForgetsTheMultiplierAndTheAnchorFollows) {
  Contact contact;
  contact.points[0].multiplier = 0.5;
  contact.place({0, 0, 0.1 / contact.k()});
  EXPECT_NEAR(contact.force()[2], 0.4, 1e-12);  // the multiplier holds a small gap closed
  contact.place({0.25, 0, 0.6 / contact.k()});
  EXPECT_EQ(contact.force(), (Point{0, 0, 0}));
  EXPECT_EQ(contact.points[0].multiplier, 0.0);
  EXPECT_EQ(contact.points[0].closed, 0.0);
  EXPECT_EQ(contact.points[0].anchor, (Point{0.25 - reference[0], -reference[1], 0.6 / contact.k() - reference[2]}));
}

TEST(RigidContact, SticksThenSlipsAtCoulombsLimit) {
  Contact contact;
  const double depth = 0.01, pressure = contact.k() * depth, limit = friction * pressure;
  contact.start_at({0, 0, -depth});
  contact.force();
  const double stick = 0.5 * friction * depth;  // half-way to the limit, since the springs are alike
  contact.place({stick, 0, -depth});
  Point force = contact.force();
  EXPECT_NEAR(force[0], -contact.k() * stick, 1e-12);
  EXPECT_EQ(contact.points[0].slip, 0.0);
  EXPECT_EQ(contact.points[0].frictional_dissipation, 0.0);

  const double slip = 0.2;
  contact.place({friction * depth + slip, 0, -depth});
  force = contact.force();
  EXPECT_NEAR(force[0], -limit, 1e-12);
  EXPECT_NEAR(contact.points[0].slip, slip, 1e-13);
  EXPECT_NEAR(contact.points[0].frictional_dissipation, limit * slip, 1e-12);

  contact.place({friction * depth + slip - stick, 0, -depth});  // turning back unloads the spring, without dissipation
  force = contact.force();
  EXPECT_NEAR(force[0], -limit + contact.k() * stick, 1e-12);
  EXPECT_NEAR(contact.points[0].slip, slip, 1e-13);
}

TEST(RigidContact, SlipIsOppositeToTheFrictionForceInThePlane) {
  Contact contact;
  contact.start_at({0, 0, -0.01});
  contact.force();
  contact.place({0.3, -0.4, -0.01});
  const Point force = contact.force();
  EXPECT_NEAR(force[0], -0.6 * friction * force[2], 1e-12);
  EXPECT_NEAR(force[1], 0.8 * friction * force[2], 1e-12);
}

TEST(RigidContact, ElasticSlipSetsTheStretchAtTheLimit) {
  const double elastic_slip = 0.02;
  Contact contact(road({line({-300, 0}, {300, 0})}), friction, elastic_slip);
  const double depth = 0.01, limit = friction * contact.k() * depth;
  contact.start_at({0, 0, -depth});
  contact.force();
  contact.place({0.5 * elastic_slip, 0, -depth});
  EXPECT_NEAR(contact.force()[0], -0.5 * limit, 1e-12);
  contact.place({elastic_slip + 0.1, 0, -depth});
  EXPECT_NEAR(contact.force()[0], -limit, 1e-12);
  EXPECT_NEAR(contact.points[0].slip, 0.1, 1e-13);
}

TEST(RigidContact, FrictionlessForceIsTheSlopeOfTheEnergy) {
  Contact contact(hilly_road(), 0.0);
  contact.master.position[0] += 3.0;
  rotate(contact.master, {0.2, -0.1, 0.3});
  const double h = 1e-5;
  for (const double x : {-20.0, 0.0, 12.0}) {
    const Point at{x, 2.0, -4.0};
    contact.place(at);
    const Point force = contact.force();
    ASSERT_GT(norm(force), 0.0);
    for (int i = 0; i < 3; ++i) {
      Point plus = at, minus = at;
      plus[i] += h;
      minus[i] -= h;
      contact.place(plus);
      const double above =
          contact.pair.output(0, contact.position.data(), contact.master, {.closed = 1.0}).spring_energy;
      contact.place(minus);
      const double below =
          contact.pair.output(0, contact.position.data(), contact.master, {.closed = 1.0}).spring_energy;
      // Central difference of a nearly quadratic energy of size 1e3: round-off 1e-13 * 1e3 / 1e-5.
      EXPECT_NEAR(force[i], -(above - below) / (2 * h), 1e-5);
    }
  }
}

TEST(RigidContact, MovingEverythingTurnsTheForceAlong) {
  Contact contact(hilly_road());
  contact.start_at({4.0, 3.0, 8.0});
  contact.force();
  contact.place({4.5, 2.9, 8.5});
  auto points = contact.points;
  const Point before = contact.force();
  ASSERT_GT(norm(before), 0.0);

  RigidBodyState turn;
  rotate(turn, {0.4, -1.2, 2.0});
  const auto rotation = rotation_matrix(turn);
  const Vector3<double> shift{100.0, -20.0, 7.0};
  const auto move = [&](const Point& p) { return (rotation * Vector3<double>{p} + shift).component; };
  contact.place(move({4.5, 2.9, 8.5}));
  contact.master.position = move(contact.master.position);
  rotate(contact.master, {0.4, -1.2, 2.0});
  contact.points = points;
  const Point after = contact.force();
  const auto expected = rotation * Vector3<double>{before};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(after[i], expected[i], 1e-11);  // lengths of 100 lose 2 digits
}

TEST(RigidContact, AStickingNodeIsDraggedByTheMovingRoad) {
  Contact contact;
  contact.start_at({0, 0, -0.01});
  contact.force();
  contact.master.position[0] += 0.001;
  EXPECT_NEAR(contact.force()[0], 0.001 * contact.k(), 1e-12);
}

// A mass m thrown along the road at v stops after v^2 / (2 mu g), and what it had becomes frictional dissipation.
TEST(RigidContact, SlidingMassStopsWhereCoulombSays) {
  Contact contact;
  const double mass = 0.01, gravity = 10.0, speed = 2.0;
  const double depth = mass * gravity / contact.k();
  const double dt = 0.05 / std::sqrt(contact.k() / mass);
  Point x{0, 0, -depth}, v{speed, 0, 0};
  contact.start_at(x);
  contact.force();
  double time = 0.0;
  for (; time < 1.2 * speed / (friction * gravity); time += dt) {
    const Point force = contact.force();
    for (int i = 0; i < 3; ++i) {
      v[i] += dt * (force[i] / mass - (i == 2 ? gravity : 0.0));
      x[i] += dt * v[i];
    }
    contact.place(x);
  }
  const double elastic = friction * depth;  // stretch of the tangential spring at the limit
  const double distance = speed * speed / (2 * friction * gravity);
  EXPECT_NEAR(x[0], distance, 2 * elastic);
  const double kinetic = 0.5 * mass * speed * speed;
  EXPECT_NEAR(contact.points[0].frictional_dissipation, kinetic, friction * mass * gravity * 2 * elastic);
  EXPECT_NEAR(contact.points[0].slip, distance, 2 * elastic);
}

// Friction acts from the increment of closing: a point that touches while the surface slides by is dragged at once.
TEST(RigidContact, ANodeThatClosesWhileSlidingHasFullFrictionAtOnce) {
  Contact contact;
  contact.start_at({0, 0, 0.003});
  contact.force();
  const double depth = 0.002, slip = 0.3 - friction * depth;
  contact.place({0.18, -0.24, -depth});
  const Point force = contact.force();
  EXPECT_NEAR(force[2], contact.k() * depth, 1e-12);
  EXPECT_NEAR(force[0], -0.6 * friction * force[2], 1e-12);
  EXPECT_NEAR(force[1], 0.8 * friction * force[2], 1e-12);
  EXPECT_NEAR(contact.points[0].slip, slip, 1e-13);
  EXPECT_NEAR(contact.points[0].frictional_dissipation, friction * force[2] * slip, 1e-12);
}

TEST(RigidContact, ANodeThatClosesSticksToWhatWasUnderIt) {
  Contact contact;
  contact.start_at({0, 0, 0.003});
  contact.force();
  const double depth = 0.01, motion = 0.4 * friction * depth;  // within the reach of the tangential spring
  contact.master.position[0] -= motion;                        // the road moves, not the node
  contact.place({0, 0, -depth});
  EXPECT_NEAR(contact.force()[0], -contact.k() * motion, 1e-12);
  EXPECT_NEAR(contact.force()[0], -contact.k() * motion, 1e-12);  // nothing moves: the force stays
  EXPECT_NEAR(contact.points[0].anchor[0], 0 - reference[0], 1e-15);
  EXPECT_NEAR(contact.points[0].anchor[2], 0 - reference[2], 1e-15);  // on the surface
  EXPECT_EQ(contact.points[0].slip, 0.0);
}

// A mass that bounces on the road while it slides: the mean normal force is the weight, so it stops after
// v^2 / (2 mu g) like one that never leaves the road. Some ten increments a touch, and friction in each.
TEST(RigidContact, ChatteringMassStopsWhereCoulombSays) {
  Contact contact;
  const double mass = 1e-4, gravity = 10.0, speed = 2.0, fall = 1e-3;
  const double dt = 0.3 / std::sqrt(contact.k() / mass);
  Point x{0, 0, fall}, v{speed, 0, 0};
  contact.start_at(x);
  contact.force();
  const double end = 1.2 * speed / (friction * gravity);
  int touches = 0;
  for (double time = 0.0; time < end; time += dt) {
    const bool closed = contact.points[0].closed > 0.0;
    const Point force = contact.force();
    touches += !closed && contact.points[0].closed > 0.0;
    for (int i = 0; i < 3; ++i) {
      v[i] += dt * (force[i] / mass - (i == 2 ? gravity : 0.0));
      x[i] += dt * v[i];
    }
    contact.place(x);
  }
  EXPECT_GT(touches, 10);
  // It stops in the middle of a touch, or in the touch after: off by less than one bounce at the last bounce's speed.
  const double bounce = std::sqrt(2 * gravity * fall);
  const double period = 2 * bounce / gravity + std::numbers::pi * std::sqrt(mass / contact.k());
  const double last = 2 * friction * bounce * period;
  const double distance = speed * speed / (2 * friction * gravity);
  ASSERT_LT(last, 0.02 * distance);
  EXPECT_NEAR(x[0], distance, last);
}

// A pair that rests in a step and comes back knows nothing of where its nodes stuck before; what was dissipated stays
// so.
TEST(RigidContact, APairThatRestedStartsAfresh) {
  Contact contact;
  contact.start_at({0, 0, -0.01});
  contact.place({0.5, 0, -0.01});
  contact.force();
  contact.points[0].multiplier = 0.5;
  const ContactPoint before = contact.points[0];
  contact.start_step();  // an active pair goes on
  EXPECT_EQ(contact.points[0].anchor, before.anchor);
  EXPECT_EQ(contact.points[0].multiplier, before.multiplier);
  EXPECT_EQ(contact.points[0].closed, 1.0);

  contact.start_step(false);
  EXPECT_EQ(contact.points[0].multiplier, 0.0);
  EXPECT_EQ(contact.points[0].closed, 0.0);
  EXPECT_EQ(contact.points[0].slip, before.slip);
  EXPECT_EQ(contact.points[0].frictional_dissipation, before.frictional_dissipation);

  contact.start_at({0.7, 0.2, -0.01});  // where it moved while the pair rested
  const Point force = contact.force();
  EXPECT_NEAR(force[2], 0.01 * contact.k(), 1e-12);
  EXPECT_NEAR(std::hypot(force[0], force[1]), 0.0, 1e-12);
}

TEST(RigidContact, AugmentationDrivesThePenetrationOut) {
  Contact contact;
  const double load = 3.0;
  double penetration = load / contact.k();
  for (int i = 0; i < 4; ++i) {  // equilibrium of one node under `load`: multiplier - k gap = load
    const double gap = (contact.points[0].multiplier - load) / contact.k();
    contact.place({0, 0, gap});
    const double greatest = contact.pair.augment(contact.position.data(), contact.master, contact.points);
    EXPECT_NEAR(greatest, i == 0 ? penetration : 0.0, 1e-15);
    EXPECT_NEAR(contact.points[0].multiplier, load, 1e-12);
    EXPECT_EQ(contact.points[0].closed, 0.0);  // only multipliers change
  }
}

TEST(RigidContact, AugmentationDropsMultipliersOfOpenPoints) {
  Contact contact;
  contact.points[0].multiplier = 1.0;
  contact.place({0, 0, 10.0 / contact.k()});
  contact.pair.augment(contact.position.data(), contact.master, contact.points);
  EXPECT_EQ(contact.points[0].multiplier, 0.0);
}

TEST(RigidContact, ForcesAreRoundedWithTheNodesConstantAndAddUpInAnyOrder) {
  Contact contact;
  contact.place({0, 0, -0.0123});
  std::vector<double> sum(contact.position.size(), 0.0);
  const double constant = rounding_constant(1e6);
  const double quantum = std::nextafter(constant, 2 * constant) - constant;
  sum[3] = constant;
  sum[2] = 7 * quantum;
  contact.pair.add_forces(contact.position.data(), contact.master, contact.points, sum.data());
  EXPECT_EQ(sum[3], constant);
  EXPECT_EQ(std::remainder(sum[2], quantum), 0.0);
  EXPECT_NEAR(sum[2], contact.k() * 0.0123 + 7 * quantum, quantum);
}

TEST(RigidContact, CopiesOfANodeOnTwoRanksGetTheSameBits) {
  Contact contact(hilly_road());
  Domain other;
  other.local_node.assign(contact.model.nodes.size(), -1);
  for (const std::int32_t row : {8, 3, 1}) {
    other.local_node[row] = static_cast<std::int32_t>(other.node_row.size());
    other.node_row.push_back(row);
    other.owned.push_back(false);
  }
  const RigidContact copy(contact.model, 0, other);
  std::vector<ContactPoint> points(copy.size());
  contact.master.position[2] -= 8.73;  // the hill now touches nodes 1 and 3, at x = 10
  contact.points.assign(contact.points.size(), {});
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  int closed = 0;
  for (int cycle = 0; cycle < 50; ++cycle) {
    auto position = positions(contact.model, contact.domain);
    for (double& x : position) x += jitter(random);
    std::vector<double> position_of_copy(4 * (other.node_row.size() + 1));
    for (std::size_t i = 0; i < other.node_row.size(); ++i)
      std::copy_n(&position[4 * other.node_row[i]], 4, &position_of_copy[4 * i]);
    std::vector<double> force(position.size(), 0.0), force_of_copy(position_of_copy.size(), 0.0);
    for (std::size_t i = 3; i < force.size(); i += 4) force[i] = rounding_constant(1e5);
    for (std::size_t i = 3; i < force_of_copy.size(); i += 4) force_of_copy[i] = rounding_constant(1e5);
    contact.pair.add_forces(position.data(), contact.master, contact.points, force.data());
    copy.add_forces(position_of_copy.data(), contact.master, points, force_of_copy.data());
    for (const std::int32_t row : {1, 3})
      for (int k = 0; k < 4; ++k) ASSERT_EQ(force[4 * row + k], force_of_copy[4 * other.local_node[row] + k]);
    closed += force[4 * 1 + 2] != 0.0;
  }
  EXPECT_GT(closed, 5);
  EXPECT_LT(closed, 50);
}

TEST(RigidContact, MasterGetsTheOppositeForceAndItsMoment) {
  Contact contact(hilly_road());
  contact.start_at({4.0, 3.0, 8.0});
  contact.force();
  contact.place({4.5, 2.9, 8.5});
  const Point force = contact.force();
  std::array<ExactSum, 6> sums;
  contact.pair.add_master_resultant(contact.position.data(), contact.master, contact.points, sums);
  Point total{}, moment{};  // over all four nodes of the plate, which the hill all reaches
  for (std::int32_t i = 0; i < contact.pair.size(); ++i) {
    const auto at = contact.pair.output(i, contact.position.data(), contact.master, contact.points[i]);
    const Point f{at.normal_force[0] + at.friction_force[0], at.normal_force[1] + at.friction_force[1],
                  at.normal_force[2] + at.friction_force[2]};
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      total[k] += f[k];
      moment[k] +=
          (contact.position[4 * i + a] - reference[a]) * f[b] - (contact.position[4 * i + b] - reference[b]) * f[a];
    }
    if (i == 0) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(f[k], force[k], 1e-10);
    }
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(sums[k].value(), -total[k], 1e-10);
    EXPECT_NEAR(sums[3 + k].value(), -moment[k], 1e-9);
  }
}

TEST(RigidContact, OutputTellsPressureShearAndSlip) {
  Contact contact;
  contact.start_at({0, 0, -0.01});
  contact.force();
  contact.place({0.5, 0, -0.01});
  const Point force = contact.force();
  const auto out = contact.pair.output(0, contact.position.data(), contact.master, contact.points[0]);
  EXPECT_NEAR(out.gap, -0.01, 1e-15);
  EXPECT_NEAR(out.pressure, force[2] / 25.0, 1e-13);
  EXPECT_NEAR(out.shear, friction * out.pressure, 1e-13);
  EXPECT_EQ(out.slip, contact.points[0].slip);
  const double tangential = friction * 0.01;
  EXPECT_NEAR(out.spring_energy, 0.5 * contact.k() * (1e-4 + tangential * tangential), 1e-13);
}

// As the points of a pair that is not active.
TEST(RigidContact, AnOpenPointHasNoForceWhereverItIs) {
  Contact contact;
  contact.place({0, 0, -0.01});
  const auto out = contact.pair.output(0, contact.position.data(), contact.master, {});
  EXPECT_NEAR(out.gap, -0.01, 1e-15);
  EXPECT_EQ(out.pressure, 0.0);
  EXPECT_EQ(out.spring_energy, 0.0);
}

TEST(RigidContact, ResultantSumsOverTheSurface) {
  Contact contact;
  const double depth = 0.01;
  contact.master.position[2] += depth;
  contact.force();
  const auto sum =
      contact.pair.resultant(Communicator(MPI_COMM_SELF), contact.position.data(), contact.master, contact.points);
  const double total = dilatational_modulus * 100.0 / (2 * height) * depth;
  EXPECT_NEAR(sum.normal_force[2], total, 1e-12);
  EXPECT_NEAR(sum.friction_force[0], 0.0, 1e-12);
  EXPECT_NEAR(sum.moment[0], 5.0 * total, 1e-11);
  EXPECT_NEAR(sum.moment[1], -5.0 * total, 1e-11);
  EXPECT_DOUBLE_EQ(sum.area, 100.0);
  EXPECT_NEAR(sum.center[0], 5.0, 1e-12);
  EXPECT_NEAR(sum.center[1], 5.0, 1e-12);
  EXPECT_NEAR(sum.greatest_penetration, depth, 1e-15);
}

TEST(RigidContact, SpringsThatACycleMustFollowAddUp) {
  Contact contact;
  std::vector<double> sum(contact.domain.size(), 0.0);
  std::vector<bool> stiff(contact.pair.size(), false);
  contact.pair.add_spring_stiffness(stiff, sum);
  contact.pair.add_spring_stiffness(stiff, sum);  // as of a second pair
  EXPECT_DOUBLE_EQ(sum[contact.pair.nodes()[0]], 2.0 * contact.k());
  Contact smooth(road({line({-300, 0}, {300, 0})}), 0.0);
  stiff[0] = true;
  std::fill(sum.begin(), sum.end(), 0.0);
  smooth.pair.add_spring_stiffness(stiff, sum);
  EXPECT_EQ(sum[smooth.pair.nodes()[0]], 0.0);  // a stiff spring without friction bounds nothing
  EXPECT_GT(sum[smooth.pair.nodes()[1]], 0.0);
}

}  // namespace
}  // namespace balocco
