// The car's body: curves, sheets, welds as small systems of their own, one connected body with both sides alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "builders/car/body_parts.hpp"
#include "builders/car/car_builder.hpp"
#include "builders/car/chassis_shells.hpp"
#include "builders/car/rail_sections.hpp"
#include "builders/car/suspension.hpp"
#include "builders/car/tyre_placement.hpp"
#include "model/diagnostics.hpp"
#include "text_of_file.hpp"

namespace balocco::car {
namespace {

const CarFiles files{test::text_of_file, [](const std::string&) { return std::nullopt; }};

std::string main_spec() {
  return *test::text_of_file(BALOCCO_CAR_SPEC);
}

CarDeck built(const std::string& text) {
  return build_car(text, BALOCCO_CAR_SPEC, files);
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(CarCurve, GraphPassesItsRowsAndIsExactForParabolas) {
  const Graph parabola({{0.0, 0.0}, {1.0, 1.0}, {3.0, 9.0}, {4.0, 16.0}});
  EXPECT_DOUBLE_EQ(parabola(3.0), 9.0);
  EXPECT_NEAR(parabola(2.0), 4.0, 1e-12);  // slopes at 1 and 3 are those of the parabola
}

TEST(CarCurve, StationsKeepTheBreaksAndTheSize) {
  const auto all = stations({0.0, 1.0, 3.5}, 0.6);
  EXPECT_EQ(all.size(), 1u + 2u + 5u);
  EXPECT_DOUBLE_EQ(all[2], 1.0);
}

/// A flat sheet of a metre square at a height.
Sheet flat(const std::string& part, double height) {
  return sheet_on(part, stations({0.0, 1000.0}, 100.0), stations({100.0, 1100.0}, 100.0), [&](double x, double y) {
    return Vector{x, y, height};
  });
}

TEST(CarWelds, APartIsInAWeldOnceAndNoNodeInTwoWelds) {
  BodyMesh mesh;
  for (const char* part : {"A", "B", "C", "D", "E"}) mesh.add(flat(part, 0.0));
  for (const auto& [first, second] : {std::pair{"A", "B"}, std::pair{"B", "C"}, std::pair{"C", "D"}, std::pair{"D", "E"}})
    mesh.weld(first, second, 1.0, 150.0);
  std::set<int> seen;
  for (const auto& weld : mesh.welds()) {
    EXPECT_LE(weld.size(), 4u);
    std::set<int> parts;
    for (const int node : weld) {
      EXPECT_TRUE(seen.insert(node).second);
      EXPECT_TRUE(parts.insert(node / 121).second);  // 11 x 11 nodes a part
    }
  }
  EXPECT_TRUE(mesh.loose_parts().empty());
}

TEST(CarWelds, KeepTheirPitch) {
  BodyMesh mesh;
  mesh.add(flat("A", 0.0));
  mesh.add(flat("B", 1.0));
  EXPECT_EQ(mesh.weld("A", "B", 5.0, 199.0), 36);  // every second node of eleven, both ways
  EXPECT_EQ(mesh.weld("A", "B", 0.5, 199.0), 0);
}

TEST(CarBody, MirrorImagesLieNodeForNode) {
  BodyMesh mesh;
  mesh.add_both(flat("A", 3.0));
  const auto *left = mesh.find("A_LEFT"), *right = mesh.find("A_RIGHT");
  ASSERT_TRUE(left && right);
  const auto normal = [&](const Part& part) {
    const auto& q = part.quadrilaterals[0];
    const auto& x = mesh.nodes();
    return cross(x[q[2]] - x[q[0]], x[q[3]] - x[q[1]]);
  };
  for (int i = 0; i < left->nodes; ++i) EXPECT_EQ(mesh.nodes()[left->first_node + i][1], -mesh.nodes()[right->first_node + i][1]);
  EXPECT_GT(normal(*left)[2] * normal(*right)[2], 0.0);
}

TEST(CarBody, IsOnePieceAtEveryMeshSize) {
  for (const char* size : {"100.0", "50.0", "14.0"}) {
    const auto report = built(changed(main_spec(), "mesh_size = 40.0", std::string("mesh_size = ") + size)).report;
    EXPECT_EQ(report.find("warning"), std::string::npos) << report;
  }
}

TEST(CarRails, SectionGoesOnceAcrossTheirMiddle) {
  BodyMesh mesh;
  mesh.add_both(flat("REAR_RAIL", 0.0));  // x from 0 to 1000 in ten columns
  mesh.add(flat("FLOOR", 1.0));
  DeckText deck;
  write_rail_section(mesh, *mesh.find("REAR_RAIL_LEFT"), 1001, deck);
  write_rail_section(mesh, *mesh.find("FLOOR"), 2001, deck);
  std::istringstream lines(deck.text());
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "*ELSET, ELSET=SECTION_REAR_RAIL_LEFT");
  std::getline(lines, line);
  std::istringstream numbers(line);
  const auto& part = *mesh.find("REAR_RAIL_LEFT");
  int count = 0;
  for (std::string number; std::getline(numbers, number, ','); ++count) {
    const auto& corners = part.quadrilaterals.at(std::stoul(number) - 1001);
    double middle = 0.0;
    for (const int node : corners) middle += 0.25 * mesh.nodes()[node][0];
    EXPECT_NEAR(middle, 550.0, 1e-9);  // of 450 and 550, which share the middle, the one ahead
  }
  EXPECT_EQ(count, 10);
  EXPECT_FALSE(std::getline(lines, line));  // a floor has none
}

TEST(CarSubframe, IsARingOfTwoWeldedHalvesAlikeOnBothSides) {
  const auto spec = read_car_spec(main_spec(), BALOCCO_CAR_SPEC, test::text_of_file);
  BodyMesh mesh;
  add_subframe(spec, mesh);
  EXPECT_GT(mesh.weld("SUBFRAME_UPPER", "SUBFRAME_LOWER", 1.0, spec.weld_pitch), 40);
  EXPECT_TRUE(mesh.loose_parts().empty());
  Inertia subframe;
  for (const auto& part : mesh.parts()) add_part(spec, mesh, part, subframe);
  EXPECT_NEAR(subframe.mass(), 16000.0, 2000.0);  // those of the class weigh so
  EXPECT_NEAR(subframe.centre()[1], 0.0, 1e-9);
  const auto& upper = mesh.parts()[0];
  std::map<int, int> elements_of;
  for (const auto& corners : upper.quadrilaterals)
    for (const int node : corners) ++elements_of[node];
  for (const auto& [node, elements] : elements_of) EXPECT_EQ(elements % 2, 0) << node;  // no end: 2 at its edges, 4 within
}

TEST(CarTorsionBeam, EndsAtBothArmsWithTheSameNodes) {
  const auto spec = read_car_spec(main_spec(), BALOCCO_CAR_SPEC, test::text_of_file);
  BodyMesh mesh;
  add_torsion_beam(spec, mesh);
  const auto [left, right] = ends_of_torsion_beam(mesh);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_NEAR(mesh.nodes()[left[i]][1], spec.chassis.rear.beam.line.back()[1], 1e-9);
    EXPECT_NEAR(length(mesh.nodes()[left[i]] - mirrored(mesh.nodes()[right[i]])), 0.0, 1e-9);
  }
}

std::string fault_of(const std::string& from, const std::string& to) {
  try {
    built(changed(main_spec(), from, to));
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages().size(), 1u) << error.messages().back();
    return error.messages()[0];
  }
  return "";
}

TEST(CarSpec, FaultsNameLineAndCure) {
  EXPECT_NE(fault_of("thickness = 0.75", "thickness = -0.75").find("[gauge.panel] thickness"), std::string::npos);
  EXPECT_NE(fault_of("material = \"high_strength\"", "material = \"high_strenght\"").find("did you mean \"high_strength\"?"),
            std::string::npos);
  EXPECT_NE(fault_of("kick_rear = -2020.0", "kick_rear = -1600.0").find("the floor rises backwards"), std::string::npos);
  EXPECT_NE(fault_of("front_track = 1385.0", "front_track = 1685.0").find("inside the wheel's centre"), std::string::npos);
  EXPECT_NE(fault_of("parts = [\"STRUT_HOUSE_TOP\", \"STRUT_HOUSE_WALL\"]", "parts = [\"STRUT_HOUSE_TOP\"]").find("no gauge"),
            std::string::npos);
  EXPECT_NE(fault_of("line = [[240.0, 0.0,", "line = [[240.0, 5.0,").find("[front.subframe] line: the line begins beside"),
            std::string::npos);
  EXPECT_NE(fault_of("[-278.0, 0.0, 210.0]]", "[-278.0, 60.0, 210.0]]").find("the ring does not close"), std::string::npos);
  EXPECT_NE(fault_of("reach = 100.0", "reach = 30.0").find("[front.subframe] reach"), std::string::npos);
  EXPECT_NE(fault_of("dash_x = -430.0", "dash_x = -930.0").find("meet nowhere"), std::string::npos);
}

TEST(CarSpec, WhatCannotBeAssembledIsToldWithLineAndCure) {
  const auto line_of = [](const std::string& key) {
    const auto text = main_spec();
    return std::to_string(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(key)), '\n') + 1);
  };
  const auto is_told = [&](const std::string& from, const std::string& to, const std::string& line, const std::string& words) {
    const auto fault = fault_of(from, to);
    EXPECT_NE(fault.find(":" + line + ": error: "), std::string::npos) << line << "\n" << fault;
    EXPECT_NE(fault.find(words), std::string::npos) << fault;
  };
  is_told("arm_front = [[150.0,", "arm_front = [[-170.0,", line_of("arm_front ="), "lies behind arm_rear");
  is_told("ball_joint = [[27.9, 612.0,", "ball_joint = [[27.9, 312.0,", line_of("ball_joint ="), "the arm reaches inwards");
  is_told("rod_outer = [[-140.0, 590.0,", "rod_outer = [[-140.0, 290.0,", line_of("rod_outer ="), "tie rod reaches inwards");
  is_told("strut_lower = [[-5.1, 572.0, -1.3]]", "strut_lower = [[-70.0, 500.0, 420.0]]", line_of("strut_lower ="),
          "the strut cannot shorten");
  is_told("place = [[-2080.0, 520.0, 320.0]]", "place = [[-2480.0, 520.0, 320.0]]", line_of("place = [[-2080.0, 520.0"),
          "does not lie ahead of the rear wheels");
  is_told("place = [[-83.8, 499.5, 736.6]]", "place = [[-83.8, 449.5, 736.6]]", line_of("place = [[-83.8, 499.5"),
          "give both one place");
  is_told("ball_joint = [[27.9, 612.0,", "ball_joint = [[27.9, 712.0,", line_of("ball_joint ="),
          "beyond the wheel's middle at 692.5 mm");
  is_told("ball_joint = [[27.9, 612.0, -104.1]]", "ball_joint = [[27.9, 612.0, 4.1]]", line_of("ball_joint ="),
          "the knuckle stands on it");
  is_told("spring_seat = [[-2440.0,", "spring_seat = [[-1440.0,", line_of("spring_seat ="), "does not lie behind the arm's pivot");
  is_told("damper_lower = [[-2520.0, 560.0, 215.0]]", "damper_lower = [[-2520.0, 560.0, 915.0]]",
          line_of("place = [[-2490.0"), "the damper has no room");
  is_told("rear_track = 1365.0", "rear_track = 1700.0", line_of("plan ="), "the skin at the rear axle");
  is_told("rear_track = 1365.0", "rear_track = 1100.0", line_of("rear_track ="), "stands in the wheel REAR_LEFT");
  is_told("[0.05, 200.0], [0.13, 300.0]", "[0.05, 200.0], [0.13, 100.0]", line_of("damper_bump ="), "what falls drives");
  is_told("size = [[420.0, 800.0, 450.0]]", "size = [[420.0, 0.0, 450.0]]", line_of("size = [[420.0"), "has no inertia");
  is_told("rates = [[91.0, 200.0,", "rates = [[91.0, 0.0,", line_of("rates ="), "does not carry along one of its axes");
  is_told("[[200.0, 0.0], [237.0,", "[[200.0, 0.0], [137.0,", line_of("plastic = [[200.0"), "stresses that do not fall");
  is_told("[mount.axle_pivot]", "[mount.axle_pivots]", line_of("[mount.strut_mount_front]"), "[mount] axle_pivot: missing");
  is_told("wheel_height = 268.0", "wheel_height = 298.0", line_of("wheel_height ="), "is not on the road");
  is_told("wheel_height = 268.0", "wheel_height = 178.0", line_of("wheel_height ="), "is on the road");
  is_told("obstacle = \"comfort\" ", "obstacle = \"dorp\"    ", line_of("obstacle = \"comfort\""), "did you mean \"drop\"?");
  is_told("height = 500.0", "height = -500.0", line_of("height = 500.0"), "[drive.drop] height: -500 is out of range");
  is_told("[drive.drop]", "[pressure]\nfront_let = 0.0\nloss_time = 40.0\n[drive.drop]", std::to_string(std::stoi(line_of("[drive.drop]")) + 1),
          "did you mean \"front_left\"?");
  is_told("[drive.drop]", "[pressure]\nrear_right = -0.1\nloss_time = 40.0\n[drive.drop]", std::to_string(std::stoi(line_of("[drive.drop]")) + 1),
          "[pressure] rear_right: -0.1 is out of range");
  const auto damper = main_spec().find("damper_bump");
  const auto curve = main_spec().substr(damper, main_spec().find('\n', damper) - damper);
  is_told(curve, "", line_of("[front.strut]"), "[front.strut] damper_bump: missing");
}

TEST(CarSpec, FilesAreNamedFromTheDescriptionInWhichTheyStand) {
  const std::string base = BALOCCO_CAR_SPEC;
  const auto spec = read_car_spec("base = \"" + base + "\"\nmesh_size = 100.0\n", "elsewhere/car.toml", test::text_of_file);
  EXPECT_EQ(spec.tyre, base.substr(0, base.rfind('/')) + "/tyre.toml");
  EXPECT_EQ(spec.mesh_size, 100.0);
  const auto other_tyre = "base = \"" + base + "\"\ntyre = \"t.toml\"\n";
  EXPECT_EQ(read_car_spec(other_tyre, "elsewhere/car.toml", test::text_of_file).tyre, "elsewhere/t.toml");
}

TEST(CarSprings, CarryTheSprungWeightAtDesignHeight) {
  const auto spec = read_car_spec(main_spec(), "car.toml", test::text_of_file);
  BodyMesh mesh;
  const auto sprung = sprung_mass(spec, mesh);
  const auto weights = corner_weights(spec, sprung);
  EXPECT_NEAR(2.0 * (weights.front + weights.rear), sprung.mass() * 9.81e-3, 1e-6);
  EXPECT_NEAR(2.0 * weights.rear * spec.profile.wheelbase, -sprung.mass() * 9.81e-3 * sprung.centre()[0],
              1e-3);  // moment about the front axle
}

TEST(CarTyres, AreFourAlikeAtTheirWheels) {
  const auto car = built(main_spec());
  const auto& model = car.tyres;
  std::vector<Point> middles;
  for (const auto* wheel : wheel_names)
    for (const auto& set : model.node_sets)
      if (set.name == std::string("TYRE_") + wheel) {
        Point sum{};
        for (const auto node : set.nodes)
          for (int c = 0; c < 3; ++c) sum[c] += model.nodes.coordinates[node][c] / static_cast<double>(set.nodes.size());
        middles.push_back(sum);
      }
  ASSERT_EQ(middles.size(), 4u);
  EXPECT_NEAR(middles[0][1] - middles[1][1], 1385.0, 1e-6);
  EXPECT_NEAR(middles[0][0] - middles[2][0], 2460.0, 1e-6);
  ASSERT_EQ(model.contact_pairs.size(), 8u);  // treads on roads, insides on rims
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    const auto& pair = model.contact_pairs[4 + wheel];
    EXPECT_EQ(model.surfaces[pair.slave].name, std::string("STRIKE_") + wheel_names[wheel]);
    EXPECT_EQ(model.surfaces[pair.master].name, std::string("RIM_") + wheel_names[wheel]);
    EXPECT_NE(car.car.find(std::string(", ANALYTICAL SURFACE=RIM_") + wheel_names[wheel]), std::string::npos);
  }
}

TEST(CarBuilder, SaysByOneWordWhatDeforms) {
  const auto of = [](const char* fidelity) {
    return build_car(main_spec(), BALOCCO_CAR_SPEC, files, {.obstacle = "", .fidelity = fidelity}).car;
  };
  EXPECT_EQ(of("complete").find("*ELSET, ELSET=RIGID_BODY"), std::string::npos);
  const auto rigid = of("rigid"), some = of("semi-flexible");
  const auto list = [](const std::string& deck) {
    const auto begin = deck.find("*ELSET, ELSET=RIGID_BODY");
    return deck.substr(begin, deck.find("*RIGID BODY", begin) - begin);
  };
  EXPECT_NE(list(rigid).find("\nSTRUT_HOUSE_TOP_LEFT\n"), std::string::npos);
  EXPECT_EQ(list(some).find("\nSTRUT_HOUSE_TOP_LEFT\n"), std::string::npos);
  EXPECT_NE(list(some).find("\nROOF\n"), std::string::npos);
}

TEST(CarBuilder, DriveTellsOfWhatDeforms) {
  const auto drive = [](const char* fidelity) {
    return build_car(main_spec(), BALOCCO_CAR_SPEC, files, {.obstacle = "", .fidelity = fidelity}).drive;
  };
  const auto complete = drive("complete"), some = drive("semi-flexible"), rigid = drive("rigid");
  const auto tells = [](const std::string& deck, const char* words) { return deck.find(words) != std::string::npos; };
  for (const auto* rails : {"ELSET=SECTION_FRONT_RAIL_LEFT\nSF", "ELSET=SECTION_REAR_RAIL_RIGHT\nSF"}) {
    EXPECT_TRUE(tells(complete, rails));
    EXPECT_FALSE(tells(some, rails));
  }
  EXPECT_TRUE(tells(some, "*EL PRINT, ELSET=SUBFRAME,"));
  EXPECT_FALSE(tells(rigid, "*EL PRINT, ELSET=SUBFRAME,"));
  EXPECT_TRUE(tells(rigid, "*EL PRINT, ELSET=TYRE_FRONT_LEFT,"));
}

TEST(CarBuilder, APotholeLiesBelowTheLeftWheelsAloneAndTheObstacleBelowBothSides) {
  const auto extremes = [](const CarDeck& deck, std::size_t surface) {
    std::array<double, 2> found{};  // lowest, highest
    for (const auto& piece : deck.tyres.surfaces[surface].analytical->profile) {
      found[0] = std::min(found[0], piece.end[1]);
      found[1] = std::max(found[1], piece.end[1]);
    }
    return found;
  };
  const auto roads = [](const CarDeck& deck) {
    return std::pair(deck.tyres.contact_pairs[0].master, deck.tyres.contact_pairs[2].master);  // left, right
  };
  const auto comfort = built(main_spec()),
             hole = build_car(main_spec(), BALOCCO_CAR_SPEC, files, {.obstacle = "pothole", .fidelity = ""});
  const auto [left, right] = roads(comfort);
  EXPECT_EQ(extremes(comfort, left), (std::array<double, 2>{0.0, 25.0}));
  EXPECT_EQ(extremes(comfort, right), (std::array<double, 2>{0.0, 25.0}));
  EXPECT_EQ(extremes(hole, left), (std::array<double, 2>{-114.0, 0.0}));
  EXPECT_EQ(extremes(hole, right), (std::array<double, 2>{0.0, 0.0}));
  EXPECT_NE(hole.drive.find("ROAD_LEFT, 1, -11.11\n"), std::string::npos);
  EXPECT_NE(comfort.drive.find("ROAD_LEFT, 1, -13.9\n"), std::string::npos);
}

TEST(CarBuilder, ADropStartsWeightlessOnReboundStopsAndFallsAsOneAboveAFlatRoad) {
  const auto drop = build_car(main_spec(), BALOCCO_CAR_SPEC, files, {.obstacle = "drop", .fidelity = ""});
  for (const auto pair : {0, 2}) EXPECT_EQ(drop.tyres.surfaces[drop.tyres.contact_pairs[pair].master].analytical->profile.size(), 1u);
  const auto fall = drop.equilibrium.substr(drop.equilibrium.find("NAME=FALL"));
  EXPECT_EQ(drop.equilibrium.find("GRAV"), std::string::npos);
  EXPECT_NE(fall.find("BODY_REFERENCE, 1, 6\n"), std::string::npos);
  EXPECT_EQ(fall.find("*STEP"), std::string::npos);  // it is the last
  // The road lies 20 mm below the front wheels, which sink by 90 mm of rebound and some 15 of the stop along a leaning strut.
  const auto road = fall.find("ROAD_LEFT, 3, 3, ") + std::string("ROAD_LEFT, 3, 3, ").size();
  EXPECT_NEAR(std::stod(fall.substr(road)), 8.0 - 110.0 - 20.0, 3.0);
  EXPECT_NE(drop.drive.find("ALL_BUT_TYRES, 3, -3.06881"), std::string::npos);  // sqrt(2 * 9.81e-3 * 480)
  EXPECT_NE(drop.drive.find("TYRE_REAR_RIGHT, 3, -3.06881"), std::string::npos);
  EXPECT_EQ(drop.drive.find("ROTATING VELOCITY"), std::string::npos);
  EXPECT_NE(drop.drive.find("ROAD_LEFT, 1, 1, 0\n"), std::string::npos);
}

TEST(CarBuilder, ATyreLosesItsAirAsTheDriveBegins) {
  const auto drive = built(main_spec() + "[pressure]\nrear_left = 0.055\nloss_time = 40.0\n").drive;
  EXPECT_NE(drive.find("*AMPLITUDE, NAME=PRESSURE_REAR_LEFT\n0., 1., 40, 0.25\n"), std::string::npos);
  EXPECT_NE(drive.find("*DSLOAD, AMPLITUDE=PRESSURE_REAR_LEFT\nLINER_REAR_LEFT, P, 0.22\n"), std::string::npos);
  EXPECT_NE(drive.find("*DSLOAD\nLINER_REAR_RIGHT, P, 0.22\n"), std::string::npos);
}

TEST(CarBuilder, MayStandUpOnARoadWithoutFriction) {
  const auto slippery = build_car(main_spec() + "[equilibrium]\nfriction = 0.0\n", BALOCCO_CAR_SPEC, files, {.obstacle = "", .fidelity = "complete"});
  EXPECT_NE(slippery.equilibrium.find("*CHANGE FRICTION, INTERACTION=GRIP\n*FRICTION\n0\n"), std::string::npos);
  EXPECT_NE(slippery.equilibrium.find("*BOUNDARY, OP=NEW\nENGINE, 1, 1\nENGINE, 2, 2\nSPRING_SEAT_REAR_LEFT, 2, 2\nHUB_FRONT_LEFT, 5, 5\n"), std::string::npos);
  EXPECT_EQ(slippery.drive.find("*CHANGE FRICTION"), std::string::npos);
  EXPECT_EQ(built(main_spec()).equilibrium.find("*CHANGE FRICTION"), std::string::npos);
}

}  // namespace
}  // namespace balocco::car
