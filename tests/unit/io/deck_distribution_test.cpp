// *DISTRIBUTION of lengths: thicknesses of single shells.
#include <gtest/gtest.h>

#include "deck_support.hpp"
#include "deck_writer.hpp"

namespace balocco {
namespace {

using test::errors_of;
using test::read;

const std::string shells =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 2, 0, 0\n6, 2, 1, 0\n"
    "*ELEMENT, TYPE=S4R, ELSET=ALL\n1, 1, 2, 3, 4\n2, 2, 5, 6, 3\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n";
const std::string table = "*DISTRIBUTION TABLE, NAME=T\nLENGTH\n", lengths = "*DISTRIBUTION, NAME=D, LOCATION=ELEMENT, TABLE=T\n",
                  plain = "*SHELL SECTION, ELSET=ALL, MATERIAL=M, SHELL THICKNESS=D\n";

TEST(DeckDistribution, GivesShellsTheirThickness) {
  const std::string deck = shells + table + lengths + ", 2.\n2, 3.\n" + plain + ", 7\n";
  for (const auto& text : {deck, write_deck(read(deck).model)}) {
    const auto model = read(text).model;
    EXPECT_EQ(model.elements[0].thickness, (std::vector<double>{2.0, 3.0}));
    EXPECT_EQ(model.sections[0].thickness, 2.5);
    EXPECT_EQ(model.sections[0].shell.points, 7);
  }
  EXPECT_EQ(read(shells + table + lengths + "ALL, 2.\n" + plain).model.sections[0].thickness, 2.0);
}

TEST(DeckDistribution, GivesGeneralSectionsTheirThicknessUnlessTheyAreStiffnesses) {
  const std::string given = shells + table + lengths + "1, 4.\n2, 6.\n";
  const auto model = read(given + "*SHELL GENERAL SECTION, ELSET=ALL, MATERIAL=M, SHELL THICKNESS=D\n").model;
  EXPECT_EQ(model.elements[0].thickness, (std::vector<double>{4.0, 6.0}));
  EXPECT_TRUE(model.sections[0].shell.general);
  const auto told = errors_of(given + "*SHELL GENERAL SECTION, ELSET=ALL, SHELL THICKNESS=D\n1., 0., 1., 0., 0., 1., 0., 0.\n"
                                      "0., 1., 0., 0., 0., 0., 1., 0.\n0., 0., 0., 0., 1.\n");
  EXPECT_NE(told.find("hold for one thickness"), std::string::npos) << told;
}

TEST(DeckDistribution, LeavesPliesTheirPartsOfTheThickness) {
  const auto model =
      read(shells + table + lengths + "1, 4.\n2, 6.\n*SHELL SECTION, ELSET=ALL, COMPOSITE, SHELL THICKNESS=D\n1., 3, M\n3., 3, M\n").model;
  ASSERT_EQ(model.sections[0].plies.size(), 2u);
  EXPECT_EQ(model.sections[0].thickness, 5.0);
  EXPECT_EQ(model.sections[0].plies[0].thickness, 1.25);
  EXPECT_EQ(model.sections[0].plies[1].thickness, 3.75);
}

TEST(DeckDistribution, WhatGivesNoThicknessIsRefused) {
  const auto told = [](const std::string& deck, const std::string& part) { return errors_of(deck).find(part) != std::string::npos; };
  EXPECT_TRUE(told(shells + table + lengths + "2, 3.\n" + plain, "gives element 1 no thickness"));
  EXPECT_TRUE(told(shells + table + lengths + ", -3.\n" + plain, "length -3 must be positive"));
  EXPECT_TRUE(told(shells + plain, "distribution D is not defined"));
  EXPECT_TRUE(told(shells + "*DISTRIBUTION, NAME=D\n, 1., 0., 0., 0., 1., 0.\n" + plain, "name one whose table is LENGTH"));
  EXPECT_TRUE(told(shells + table + lengths + ", 3.\n*SHELL SECTION, ELSET=ALL, MATERIAL=M, NODAL THICKNESS, SHELL THICKNESS=D\n",
                   "keep one of them"));
  EXPECT_TRUE(told(shells + table + lengths + ", 3.\n*ORIENTATION, NAME=O\nD\n*SHELL SECTION, ELSET=ALL, MATERIAL=M, ORIENTATION=O\n1.\n",
                   "names distribution D of lengths"));
}

}  // namespace
}  // namespace balocco
