// Nastran bulk data: every format of a card is the same card; the deck that is written reads back without a complaint; what would
// change the mesh is refused, the rest is told.
#include <gtest/gtest.h>

#include <cmath>

#include "deck_support.hpp"
#include "deck_writer.hpp"
#include "elements/element_type.hpp"
#include "nastran/bulk_cards.hpp"
#include "nastran_reader.hpp"

namespace balocco {
namespace {

/// A square of two by one, a quadrilateral and two triangles, in small fields.
const std::string plate =
    "SOL 101\nCEND\nSPC = 1\nBEGIN BULK\n"
    "$ a comment\n"
    "$HMNAME PROP                   7\"left half\" 4\n"
    "GRID           1              0.      0.      0.\n"
    "GRID           2              1.      0.      0.                        $ behind the fields\n"
    "GRID           3              1.      1.      0.\n"
    "GRID           4              0.      1.      0.\n"
    "GRID           5              2.      0.     0.0\n"
    "GRID           6             2.0     1.0     0.0\n"
    "CQUAD4        11       7       1       2       3       4\n"
    "CTRIA3        12       8       2       5       6\n"
    "CTRIA3        13       8       2       6       3\n"
    "PSHELL         7       1     0.5       1               1\n"
    "PSHELL         8       1    0.25       1\n"
    "MAT1           12.1+5                0.3  7.85-9\n"
    "ENDDATA\n"
    "GRID           1              9.      9.      9.\n";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string faults_of(const std::string& text) {
  try {
    read_nastran(text, "plate.bdf");
  } catch (const InputError& error) {
    std::string all;
    for (const auto& message : error.messages()) all += message + "\n";
    return all;
  }
  return "accepted";
}

TEST(NastranCards, NumbersAreWrittenInManyWays) {
  for (const auto* text : {"1500.", "1.5+3", "1.5E3", "1.5e+3", "1.5D3", "+1.5d+03", "150.+1", ".15E+4"})
    EXPECT_EQ(nastran::parse_bulk_real(text), 1500.0) << text;
  EXPECT_EQ(nastran::parse_bulk_real("-1.5-3"), -1.5e-3);
  EXPECT_EQ(nastran::parse_bulk_real("-7"), -7.0);
  for (const auto* text : {"1.5-", "+", "1.5-3-4", "abc", "1.5 3"}) EXPECT_FALSE(nastran::parse_bulk_real(text)) << text;
}

TEST(NastranCards, AreTheSameInEveryFormat) {
  for (const std::string same :
       {"GRID,3,,1.,1.,0.\n", "grid, 3, , 1.,1.\n",
        "GRID*                  3                              1.              1.*G3\n*G3                   0.\n",
        "GRID*,3,,1.0,1.,*\n*,0.\n", "GRID\t3\t\t1.\t1.\t0.\r\n"}) {
    const auto text = changed(plate, "GRID           3              1.      1.      0.\n", same);
    EXPECT_EQ(read_nastran(text, "plate.bdf").model.nodes.coordinates[2], (Point{1.0, 1.0, 0.0})) << same;
  }
}

TEST(NastranCards, ContinuationsAreFollowed) {
  deck::Diagnostics diagnostics;
  const auto data = nastran::read_bulk_data(
      "RBE2           1       2     123       3       4       5       6       7+A\n"
      "+A             8       9\n"
      "CORD2R,5,,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n",
      diagnostics);
  EXPECT_EQ(diagnostics.number_of_errors(), 0u);
  ASSERT_EQ(data.cards.size(), 2u);
  EXPECT_EQ(data.cards[0].fields[8], "8");
  EXPECT_EQ(data.cards[1].fields[10], "0.");
  EXPECT_EQ(data.cards[1].line, 3);
}

TEST(Nastran, BecomesADeckThatReadsBackWithoutAComplaint) {
  const auto converted = read_nastran(plate, "plate.bdf");
  const auto [model, warnings] = test::read(write_deck(converted.model));
  EXPECT_EQ(warnings, std::vector<std::string>{});
  ASSERT_EQ(model.nodes.size(), 6);
  ASSERT_EQ(model.elements.size(), 2u);
  EXPECT_EQ(model.elements[0].type->name, "S4R");
  EXPECT_EQ(model.elements[0].id, std::vector<std::int64_t>{11});
  EXPECT_EQ(model.elements[1].type->name, "S3R");
  EXPECT_EQ(model.elements[1].connectivity, (std::vector<std::int32_t>{1, 4, 5, 1, 5, 2}));
  ASSERT_EQ(model.sections.size(), 2u);
  EXPECT_EQ(model.sections[0].element_set, "LEFT HALF");
  EXPECT_EQ(model.sections[0].thickness, 0.5);
  EXPECT_EQ(model.sections[1].element_set, "PSHELL-8");
  EXPECT_EQ(model.materials[0].density, 7.85e-9);
  EXPECT_EQ(model.materials[0].parameters, (std::vector<double>{2.1e5, 0.3}));
}

TEST(Nastran, TellsWhatItDoesNotTakeOver) {
  const auto text =
      changed(plate, "ENDDATA\n",
              "SPC            1       1     123\nGRAV,2,,9.81,0.,0.,-1.\nGRAV,3,,9.81,0.,0.,-1.\nGRID,99,,5.,5.,5.,,123\n");
  const auto summary = read_nastran(text.substr(0, text.rfind("GRID           1")), "plate.bdf").summary;
  EXPECT_NE(summary.find("6 nodes, 1 S4R, 2 S3R"), std::string::npos) << summary;
  EXPECT_NE(summary.find("note: not taken over: 2 GRAV, 1 GRID that no element uses, 1 PS (constraint) of GRID, 1 SPC\n"),
            std::string::npos)
      << summary;
}

TEST(Nastran, TurnsShellsToTheSideOfTheirSurface) {
  const auto converted = read_nastran(
      changed(plate, "CTRIA3        13       8       2       6       3", "CTRIA3        13       8       2       3       6"),
      "plate.bdf");
  EXPECT_NE(converted.summary.find("note: 1 shells turned round"), std::string::npos) << converted.summary;
  EXPECT_EQ(test::read(write_deck(converted.model)).warnings, std::vector<std::string>{});
  EXPECT_EQ(read_nastran(plate, "plate.bdf").summary.find("turned"), std::string::npos);
}

TEST(Nastran, CoordinateSystemsStandOnEachOther) {
  // System 5 lies at (10, 0, 0) with its z along x and its x along y; 6 is cylindrical in it, moved along its z by 1.
  const auto text = changed(plate, "GRID           3              1.      1.      0.\n",
                            "CORD2R,5,0,10.,0.,0.,11.,0.,0.,+\n+,10.,1.,0.\n"
                            "CORD2C,6,5,0.,0.,1.,0.,0.,2.,+\n+,1.,0.,1.\n"
                            "GRID,3,6,2.,90.,3.\n");
  const auto place = read_nastran(text, "plate.bdf").model.nodes.coordinates[2];
  const Point expected{14.0, 0.0, 2.0};  // 10 + 1 + 3 along x; a quarter turn from y about x is z
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(place[c], expected[c], 1e-12);
}

TEST(Nastran, ElasticConstantsMayBeAnyTwo) {
  const auto with = [](const std::string& constants) {
    return read_nastran(changed(plate, "MAT1           12.1+5                0.3  7.85-9", "MAT1,1," + constants), "plate.bdf")
        .model.materials[0];
  };
  EXPECT_NEAR(with("2.6e5,1.0e5").parameters[1], 0.3, 1e-12);
  EXPECT_NEAR(with(",1.0e5,0.3").parameters[0], 2.6e5, 1e-6);
  EXPECT_EQ(with("2.6e5,,0.3").density, 0.0);
}

TEST(Nastran, RefusesWhatWouldBeAnotherMesh) {
  const auto is_told = [&](const std::string& from, const std::string& to, const std::string& message, int messages = 1) {
    const auto faults = faults_of(changed(plate, from, to));
    EXPECT_NE(faults.find(message), std::string::npos) << faults;
    EXPECT_EQ(faults.find("plate.bdf:"), 0u) << faults;
    EXPECT_EQ(std::count(faults.begin(), faults.end(), '\n'), messages) << faults;
  };
  is_told("GRID           3        ", "GRID           3       5",
          "plate.bdf:9: error: GRID 3: its coordinate system 5 is no CORD2R or CORD2C");
  is_told("GRID           3              1.", "GRID           3             1.a",
          ":9: error: GRID 3: a coordinate is '1.A'; write a number");
  is_told("$ a comment\n", "GRID,4\n", ":10: error: GRID 4: this number is taken; give each GRID its own");
  is_told("CQUAD4        11       7       1", "CHEXA         11       7       1",
          ":13: error: CHEXA 11: this kind of element is not read");
  is_told("       3       4\n", "       3       4             0.1\n", ":13: error: CQUAD4 11: its offset ZOFFS is not read");
  is_told("       6       3\n", "       6       6\n", ":15: error: CTRIA3 13: a node is named twice");
  is_told("       6       3\n", "       6      33\n", ":15: error: element 13: no GRID 33 is there");
  is_told("CTRIA3        12       8", "CTRIA3        12       9", ":14: error: element 12: no PSHELL 9 describes it");
  is_told("0.5       1  ", "0.5       3  ", ":16: error: PSHELL 7: it bends otherwise than a homogeneous plate; give MID2 = MID1");
  is_told("    0.25       1\n", "    0.25\n", ":17: error: PSHELL 8: it bends otherwise than a homogeneous plate");
  is_told("    0.25       1\n", "   -0.25       1\n", "its thickness is -0.25; give one > 0");
  is_told("MAT1           1", "MAT8           1", ":16: error: PSHELL 7: no MAT1 1 describes it", 2);
  is_told("     0.3  7.85-9", "          7.85-9", ":18: error: MAT1 1: it needs two of E, G and NU");
  is_told("BEGIN BULK\n", "", "no BEGIN BULK");
  is_told("$ a comment\n", "INCLUDE 'wheel.dat'\n", ":5: error: INCLUDE is not followed");
  is_told("$ a comment\n", "+B             1\n", ":5: error: a continuation without a card before it");
  is_told("GRID           1              0.      0.      0.\n",
          "GRID           1              0.      0.      0.                        +A\n+B\n",
          ":8: error: the continuation +B follows a line that asks for +A");
  is_told("CEND\n", "CEND\nBEGIN BULK\nENDDATA\n", "plate.bdf:1: error: no CQUAD4 and no CTRIA3");
}

TEST(Nastran, AChainOfCoordinateSystemsThatClosesIsRefused) {
  const auto faults = faults_of(changed(plate, "GRID           3              1.      1.      0.\n",
                                        "CORD2R,5,6,0.,0.,0.,1.,0.,0.,+\n+,0.,1.,0.\nCORD2R,6,5,0.,0.,0.,1.,0.,0.,+\n+,0.,1.,0.\n"
                                        "GRID,3,5,2.,90.,3.\n"));
  EXPECT_NE(faults.find("plate.bdf:11: error: CORD2R 6: its coordinate system 5 stands on itself"), std::string::npos) << faults;
}

}  // namespace
}  // namespace balocco
