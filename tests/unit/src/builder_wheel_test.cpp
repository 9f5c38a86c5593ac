// A wheel of shells: set upright from wherever its mesh lies, scaled to the tyre's rim, held by hub and beads, its mass counted
// once.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "builders/car/car_builder.hpp"
#include "builders/car/wheel_mesh.hpp"
#include "builders/tyre_mesh.hpp"
#include "model/diagnostics.hpp"
#include "text_of_file.hpp"

namespace balocco::car {
namespace {

constexpr int sectors = 24;

/// A ring of nodes about the y axis, all of it tilted and moved. @return its first row.
std::int32_t add_ring(double radius, double axial, Model& model) {
  const double tilt = 0.17, c = std::cos(tilt), s = std::sin(tilt);
  const auto first = model.nodes.size();
  for (int i = 0; i < sectors; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sectors, x = radius * std::cos(angle), z = radius * std::sin(angle);
    add_node(model, {x + 5.0, c * axial - s * z - 600.0, s * axial + c * z + 20.0});
  }
  return first;
}

void join(std::int32_t inner, std::int32_t outer, std::int32_t section, Model& model) {
  for (int i = 0; i < sectors; ++i) {
    const int next = (i + 1) % sectors;
    add_element(model, 0, {inner + i, inner + next, outer + next, outer + i}, section);
  }
}

/// Rim with flanges of 177 mm radius and 150 mm apart, a disc whose hub face lies 43 mm towards -y, a node that nothing uses.
Model mesh_of_wheel() {
  Model model;
  add_element_table(model, "S4R");
  model.sections.push_back({.kind = Section::Kind::shell, .element_set = "RIM", .thickness = 2.5});
  model.sections.push_back({.kind = Section::Kind::shell, .element_set = "DISC", .thickness = 3.5});
  add_node(model, {0.0, 0.0, 0.0});
  constexpr std::array<std::array<double, 2>, 9> profile{
      {{177, -75}, {166, -63}, {165, -40}, {150, -20}, {150, 0}, {150, 20}, {165, 40}, {166, 63}, {177, 75}}};
  std::vector<std::int32_t> rings;
  for (const auto& [radius, axial] : profile) {
    rings.push_back(add_ring(radius, axial, model));
    if (rings.size() > 1) join(rings[rings.size() - 2], rings.back(), 0, model);
  }
  auto outer = rings[3];
  for (const auto& [radius, axial] : std::array<std::array<double, 2>, 3>{{{100, -40}, {60, -43}, {30, -43}}}) {
    const auto inner = add_ring(radius, axial, model);
    join(inner, outer, 1, model);
    outer = inner;
  }
  return model;
}

const WheelSpec wheel_spec{.mesh = "wheel.bdf",
                           .seat_diameter = 330.2,
                           .width = 127.0,
                           .seat_width = 20.0,
                           .mounting_diameter = 140.0,
                           .material = "mild",
                           .where = "car.toml:7"};
const RimSpec rim{.diameter = 354.8, .width = 139.7};

TEST(CarWheel, IsSetUprightAndScaledToTheRim) {
  const auto wheel = make_wheel(wheel_spec, rim, mesh_of_wheel());
  ASSERT_EQ(wheel.nodes.size(), 12u * sectors);
  const double radial = 354.8 / 330.2, axial = 139.7 / 127.0;
  int on_flanges = 0;
  for (const auto& node : wheel.nodes) {
    if (std::hypot(node[0], node[2]) < 176.0 * radial) continue;
    ++on_flanges;
    EXPECT_NEAR(std::hypot(node[0], node[2]), 177.0 * radial, 1e-9);
    EXPECT_NEAR(std::abs(node[1]), 75.0 * axial, 1e-9);
  }
  EXPECT_EQ(on_flanges, 2 * sectors);
  ASSERT_EQ(wheel.mounting.size(), 2u * sectors);                                               // the disc's two inner rings
  for (const int node : wheel.mounting) EXPECT_NEAR(wheel.nodes[node][1], 43.0 * axial, 1e-9);  // outside
  EXPECT_EQ(wheel.seats.size(), 4u * sectors);                                                  // two rings a side
  ASSERT_EQ(wheel.gauges.size(), 2u);
  EXPECT_EQ(wheel.gauges[1].thickness, 3.5);
  EXPECT_EQ(wheel.gauges[1].shells.size(), 3u * sectors);
}

TEST(CarWheel, FreeEdgesAreTheFlangesAndTheBore) {
  const auto edges = free_edges(make_wheel(wheel_spec, {.diameter = 330.2, .width = 127.0}, mesh_of_wheel()));
  ASSERT_EQ(edges.size(), 3u);
  EXPECT_NEAR(edges[0].radius, 177.0, 1e-9);
  EXPECT_NEAR(edges[2].radius, 30.0, 1e-9);
  EXPECT_NEAR(edges[2].middle[1], 43.0, 1e-9);
}

TEST(CarWheel, RefusesWhatIsNoSuchWheel) {
  const auto said = [](const auto& change_spec, const auto& change_mesh) {
    auto spec = wheel_spec;
    auto mesh = mesh_of_wheel();
    change_spec(spec);
    change_mesh(mesh);
    try {
      make_wheel(spec, rim, mesh);
    } catch (const InputError& error) {
      return error.messages().front();
    }
    return std::string("accepted");
  };
  const auto same_spec = [](WheelSpec&) {};
  const auto same_mesh = [](Model&) {};
  EXPECT_EQ(said([](WheelSpec& spec) { spec.seat_diameter = 355.0; }, same_mesh),
            "car.toml:7: error: [wheel] seat_diameter: the mesh's flanges end at a diameter of 354.0 mm, which is no rim of 355 "
            "mm; give the "
            "diameter of its bead seats");
  EXPECT_NE(
      said([](WheelSpec& spec) { spec.width = 100.0; }, same_mesh).find("[wheel] width: the mesh's flanges end 150.0 mm apart"),
      std::string::npos);
  EXPECT_NE(said([](WheelSpec& spec) { spec.mounting_diameter = 50.0; }, same_mesh).find("[wheel] mounting_diameter: 0 nodes"),
            std::string::npos);
  EXPECT_NE(said([](WheelSpec& spec) { spec.seat_width = 0.1; }, same_mesh).find("accepted"), std::string::npos);  // flanges alone
  EXPECT_NE(said(same_spec, [](Model& mesh) { mesh.sections[0].shell.offset = 0.5; }).find("[wheel] mesh: RIM are no plain shells"),
            std::string::npos);
  EXPECT_NE(said(same_spec,
                 [](Model& mesh) {
                   for (int i = 1; i <= sectors; ++i) mesh.nodes.coordinates[i][0] *= 0.5;
                 })
                .find("no pair of flanges"),
            std::string::npos);
}

CarDeck car_with_wheels(const std::string& change = "") {
  const CarFiles files{
      test::text_of_file, [](const std::string& path) { return path.ends_with("wheel.bdf") ? std::optional(mesh_of_wheel()) : std::nullopt; }};
  auto text = *test::text_of_file(BALOCCO_CAR_SPEC) +
              "[wheel]\nmesh = \"wheel.bdf\"\nseat_diameter = 330.2\nwidth = 127.0\nseat_width = 20.0\nmounting_diameter = 140.0\n"
              "material = \"mild\"\n";
  const std::string from = "mass = 13000.0";
  if (!change.empty()) text.replace(text.find(from), from.size(), change);
  return build_car(text, BALOCCO_CAR_SPEC, files);
}

/// The number behind the first occurrence of `words` behind the line that says `keyword`.
double number_after(const std::string& deck, const std::string& keyword) {
  const auto at = deck.find(keyword);
  EXPECT_NE(at, std::string::npos) << keyword;
  return std::stod(deck.substr(deck.find('\n', at) + 1));
}

TEST(CarWheel, TakesTheRimsPlaceInTheDeck) {
  const auto car = car_with_wheels();
  EXPECT_NE(car.car.find("TIE NSET=P_SEATS_FRONT_LEFT, ANALYTICAL SURFACE=RIM_FRONT_LEFT"), std::string::npos);
  EXPECT_NE(car.car.find("TIE NSET=P_HUB_FRONT_LEFT\n"), std::string::npos);
  EXPECT_NE(car.equilibrium.find("*RIGID BODY, REF NODE=SEATS_REAR_RIGHT, TIE NSET=BEAD_LEFT_REAR_RIGHT"), std::string::npos);
  EXPECT_NE(car.drive.find("TYRE_REAR_LEFT, HUB_REAR_LEFT\nRIM_AND_DISC_REAR_LEFT, SEATS_REAR_LEFT\n"), std::string::npos);
  EXPECT_NE(car.drive.find("*FIXED MASS SCALING, ELSET=RIM_AND_DISC_REAR_LEFT, FACTOR=1."), std::string::npos);
  EXPECT_EQ(car.kinematics.find("RIM_AND_DISC"), std::string::npos);  // axles alone
  EXPECT_EQ(number_after(car.kinematics, "*MASS, ELSET=M_HUB_FRONT_LEFT"), 13000.0);
}

TEST(CarWheel, ItsMassIsCountedOnce) {
  const auto car = car_with_wheels();
  const auto wheel = make_wheel(wheel_spec, {.diameter = 354.8, .width = 127.0}, mesh_of_wheel());
  double mass = 0.0, spin = 0.0;
  for (const auto& gauge : wheel.gauges)
    for (const auto& shell : gauge.shells) {
      const auto corner = corners_of(wheel, shell);
      const auto diagonals = cross(corner[2] - corner[0], corner[3] - corner[1]);
      const auto middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
      const double own = 0.5 * length(diagonals) * gauge.thickness * 7.85e-3;
      mass += own;
      spin += own * (middle[0] * middle[0] + middle[2] * middle[2]);
    }
  EXPECT_NEAR(number_after(car.car, "*MASS, ELSET=M_HUB_FRONT_LEFT"), 13000.0 - mass, 0.1);  // printed with six digits
  EXPECT_NEAR(number_after(car.car, "*MASS, ELSET=M_HUB_REAR_LEFT"), 14000.0 - mass, 0.1);
  const auto at = car.car.find("*ROTARY INERTIA, ELSET=I_HUB_FRONT_LEFT\n");
  const auto row = car.car.substr(car.car.find('\n', at) + 1);
  const double described = 13000.0 * (360.0 * 360.0 + 360.0 * 360.0) / 12.0;
  EXPECT_NEAR(std::stod(row.substr(row.find(',') + 1)), described - spin, 1e-5 * described);
  EXPECT_NE(car.report.find("each wheel"), std::string::npos);
}

TEST(CarWheel, AHubNoHeavierThanItsWheelIsRefused) {
  try {
    car_with_wheels("mass = 3000.0");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(error.messages()[0].find("error: [wheel] mesh: the wheel weighs "), std::string::npos) << error.messages()[0];
    EXPECT_NE(error.messages()[0].find("raise mass or size in [front.hub]"), std::string::npos) << error.messages()[0];
  }
}

}  // namespace
}  // namespace balocco::car
