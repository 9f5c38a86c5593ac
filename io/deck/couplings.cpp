// *COUPLING with *KINEMATIC or *DISTRIBUTING, and their older spellings *KINEMATIC COUPLING and *DISTRIBUTING COUPLING.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "constraints/nodal_directions.hpp"
#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/orientations.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/surface_nodes.hpp"

namespace balocco::deck {

namespace {

/// Nodes of a surface with the share of its area that belongs to each; of a surface of nodes all shares are 1.
std::map<std::int32_t, double> nodes_with_areas(const Model& model, const Surface& surface) {
  std::map<std::int32_t, double> share;
  for (const auto node : surface.nodes) share[node] = 1.0;
  for (const auto& face : surface.faces) {
    const auto nodes = face_nodes(model, face);
    const auto at = [&](std::size_t i) { return model.nodes.coordinates[nodes[i]]; };
    const std::size_t corners = nodes.size() > 4 ? nodes.size() / 2 : nodes.size();  // they come first
    Point area{};  // twice the vector area
    for (std::size_t i = 1; i + 1 < corners; ++i) {
      const auto piece = cross(subtract(at(i), at(0)), subtract(at(i + 1), at(0)));
      for (int c = 0; c < 3; ++c) area[c] += piece[c];
    }
    for (const auto node : nodes) share[node] += 0.5 * norm(area) / static_cast<double>(nodes.size());
  }
  return share;
}

struct Cloud {
  std::int32_t reference = -1;
  std::vector<std::int32_t> nodes;
  std::vector<double> weights;
  const Orientation* orientation = nullptr;  // null: global axes

  /// Axes there: those of a cylindrical system differ from place to place.
  std::array<Point, 3> axes_at(const Point& place) const {
    std::array<Point, 3> result{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (!orientation) return result;
    const auto axes = local_axes(*orientation, place);
    for (int i = 0; i < 3; ++i) result[i] = {axes(i, 0), axes(i, 1), axes(i, 2)};
    return result;
  }
};

std::optional<std::int32_t> one_node(Builder& builder, const Block& block, const char* parameter) {
  std::vector<std::int32_t> rows;
  if (!builder.nodes_of(block.value(parameter), block, block.location, rows)) return std::nullopt;
  if (rows.size() == 1) return rows[0];
  builder.error(block, block.location, fmt::format("{}={} stands for {} nodes; give one", parameter, block.value(parameter), rows.size()));
  return std::nullopt;
}

bool find_orientation(Builder& builder, const Block& block, Cloud& cloud) {
  if (!block.has("ORIENTATION")) return true;
  const auto row = require_directions(builder, block.value("ORIENTATION"), block, block.location);
  if (row) cloud.orientation = &builder.model.orientations[*row];
  return row.has_value();
}

/// The nodes that *COUPLING couples to its reference node.
std::optional<Cloud> read_cloud(Builder& builder, const Block& block) {
  Cloud cloud;
  const auto reference = one_node(builder, block, "REF NODE");
  const auto surface = builder.require(builder.surfaces, block.value("SURFACE"), block, block.location);
  if (!reference || !surface) return std::nullopt;
  cloud.reference = *reference;
  if (!find_orientation(builder, block, cloud)) return std::nullopt;
  const double radius = block.real("INFLUENCE RADIUS", HUGE_VAL);
  double nearest = HUGE_VAL;
  for (const auto& [node, share] : nodes_with_areas(builder.model, builder.model.surfaces[*surface])) {
    if (node == cloud.reference) continue;
    const double distance = norm(subtract(builder.model.nodes.coordinates[node], builder.model.nodes.coordinates[cloud.reference]));
    nearest = std::min(nearest, distance);
    if (distance > radius) continue;
    cloud.nodes.push_back(node);
    cloud.weights.push_back(share);
  }
  if (!cloud.nodes.empty()) return cloud;
  builder.error(block, block.location,
                nearest < HUGE_VAL ? fmt::format("no node of {} lies within the INFLUENCE RADIUS of {}; the nearest is {:.4g} away", block.value("SURFACE"),
                                                 radius, nearest)
                                   : fmt::format("surface {} has no node but the reference node; name the surface to be coupled", block.value("SURFACE")));
  return std::nullopt;
}

/// Lines "first degree of freedom, last"; all six where there are none.
std::optional<std::array<bool, 6>> read_freedoms(Builder& builder, const Block& block) {
  std::array<bool, 6> freedoms{};
  if (block.lines.empty()) freedoms.fill(true);
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const auto first = row.integer(0, "first degree of freedom"), last = row.integer_or(1, first, "last degree of freedom");
    row.at_most(2);
    if (row.ok() && (first < 1 || last > 6 || first > last))
      row.error(fmt::format("degrees of freedom {} to {} are out of range; displacements are 1 to 3, rotations 4 to 6", first, last));
    if (!row.ok()) return std::nullopt;
    for (auto dof = first; dof <= last; ++dof) freedoms[dof - 1] = true;
  }
  return freedoms;
}

void add_kinematic(Builder& builder, const Cloud& cloud, const std::array<bool, 6>& freedoms, const char* keyword, Location location) {
  for (const auto node : cloud.nodes) {
    const auto axes = cloud.axes_at(builder.model.nodes.coordinates[node]);
    Joint joint{.nodes = {cloud.reference, node}, .pieces = {}, .axes = axes, .second_axes = axes};
    const std::array translations{freedoms[0], freedoms[1], freedoms[2]}, rotations{freedoms[3], freedoms[4], freedoms[5]};
    if (std::ranges::count(translations, true) > 0) joint.pieces.push_back({Joint::Part::offset, translations});
    if (std::ranges::count(rotations, true) > 0)
      builder.held_rotations.push_back({static_cast<std::int32_t>(builder.model.constraints.size()), rotations});
    builder.model.constraints.push_back({std::move(joint), keyword, location.file, location.line});
  }
}

void add_distributing(Builder& builder, const Cloud& cloud, std::array<bool, 6> freedoms, const char* keyword, Location location) {
  for (int i = 0; i < 3; ++i) freedoms[i] = true;  // forces are always shared out
  builder.model.constraints.push_back(
      {DistributingCoupling{cloud.reference, cloud.nodes, cloud.weights, freedoms}, keyword, location.file, location.line});
}

/// Rotations about some axes of an ORIENTATION alone: as in CalculiX the reference node's degrees of freedom count along these axes, and
/// about the others, which nothing would hold, it does not turn.
void turn_about_own_axes(Builder& builder, const Block& block, const Cloud& cloud, const std::array<bool, 6>& freedoms) {
  Model& model = builder.model;
  const auto location = builder.coupling->location;
  std::get<DistributingCoupling>(model.constraints.back().kind).axes = cloud.axes_at(model.nodes.coordinates[cloud.reference]);
  const bool has_axes = std::ranges::any_of(model.transforms, [&](const auto& transform) { return std::ranges::count(transform.nodes, cloud.reference) > 0; });
  const bool has_elements = std::ranges::any_of(model.elements, [&](const auto& table) { return std::ranges::count(table.connectivity, cloud.reference) > 0; });
  if (has_axes || has_elements)
    return builder.error(block, block.location,
                         "rotations about some axes of an ORIENTATION alone are distributed for a reference node without elements and without "
                         "*TRANSFORM; give all of 4 to 6, or none");
  model.transforms.push_back({{cloud.reference}, model.orientations[*builder.require(builder.orientations, builder.coupling->value("ORIENTATION"), *builder.coupling, location)]});
  for (std::int32_t dof = 3; dof < 6; ++dof)
    if (!freedoms[dof]) model.constraints.push_back({LinearEquation{{{cloud.reference, dof, 1.0}}}, "*COUPLING", location.file, location.line});
}

/// *COUPLING waits for the keyword that says which kind it is.
void read_coupling(Builder& builder, const Block& block) {
  builder.coupling = &block;
}

void read_kinematic(Builder& builder, const Block& block) {
  const auto cloud = read_cloud(builder, *builder.coupling);
  const auto freedoms = read_freedoms(builder, block);
  if (cloud && freedoms) add_kinematic(builder, *cloud, *freedoms, "*COUPLING", builder.coupling->location);
}

/// Weights fall with the distance r from the reference node: uniform 1, linear 1 - r / R, quadratic 1 - (r / R)^2, cubic
/// 1 - 3 (r / R)^2 + 2 (r / R)^3, with R the greatest distance, a little stretched so that none vanishes.
void weigh(const Model& model, const std::string& method, Cloud& cloud) {
  if (method.empty() || method == "UNIFORM") return;
  std::vector<double> distance;
  for (const auto node : cloud.nodes)
    distance.push_back(norm(subtract(model.nodes.coordinates[node], model.nodes.coordinates[cloud.reference])));
  const double reach = 1.0001 * *std::ranges::max_element(distance);
  if (!(reach > 0.0)) return;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const double s = distance[i] / reach;
    cloud.weights[i] *= method == "LINEAR" ? 1.0 - s : method == "QUADRATIC" ? 1.0 - s * s : 1.0 - 3.0 * s * s + 2.0 * s * s * s;
  }
}

void read_distributing(Builder& builder, const Block& block) {
  auto cloud = read_cloud(builder, *builder.coupling);
  const auto freedoms = read_freedoms(builder, block);
  if (!cloud || !freedoms) return;
  const bool turns_partly = std::ranges::count(freedoms->begin() + 3, freedoms->end(), true) % 3 != 0;
  weigh(builder.model, squeeze(block.value("WEIGHTING METHOD")), *cloud);
  add_distributing(builder, *cloud, *freedoms, "*COUPLING", builder.coupling->location);
  if (turns_partly && builder.coupling->has("ORIENTATION")) turn_about_own_axes(builder, block, *cloud, *freedoms);
}

/// Lines "node or set, first degree of freedom, last" of the older keyword.
void read_kinematic_coupling(Builder& builder, const Block& block) {
  Cloud cloud;
  const auto reference = one_node(builder, block, "REF NODE");
  if (!reference) return;
  cloud.reference = *reference;
  if (!find_orientation(builder, block, cloud)) return;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const auto first = row.integer_or(1, 1, "first degree of freedom"), last = row.integer_or(2, row.has(1) ? first : 6, "last degree of freedom");
    row.at_most(3);
    cloud.nodes.clear();
    if (!row.ok() || !builder.nodes_of(row.text(0), block, line.location, cloud.nodes)) continue;
    if (first < 1 || last > 6 || first > last) {
      row.error(fmt::format("degrees of freedom {} to {} are out of range; displacements are 1 to 3, rotations 4 to 6", first, last));
      continue;
    }
    std::array<bool, 6> freedoms{};
    for (auto dof = first; dof <= last; ++dof) freedoms[dof - 1] = true;
    std::erase(cloud.nodes, cloud.reference);
    add_kinematic(builder, cloud, freedoms, "*KINEMATIC COUPLING", line.location);
  }
}

/// Lines "node or set, weight" of the elements' older keyword.
void read_distributing_coupling(Builder& builder, const Block& block) {
  Cloud cloud;
  const auto reference = one_node(builder, block, "REF NODE");
  if (!reference) return;
  cloud.reference = *reference;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const double weight = row.real_or(1, 1.0, "weight");
    row.at_most(2);
    std::vector<std::int32_t> nodes;
    if (!row.ok() || !builder.nodes_of(row.text(0), block, line.location, nodes)) continue;
    if (!(weight > 0.0)) {
      row.error(fmt::format("weight {} must be positive; correct it", weight));
      continue;
    }
    std::erase(nodes, cloud.reference);
    cloud.nodes.insert(cloud.nodes.end(), nodes.begin(), nodes.end());
    cloud.weights.resize(cloud.nodes.size(), weight);
  }
  if (cloud.nodes.empty()) return builder.error(block, block.location, "it couples no node; add lines: node or set, weight");
  add_distributing(builder, cloud, {true, true, true, true, true, true}, "*DISTRIBUTING COUPLING", block.location);
}

const RegisterKeyword coupling{{"COUPLING",
                                Phase::constraints,
                                Place::model,
                                {required(name("REF NODE")), required(name("SURFACE")), name("CONSTRAINT NAME"), name("ORIENTATION"),
                                 real("INFLUENCE RADIUS")},
                                read_coupling}};
const RegisterKeyword kinematic{{"KINEMATIC", Phase::constraints, Place::model, {}, read_kinematic, "COUPLING"}};
const RegisterKeyword distributing{{"DISTRIBUTING",
                                    Phase::constraints,
                                    Place::model,
                                    {choice("WEIGHTING METHOD", {"UNIFORM", "LINEAR", "QUADRATIC", "CUBIC"})},
                                    read_distributing,
                                    "COUPLING"}};
const RegisterKeyword kinematic_coupling{
    {"KINEMATIC COUPLING", Phase::constraints, Place::model, {required(name("REF NODE")), name("ORIENTATION")}, read_kinematic_coupling}};
const RegisterKeyword distributing_coupling{
    {"DISTRIBUTING COUPLING", Phase::constraints, Place::model, {required(name("REF NODE"))}, read_distributing_coupling}};

}  // namespace

}  // namespace balocco::deck
