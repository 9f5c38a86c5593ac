#include <gtest/gtest.h>

#include "deck_support.hpp"

namespace balocco {
namespace {

using test::brick;
using test::read;

/// Far nodes 21 to 24, and a brick whose nodes move with node 20.
const std::string welded =
    brick + "*NODE\n20, 0.5, 0.5, 3\n21, 2, 0, 0\n22, 2, 0, 0\n23, 3, 0, 0\n24, 3, 0, 0\n*NSET, NSET=FAR\n21, 22, 23\n";
const std::string tied = "*RIGID BODY, REF NODE=20, ELSET=ALL, TIE NSET=FAR\n";
const std::string held_step = "*STEP\n*STATIC\n*BOUNDARY\n20, 1, 6\n*END STEP\n";

TEST(DeckRigidBody, TheReferenceNodeMovesToTheCentreOfMass) {
  const auto model = read(welded + "*RIGID BODY, REF NODE=20, ELSET=ALL, POSITION=CENTER OF MASS\n" + held_step).model;
  const auto reference = model.rigid_bodies[0].reference_node;
  for (const double x : model.nodes.coordinates[reference]) EXPECT_NEAR(x, 0.5, 1e-15);
}

TEST(DeckRigidBody, JointsWithinABodyAreLeftOutWithANote) {
  const auto [model, warnings] = read(welded + tied + "*MPC\nBEAM, 22, 21\nBEAM, 21, 20\nBEAM, 1, 2\n" + held_step);
  EXPECT_TRUE(model.constraints.empty());
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.back().find("note: *MPC: nodes 21 and 22 move as one with the rigid body of reference node 20; this joint "
                                 "is left out, and 2 others for the same reason"),
            std::string::npos)
      << warnings.back();
}

TEST(DeckRigidBody, CarriesWhatRigidArmsJoinToIt) {
  const auto arms = welded + "*RIGID BODY, REF NODE=20, ELSET=ALL\n*MPC\nBEAM, 22, 21\nBEAM, 21, 1\nBEAM, 22, 1\nPIN, 23, 1\n";
  const auto nodes_and_joints = [](const Model& model) { return std::pair(model.rigid_bodies[0].tie_nodes.size(), model.constraints.size()); };
  EXPECT_EQ(nodes_and_joints(read(arms + held_step).model), std::pair(std::size_t{10}, std::size_t{3}));
  const auto held = read(arms + "*STEP\n*STATIC\n*BOUNDARY\n20, 1, 6\n21, 1, 1\n*END STEP\n").model;
  EXPECT_EQ(nodes_and_joints(held), std::pair(std::size_t{9}, std::size_t{5})) << "22 alone, by its arm to 1";
  const auto connected = "*ELEMENT, TYPE=CONN3D2, ELSET=LEG\n2, 21, 1\n*CONNECTOR SECTION, ELSET=LEG\nBEAM\n" + held_step;
  EXPECT_EQ(nodes_and_joints(read(arms + connected).model), std::pair(std::size_t{9}, std::size_t{6})) << "the connector has forces to tell";
}

TEST(DeckRigidBody, NodesAtArmsStartAsTheirBodyDoes) {
  const auto thrown = [](const std::string& nodes) {
    return read(welded + tied + "*MPC\nBEAM, 24, 23\n*NSET, NSET=THROWN\n" + nodes + "\n*INITIAL CONDITIONS, TYPE=VELOCITY\nTHROWN, 1, 1.\n"
                "*STEP\n*DYNAMIC, EXPLICIT\n, 1.\n*END STEP\n").model;
  };
  const auto with_body = thrown("20, 21, 22, 23");
  EXPECT_TRUE(with_body.constraints.empty());
  EXPECT_EQ(with_body.initial_velocities.front().nodes.size(), 5u) << "node 24 too";
  EXPECT_EQ(thrown("24").constraints.size(), 1u) << "its momentum is shared with the body by the joint";
}

TEST(DeckRigidBody, ABeamFromACarriedNodeHoldsRotations) {
  const auto model = read(welded + tied + "*ELEMENT, TYPE=MASS, ELSET=M\n2, 24\n*MASS, ELSET=M\n1.\n*MPC\nBEAM, 23, 24\n" + held_step).model;
  EXPECT_TRUE(model.constraints.empty());
  EXPECT_EQ(model.rigid_bodies.front().tie_nodes.size(), 12u);  // of the brick, FAR, and 24
}

TEST(DeckRigidBody, JointsOfNodesThatAreOnlyPinnedOrLetGoStay) {
  const std::string weld = "*MPC\nBEAM, 22, 21\n", pinned = "*RIGID BODY, REF NODE=20, ELSET=ALL, PIN NSET=FAR\n";
  EXPECT_EQ(read(welded + pinned + weld + held_step).model.constraints.size(), 1u);
  const std::string release = "*STEP\n*STATIC\n*RIGID BODY, REF NODE=20, RELEASE NSET=FAR\n*BOUNDARY\n20, 1, 6\n*END STEP\n";
  EXPECT_EQ(read(welded + tied + weld + release).model.constraints.size(), 1u);
}

TEST(DeckRigidBody, WhatFollowsAJointFindsItWhereOthersAreLeftOut) {
  const auto model = read(welded + "*RIGID BODY, REF NODE=20, ELSET=ALL\n*MPC\nBEAM, 1, 2\n"
                          "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n"
                          "*ELEMENT, TYPE=CONN3D2, ELSET=LEG\n2, 21, 23\n"
                          "*CONNECTOR BEHAVIOR, NAME=STOPS\n*CONNECTOR STOP, COMPONENT=1\n-1., 2.\n"
                          "*CONNECTOR SECTION, ELSET=LEG, BEHAVIOR=STOPS\nTRANSLATOR\nO\n" + held_step).model;
  ASSERT_EQ(model.constraints.size(), 2u);
  EXPECT_EQ(std::get<Guide>(model.constraints[1].kind).joint, 0);
}

}  // namespace
}  // namespace balocco
