// Lines, names, numbers, includes, parameters; how errors are collected.
#include <gtest/gtest.h>

#include "deck/digest.hpp"
#include "deck/expression.hpp"
#include "deck/groups.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "deck_support.hpp"

namespace balocco {
namespace {

using test::brick;
using test::errors_of;
using test::read;
using test::static_step;

TEST(DeckText, Numbers) {
  EXPECT_EQ(deck::parse_real("1.D-3"), 1e-3);
  EXPECT_EQ(deck::parse_real("+2.5d+02"), 250.0);
  EXPECT_EQ(deck::parse_real("-.5"), -0.5);
  EXPECT_FALSE(deck::parse_real("1.0.0"));
  EXPECT_FALSE(deck::parse_real("nan"));
  EXPECT_FALSE(deck::parse_real("++1"));
  EXPECT_EQ(deck::parse_integer("12."), 12);
  EXPECT_FALSE(deck::parse_integer("12.5"));
}

TEST(DeckText, NearestWord) {
  EXPECT_EQ(deck::nearest("SOLID SECTOIN", {"SHELL SECTION", "SOLID SECTION"}), "SOLID SECTION");
  EXPECT_EQ(deck::nearest("XYZ", {"BOUNDARY"}), "");
}

TEST(KeywordRegister, KnowsEachKeywordOnce) {
  EXPECT_THROW(deck::RegisterKeyword({.keyword = "NODE"}), std::logic_error);
  deck::register_material_laws();
  EXPECT_THROW(deck::RegisterKeyword({.keyword = "ELASTIC"}), std::logic_error);
}

TEST(DeckExpression, PrecedenceAndFunctions) {
  const deck::ParameterValues values{{"R", 2.0}};
  EXPECT_DOUBLE_EQ(deck::evaluate("1 + 2*3", values), 7.0);
  EXPECT_DOUBLE_EQ(deck::evaluate("-r**2", values), -4.0);
  EXPECT_DOUBLE_EQ(deck::evaluate("2**3**2", values), 512.0);
  EXPECT_DOUBLE_EQ(deck::evaluate("sqrt(2.*r)/(1e-1*10)", values), 2.0);
  EXPECT_THROW(deck::evaluate("1 +", values), std::invalid_argument);
  EXPECT_THROW(deck::evaluate("s", values), std::invalid_argument);
}

// Published test vectors of FIPS 180-4.
TEST(DeckDigest, Sha256) {
  EXPECT_EQ(deck::digest({"abc"}), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(deck::digest({}), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(deck::digest({"abcdbcdecdefdefgefghfghighij", "hijkijkljklmklmnlmnomnopnopq"}),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(DeckSyntax, CommentsCaseBlanksAndLineEnds) {
  const auto model =
      read(
          "*Heading\r\n** a comment\r\nTitle\r\n*node,nset = \"left end\"\r\n 1 , 0.D0, 0., 0.\r\n** "
          "between\r\n\r\n2,1.0E+00\r\n"
          "*Element, type=t3d2,\r\n elset=Bars\r\n1, 1, 2\r\n*solidsection,elset=BARS,\r\nmaterial=steel\r\n2.\r\n"
          "*MATERIAL,NAME=Steel\r\n*ELASTIC\r\n1.,.3\r\n")
          .model;
  EXPECT_EQ(model.heading, "Title");
  ASSERT_EQ(model.nodes.size(), 2);
  EXPECT_EQ(model.nodes.coordinates[1], (Point{1.0, 0.0, 0.0}));
  EXPECT_EQ(model.node_sets[0].name, "LEFT END");
  EXPECT_EQ(model.element_sets[0].name, "BARS");
  EXPECT_EQ(model.sections[0].area, 2.0);
  EXPECT_EQ(model.where(model.nodes.location[1]), "job.inp:8");
}

TEST(DeckSyntax, ConnectivityRunsOverLines) {
  std::string deck = brick + static_step;
  const auto place = deck.find("1, 1, 2, 3, 4, 5, 6, 7, 8");
  deck.replace(place, 25, "1, 1, 2, 3,\n4, 5,\n6, 7, 8");
  EXPECT_EQ(read(deck).model.elements[0].connectivity, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(DeckSyntax, IncludesCountFromTheIncludingFile) {
  const auto model =
      read("*INCLUDE, INPUT=parts/mesh.inc\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n*SOLID SECTION, ELSET=E, MATERIAL=M\n",
           {{"parts/mesh.inc", "*NODE\n1, 0.\n2, 1.\n*INCLUDE, INPUT=bars.inc\n"},
            {"parts/bars.inc", "*ELEMENT, TYPE=T3D2, ELSET=E\n1, 1, 2\n"}})
          .model;
  EXPECT_EQ(model.files, (std::vector<std::string>{"job.inp", "parts/mesh.inc", "parts/bars.inc"}));
  EXPECT_EQ(model.where(model.elements[0].location[0]), "parts/bars.inc:2");
}

TEST(DeckSyntax, ParametersAreSubstituted) {
  std::string deck = "*PARAMETER\nlength = 3.\narea = length**2 / 2  # of the bar\n" + brick + static_step;
  deck.replace(deck.find("2, 1, 0, 0"), 10, "2, <area>, 0, 0");
  EXPECT_EQ(read(deck).model.nodes.coordinates[1][0], 4.5);
}

TEST(DeckSyntax, IgnoredKeywordsWarnAndLoseTheirData) {
  const std::string deck = brick + "*ACOUSTIC MEDIUM\n2.\n" + static_step;
  EXPECT_NE(errors_of(deck), "");
  const auto result = read(deck, {}, {{"acoustic medium"}});
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("*ACOUSTIC MEDIUM: ignored"), std::string::npos);
}

TEST(DeckErrors, SortedByLineAndAtMostTwenty) {
  std::string deck = "*NODE\n";
  for (int i = 1; i <= 30; ++i) deck += "x, 0., 0., 0.\n";
  try {
    read(deck);
    FAIL();
  } catch (const InputError& trouble) {
    ASSERT_EQ(trouble.messages().size(), 20u);
    EXPECT_TRUE(trouble.messages()[0].starts_with("job.inp:2: error: *NODE: field 1 ('x')"));
    EXPECT_TRUE(trouble.messages()[19].starts_with("job.inp:21: "));
  }
}

TEST(DeckErrors, IndependentErrorsAreAllTold) {
  std::string deck = brick + "*STEP\n*STATIC\n*BOUNDARY\nLEFT, 1\nLEFT, 2\n*CLOAD\nALLN, 1, 1.x\n*END STEP\n";
  deck.replace(deck.find("MATERIAL=STEEL"), 14, "MATERIAL=STEAL");
  EXPECT_EQ(errors_of(deck),
            "job.inp:19: error: *SOLID SECTION: material STEAL is not defined; did you mean STEEL?\n"
            "job.inp:23: error: *BOUNDARY: node set LEFT is not defined; define it\n"
            "job.inp:26: error: *CLOAD: field 3 ('1.x') should be a number: magnitude; correct it\n");
}

TEST(DeckErrors, ConsequencesAreNotTold) {
  // The misspelt element block leaves sets, surfaces and sections without elements; only the cause is told.
  std::string deck =
      brick + "*SURFACE, NAME=TOP\nALL, S2\n*ELSET, ELSET=ONE\n1\n*STEP\n*STATIC\n*DSLOAD\nTOP, P, 1.\n*END STEP\n";
  deck.replace(deck.find("*ELEMENT"), 8, "*ELEMNET");
  const std::string errors = errors_of(deck);
  EXPECT_TRUE(errors.starts_with(
      "job.inp:12: error: *ELEMNET: this keyword is unknown or not supported; did you mean *ELEMENT?"));
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
}

}  // namespace
}  // namespace balocco
