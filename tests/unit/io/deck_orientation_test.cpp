// Directions by coordinates, by nodes, and of single elements.
#include <gtest/gtest.h>

#include <cmath>

#include "deck_support.hpp"
#include "deck_writer.hpp"

namespace balocco {
namespace {

using test::errors_of;
using test::read;

const std::string bricks =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n"
    "9, 3, 0, 0\n10, 3, 1, 0\n11, 3, 0, 1\n12, 3, 1, 1\n"
    "*ELEMENT, TYPE=C3D8R, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 2, 9, 10, 3, 6, 11, 12, 7\n"
    "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n*SOLID SECTION, ELSET=ALL, MATERIAL=M, ORIENTATION=O\n";

Orientation of(const Model& model, std::int32_t row) { return model.orientations.at(0).of({0, row}); }

void expect_axes(const Orientation& orientation, const Point& first, const Point& second) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(orientation.axes[0][i], first[i], 1e-15);
    EXPECT_NEAR(orientation.axes[1][i], second[i], 1e-15);
  }
}

TEST(DeckOrientation, NodesShowTheAxes) {
  const auto model = read(bricks + "*ORIENTATION, NAME=O, DEFINITION=NODES\n3, 4, 2\n3, 30.\n").model;
  expect_axes(of(model, 1), {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0});  // from 2 to 3, towards 4
  EXPECT_EQ(model.orientations[0].origin, (Point{1.0, 0.0, 0.0}));
  EXPECT_EQ(model.orientations[0].rotation_axis, 2);
  expect_axes(of(read(bricks + "*ORIENTATION, NAME=O, DEFINITION=NODES\n2, 4\n").model, 0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  const auto round = read(bricks + "*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL, DEFINITION=NODES\n2, 6\n").model.orientations[0];
  EXPECT_EQ(round.system, Orientation::System::cylindrical);
  EXPECT_EQ(round.axes[2], (Point{0.0, 0.0, 1.0}));
  EXPECT_EQ(round.origin, (Point{1.0, 0.0, 0.0}));
}

TEST(DeckOrientation, NodesOfEachElementShowItsAxes) {
  const auto model = read(bricks + "*ORIENTATION, NAME=O, DEFINITION=OFFSET TO NODES\n5, 4\n").model;
  expect_axes(of(model, 0), {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0});
  const auto sheared = read(bricks + "*ORIENTATION, NAME=O, DEFINITION=OFFSET TO NODES\n2, 3, 4\n").model;
  const double diagonal = std::sqrt(0.5), length = std::sqrt(5.0);
  expect_axes(of(sheared, 0), {diagonal, -diagonal, 0.0}, {diagonal, diagonal, 0.0});
  expect_axes(of(sheared, 1), {2.0 / length, -1.0 / length, 0.0}, {1.0 / length, 2.0 / length, 0.0});
}

TEST(DeckOrientation, ADistributionGivesElementsTheirAxes) {
  const std::string deck = bricks +
                           "*ORIENTATION, NAME=O\nD\n3, 15.\n*DISTRIBUTION TABLE, NAME=T\nCOORD3D, COORD3D\n"
                           "*DISTRIBUTION, NAME=D, LOCATION=ELEMENT, TABLE=T\n, 1., 0., 0., 0., 1., 0.\n2, 0., 2., 0., -1., 1., 0.\n";
  for (const auto& text : {deck, write_deck(read(deck).model)}) {
    const auto model = read(text).model;
    expect_axes(of(model, 0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    expect_axes(of(model, 1), {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0});
    EXPECT_EQ(of(model, 1).rotation_axis, 2);
    EXPECT_NEAR(of(model, 1).additional_rotation, 15.0 * M_PI / 180.0, 1e-15);
  }
}

TEST(DeckOrientation, WhatGivesNoDirectionsIsRefused) {
  const std::string table = "*DISTRIBUTION TABLE, NAME=T\nCOORD3D, COORD3D\n";
  const std::string one = "*DISTRIBUTION, NAME=D, LOCATION=ELEMENT, TABLE=T\n2, 0., 2., 0., -1., 1., 0.\n";
  const auto contains = [](const std::string& errors, const std::string& part) { return errors.find(part) != std::string::npos; };
  EXPECT_TRUE(contains(errors_of(bricks + "*ORIENTATION, NAME=O\nD\n" + table + one), "gives element 1 no directions"));
  EXPECT_TRUE(contains(errors_of(bricks + "*ORIENTATION, NAME=O\nD\n" + table), "distribution D is not defined"));
  EXPECT_TRUE(contains(errors_of(bricks + "*ORIENTATION, NAME=O\nD\n*DISTRIBUTION TABLE, NAME=T\nANGLE\n" + one), "give one of these"));
  EXPECT_TRUE(contains(errors_of(bricks + "*ORIENTATION, NAME=O\nD\n" + table + one + "2, 1., 0., 0., 0., 1., 0.\n"), "has its own already"));
  EXPECT_TRUE(contains(errors_of(bricks + "*ORIENTATION, NAME=O, DEFINITION=OFFSET TO NODES\n2, 9\n"), "gives element 1 no directions"));
  EXPECT_TRUE(contains(errors_of(bricks + "*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL, DEFINITION=OFFSET TO NODES\n2, 4\n"), "are rectangular"));
  EXPECT_TRUE(contains(errors_of("*NODE\n20, 0., 0., 0.\n21, 1., 0., 0.\n*ELEMENT, TYPE=CONN3D2, ELSET=C\n20, 20, 21\n"
                                 "*CONNECTOR SECTION, ELSET=C\nHINGE\nO\n" +
                                 bricks + "*ORIENTATION, NAME=O, DEFINITION=OFFSET TO NODES\n2, 4\n"),
                       "which only solids, membranes and shells take"));
}

}  // namespace
}  // namespace balocco
