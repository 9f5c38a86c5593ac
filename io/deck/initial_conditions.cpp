// *INITIAL CONDITIONS.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "elements/element_type.hpp"
#include "materials/initial_stress.hpp"

namespace balocco::deck {

namespace {

/// Lines "nodes, degree of freedom, value" of a displacement or a velocity.
template <class Add>
void read_translations(Builder& builder, const Block& block, const char* what, Add add) {
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const std::int64_t dof = row.integer(1, "degree of freedom");
    const double value = row.real(2, what);
    row.at_most(3);
    if (row.ok() && (dof < 1 || dof > 3)) row.error(fmt::format("degree of freedom {} has no initial {}; give 1 to 3", dof, what));
    std::vector<std::int32_t> nodes;
    if (!row.ok() || !builder.nodes_of(row.text(0), block, line.location, nodes)) continue;
    add(std::move(nodes), static_cast<std::int32_t>(dof - 1), value, line.location);
  }
}

void read_velocities(Builder& builder, const Block& block) {
  read_translations(builder, block, "velocity", [&](std::vector<std::int32_t> nodes, std::int32_t dof, double value, Location location) {
    InitialVelocity velocity{.nodes = std::move(nodes), .dof = dof, .location = location};
    velocity.velocity[dof] = value;
    builder.model.initial_velocities.push_back(std::move(velocity));
  });
}

void read_displacements(Builder& builder, const Block& block) {
  read_translations(builder, block, "displacement", [&](std::vector<std::int32_t> nodes, std::int32_t dof, double value, Location location) {
    builder.model.initial_displacements.push_back({std::move(nodes), dof, value, location});
  });
}

/// Pairs of lines: nodes, angular speed, velocity of the axis; two points of the axis.
void read_rotating_velocities(Builder& builder, const Block& block) {
  if (block.lines.size() % 2 != 0) {
    return builder.error(
        block, block.location,
        "each line 'nodes, angular speed, vx, vy, vz' needs a line with two points of the axis; add it");
  }
  for (std::size_t line = 0; line < block.lines.size(); line += 2) {
    Row row(builder, block, block.lines[line]), axis(builder, block, block.lines[line + 1]);
    InitialVelocity rotation;
    rotation.kind = InitialVelocity::Kind::rotation;
    rotation.location = row.location();
    rotation.angular_speed = row.real(1, "angular speed");
    Point second{};
    for (int i = 0; i < 3; ++i) {
      rotation.velocity[i] = row.real_or(2 + i, 0.0, "velocity of the axis");
      rotation.axis_point[i] = axis.real_or(i, 0.0, "first point of the axis");
      second[i] = axis.real_or(3 + i, 0.0, "second point of the axis");
    }
    row.at_most(5);
    axis.at_most(6);
    rotation.axis_direction = subtract(second, rotation.axis_point);
    const double length = norm(rotation.axis_direction);
    if (axis.ok() && !(length > 0.0)) axis.error("the two points of the axis coincide; correct them");
    if (!row.ok() || !axis.ok() || !builder.nodes_of(row.text(0), block, row.location(), rotation.nodes)) continue;
    for (double& component : rotation.axis_direction) component /= length;
    builder.model.initial_velocities.push_back(std::move(rotation));
  }
}

/// Components of an initial stress that elements with such a section have; 0 where they cannot have one.
int stress_components(Section::Kind kind) {
  switch (kind) {
    case Section::Kind::solid:
      return initial_stress_size(PointKind::solid);
    case Section::Kind::membrane:
    case Section::Kind::shell:
      return initial_stress_size(PointKind::plane);
    case Section::Kind::beam:
    case Section::Kind::truss:
      return initial_stress_size(PointKind::line);
    default:
      return 0;
  }
}

/// The elements of a line, none if it is wrong (told). All of them must be of one kind of section.
std::vector<ElementRef> elements_of_line(Builder& builder, const Block& block, Row& row, const char* what) {
  std::vector<ElementRef> elements;
  if (!builder.elements_of(row.text(0), block, row.location(), elements)) return {};
  const auto kind = builder.model.elements[elements[0].table].type->section;
  for (const auto element : elements) {
    const auto& table = builder.model.elements[element.table];
    if (stress_components(table.type->section) > 0 && table.type->section == kind) continue;
    row.error(fmt::format("element {} of type {} cannot have an initial {} on this line; name solids, shells, membranes, beams or trusses, "
                          "one kind on a line",
                          table.id[element.row], table.type->name, what));
    return {};
  }
  std::ranges::sort(elements);
  return elements;
}

void mark_stressed(Builder& builder, const std::vector<ElementRef>& elements) {
  for (const auto element : elements)
    if (const auto section = builder.model.elements[element.table].section[element.row]; section >= 0)
      builder.model.sections[section].initially_stressed = true;
}

using FieldsByElement = std::map<ElementRef, InitialField>;

/// Points that lines may name one by one: those through the thickness of shells, integration points of others.
int points_of(const Model& model, ElementRef element) {
  const auto& table = model.elements[element.table];
  const auto row = table.section[element.row];
  if (table.type->section != Section::Kind::shell || row < 0) return table.type->integration_points;
  const auto& section = model.sections[row];
  int points = section.plies.empty() ? section.shell.points : 0;
  for (const auto& ply : section.plies) points += ply.points;
  return points;
}

/// A line "elements, point, values".
void read_values_of_point(Builder& builder, const Block& block, Row& row, const std::string& field, const char* what, FieldsByElement& by_element) {
  const auto elements = elements_of_line(builder, block, row, what);
  if (elements.empty()) return;
  const auto& first = builder.model.elements[elements[0].table];
  if (block.has("SECTION POINTS") && first.type->section != Section::Kind::shell)
    return row.error(fmt::format("element {} of type {} has no points through a thickness; name shells, or leave SECTION POINTS out",
                                 first.id[elements[0].row], first.type->name));
  const int components = field == "S0" ? stress_components(first.type->section) : 1;
  const auto point = row.integer(1, "point");
  std::vector<double> values;
  for (int k = 0; k < components; ++k) values.push_back(row.real_or(2 + k, 0.0, what));
  row.at_most(2 + components);
  for (const auto element : elements) {
    const int points = points_of(builder.model, element);
    if (row.ok() && (point < 1 || point > points)) {
      const auto& table = builder.model.elements[element.table];
      row.error(fmt::format("element {} of type {} has points 1 to {}; correct field 2", table.id[element.row], table.type->name, points));
    }
    if (!row.ok()) return;
    InitialField& initial = by_element[element];
    if (initial.elements.empty())
      initial = {.field = field, .components = components, .elements = {element}, .values = {}, .location = row.location()};
    initial.values.resize(static_cast<std::size_t>(components) * points, 0.0);
    std::ranges::copy(values, initial.values.begin() + components * (point - 1));
  }
  if (field == "S0") mark_stressed(builder, elements);
}

void read_stresses(Builder& builder, const Block& block) {
  FieldsByElement by_element;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    if (block.has("SECTION POINTS") || row.size() > 1 + initial_stress_size(PointKind::solid)) {  // the latter as CalculiX has it
      read_values_of_point(builder, block, row, "S0", "stress", by_element);
      continue;
    }
    InitialField stress{.field = "S0", .elements = elements_of_line(builder, block, row, "stress"), .values = {}, .location = line.location};
    if (stress.elements.empty()) continue;
    stress.components = stress_components(builder.model.elements[stress.elements[0].table].type->section);
    for (int k = 0; k < stress.components; ++k) stress.values.push_back(row.real_or(1 + k, 0.0, "component of the stress"));
    row.at_most(1 + stress.components);
    if (!row.ok()) continue;
    mark_stressed(builder, stress.elements);
    builder.model.initial_fields.push_back(std::move(stress));
  }
  for (auto& [element, stress] : by_element) builder.model.initial_fields.push_back(std::move(stress));
}

void read_hardening(Builder& builder, const Block& block) {
  FieldsByElement by_element;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const bool of_point = block.has("SECTION POINTS");
    const int field = of_point ? 2 : 1;
    if (row.real(field, "equivalent plastic strain") < 0.0)
      row.error(fmt::format("equivalent plastic strain {} is negative; correct it", row.real(field, "equivalent plastic strain")));
    if (!row.ok()) continue;
    if (of_point) {
      read_values_of_point(builder, block, row, "PEEQ", "hardening", by_element);
      continue;
    }
    InitialField hardening{.field = "PEEQ", .elements = elements_of_line(builder, block, row, "hardening"), .values = {}, .location = line.location};
    hardening.values = {row.real(1, "equivalent plastic strain")};
    row.at_most(2);
    if (row.ok() && !hardening.elements.empty()) builder.model.initial_fields.push_back(std::move(hardening));
  }
  for (auto& [element, hardening] : by_element) builder.model.initial_fields.push_back(std::move(hardening));
}

void read_temperatures(Builder& builder, const Block& block) {
  auto& temperature = builder.model.initial_temperature;
  temperature.resize(builder.model.nodes.id.size(), 0.0);
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const double value = row.real(1, "temperature");
    row.at_most(2);
    std::vector<std::int32_t> nodes;
    if (!row.ok() || !builder.nodes_of(row.text(0), block, line.location, nodes)) continue;
    for (const auto node : nodes) temperature[node] = value;
  }
}

void read_initial_conditions(Builder& builder, const Block& block) {
  const std::string type = block.value("TYPE");
  if (block.has("SECTION POINTS") && type != "STRESS" && type != "HARDENING")
    builder.error(block, block.location, "SECTION POINTS: stress and hardening of shells alone have such points; remove it");
  if (type == "DISPLACEMENT") return read_displacements(builder, block);
  if (type == "VELOCITY") return read_velocities(builder, block);
  if (type == "ROTATING VELOCITY") return read_rotating_velocities(builder, block);
  if (type == "TEMPERATURE") return read_temperatures(builder, block);
  type == "STRESS" ? read_stresses(builder, block) : read_hardening(builder, block);
}

const RegisterKeyword initial{{"INITIAL CONDITIONS",
                               Phase::constraints,
                               Place::model,
                               {required(choice("TYPE", {"DISPLACEMENT", "VELOCITY", "ROTATING VELOCITY", "STRESS", "HARDENING", "TEMPERATURE"})),
                                flag("SECTION POINTS")},
                               read_initial_conditions}};

}  // namespace

}  // namespace balocco::deck
