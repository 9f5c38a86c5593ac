// The built tyre: a closed mesh of right handedness and mass, with the sets, surfaces and steps that the job needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "builder_sample.hpp"
#include "builders/meridian_line.hpp"
#include "builders/rim_profile.hpp"
#include "builders/road_profile.hpp"
#include "builders/section_picture.hpp"
#include "builders/tyre_builder.hpp"
#include "builders/tyre_report.hpp"
#include "builders/tyre_steps.hpp"
#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

struct Built {
  TyreSpec spec;
  TyreSection section;
  Model model;
  TyreMesh mesh;
};

Built build(int model_number) {
  Built built;
  built.spec = read_tyre_spec(sample_tyre(model_number), "t.toml", no_file);
  built.section = make_section(built.spec);
  built.mesh = add_tyre(built.spec, built.section, built.model);
  return built;
}

Model whole(int model_number) {
  std::string report;
  return build_tyre(sample_tyre(model_number), "t.toml", no_file, report);
}

const std::vector<ElementRef>& elements_of(const Model& model, const std::string& name) {
  for (const auto& set : model.element_sets)
    if (set.name == name) return set.elements;
  throw std::runtime_error("no element set " + name);
}

const std::vector<std::int32_t>& nodes_of(const Model& model, const std::string& name) {
  for (const auto& set : model.node_sets)
    if (set.name == name) return set.nodes;
  throw std::runtime_error("no node set " + name);
}

std::vector<Point> corners(const Model& model, const ElementTable& elements, std::int32_t row) {
  std::vector<Point> points;
  for (int i = 0; i < elements.type->nodes; ++i)
    points.push_back(model.nodes.coordinates[elements.connectivity[row * elements.type->nodes + i]]);
  return points;
}

/// Elements of the half line; the sample's caps have two layers.
constexpr int belt = 4, shoulder = 2, sidewall = 6, bead = 4, line = 2 * (belt + shoulder + sidewall + bead);

TEST(MeridianLine, FollowsACircle) {
  TyreSpec spec;
  const double radius = 100.0;
  spec.crown_radius = 200.0 + radius;
  const auto at = [&](double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return SectionPoint{200.0 + radius * std::cos(angle), radius * std::sin(angle), 5.0, 0.0};
  };
  for (int r = 0; r < region_count; ++r) spec.regions[r].points = {at(20.0 * r + 10.0), at(20.0 * r + 20.0)};
  const MeridianLine circle(spec);
  // A natural spline errs at its free ends; 10 degrees a span leave 1e-3 of the radius there and far less elsewhere.
  EXPECT_NEAR(circle.region_end(Region::sidewall), radius * std::numbers::pi / 3.0, 1e-3 * radius);
  const auto point = circle.at(circle.region_end(Region::belt) * 0.75);
  EXPECT_NEAR(std::hypot(point.radius - 200.0, point.axial), radius, 1e-4 * radius);
  EXPECT_NEAR(point.normal[0] * (point.radius - 200.0) + point.normal[1] * point.axial, radius, 1e-3 * radius);
  EXPECT_NEAR(circle.at(0.0).normal[0], 1.0, 1e-12);
  EXPECT_NEAR(point.base, 5.0, 1e-12);
}

TEST(TyreSection, IsSymmetricAndTouchesTheRim) {
  const auto built = build(3);
  const auto& line_nodes = built.section.layers[0];
  ASSERT_EQ(built.section.line_size(), line + 1);
  for (int j = 0; j <= line; ++j) {
    EXPECT_DOUBLE_EQ(built.section.nodes[line_nodes[j]][1], -built.section.nodes[line_nodes[line - j]][1]);
    EXPECT_DOUBLE_EQ(built.section.nodes[line_nodes[j]][0], built.section.nodes[line_nodes[line - j]][0]);
  }
  // Toe, heel, and the outer nodes below the flange's top at 177.4 + 15.5 mm.
  for (const int node : built.section.bead_left) {
    EXPECT_GT(built.section.nodes[node][1], 0.0);
    EXPECT_LE(built.section.nodes[node][0], 177.4 + 15.5);
  }
  EXPECT_EQ(built.section.bead_left.size(), built.section.bead_right.size());
  EXPECT_GE(built.section.bead_left.size(), 3u);
  EXPECT_NEAR(built.section.seat_shift, 56.5 + 11.0 - 63.5, 0.05);  // the line ends almost radially
}

TEST(TyreMesh, MembranesCloseAroundTheTyreWithNormalsOutwards) {
  const auto built = build(3);
  const auto& membranes = built.model.elements[built.mesh.membranes];
  const auto line_membranes =
      static_cast<std::int32_t>(elements_of(built.model, "CARCASS").size());  // before the turn-up
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (std::int32_t row = 0; row < line_membranes; ++row) {
    const auto* nodes = &membranes.connectivity[4 * row];
    for (int i = 0; i < 4; ++i) ++edges[std::minmax(nodes[i], nodes[(i + 1) % 4])];
    const auto points = corners(built.model, membranes, row);
    // Outwards: away from the middle circle of the cavity.
    Point centre{}, normal{}, first{}, second{};
    for (int axis = 0; axis < 3; ++axis) {
      for (const auto& point : points) centre[axis] += 0.25 * point[axis];
      first[axis] = points[2][axis] - points[0][axis];
      second[axis] = points[3][axis] - points[1][axis];
    }
    for (int axis = 0; axis < 3; ++axis)
      normal[axis] = first[(axis + 1) % 3] * second[(axis + 2) % 3] - first[(axis + 2) % 3] * second[(axis + 1) % 3];
    const double radius = std::hypot(centre[0], centre[2]);
    const double shrink = 230.0 / radius;
    EXPECT_GT(normal[0] * centre[0] * (1.0 - shrink) + normal[1] * centre[1] + normal[2] * centre[2] * (1.0 - shrink),
              0.0);
  }
  int open = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_LE(count, 2);
    if (count == 1) ++open;
  }
  EXPECT_EQ(open, 2 * built.mesh.sectors());  // the toes only
}

TEST(TyreMesh, SolidsArePositiveAndTheirFacesMatch) {
  for (const int number : {1, 2, 3}) {
    const auto built = build(number);
    const auto& solids = built.model.elements[built.mesh.solids];
    std::map<std::set<std::int32_t>, int> faces;
    for (std::int32_t row = 0; row < solids.size(); ++row) {
      EXPECT_GT(hexahedron_volume(corners(built.model, solids, row)), 0.0);
      for (const auto& face : solids.type->faces) {
        std::set<std::int32_t> nodes;
        for (const int local : face) nodes.insert(solids.connectivity[8 * row + local]);
        ++faces[nodes];
      }
    }
    for (const auto& [face, count] : faces) EXPECT_LE(count, 2);
  }
}

TEST(TyreMesh, TreadSurfaceIsTheOutside) {
  const auto built = build(3);
  const auto& tread = built.model.surfaces[built.mesh.tread_surface];
  EXPECT_EQ(tread.faces.size(), static_cast<std::size_t>(2 * (belt + shoulder) * built.mesh.sectors()));
  for (const auto& face : tread.faces) {
    const auto points = corners(built.model, built.model.elements[face.element.table], face.element.row);
    const auto radius_of = [&](int first) {
      double sum = 0.0;
      for (int i = first; i < first + 4; ++i) sum += std::hypot(points[i][0], points[i][2]);
      return sum;
    };
    EXPECT_EQ(face.face, 1);
    EXPECT_GT(radius_of(4), radius_of(0));
  }
  EXPECT_EQ(built.model.surfaces[built.mesh.liner_surface].faces.size(),
            static_cast<std::size_t>(line * built.mesh.sectors()));
}

// Chords of 6 degrees enclose sin(6)/6 = 0.998 of the body of revolution: 1 % holds any error of the mesh worth the
// name.
TEST(TyreMesh, MassIsThatOfTheBodyOfRevolution) {
  for (const int number : {1, 2, 3}) {
    const auto built = build(number);
    double meshed = 0.0;
    for (const auto& part : tyre_masses(built.spec, built.mesh, built.model)) meshed += part.mass;
    double revolved = 0.0;
    const auto body_density = [&](Region region) {  // 1 mm; cords fill 0.2 of it at the crown
      const double fraction = 0.2 * 276.0 / mean_radius(built.section, region);
      return fraction * 1.38e-3 + (1.0 - fraction) * 1.1e-3;
    };
    for (const auto& quad : built.section.quads) revolved += 1.1e-3 * revolved_volume(built.section, quad);
    for (int j = 0; j < line; ++j) {
      double areal = 0.0;
      const auto region = built.section.line_regions[j];
      if (region == Region::belt) areal += 0.2 * 7.85e-3 + 0.8 * 1.1e-3;  // cords fill 0.22 / 1.1 of 1 mm
      areal += body_density(region) + 1.2 * 1.1e-3;
      if (region == Region::sidewall && number == 1) areal += built.section.sidewall_rubber * 1.1e-3;
      revolved += areal * revolved_area(built.section, j);
    }
    for (const auto& quad : built.section.quads) {
      if (quad.part != SolidPart::apex) continue;
      TyreSection outside;
      outside.nodes = {built.section.nodes[quad.nodes[3]], built.section.nodes[quad.nodes[2]]};
      outside.layers = {{0, 1}};
      revolved += body_density(Region::bead) * revolved_area(outside, 0);
    }
    ASSERT_EQ(built.section.wire_nodes.size(), 4u);  // one height, both sides of both apexes
    for (const int node : built.section.wire_nodes)
      revolved += 17.5 * 7.85e-3 * 2.0 * std::numbers::pi * built.section.nodes[node][0];
    EXPECT_NEAR(meshed / revolved, 1.0, 0.01) << "model " << number;
  }
}

TEST(TyreMesh, ModelOneCarriesTheSidewallsMassInItsMembranes) {
  const auto mass = [](const Built& built) {
    double sum = 0.0;
    for (const auto& part : tyre_masses(built.spec, built.mesh, built.model)) sum += part.mass;
    return sum;
  };
  const double first = mass(build(1)), second = mass(build(2));
  EXPECT_NEAR(first / second, 1.0, 5e-3);  // chords shorten the outside more than the line
}

TEST(TyreMesh, ModelsDifferAsTheyShould) {
  const auto first = whole(1), second = whole(2), third = whole(3);
  EXPECT_THROW(elements_of(first, "SIDEWALL_SOLID"), std::runtime_error);
  EXPECT_EQ(elements_of(second, "SIDEWALL_SOLID").size(), 2u * sidewall * 60);
  // 36 sectors in the arc and 270 / 360 of 60 outside it.
  EXPECT_EQ(elements_of(third, "SIDEWALL_SOLID").size(), 2u * sidewall * (36 + 45));
  EXPECT_EQ(elements_of(first, "BELT").size(), 2u * belt * 60);
  EXPECT_EQ(elements_of(first, "TREAD_SOLID").size(), 2u * (belt + shoulder) * 3 * 60);
  EXPECT_EQ(elements_of(first, "BEAD_SOLID").size(), 2u * bead * 2 * 60);
  EXPECT_EQ(elements_of(first, "BEAD_WIRE").size(), 4u * 60);
  EXPECT_EQ(elements_of(first, "CARCASS").size(), static_cast<std::size_t>(line) * 60);
  EXPECT_EQ(elements_of(first, "TURN_UP").size(), 2u * bead * 60);
}

TEST(TyreMesh, RefinedArcLiesWhereItWasAsked) {
  const auto spec = read_tyre_spec(sample_tyre(3), "t.toml", no_file);
  const auto angles = sector_angles(spec);
  const double degree = std::numbers::pi / 180.0;
  ASSERT_EQ(angles.size(), 81u);
  EXPECT_NEAR(angles[0], (20.0 - 45.0) * degree, 1e-12);
  EXPECT_NEAR(angles[36], (20.0 + 45.0) * degree, 1e-12);
  EXPECT_NEAR(angles[1] - angles[0], 2.5 * degree, 1e-12);
  EXPECT_NEAR(angles[0] + 360.0 * degree - angles.back(), 6.0 * degree, 1e-12);
}

TEST(TyreModel, IsComplete) {
  const auto model = whole(3);
  ASSERT_EQ(model.nodes.location.size(), model.nodes.id.size());
  std::set<std::int64_t> ids;
  for (const auto& elements : model.elements) {
    EXPECT_EQ(elements.connectivity.size(), elements.id.size() * static_cast<std::size_t>(elements.type->nodes));
    EXPECT_EQ(elements.section.size(), elements.id.size());
    for (const auto id : elements.id) EXPECT_TRUE(ids.insert(id).second);
    for (std::int32_t row = 0; row < elements.size(); ++row) {
      const auto& section = model.sections.at(elements.section[row]);
      EXPECT_EQ(section.kind, elements.type->section);
    }
  }
  for (std::int32_t row = 0; row < model.nodes.size(); ++row)
    EXPECT_EQ(model.nodes.row_of_id.at(model.nodes.id[row]), row);
  for (const auto& set : model.node_sets) EXPECT_TRUE(std::is_sorted(set.nodes.begin(), set.nodes.end())) << set.name;
  for (const auto& set : model.element_sets)
    EXPECT_TRUE(std::is_sorted(set.elements.begin(), set.elements.end())) << set.name;
  for (const auto& section : model.sections)
    EXPECT_FALSE(elements_of(model, section.element_set).empty()) << section.element_set;
}

TEST(TyreModel, StepsSeatInflateTouchLoadAndRoll) {
  const auto model = whole(3);
  ASSERT_EQ(model.steps.size(), 6u);
  const auto left = nodes_of(model, "BEAD_LEFT");
  double moved = 0.0;
  for (const auto& condition : model.steps[0].boundary)
    if (condition.node == left[0] && condition.dof == 1) moved = condition.magnitude;
  EXPECT_NEAR(moved, -4.0, 0.05);
  EXPECT_TRUE(model.steps[1].active_contact_pairs.empty());
  ASSERT_EQ(model.steps[1].attachments.size(), 1u);
  EXPECT_EQ(model.steps[1].attachments[0].nodes.size(), left.size() + nodes_of(model, "BEAD_RIGHT").size());
  EXPECT_DOUBLE_EQ(model.steps[1].surface_loads[0].previous, 0.02);
  EXPECT_DOUBLE_EQ(model.steps[3].concentrated_loads[0].magnitude, 3061.0);
  EXPECT_TRUE(model.steps[2].concentrated_loads.empty());
  // Rolling: the hub spins freely, the road travels backwards at its height, the wheel turns forwards.
  const auto hub = nodes_of(model, "HUB")[0], road = nodes_of(model, "ROAD")[0];
  for (const auto& condition : model.steps[5].boundary) {
    EXPECT_FALSE(condition.node == hub && condition.dof == 4);
    if (condition.node != road) continue;
    EXPECT_EQ(condition.fixed, condition.dof == 2);
    EXPECT_DOUBLE_EQ(condition.magnitude, condition.dof == 0 ? -11.11 : 0.0);
  }
  ASSERT_EQ(model.initial_velocities.size(), 2u);
  const double radius = 276.0 + 2.5 + 5.5 - 3061.0 / 185.0 / 3.0;
  EXPECT_NEAR(model.initial_velocities[0].angular_speed, 11.11 / radius, 1e-4);
}

TEST(TyreModel, StaticsAloneHaveFourSteps) {
  std::string report;
  const auto model = build_tyre(sample_with("[rolling]", "[rolling]\nenabled = false"), "t.toml", no_file, report);
  EXPECT_EQ(model.steps.size(), 4u);
  EXPECT_TRUE(model.initial_velocities.empty());
  EXPECT_NE(report.find("kg"), std::string::npos);
}

TEST(RoadProfile, IsConnectedAndStandsAtItsHeight) {
  const auto spec = read_tyre_spec(sample_tyre(), "t.toml", no_file);
  const auto profile = road_profile(spec.road);
  ASSERT_EQ(profile.size(), 9u);
  double highest = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    EXPECT_EQ(profile[i].start, i > 0 ? profile[i - 1].end : (std::array<double, 2>{-500.0, 0.0}));
    highest = std::max(highest, profile[i].end[1]);
    if (profile[i].kind != ProfileSegment::Kind::arc) continue;
    const auto distance = [&](const std::array<double, 2>& point) {
      return std::hypot(point[0] - profile[i].centre[0], point[1] - profile[i].centre[1]);
    };
    EXPECT_NEAR(distance(profile[i].start), distance(profile[i].end), 1e-12);
  }
  EXPECT_DOUBLE_EQ(highest, 25.0);
  EXPECT_DOUBLE_EQ(profile.back().end[0], 1000.0);
  EXPECT_TRUE(profile[1].counter_clockwise);
  EXPECT_FALSE(profile[3].counter_clockwise);
}

TEST(RoadProfile, APotholeHasRampsAndRoundEdges) {
  RoadSpec road{.behind = 500.0, .ahead = 4000.0};
  road.pothole = {.depth = 114.0, .length = 2700.0, .start = 300.0, .ramp = 200.0, .fillet = 30.0};
  const auto profile = road_profile(road);
  ASSERT_EQ(profile.size(), 9u);
  double deepest = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    EXPECT_EQ(profile[i].start, profile[i - 1].end);
    deepest = std::min(deepest, profile[i].end[1]);
    if (profile[i].kind != ProfileSegment::Kind::arc) continue;
    const auto before = profile[i - 1], arc = profile[i];  // lines run into arcs without a kink
    const double along = before.end[0] - before.start[0], up = before.end[1] - before.start[1];
    EXPECT_NEAR(std::hypot(arc.end[0] - arc.centre[0], arc.end[1] - arc.centre[1]), 30.0, 1e-9);
    EXPECT_NEAR((arc.start[0] - arc.centre[0]) * along + (arc.start[1] - arc.centre[1]) * up, 0.0, 1e-9 * std::hypot(along, up));
  }
  EXPECT_DOUBLE_EQ(deepest, -114.0);
  const auto& ramp = profile[2];
  EXPECT_NEAR((ramp.end[1] - ramp.start[1]) / (ramp.end[0] - ramp.start[0]), -114.0 / 200.0, 1e-12);
  EXPECT_FALSE(profile[1].counter_clockwise);
  EXPECT_TRUE(profile[3].counter_clockwise);
}

TEST(SectionPicture, DrawsEveryQuad) {
  const auto spec = read_tyre_spec(sample_tyre(2), "t.toml", no_file);
  const auto section = make_section(spec);
  const auto svg = section_svg(spec, section);
  std::size_t polygons = 0;
  for (auto at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1)) ++polygons;
  EXPECT_EQ(polygons, section.quads.size());
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(TyreRim, IsStruckWhereTheSpecSaysWhatLiesBetween) {
  EXPECT_EQ(whole(2).contact_pairs.size(), 1u);
  auto text = sample_tyre(2);
  text.replace(text.find("flange_height = 15.5"), 20, "flange_height = 15.5\npad = 9.0");
  std::string report;
  const auto model = build_tyre(text, "t.toml", no_file, report);
  ASSERT_EQ(model.contact_pairs.size(), 2u);
  EXPECT_EQ(model.steps.back().active_contact_pairs, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(model.steps.front().active_contact_pairs.size(), 0u);
  const auto& profile = model.surfaces[model.contact_pairs[1].master].analytical->profile;
  double highest = 0.0, widest = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (i > 0) EXPECT_EQ(profile[i].start, profile[i - 1].end);
    highest = std::max(highest, profile[i].end[0]);
  }
  EXPECT_NEAR(highest, 177.4 + 15.5 + 9.0, 1e-9);  // the flange's edge with its rubber
  const auto& faces = model.surfaces[model.contact_pairs[1].slave].faces;
  ASSERT_FALSE(faces.empty());
  for (const auto& face : faces)
    for (const auto& corner : corners(model, model.elements[face.element.table], face.element.row)) {
      EXPECT_GT(std::hypot(corner[0], corner[2]), highest + 5.0);  // nothing touches in the mould
      widest = std::max(widest, std::abs(corner[1]));
    }
  EXPECT_GT(widest, 70.0);  // sidewalls too
}

}  // namespace
}  // namespace balocco
