#include "constraints/rigid_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

constexpr double pi = std::numbers::pi;

Model model_of_nodes(const std::vector<Point>& coordinates) {
  Model model;
  model.files = {"job.inp"};
  for (const Point& point : coordinates) {
    model.nodes.id.push_back(model.nodes.size() + 1);
    model.nodes.coordinates.push_back(point);
  }
  return model;
}

TEST(RigidBody, QuarterTurnAboutAnAxisMapsTheOtherAxes) {
  RigidBodyState body;
  rotate(body, {0.0, 0.0, 0.5 * pi});
  const auto rotation = rotation_matrix(body);
  const auto image = rotation * Vector3<double>{1.0, 0.0, 0.0};
  EXPECT_NEAR(image[0], 0.0, 1e-15);
  EXPECT_NEAR(image[1], 1.0, 1e-15);
  EXPECT_NEAR(image[2], 0.0, 1e-15);
}

TEST(RigidBody, SpinsAreAppliedOnTheLeftInGlobalDirections) {
  RigidBodyState body;
  rotate(body, {0.0, 0.0, 0.5 * pi});  // e1 -> e2
  rotate(body, {0.5 * pi, 0.0, 0.0});  // e2 -> e3, about the GLOBAL first axis
  const auto image = rotation_matrix(body) * Vector3<double>{1.0, 0.0, 0.0};
  EXPECT_NEAR(image[2], 1.0, 1e-15);
}

// Rodrigues's formula, written independently of quaternions.
TEST(RigidBody, ExponentialAgreesWithRodrigues) {
  const Point spin{0.3, -1.1, 0.7};
  const double angle = std::sqrt(0.09 + 1.21 + 0.49);
  const Vector3<double> axis{spin[0] / angle, spin[1] / angle, spin[2] / angle};
  const Vector3<double> vector{0.2, 0.5, -1.3};
  RigidBodyState body;
  rotate(body, spin);
  const auto turned = rotation_matrix(body) * vector;
  const auto expected = std::cos(angle) * vector + std::sin(angle) * cross(axis, vector) +
                        (1.0 - std::cos(angle)) * dot(axis, vector) * axis;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(turned[i], expected[i], 4e-16 * 4);
}

TEST(RigidBody, ManySmallTurnsStayARotationAndAddUp) {
  RigidBodyState body;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i) rotate(body, {0.0, 4.0 * pi / steps, 0.0});  // two turns
  EXPECT_NEAR(body.rotation[1], 4.0 * pi, 1e-10);                              // round-off of 1e5 additions
  const auto rotation = rotation_matrix(body);
  const auto product = rotation * transpose(rotation);
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(product.component[i], i % 4 == 0 ? 1.0 : 0.0, 1e-15);
    EXPECT_NEAR(rotation.component[i], i % 4 == 0 ? 1.0 : 0.0, 1e-10);
  }
}

TEST(RigidBody, TinySpinIsNotLost) {
  RigidBodyState body;
  rotate(body, {1e-12, 0.0, 0.0});
  EXPECT_NEAR(rotation_matrix(body)(2, 1), 1e-12, 1e-27);
}

TEST(RigidBody, AttachedNodeFollowsTheBodyFromWhereItStood) {
  RigidBodyState body;
  body.position = {1.0, 2.0, 3.0};
  rotate(body, {0.1, 0.9, -0.4});
  const Point stood{4.0, -1.0, 2.5};
  attach(body, 7, true, stood);
  ASSERT_EQ(body.nodes.size(), 1u);
  const Point arm = rigid_arm(rotation_matrix(body), body.nodes[0]);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(body.position[i] + arm[i], stood[i], 2e-15);

  const Point spin{0.0, 0.0, 0.5 * pi};
  rotate(body, spin);
  const Point turned = rigid_arm(rotation_matrix(body), body.nodes[0]);
  EXPECT_NEAR(turned[0], -(stood[1] - 2.0), 4e-15);
  EXPECT_NEAR(turned[1], stood[0] - 1.0, 4e-15);
  EXPECT_NEAR(turned[2], stood[2] - 3.0, 4e-15);
}

TEST(RigidBody, AttachKeepsRowsSortedAndReplaces) {
  RigidBodyState body;
  for (const std::int32_t row : {5, 2, 9, 2}) attach(body, row, row != 2, {1.0 * row, 0.0, 0.0});
  ASSERT_EQ(body.nodes.size(), 3u);
  EXPECT_EQ(body.nodes[0].node, 2);
  EXPECT_FALSE(body.nodes[0].tie);
  EXPECT_EQ(body.nodes[1].node, 5);
  EXPECT_EQ(body.nodes[2].node, 9);
  release(body, 5);
  release(body, 6);  // not carried: no effect
  ASSERT_EQ(body.nodes.size(), 2u);
  EXPECT_EQ(body.nodes[1].node, 9);
}

TEST(RigidBody, InitialBodiesCarryTheirSetsButNotTheReferenceNode) {
  Model model = model_of_nodes({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}});
  RigidBody body;
  body.reference_node = 1;
  body.tie_nodes = {3, 1, 0};
  body.pin_nodes = {2};
  model.rigid_bodies.push_back(body);
  const auto states = initial_rigid_bodies(model);
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states[0].position, (Point{1, 0, 0}));
  ASSERT_EQ(states[0].nodes.size(), 3u);
  EXPECT_EQ(states[0].nodes[0].node, 0);
  EXPECT_EQ(states[0].nodes[1].node, 2);
  EXPECT_FALSE(states[0].nodes[1].tie);
  EXPECT_EQ(states[0].nodes[2].offset, (Point{-1, 0, 3}));
}

TEST(RigidBody, ReferenceNodeMovesToTheCenterOfMass) {
  Model model = model_of_nodes({{9, 9, 9}, {0, 0, 0}, {4, 0, 0}, {0, 2, 0}});
  const ElementType mass_type{.name = "MASS", .section = Section::Kind::mass, .faces = {}};
  model.elements.push_back(
      {.type = &mass_type, .id = {1, 2, 3}, .connectivity = {1, 2, 3}, .section = {0, 0, 1}, .location = {}});
  model.sections.resize(2);
  model.sections[0].mass = 1.0;
  model.sections[1].mass = 2.0;
  RigidBody body;
  body.reference_node = 0;
  body.at_center_of_mass = true;
  body.elements = {{0, 0}, {0, 1}, {0, 2}};
  model.rigid_bodies.push_back(body);
  place_reference_nodes(model);
  EXPECT_EQ(model.nodes.coordinates[0], (Point{1, 1, 0}));
  const auto states = initial_rigid_bodies(model);
  EXPECT_EQ(states[0].position, (Point{1, 1, 0}));  // (1 * 0 + 1 * 4 + 2 * 0) / 4, (2 * 2) / 4
  ASSERT_EQ(states[0].nodes.size(), 3u);
  EXPECT_EQ(states[0].nodes[1].offset, (Point{3, -1, 0}));
}

TEST(RigidBody, CenterOfMassWithoutMassIsRefused) {
  Model model = model_of_nodes({{0, 0, 0}});
  RigidBody body;
  body.reference_node = 0;
  body.at_center_of_mass = true;
  body.location = {0, 12};
  model.rigid_bodies.push_back(body);
  try {
    place_reference_nodes(model);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("job.inp:12: error: *RIGID BODY: POSITION=CENTER OF MASS"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace balocco
