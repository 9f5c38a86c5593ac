// *CONNECTOR SECTION, and *CONNECTOR BEHAVIOR with *CONNECTOR ELASTICITY, DAMPING and CONSTITUTIVE REFERENCE. What limits the motion of a
// component is in connector_guides.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "constraints/nodal_directions.hpp"
#include "deck/builder.hpp"
#include "deck/connector_guides.hpp"
#include "deck/orientations.hpp"
#include "deck/register.hpp"
#include "deck/section_assignment.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

using Part = Joint::Part;
using Piece = Joint::Piece;
constexpr auto cartesian = Connector::Translation::cartesian;
constexpr auto axial = Connector::Translation::axial;
constexpr auto cardan = Connector::Rotation::cardan;

/// A connection type as the manual of Abaqus defines it: what it holds, and the components that it leaves.
struct Type {
  const char* name;
  std::vector<Piece> pieces;
  std::vector<int> available;  // components 1 to 6
  Connector::Translation translation = Connector::Translation::none;
  Connector::Rotation rotation = Connector::Rotation::none;
};

const std::vector<Type>& types() {
  static const Piece join{.part = Part::offset}, align{.part = Part::align}, revolute{.part = Part::revolute},
      universal{.part = Part::universal}, slot{.part = Part::slot};
  static const std::vector<Type> all{
      {"AXIAL", {}, {1}, axial},
      {"CARTESIAN", {}, {1, 2, 3}, cartesian},
      {"JOIN", {join}, {}},
      {"LINK", {{.part = Part::distance}}, {}},
      {"SLOT", {slot}, {1}, cartesian},
      {"SLIDE-PLANE", {{.part = Part::plane}}, {2, 3}, cartesian},
      {"ALIGN", {align}, {}},
      {"REVOLUTE", {revolute}, {4}, Connector::Translation::none, cardan},
      {"UNIVERSAL", {universal}, {4, 6}, Connector::Translation::none, cardan},
      {"CARDAN", {}, {4, 5, 6}, Connector::Translation::none, cardan},
      {"EULER", {}, {4, 5, 6}, Connector::Translation::none, Connector::Rotation::euler},
      {"ROTATION", {}, {4, 5, 6}, Connector::Translation::none, Connector::Rotation::vector},
      {"BEAM", {join, align}, {}},
      {"WELD", {join, align}, {}},
      {"HINGE", {join, revolute}, {4}, Connector::Translation::none, cardan},
      {"CYLINDRICAL", {slot, revolute}, {1, 4}, cartesian, cardan},
      {"TRANSLATOR", {slot, align}, {1}, cartesian},
      {"UJOINT", {join, universal}, {4, 6}, Connector::Translation::none, cardan},
      {"PLANAR", {{.part = Part::plane}, revolute}, {2, 3, 4}, cartesian, cardan},
      {"BUSHING", {}, {1, 2, 3, 4, 5, 6}, cartesian, cardan},
  };
  return all;
}

const Type* find_type(std::string_view name) {
  const auto found = std::ranges::find_if(types(), [&](const Type& type) { return squeeze(name) == squeeze(type.name); });
  return found == types().end() ? nullptr : &*found;
}

/// The connection types of the first data line: one assembled one, or a translational and a rotational one.
std::optional<Connector> read_types(Builder& builder, const Block& block, const DataLine& line) {
  Connector connector;
  Row row(builder, block, line);
  row.at_most(2);
  for (int field = 0; field < std::min(row.size(), 2) && row.ok(); ++field) {
    if (!row.has(field)) continue;
    const auto* type = find_type(row.text(field));
    if (type == nullptr) {
      std::vector<std::string> known;
      for (const auto& each : types()) known.emplace_back(each.name);
      row.error(fmt::format("connection type {} is unknown or not supported; supported: {}", row.text(field), join(known)));
      return std::nullopt;
    }
    connector.type += (connector.type.empty() ? "" : ", ") + std::string(type->name);
    connector.pieces.insert(connector.pieces.end(), type->pieces.begin(), type->pieces.end());
    if (type->translation != Connector::Translation::none) connector.translation = type->translation;
    if (type->rotation != Connector::Rotation::none) connector.rotation = type->rotation;
    for (const int component : type->available) connector.available[component - 1] = true;
  }
  if (row.ok() && connector.type.empty()) row.error("the connection type is missing; name one, such as HINGE or JOIN, REVOLUTE");
  if (!row.ok()) return std::nullopt;
  return connector;
}

bool read_orientations(Builder& builder, const Block& block, Connector& connector) {
  if (block.lines.size() < 2) {
    const bool turns = connector.rotation == cardan && !connector.pieces.empty();
    const bool slides = std::ranges::any_of(connector.pieces, [](const Piece& piece) { return piece.part == Part::slot || piece.part == Part::plane; });
    if (!turns && !slides) return true;
    builder.error(block, block.location,
                  fmt::format("{} needs directions: its axis is the first one of an *ORIENTATION; name it on a second data line", connector.type));
    return false;
  }
  Row row(builder, block, block.lines[1]);
  row.at_most(2);
  for (int end = 0; end < 2; ++end) {
    if (!row.has(end)) continue;
    const auto orientation = require_directions(builder, row.name(end), block, row.location());
    if (!orientation) return false;
    connector.orientation[end] = *orientation;
  }
  return row.ok();
}

void check_friction(Builder& builder, const Block& block, const Connector& connector, const Guide::Friction& friction) {
  if (friction.coefficient == 0.0)
    builder.error(block, block.location, fmt::format("the *CONNECTOR FRICTION of behavior {} has no coefficient; let *FRICTION follow it", block.value("BEHAVIOR")));
  for (const auto& arms : friction.terms)
    for (int c = 0; c < 6; ++c)
      if (arms[c] != 0.0 && (connector.available[c] || connector.pieces.empty()))
        builder.error(block, block.location,
                      fmt::format("the friction of behavior {} takes the force of component {}, which {} does not hold; name one that it holds",
                                  block.value("BEHAVIOR"), c + 1, connector.type));
}

void take_behavior(Builder& builder, const Block& block, Connector& connector) {
  const auto behavior = builder.connector_behaviors.find(block.value("BEHAVIOR"));
  if (behavior == builder.connector_behaviors.end()) {
    if (!builder.is_poisoned(block.value("BEHAVIOR")))
      builder.error(block, block.location, fmt::format("connector behavior {} is not defined; define *CONNECTOR BEHAVIOR, NAME={}", block.value("BEHAVIOR"),
                                                       block.value("BEHAVIOR")));
    return;
  }
  const auto& given = behavior->second;
  for (int c = 0; c < 6; ++c) {
    const auto& component = given.component[c];
    if (!connector.available[c] && (component.elasticity || component.damping || component.reference || component.guide))
      builder.error(block, block.location,
                    fmt::format("the behavior {} speaks of component {}, which {} does not leave free; remove it, or use another type",
                                block.value("BEHAVIOR"), c + 1, connector.type));
  }
  for (int c = 0; c < 6; ++c)
    if (const auto& guide = given.component[c].guide; guide && guide->friction) check_friction(builder, block, connector, *guide->friction);
  connector.component = given.component;
  connector.coupled_elasticity = given.coupled_elasticity;
  connector.coupled_damping = given.coupled_damping;
}

/// What the connector of these elements holds, stops and rubs becomes constraints.
bool add_joints(Builder& builder, const Block& block, const Connector& connector, const std::vector<ElementRef>& elements) {
  for (const auto element : elements) {
    const auto& table = builder.model.elements[element.table];
    const auto* nodes = &table.connectivity[2 * static_cast<std::size_t>(element.row)];
    const auto &a = builder.model.nodes.coordinates[nodes[0]], &b = builder.model.nodes.coordinates[nodes[1]];
    const bool measures_distance = connector.translation == axial || std::ranges::any_of(connector.pieces, [](const Piece& piece) {
                                     return piece.part == Part::distance;
                                   });
    if (measures_distance && a == b) {
      builder.error(block, table.location[element.row],
                    fmt::format("element {}: {} acts along the line between its nodes, which lie in one place; move one of them",
                                builder.model.element_name(element), connector.type));
      return false;
    }
    const auto location = table.location[element.row];
    if (!connector.pieces.empty()) {
      Joint joint{.nodes = {nodes[0], nodes[1]}, .pieces = connector.pieces};
      joint.axes = axes_at(builder.model, connector, 0, nodes[0]);
      joint.second_axes = axes_at(builder.model, connector, 1, nodes[1]);
      builder.model.constraints.push_back(
          {std::move(joint), fmt::format("*CONNECTOR SECTION ({})", connector.type), location.file, location.line, element});
    }
    for (int c = 0; c < 6; ++c)
      if (const auto& given = connector.component[c].guide) guide_row(builder, connector, element, c) = *given;
  }
  return true;
}

void read_section(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin_section(builder, block, elements);
  if (!section) return;
  section->kind = Section::Kind::connector;
  if (builder.model.elements[elements[0].table].type->section != Section::Kind::connector)
    return assign_section(builder, block, *std::move(section), elements);  // refused there
  if (block.lines.empty()) return builder.error(block, block.location, "the connection type is missing; add a data line, such as HINGE or JOIN, REVOLUTE");
  auto connector = read_types(builder, block, block.lines[0]);
  if (!connector || !read_orientations(builder, block, *connector)) return;
  if (block.has("BEHAVIOR")) take_behavior(builder, block, *connector);
  if (!add_joints(builder, block, *connector, elements)) return;
  section->connector = static_cast<std::int32_t>(builder.model.connectors.size());
  builder.model.connectors.push_back(*std::move(connector));
  assign_section(builder, block, *std::move(section), elements);
}

void read_behavior(Builder& builder, const Block& block) {
  builder.connector_behavior = &builder.connector_behaviors[block.value("NAME")];
  builder.derived_components.clear();
}

/// A slope, a table with NONLINEAR, or, where no COMPONENT is named, the upper triangle of a matrix.
void read_curve(Builder& builder, const Block& block, std::optional<ConnectorComponent::Curve> ConnectorComponent::*where, std::vector<double>& matrix,
                const char* argument) {
  std::vector<Row> rows;
  for (const auto& line : block.lines) rows.emplace_back(builder, block, line);
  if (rows.empty()) return builder.error(block, block.location, "its data lines are missing; add them");
  if (!block.has("COMPONENT")) {
    std::vector<double> values;
    for (auto& row : rows)
      for (int field = 0; field < row.size(); ++field)
        if (row.has(field)) values.push_back(row.real(field, "coefficient"));
    if (values.size() != 21)
      return builder.error(block, block.location, fmt::format("a coupled matrix has 21 coefficients (upper triangle, column by column), not {}; or name a COMPONENT",
                                                              values.size()));
    matrix = std::move(values);
    return;
  }
  const auto component = component_of(builder, block);
  if (!component) return;
  ConnectorComponent::Curve curve;
  if (!block.has("NONLINEAR")) {
    if (rows.size() > 1) return rows[1].error("a linear one has one data line; remove this line or add NONLINEAR");
    curve.slope = rows[0].real(0, "coefficient");
  }
  for (auto& row : rows) {
    if (!block.has("NONLINEAR")) break;
    const double force = row.real(0, "force"), at = row.real(1, argument);
    if (row.ok() && !curve.table.empty() && !(at > curve.table.back()[0]))
      row.error(fmt::format("the {} {} does not rise above the one before, {}; list them in rising order", argument, at, curve.table.back()[0]));
    if (!row.ok()) return;
    curve.table.push_back({at, force});
  }
  if (block.has("NONLINEAR") && curve.table.size() < 2) return builder.error(block, block.location, "NONLINEAR needs at least two lines; add them or leave it out");
  (builder.connector_behavior->component[*component].*where) = std::move(curve);
}

void read_elasticity(Builder& builder, const Block& block) {
  read_curve(builder, block, &ConnectorComponent::elasticity, builder.connector_behavior->coupled_elasticity, "relative motion");
}

void read_connector_damping(Builder& builder, const Block& block) {
  read_curve(builder, block, &ConnectorComponent::damping, builder.connector_behavior->coupled_damping, "relative velocity");
}

/// Lengths, and angles in degrees, without force; empty fields leave them where they are at the start.
void read_reference(Builder& builder, const Block& block) {
  if (block.lines.empty()) return builder.error(block, block.location, "the lengths and angles without force are missing; add a data line");
  Row row(builder, block, block.lines[0]);
  row.at_most(6);
  for (int c = 0; c < 6; ++c) {
    if (!row.has(c)) continue;
    const double value = row.real(c, "length or angle");
    builder.connector_behavior->component[c].reference = c < 3 ? value : value * std::numbers::pi / 180.0;
  }
}

const RegisterKeyword connector_section{
    {"CONNECTOR SECTION", Phase::sections, Place::model, {required(name("ELSET")), name("BEHAVIOR")}, read_section}};
const RegisterKeyword connector_behavior{{"CONNECTOR BEHAVIOR", Phase::definitions, Place::model, {required(name("NAME"))}, read_behavior}};
const RegisterKeyword elasticity{
    {"CONNECTOR ELASTICITY", Phase::definitions, Place::model, {integer("COMPONENT"), flag("NONLINEAR")}, read_elasticity, "CONNECTOR BEHAVIOR"}};
const RegisterKeyword connector_damping{
    {"CONNECTOR DAMPING", Phase::definitions, Place::model, {integer("COMPONENT"), flag("NONLINEAR")}, read_connector_damping, "CONNECTOR BEHAVIOR"}};
const RegisterKeyword reference{
    {"CONNECTOR CONSTITUTIVE REFERENCE", Phase::definitions, Place::model, {}, read_reference, "CONNECTOR BEHAVIOR"}};

}  // namespace

}  // namespace balocco::deck
