// Loads on faces and on edges: labels, and what later steps change of them.
#include <gtest/gtest.h>

#include "deck_support.hpp"
#include "deck_writer.hpp"

namespace balocco {
namespace {

using test::errors_of;
using test::read;
using Kind = SurfaceLoad::Kind;

const std::string sheet =
    "*HEADING\nsheet\n*NODE, NSET=ALLN\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 2, 0, 0\n6, 2, 1, 0\n"
    "*ELEMENT, TYPE=S4R, ELSET=ALL\n1, 1, 2, 3, 4\n2, 2, 5, 6, 3\n*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8E-9\n"
    "*SHELL SECTION, ELSET=ALL, MATERIAL=STEEL\n0.1\n*SURFACE, NAME=RIM\n2, E2\n*SURFACE, NAME=SKIN\nALL, SPOS\n";

TEST(DeckSurfaceLoad, EdgesOfElementsAndSurfaces) {
  const auto model = read(sheet + "*STEP\n*STATIC\n*DSLOAD\nRIM, EDNOR, 2.\nSKIN, TRVEC, 3., 0., 0., -2.\n*DLOAD\nALL, EDSHR4, 5.\nALL, TRSHR, 6., 1., 0., 0.\n"
                                  "*END STEP\n")
                         .model;
  const auto& loads = model.steps[0].surface_loads;
  ASSERT_EQ(loads.size(), 4u);
  EXPECT_EQ(loads[0].kind, Kind::edge_normal);
  ASSERT_EQ(model.surfaces[loads[0].surface].edges.size(), 1u);
  EXPECT_EQ(model.surfaces[loads[0].surface].edges[0].face, 1);
  EXPECT_EQ(model.surfaces[loads[0].surface].nodes, (std::vector<std::int32_t>{4, 5}));
  EXPECT_EQ(loads[1].direction, (std::array<double, 3>{0, 0, -1}));
  EXPECT_TRUE(loads[1].follows);
  ASSERT_EQ(model.surfaces[loads[2].surface].edges.size(), 2u);
  EXPECT_EQ(model.surfaces[loads[2].surface].edges[0].face, 3);
  EXPECT_EQ(loads[3].kind, Kind::shear);
  EXPECT_EQ(model.surfaces[loads[3].surface].faces.size(), 2u);
}

TEST(DeckSurfaceLoad, ANewDirectionTakesThePlaceOfTheOld) {
  const auto steps = read(sheet + "*STEP\n*STATIC\n*DSLOAD, FOLLOWER=NO\nRIM, EDLD, 2., 1., 0., 0.\nRIM, EDLD, 3., 0., 1., 0.\n*END STEP\n"
                                  "*STEP\n*STATIC\n*DSLOAD, FOLLOWER=NO\nRIM, EDLD, 4., 0., 2., 0.\n*END STEP\n*STEP\n*STATIC\n*END STEP\n")
                         .model.steps;
  ASSERT_EQ(steps[0].surface_loads.size(), 2u);  // both act
  const auto& second = steps[1].surface_loads;
  ASSERT_EQ(second.size(), 2u);
  EXPECT_EQ(second[0].magnitude, 0.0);
  EXPECT_EQ(second[0].previous, 2.0);
  EXPECT_EQ(second[1].magnitude, 4.0);
  EXPECT_EQ(second[1].previous, 3.0);
  ASSERT_EQ(steps[2].surface_loads.size(), 1u);
  EXPECT_EQ(steps[2].surface_loads[0].magnitude, 4.0);
}

TEST(DeckSurfaceLoad, IsWrittenAsItIsRead) {
  const auto model = read(sheet + "*STEP\n*STATIC\n*DSLOAD, FOLLOWER=NO, CONSTANT RESULTANT=YES\nRIM, EDLD, 2., 0., 0.6, 0.8\n*DSLOAD\nRIM, EDTRA, 2.\n"
                                  "SKIN, P, 4.\n*END STEP\n")
                         .model;
  const auto again = read(write_deck(model)).model;
  ASSERT_EQ(again.steps[0].surface_loads.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const auto &load = model.steps[0].surface_loads[i], &other = again.steps[0].surface_loads[i];
    EXPECT_TRUE(acts_alike(load, other));
    EXPECT_EQ(load.magnitude, other.magnitude);
  }
  EXPECT_EQ(again.surfaces[0].edges.size(), 1u);
}

TEST(DeckSurfaceLoad, SurfacesThatDoNotHaveWhatIsLoaded) {
  EXPECT_NE(errors_of(sheet + "*STEP\n*STATIC\n*DSLOAD\nRIM, P, 2.\n*END STEP\n").find("surface RIM has no element faces"), std::string::npos);
  EXPECT_NE(errors_of(sheet + "*STEP\n*STATIC\n*DSLOAD\nSKIN, EDTRA, 2.\n*END STEP\n").find("surface SKIN has no edges"), std::string::npos);
  EXPECT_NE(errors_of(sheet + "*STEP\n*STATIC\n*DLOAD\nALL, EDNOR5, 2.\n*END STEP\n").find("cannot take the load EDNOR5"), std::string::npos);
}

}  // namespace
}  // namespace balocco
