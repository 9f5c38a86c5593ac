// Generated nodes and elements, sets, parts and instances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deck_support.hpp"

namespace balocco {
namespace {

using test::errors_of;
using test::read;

const std::string bars = "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n*SOLID SECTION, ELSET=E, MATERIAL=M\n";
const std::string bar = "*ELEMENT, TYPE=T3D2, ELSET=E\n1, 1, 2\n";

std::int32_t row_of(const Model& model, std::int64_t id) {
  return static_cast<std::int32_t>(std::ranges::find(model.nodes.id, id) - model.nodes.id.begin());
}

const Point& at(const Model& model, std::int64_t id) {
  return model.nodes.coordinates[row_of(model, id)];
}

TEST(DeckMesh, NodesOnALineAndOnACircle) {
  const auto model = read(
                         "*NODE\n1, 1., 0., 0.\n2, 0., 2., 0.\n9, 5., 0., 0.\n11, 0., 1., 0.\n100, 0., 0., 0.\n"
                         "*NGEN, NSET=LINE\n1, 9, 2\n*NGEN, LINE=C\n1, 11, 5, 100\n" +
                         bar + bars)
                         .model;
  EXPECT_EQ(at(model, 5), (Point{3.0, 0.0, 0.0}));
  EXPECT_EQ(model.node_sets[0].nodes.size(), 5u);
  // Half-way on a quarter circle; 1e-15 is round-off.
  EXPECT_NEAR(at(model, 6)[0], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(at(model, 6)[1], std::sqrt(0.5), 1e-15);
}

TEST(DeckMesh, FillAndCopy) {
  const auto model =
      read(
          "*NODE, NSET=A\n1, 0., 0., 0.\n2, 1., 0., 0.\n*NODE, NSET=B\n31, 0., 3., 0.\n32, 1., 6., 0.\n"
          "*NFILL, NSET=ALL\nA, B, 3, 10\n*NCOPY, OLD SET=A, CHANGE NUMBER=100, SHIFT, NEW SET=C\n0., 0., 5.\n"
          "0., 0., 0., 0., 0., 1., 90.\n" +
          bar + bars)
          .model;
  EXPECT_EQ(at(model, 12), (Point{1.0, 2.0, 0.0}));
  EXPECT_EQ(at(model, 21), (Point{0.0, 2.0, 0.0}));
  EXPECT_NEAR(at(model, 102)[0], 0.0, 1e-15);
  EXPECT_NEAR(at(model, 102)[1], 1.0, 1e-15);
  EXPECT_EQ(at(model, 102)[2], 5.0);
}

TEST(DeckMesh, ReflectedCopies) {
  const auto model =
      read(
          "*NODE, NSET=A\n1, 1., 2., 3.\n2, 4., 2., 3.\n*NCOPY, OLD SET=A, CHANGE NUMBER=10, REFLECT=POINT\n1., 1., 1.\n"
          "*NCOPY, OLD SET=A, CHANGE NUMBER=20, REFLECT=LINE\n0., 0., 0., 0., 0., 2.\n"
          "*NCOPY, OLD SET=A, CHANGE NUMBER=30, REFLECT=MIRROR\n0., 1., 0., 5., 1., 0.\n0., 1., 7.\n"
          "*NCOPY, OLD SET=A, CHANGE NUMBER=40, POLE\n2\n" +
          bar + bars)
          .model;
  EXPECT_EQ(at(model, 11), (Point{1.0, 0.0, -1.0}));
  EXPECT_EQ(at(model, 21), (Point{-1.0, -2.0, 3.0}));
  EXPECT_EQ(at(model, 31), (Point{1.0, 0.0, 3.0}));
  EXPECT_EQ(at(model, 41), (Point{-2.0, 2.0, 3.0}));
}

TEST(DeckMesh, MappedNodes) {
  const auto map = [](const std::string& line) {
    return at(read("*NODE\n1, 2., 90., 30.\n2, 1., 0., 0.\n*NODE, NSET=A\n7, 2., 90., 30.\n*NMAP, NSET=A, TYPE=" + line + "\n" +
                   bar + bars)
                  .model,
              7);
  };
  const auto expect_near = [](const Point& value, const Point& expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], 1e-14);  // of numbers up to 90
  };
  expect_near(map("RECTANGULAR\n1., 2., 3."), {3.0, 92.0, 33.0});
  expect_near(map("RECTANGULAR\n0., 0., 0., 0., 1., 0.\n-1., 0., 0."), {-90.0, 2.0, 30.0});
  expect_near(map("CYLINDRICAL\n0., 0., 1., 0., 0., 2.\n1., 0., 1.\n1., 2., 0.1"), {-2.0, 0.0, 4.0});
  expect_near(map("SPHERICAL\n0., 0., 0., 0., 0., 1.\n1., 0., 0."), {0.0, 2.0 * std::sqrt(0.75), 1.0});
  expect_near(map("DIAMOND\n0., 0., 0., 1., 0., 0.\n1., 1., 0., 0., 0., 2."),
              {2.0 + 90.0 * std::sqrt(0.5), 90.0 * std::sqrt(0.5), 30.0});
  expect_near(map("ROTATION\n0., 0., 0., 0., 0., 1.\n1., 0., 0.\n90."), {-89.0, 1.0, 30.0});
  expect_near(map("TRANSLATION\n0., 0., 0., 0., 5., 0.\n10."), {2.0, 100.0, 30.0});
  expect_near(map("SCALE, DEFINITION=NODES\n2\n2., 0.5, 3."), {3.0, 45.0, 90.0});
}

TEST(DeckMesh, MirroredElementsAreRightSideOut) {
  const auto model =
      read(
          "*NODE, NSET=ALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n"
          "7, 1., 1., 1.\n8, 0., 1., 1.\n*NCOPY, OLD SET=ALL, CHANGE NUMBER=100, REFLECT=MIRROR\n0., 0., -1., 1., 0., -1.\n0., 1., "
          "-1.\n"
          "*ELEMENT, TYPE=C3D8R, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
          "*ELCOPY, OLD SET=E, ELEMENT SHIFT=10, SHIFT NODES=100, NEW SET=F, REFLECT\n*ELSET, ELSET=G\nE, F\n"
          "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n*SOLID SECTION, ELSET=G, MATERIAL=M\n")
          .model;
  EXPECT_EQ(model.elements[0].connectivity[9], row_of(model, 104));
}

TEST(DeckMesh, CylindricalInputAndLocalSystem) {
  const auto model = read(
                         "*SYSTEM\n10., 0., 0., 10., 1., 0.\n9., 0., 0.\n*NODE\n1, 1., 2., 3.\n*SYSTEM\n"
                         "*NODE, SYSTEM=C\n2, 2., 90., 1.\n" +
                         bar + bars)
                         .model;
  EXPECT_EQ(at(model, 1), (Point{8.0, 1.0, 3.0}));  // local x is global y, local y is global -x
  EXPECT_NEAR(at(model, 2)[0], 0.0, 1e-15);
  EXPECT_NEAR(at(model, 2)[1], 2.0, 1e-15);
}

TEST(DeckMesh, GeneratedElements) {
  const auto model =
      read(
          "*NODE\n1\n5, 4.\n11, 0., 1.\n15, 4., 1.\n*NGEN\n1, 5\n11, 15\n*ELEMENT, TYPE=T3D2\n1, 1, 2\n"
          "*ELGEN, ELSET=E\n1, 4, 1, 1, 2, 10, 10\n*ELCOPY, OLD SET=E, ELEMENT SHIFT=100, SHIFT NODES=0, NEW SET=F\n"
          "*ELSET, ELSET=G\nE, F\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n*SOLID SECTION, ELSET=G, MATERIAL=M\n")
          .model;
  ASSERT_EQ(model.elements[0].size(), 16);
  EXPECT_EQ(model.elements[0].id[4], 11);
  EXPECT_EQ(model.elements[0].connectivity[8], row_of(model, 11));
  EXPECT_EQ(model.elements[0].id[15], 114);
}

TEST(DeckSets, MayReferToWhatComesLater) {
  const auto model =
      read(
          "*NSET, NSET=BOTH\nFIRST, 2\n*NSET, NSET=FIRST\n1\n*NSET, NSET=OF_BARS, ELSET=E\n*ELSET, ELSET=ALSO\nE\n"
          "*NODE\n1\n2, 1.\n3, 2.\n" +
          bar + bars)
          .model;
  for (const auto& set : model.node_sets) {
    EXPECT_EQ(set.nodes, set.name == "FIRST" ? (std::vector<std::int32_t>{0}) : (std::vector<std::int32_t>{0, 1}))
        << set.name;
  }
  ASSERT_EQ(model.element_sets.size(), 2u);
  EXPECT_EQ(model.element_sets[0].elements, model.element_sets[1].elements);
}

TEST(DeckSets, SortedUnlessUnsorted) {
  const auto model = read(
                         "*NODE\n1\n2, 1.\n3, 2.\n*NSET, NSET=S\n3, 1, 3\n*NSET, NSET=U, UNSORTED\n3, 1\n"
                         "*NSET, NSET=G, GENERATE\n1, 3, 2\n" +
                         bar + bars)
                         .model;
  EXPECT_EQ(model.node_sets[0].nodes, (std::vector<std::int32_t>{0, 2}));
  EXPECT_EQ(model.node_sets[1].nodes, (std::vector<std::int32_t>{2, 0}));
  EXPECT_EQ(model.node_sets[2].nodes, (std::vector<std::int32_t>{0, 2}));
}

TEST(DeckAssembly, InstancesAreMovedAndRenumbered) {
  const auto model =
      read(
          "*PART, NAME=BAR\n*NODE, NSET=TIP\n2, 1., 0., 0.\n*NODE\n1\n*ELEMENT, TYPE=T3D2, ELSET=E\n1, 1, 2\n"
          "*SOLID SECTION, ELSET=E, MATERIAL=M\n2.\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=LEFT, PART=BAR\n*END "
          "INSTANCE\n"
          "*INSTANCE, NAME=RIGHT, PART=BAR\n10., 0., 0.\n10., 0., 0., 10., 0., 1., 90.\n*END INSTANCE\n*NODE\n1, 5., "
          "5., 5.\n"
          "*NSET, NSET=TIPS, INSTANCE=LEFT\n2\n*NSET, NSET=TIPS, INSTANCE=RIGHT\nTIP\n*NSET, NSET=REF\n1\n*END "
          "ASSEMBLY\n"
          "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n*STEP\n*STATIC\n*BOUNDARY\nTIPS, 1\nRIGHT.TIP, 2\nLEFT.1, 3\nREF, "
          "3\n*END STEP\n")
          .model;
  ASSERT_EQ(model.nodes.size(), 5);
  EXPECT_EQ(model.nodes.id, (std::vector<std::int64_t>{2, 1, 1002, 1001, 2001}));
  EXPECT_EQ(model.elements[0].id, (std::vector<std::int64_t>{1, 1001}));
  EXPECT_NEAR(at(model, 1002)[0], 10.0, 1e-14);  // turned about z at (10, 0, 0)
  EXPECT_NEAR(at(model, 1002)[1], 1.0, 1e-14);
  EXPECT_EQ(model.elements[0].section, (std::vector<std::int32_t>{0, 1}));
  std::vector<std::int32_t> held;
  for (const auto& condition : model.steps[0].boundary) held.push_back(condition.node);
  EXPECT_EQ(held, (std::vector<std::int32_t>{0, 2, 2, 1, 4}));
}

// Where a solid is inside out, the line of the keyword or data line that made it is told, whichever that is.
TEST(DeckMesh, VolumesAreRefusedWhereTheElementComesFrom) {
  const std::string nodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n";
  const std::string law = "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n", section = "*SOLID SECTION, ELSET=E, MATERIAL=M\n";
  const auto refuses = [](const std::string& deck, const std::string& where, const std::map<std::string, std::string>& files = {}) {
    const auto errors = errors_of(deck, files);
    EXPECT_NE(errors.find(where + ": error: *ELEMENT: element "), std::string::npos) << errors;
    EXPECT_NE(errors.find("has a negative volume"), std::string::npos) << errors;
  };
  const std::string inverted = "5, 6, 7, 8, 1, 2, 3, 4\n";
  refuses(nodes + "*INCLUDE, INPUT=more.inp\n" + law + section, "more.inp:2",
          {{"more.inp", "*ELEMENT, TYPE=C3D8R, ELSET=E\n1, " + inverted}});
  // The copy joins the set, the good original stays: nodes shifted down by four turn the brick inside out.
  refuses("*NODE\n11, 0, 0, -1\n12, 1, 0, -1\n13, 1, 1, -1\n14, 0, 1, -1\n15, 0, 0, -2\n16, 1, 0, -2\n17, 1, 1, -2\n18, 0, 1, -2\n" +
              nodes + "*ELEMENT, TYPE=C3D8R, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
              "*ELCOPY, ELEMENT SHIFT=10, OLD SET=E, SHIFT NODES=10, NEW SET=E\n" + law + section,
          "job.inp:21");
  refuses("*PART, NAME=P\n" + nodes + "*ELEMENT, TYPE=C3D8R, ELSET=E\n1, " + inverted + section +
              "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*END ASSEMBLY\n" + law,
          "job.inp:12");
}

TEST(DeckMesh, MembraneMayOnlyLieOnItsNodes) {
  const std::string sheet =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n*ELEMENT, TYPE=M3D3, ELSET=E\n1, 1, 2, 3\n"
      "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n";
  EXPECT_EQ(errors_of(sheet + "*MEMBRANE SECTION, ELSET=E, MATERIAL=M, OFFSET=0.\n0.1\n"), "");
  EXPECT_NE(errors_of(sheet + "*MEMBRANE SECTION, ELSET=E, MATERIAL=M, OFFSET=0.5\n0.1\n")
                .find("job.inp:10: error: *MEMBRANE SECTION: OFFSET=0.5: the nodes of a membrane lie on its middle surface"),
            std::string::npos);
}

TEST(DeckMesh, ElementNeedsItsSectionOnce) {
  const std::string errors = errors_of("*NODE\n1\n2, 1.\n3, 2.\n" + bar + "*ELEMENT, TYPE=T3D2\n2, 2, 3\n" + bars);
  EXPECT_EQ(errors,
            "job.inp:8: error: *ELEMENT: element 2 of type T3D2 has no section (1 in all); add a section for a set "
            "that holds it, or delete it if a mesher left it there\n");
}

}  // namespace
}  // namespace balocco
