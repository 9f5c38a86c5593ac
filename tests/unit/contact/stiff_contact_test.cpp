// Springs stiffer than an explicit cycle could follow: energy, stability, import of multipliers.
#include <gtest/gtest.h>

#include <cmath>

#include "contact_fixture.hpp"

namespace balocco {
namespace {

using namespace test;

/// Node 0 alone, as a mass that falls on the road.
struct Falling {
  Contact contact;
  std::vector<SlaveFreedom> freedom;
  std::vector<double> velocity, force;
  double mass, dt, load = 0.0, pull = 0.0;

  Falling(double the_mass, double the_increment, double mu = 0.0)
      : contact(road({line({-300, 0}, {300, 0})}), mu), mass(the_mass), dt(the_increment) {
    contact.pair.choose_springs(contact.position.data(), contact.master, std::vector<bool>(contact.pair.size(), true),
                                contact.points);
    freedom.resize(contact.pair.size());
    freedom[0].inverse_mass = 1.0 / mass;
    velocity.assign(contact.position.size(), 0.0);
  }

  double& height() { return contact.position[2]; }
  double& speed() { return velocity[2]; }
  double& along() { return velocity[0]; }
  ContactPoint& point() { return contact.points[0]; }

  /// Lies on the surface under a load, held by its multiplier alone, as statics leave it.
  void press(double pressure) {
    point() = {.multiplier = pressure, .closed = 1.0, .anchor = contact.position_of()};
    contact.pair.choose_springs(contact.position.data(), contact.master, std::vector<bool>(contact.pair.size(), true), contact.points);
    load = -pressure;
  }

  /// Forces are rounded to this at the most.
  double quantum() const { return std::ldexp(1e3 * contact.k(), -50); }

  /// One cycle: the contact force at the instant, then velocity and position.
  double cycle(bool first = false) {
    force.assign(contact.position.size(), 0.0);
    for (std::size_t i = 3; i < force.size(); i += 4) force[i] = rounding_constant(1e3 * contact.k());
    force[0] = pull;
    force[2] = load;
    const StiffCycle around{contact.position.data(), velocity.data(), first ? 0.0 : dt, dt};
    contact.pair.add_stiff_forces(around, contact.master, freedom, contact.points, force.data());
    speed() += 0.5 * (around.previous + around.next) * force[2] / mass;
    along() += 0.5 * (around.previous + around.next) * force[0] / mass;
    height() += dt * speed();
    contact.position[0] += dt * along();
    return force[2] - load;
  }
};

TEST(StiffContact, AMassBouncesWithTheSpeedItCameWith) {
  // k dt^2 / m of 0.2 to 20000: an explicit spring of the pair would diverge beyond 4.
  for (const double ratio : {0.01, 1.0, 30.0, 1000.0}) {
    Falling body(1.0, 1.0);
    body.mass = body.contact.k() / ratio;
    body.freedom[0].inverse_mass = 1.0 / body.mass;
    body.height() = 3.3;
    body.speed() = -1.0;
    for (int i = 0; i < 60; ++i) body.cycle();
    EXPECT_NEAR(body.speed(), 1.0, 1e-12 + 60 * body.quantum() / body.mass) << ratio;
    EXPECT_GT(body.height(), 0.0) << ratio;
  }
}

TEST(StiffContact, AnImportedForceStaysAndEndsWithTheContact) {
  Falling body(0.01, 1e-3);
  const double held = 0.3;
  auto& point = body.contact.points[0];
  point = {.multiplier = held, .closed = 1.0};  // as statics leave it: on the surface, held by the multiplier alone
  body.contact.pair.choose_springs(body.contact.position.data(), body.contact.master,
                                   std::vector<bool>(body.contact.pair.size(), true), body.contact.points);
  body.load = -held;
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(body.cycle(i == 0), held, body.quantum());
  body.load = 0.0;  // let go: it leaves, and nothing pushes across the gap
  for (int i = 0; i < 20; ++i) body.cycle();
  EXPECT_GT(body.height(), 0.0);
  EXPECT_EQ(point.multiplier, 0.0);
  EXPECT_EQ(point.closed, 0.0);
}

TEST(StiffContact, AForceImportedAboveTheSurfaceStays) {
  Falling body(0.01, 1e-3, friction);
  const double held = 0.3, gap = 1e-3, k = body.contact.k();
  body.height() = gap;  // within the tolerance to which statics close a gap
  body.point() = {.multiplier = held + k * gap, .closed = 1.0, .anchor = body.contact.position_of()};
  body.contact.pair.choose_springs(body.contact.position.data(), body.contact.master,
                                   std::vector<bool>(body.contact.pair.size(), true), body.contact.points);
  body.load = -held;
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(body.cycle(i == 0), held, 10 * body.quantum());
  EXPECT_NEAR(body.height(), gap, 1e-9);
}

TEST(StiffFriction, AMassThatSlidesLosesWhatIsBookedAndStops) {
  for (const double ratio : {30.0, 1000.0}) {  // k dt^2 / m
    Falling body(1.0, 1.0, friction);
    body.mass = body.contact.k() / ratio;
    body.freedom[0].inverse_mass = 1.0 / body.mass;
    const double pressure = 1e-3 * body.contact.k(), braking = friction * pressure / body.mass;
    body.point() = {.multiplier = pressure, .closed = 1.0, .anchor = body.contact.position_of()};
    body.point().stiff_spring = body.contact.k();
    body.point().stiff_force = pressure;
    body.load = -pressure;
    body.along() = 20.5 * braking;
    const double start = body.contact.position[0], energy = 0.5 * body.mass * body.along() * body.along();
    for (int i = 0; i < 60; ++i) body.cycle();
    EXPECT_NEAR(body.along(), 0.0, 1e-6 * braking) << ratio;
    EXPECT_NEAR(body.contact.position[0] - start, 200.0 * braking, braking) << ratio;  // the sum of 19.5, 18.5 ... 0.5
    EXPECT_NEAR(body.point().frictional_dissipation, energy, 1e-6 * energy) << ratio;
  }
}

TEST(StiffFriction, APullBelowTheLimitMovesNothingOn) {
  Falling body(0.01, 1e-3, friction);
  const double pressure = 0.3;
  body.press(pressure);
  body.pull = 0.45 * friction * pressure;  // at once: the spring swings to twice its stretch at the most
  const double start = body.contact.position[0];
  for (int i = 0; i < 2000; ++i) body.cycle(i == 0);
  EXPECT_NEAR(body.contact.position[0] - start, body.pull / body.point().stiff_spring, 1e-9);  // the spring's own stretch
  EXPECT_NEAR(body.force[0], 0.0, 1e-9 * pressure);
  EXPECT_EQ(body.point().slip, 0.0);
}

TEST(StiffFriction, ADirectionThatIsHeldIsNotPushed) {
  // Dragged at 45 degrees across the direction that is held: Coulomb's force against the slip all the same.
  Falling body(0.01, 1e-3, friction);
  const double pressure = 0.3;
  body.press(pressure);
  body.freedom[0].held = 1;
  body.freedom[0].direction[0] = {std::sqrt(0.5), std::sqrt(0.5), 0};
  body.freedom[0].velocity[0] = 1.0;
  body.velocity[0] = body.velocity[1] = std::sqrt(0.5);
  body.cycle(true);
  EXPECT_NEAR(std::hypot(body.force[0], body.force[1]), friction * pressure, 1e-9);
  EXPECT_NEAR(body.force[0], body.force[1], 1e-9);
  EXPECT_LT(body.force[0], 0.0);
}

TEST(StiffContact, TheForceOfAClosedPointSurvivesTheChoiceOfSprings) {
  Contact contact;
  contact.start_at({0, 0, -0.002});
  const double force = contact.force()[2];
  const auto choose = [&](bool stiff) {
    contact.pair.choose_springs(contact.position.data(), contact.master, std::vector<bool>(contact.pair.size(), stiff),
                                contact.points);
  };
  choose(true);
  EXPECT_GT(contact.points[0].stiff_spring, contact.k());
  EXPECT_NEAR(contact.points[0].multiplier - contact.points[0].stiff_spring * -0.002, force, 1e-12);
  choose(false);
  EXPECT_NEAR(contact.force()[2], force, 1e-12);
}

TEST(StiffContact, AHeldDirectionDoesNotYield) {
  Falling body(0.01, 1e-3);
  body.freedom[0].held = 1;
  body.freedom[0].direction[0] = {0, 0, 1};
  body.freedom[0].velocity[0] = 0.0;
  body.height() = -1e-3;
  body.contact.points[0].stiff_spring = body.contact.k();
  body.contact.points[0].closed = 1.0;
  body.speed() = 0.0;
  body.force.clear();
  const double force = body.cycle();
  EXPECT_NEAR(force, 1e-3 * body.contact.k(), body.quantum());
}

TEST(RigidContact, TellsTheDeepestNodeAndWhereAProfileHadEnded) {
  Contact contact(road({line({-5, 0}, {8, 0})}));
  contact.place({0, 0, -0.25});
  const auto deepest = 
      contact.pair.deepest(contact.position.data(), contact.master, contact.points, RigidContact::Which::all);
  EXPECT_NEAR(deepest.depth, 0.25, 1e-14);
  EXPECT_EQ(deepest.node, 0);
  EXPECT_FALSE(contact.pair.past_end(contact.position.data(), contact.master, contact.points));
  contact.points[0].closed = 1.0;
  EXPECT_EQ(contact.pair.deepest(contact.position.data(), contact.master, contact.points, RigidContact::Which::open).depth, 0.0);
  EXPECT_FALSE(contact.pair.past_end(contact.position.data(), contact.master, contact.points));
  contact.place({8.5, 0, -0.25});
  EXPECT_TRUE(contact.pair.past_end(contact.position.data(), contact.master, contact.points));
}

}  // namespace
}  // namespace balocco
