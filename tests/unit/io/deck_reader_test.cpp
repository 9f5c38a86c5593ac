#include <gtest/gtest.h>

#include "deck_support.hpp"
#include "elements/element_type.hpp"

namespace balocco {
namespace {

using namespace std::string_literals;
using test::brick;
using test::read;

TEST(DeckReader, BrickWithAStaticStep) {
  const auto [model, warnings] =
      read(brick + "*STEP, NLGEOM\n*STATIC\n0.1, 1.\n*BOUNDARY\n1, 1, 3\n2, 3, 3, 0.5\n*END STEP\n");
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(model.nodes.size(), 8);
  ASSERT_EQ(model.elements.size(), 1u);
  EXPECT_EQ(model.elements[0].type, find_element_type("C3D8R"));
  EXPECT_EQ(model.elements[0].connectivity, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(model.elements[0].section, std::vector<std::int32_t>{0});
  ASSERT_EQ(model.steps.size(), 1u);
  EXPECT_EQ(model.steps[0].boundary.size(), 4u);
  EXPECT_TRUE(std::get<StaticProcedure>(model.steps[0].procedure).nonlinear_geometry);
  EXPECT_DOUBLE_EQ(model.steps[0].boundary[3].magnitude, 0.5);
}

TEST(DeckReader, RigidBodyInAStepAttachesNodesToTheBodyOfTheModel) {
  const std::string body = "*NODE\n9, 0.5, 0.5, 3.\n*NSET, NSET=TOP\n5, 6, 7, 8\n*RIGID BODY, REF NODE=9\n";
  const auto [model, warnings] =
      read(brick + body + "*STEP, NLGEOM\n*STATIC\n*RIGID BODY, REF NODE=9, TIE NSET=TOP\n*END STEP\n");
  ASSERT_EQ(model.rigid_bodies.size(), 1u);
  EXPECT_TRUE(model.rigid_bodies[0].tie_nodes.empty());
  ASSERT_EQ(model.steps[0].attachments.size(), 1u);
  EXPECT_EQ(model.steps[0].attachments[0].nodes, (std::vector<std::int32_t>{4, 5, 6, 7}));
}

TEST(DeckReader, CouplingsToWhatOneBodyCarriesAreCarriedToo) {
  const std::string heavy = "*NODE\n9, 0.5, 0.5, 3.\n10, 0.5, 0.5, 0.5\n*ELEMENT, TYPE=MASS, ELSET=M\n2, 9\n*MASS, ELSET=M\n1.\n";
  const auto kind_of = [&](const std::string& body, const std::string& cloud) {
    const auto [model, warnings] = read(brick + heavy + body + "*SURFACE, TYPE=NODE, NAME=CLOUD\n" + cloud +
                                        "*COUPLING, CONSTRAINT NAME=HANG, REF NODE=9, SURFACE=CLOUD\n*DISTRIBUTING\n"
                                        "*STEP, NLGEOM\n*STATIC\n*BOUNDARY\n10, 1, 6\n*END STEP\n");
    const auto& carried = model.rigid_bodies.empty() ? std::vector<std::int32_t>{} : model.rigid_bodies.front().tie_nodes;
    const bool rides = std::ranges::count_if(carried, [&](auto row) { return model.nodes.id[row] == 9; }) > 0;
    EXPECT_EQ(model.constraints.empty(), rides);
    return rides ? "carried" : "cloud";
  };
  const std::string whole = "*RIGID BODY, REF NODE=10, ELSET=ALL\n";
  EXPECT_EQ(kind_of(whole, "5,\n6,\n7,\n8,\n"), "carried"s);
  EXPECT_EQ(kind_of("", "5,\n6,\n7,\n8,\n"), "cloud"s);
  EXPECT_EQ(kind_of(whole, "5,\n6,\n"), "cloud"s) << "nodes on one line leave a rotation free";
  EXPECT_EQ(kind_of("*NSET, NSET=SOME\n5, 6, 7\n*RIGID BODY, REF NODE=10, TIE NSET=SOME\n", "5,\n6,\n7,\n8,\n"), "cloud"s);
}

}  // namespace
}  // namespace balocco
