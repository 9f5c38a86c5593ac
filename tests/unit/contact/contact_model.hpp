// A plate of bricks over a rigid road: the model that the tests of contact share.
#pragma once

#include <numeric>

#include "domain.hpp"
#include "elements/element_type.hpp"
#include "model/model.hpp"

namespace balocco::test {

inline const ElementType& brick_type() {
  static const ElementType type{
      .name = "BRICK",
      .shape = Shape::hexahedron,
      .nodes = 8,
      .section = Section::Kind::solid,
      .faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  return type;
}

constexpr double young = 6.0, poisson = 0.3, friction = 0.5;
constexpr double dilatational_modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));  // K + 4/3 G
constexpr double width = 10.0, height = 5.0;                                                          // of a brick
constexpr Point reference{1.0, 2.0, -3.0};  // of the road's body

inline ProfileSegment line(std::array<double, 2> start, std::array<double, 2> end) {
  return {ProfileSegment::Kind::line, start, end, {}, false};
}

/// Profile in global x (first) and z (second); outward is +z.
inline AnalyticalSurface road(std::vector<ProfileSegment> profile) {
  AnalyticalSurface surface;
  surface.axes = {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
  surface.profile = std::move(profile);
  return surface;
}

/// Flat, then a hill of radius 40 about (0, -30), whose top is at z = 10, with a sharp foot.
inline AnalyticalSurface hilly_road() {
  const double foot = 26.457513110645905907;  // sqrt(40^2 - 30^2)
  return road({line({-300, 0}, {-foot, 0}),
               {ProfileSegment::Kind::arc, {-foot, 0}, {foot, 0}, {0, -30}, false},
               line({foot, 0}, {300, 0})});
}

inline void add_node(Model& model, const Point& at) {
  model.nodes.id.push_back(model.nodes.size() + 1);
  model.nodes.coordinates.push_back(at);
}

/// n x n bricks whose lower faces, at z = 0, are the slave surface; the last node is the road's reference node.
inline Model plate_on_road(int n, const AnalyticalSurface& surface = road({line({-300, 0}, {300, 0})})) {
  Model model;
  model.files = {"job.inp"};
  for (int layer = 0; layer < 2; ++layer)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) add_node(model, {width * i, width * j, height * layer});
  add_node(model, reference);
  ElementTable bricks;
  bricks.type = &brick_type();
  Surface slave{.kind = Surface::Kind::element_faces,
                .name = "TREAD",
                .faces = {},
                .nodes = {},
                .analytical = {},
                .location = {}};
  const int row = n + 1, layer = row * row;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int first = j * row + i;
      slave.faces.push_back({{0, bricks.size()}, 0});
      for (const int base : {first, first + layer})
        for (const int node : {base, base + 1, base + row + 1, base + row}) bricks.connectivity.push_back(node);
      bricks.id.push_back(bricks.size() + 1);
      bricks.section.push_back(0);
    }
  model.elements.push_back(bricks);
  model.materials.push_back({.name = "RUBBER", .law = "elastic", .parameters = {young, poisson}, .location = {}});
  model.sections.resize(1);
  model.sections[0].material = 0;
  Surface master{.kind = Surface::Kind::analytical,
                 .name = "ROAD",
                 .faces = {},
                 .nodes = {},
                 .analytical = surface,
                 .location = {}};
  model.surfaces = {slave, master};
  RigidBody body;
  body.reference_node = model.nodes.size() - 1;
  body.analytical_surface = 1;
  model.rigid_bodies.push_back(body);
  model.interactions.push_back({.name = "RR", .friction = friction, .elastic_slip = {}, .location = {}});
  model.contact_pairs.push_back({.slave = 0, .master = 1, .interaction = 0, .first_step = 0, .location = {0, 77}});
  return model;
}

/// All of the model on one rank.
inline Domain whole(const Model& model) {
  Domain domain;
  domain.node_row.resize(model.nodes.size());
  std::iota(domain.node_row.begin(), domain.node_row.end(), 0);
  domain.local_node = domain.node_row;
  domain.owned.assign(model.nodes.size(), true);
  return domain;
}

/// 4 a node, with a scratch node behind the last.
inline std::vector<double> positions(const Model& model, const Domain& domain) {
  std::vector<double> position;
  for (const auto row : domain.node_row) {
    for (const double x : model.nodes.coordinates[row]) position.push_back(x);
    position.push_back(0.0);
  }
  position.resize(position.size() + 4);
  return position;
}

}  // namespace balocco::test
