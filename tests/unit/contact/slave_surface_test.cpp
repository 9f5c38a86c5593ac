#include "slave_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact_model.hpp"
#include "model/diagnostics.hpp"
#include "rigid_contact.hpp"

namespace balocco {
namespace {

using namespace test;

std::string refusal(const Model& model) {
  try {
    const RigidContact contact(model, 0, whole(model));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refusal(const Model& model, const std::string& text) {
  const std::string message = refusal(model);
  EXPECT_EQ(message.rfind("job.inp:77: error: *CONTACT PAIR: ", 0), 0u) << message;
  EXPECT_NE(message.find(text), std::string::npos) << message;
}

TEST(SlaveSurface, NodesShareTheAreaOfTheirFaces) {
  const SlaveNodes slave = slave_nodes(plate_on_road(2), {.slave = 0, .master = 1, .interaction = 0, .location = {}});
  ASSERT_EQ(slave.rows.size(), 9u);
  EXPECT_DOUBLE_EQ(slave.area[0], 25.0);   // corner
  EXPECT_DOUBLE_EQ(slave.area[1], 50.0);   // edge
  EXPECT_DOUBLE_EQ(slave.area[4], 100.0);  // middle
}

TEST(SlaveSurface, StiffnessIsHalfThatOfTheLayerBehind) {
  Model model = plate_on_road(2);
  model.interactions[0].penalty_scale = 3.0;
  const SlaveNodes slave = slave_nodes(model, model.contact_pairs[0]);
  for (std::size_t i = 0; i < slave.rows.size(); ++i)
    EXPECT_NEAR(slave.stiffness[i], 3.0 * dilatational_modulus * slave.area[i] / (2.0 * height), 1e-12);
}

// Rubber of M = 100 MPa, 8 mm thick, under 0.3 MPa: well below 0.1 mm.
TEST(SlaveSurface, PenetrationOfTypicalRubberIsSmall) {
  Model model = plate_on_road(1);
  for (int node = 4; node < 8; ++node) model.nodes.coordinates[node][2] = 8.0;
  model.materials[0] = {
      .name = "TREAD", .law = "neo-hooke", .parameters = {0.8, 0.02}, .location = {}};  // G = 1.6, K = 100
  const SlaveNodes slave = slave_nodes(model, model.contact_pairs[0]);
  const double penetration = 0.3 * slave.area[0] / slave.stiffness[0];
  EXPECT_LT(penetration, 0.05);
  EXPECT_NEAR(penetration, 2.0 * 8.0 * 0.3 / (100.0 + 4.0 / 3.0 * 1.6), 1e-12);
}

// Half of the plate's bricks as membranes of the same faces.
TEST(SlaveSurface, MembranesGiveTheirInPlaneStiffness) {
  static const ElementType membrane{.name = "MEMBRANE",
                                    .shape = Shape::quadrilateral,
                                    .nodes = 4,
                                    .section = Section::Kind::membrane,
                                    .faces = {{0, 1, 2, 3}, {3, 2, 1, 0}}};
  Model model = plate_on_road(1);
  model.elements[0].type = &membrane;
  model.elements[0].connectivity = {0, 1, 3, 2};
  model.surfaces[0].faces = {{{0, 0}, 1}};  // SNEG looks down to the road
  model.sections[0].kind = Section::Kind::membrane;
  model.sections[0].thickness = 1.5;
  const SlaveNodes slave = slave_nodes(model, model.contact_pairs[0]);
  ASSERT_EQ(slave.rows.size(), 4u);
  EXPECT_DOUBLE_EQ(slave.area[0], 25.0);
  // Plane stress: the stiffest direction is equal biaxial, E / (1 - nu); a bound may lie a little above.
  const double least = 0.125 * young / (1.0 - poisson) * 1.5;
  EXPECT_GE(slave.stiffness[0], 0.999999 * least);
  EXPECT_LE(slave.stiffness[0], 2.0 * least);
  EXPECT_EQ(refusal(model), "accepted");
  model.surfaces[0].faces[0].face = 0;
  expect_refusal(model, "TREAD faces away from ROAD");
}

TEST(SlaveSurface, NodeBasedSurfacesHaveUnitArea) {
  Model model = plate_on_road(1);
  model.surfaces[0] = {
      .kind = Surface::Kind::nodes, .name = "TREAD", .faces = {}, .nodes = {3, 0}, .analytical = {}, .location = {}};
  const SlaveNodes slave = slave_nodes(model, model.contact_pairs[0]);
  EXPECT_EQ(slave.rows, (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(slave.area, (std::vector<double>{1.0, 1.0}));
  EXPECT_NEAR(slave.stiffness[0], dilatational_modulus * std::cbrt(500.0) / 8.0, 1e-12);
}

TEST(SlaveSurface, PairsThatCannotWorkAreRefusedWithTheirCure) {
  Model model = plate_on_road(1);
  model.surfaces[0].faces.clear();
  expect_refusal(model, "TREAD has no faces and no nodes");

  model = plate_on_road(1);
  model.surfaces[0].faces[0].face = 1;  // the upper side
  expect_refusal(model, "TREAD faces away from ROAD");

  model = plate_on_road(1, road({line({300, 0}, {-300, 0})}));  // outward is -z
  expect_refusal(model, "opposite direction");

  model = plate_on_road(1);
  model.contact_pairs[0].master = 0;
  expect_refusal(model, "the master surface TREAD belongs to no rigid body");

  model = plate_on_road(1);
  model.contact_pairs[0].slave = 1;
  expect_refusal(model, "name the deformable surface first");

  model = plate_on_road(1);
  model.rigid_bodies.clear();
  expect_refusal(model, "belongs to no rigid body");

  model = plate_on_road(1);
  model.materials[0].law.clear();
  expect_refusal(model, "no element with a stiffness");

  model = plate_on_road(1);
  model.surfaces[1].analytical->profile.clear();
  expect_refusal(model, "has no length");
}

TEST(SlaveSurface, OneFaceTowardsTheRoadIsEnough) {
  Model model = plate_on_road(1);
  model.surfaces[0].faces = {{{0, 0}, 1}, {{0, 0}, 2}, {{0, 0}, 0}};
  EXPECT_EQ(refusal(model), "accepted");
  model.surfaces[0].faces = {{{0, 0}, 2}};  // at right angles to the road
  EXPECT_EQ(refusal(model), "accepted");
}

/// Half of the nodes, numbered backwards, with foreign ones missing.
TEST(SlaveSurface, SharesHaveTheSameBitsOnEveryRank) {
  Model model = plate_on_road(3);
  for (Point& point : model.nodes.coordinates) point[0] += 0.03 * point[1] + 0.01 * std::sin(point[0]);
  const RigidContact all(model, 0, whole(model));
  Domain part;
  part.local_node.assign(model.nodes.size(), -1);
  for (std::int32_t row = model.nodes.size() - 1; row >= 0; row -= 2) {
    part.local_node[row] = static_cast<std::int32_t>(part.node_row.size());
    part.node_row.push_back(row);
    part.owned.push_back(row % 3 != 0);
  }
  const RigidContact some(model, 0, part);
  ASSERT_EQ(all.size(), 16);
  ASSERT_EQ(some.size(), 8);
  for (std::int32_t i = 0; i < some.size(); ++i) {
    const auto row = part.node_row[some.nodes()[i]];
    ASSERT_EQ(all.nodes()[row], row);
    EXPECT_EQ(some.area(i), all.area(row));
    EXPECT_EQ(some.normal_stiffness(i), all.normal_stiffness(row));
    if (i > 0) {
      EXPECT_LT(part.node_row[some.nodes()[i - 1]], row);
    }
  }
}

}  // namespace
}  // namespace balocco
