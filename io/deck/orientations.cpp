// *ORIENTATION *TRANSFORM.
#include "deck/orientations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

using Axes = std::array<Point, 3>;

/// Axes of a cylindrical system about the line from a to b.
std::optional<std::array<Point, 3>> cylindrical_axes(const Point& a, const Point& b) {
  Point axis = subtract(b, a);
  const double length = norm(axis);
  if (!(length > 0.0)) return std::nullopt;
  for (double& component : axis) component /= length;
  return axes_about(axis);
}

/// Points a and b (and c) of a line: coordinates, or nodes, which are where their instance has put them.
struct DefiningPoints {
  Point a{}, b{}, c{};
  bool placed = false;
};

std::optional<DefiningPoints> points_by_nodes(Builder& builder, const Block& block, Row& row, bool cylindrical) {
  DefiningPoints points{.placed = true};
  row.at_most(cylindrical ? 2 : 3);
  for (int i = 0; i < (cylindrical ? 2 : 3); ++i) {
    if (i == 2 && !row.has(i)) continue;  // the global origin
    const auto id = row.integer(i, "node");
    const auto node = row.ok() ? builder.require_node(id, block, row.location()) : std::nullopt;
    if (!node) return std::nullopt;
    (i == 0 ? points.a : i == 1 ? points.b : points.c) = builder.model.nodes.coordinates[*node];
  }
  return points;
}

std::optional<DefiningPoints> points_by_coordinates(Row& row, bool cylindrical) {
  const DefiningPoints points{.a = row.point(0, "point a"), .b = row.point(3, "point b"), .c = row.point(6, "point c")};
  row.at_most(cylindrical ? 6 : 9);
  return row.ok() ? std::optional(points) : std::nullopt;
}

/// Axes that are the same for all elements.
void read_axes(Builder& builder, const Block& block, Row& row, Orientation& orientation) {
  const bool cylindrical = block.value("SYSTEM") == "CYLINDRICAL";
  orientation.system = cylindrical ? Orientation::System::cylindrical : Orientation::System::rectangular;
  const auto points = block.value("DEFINITION") == "NODES" ? points_by_nodes(builder, block, row, cylindrical) : points_by_coordinates(row, cylindrical);
  if (!points) return;
  const auto& [a, b, c, placed] = *points;
  // Rectangular: c is the origin (default: the global one), a on the first axis, b in the plane of the first two.
  const auto axes = cylindrical ? cylindrical_axes(a, b) : axes_of_points(c, a, b);
  if (!axes) return row.error("the points define no axes; give points that do not lie on a line");
  const Point& origin = cylindrical ? a : c;
  orientation.origin = placed ? origin : builder.scope->place(origin);
  for (int k = 0; k < 3; ++k) orientation.axes[k] = placed ? (*axes)[k] : builder.scope->turn((*axes)[k]);
}

/// OFFSET TO NODES: nodes a and b of each element, c (at first the first one) the origin.
void read_corners(Row& row, ElementDirections& directions) {
  row.at_most(3);
  for (int i = 0; i < 3; ++i) {
    const auto corner = i == 2 ? row.integer_or(i, 1, "number of a node in the element") : row.integer(i, "number of a node in the element");
    if (row.ok() && corner < 1) row.error(fmt::format("nodes of an element count from 1, but {} is given; correct it", corner));
    directions.corner[i] = static_cast<int>(corner) - 1;
  }
}

/// Axes of single elements. @return false if the block has none
bool read_element_directions(Builder& builder, const Block& block, Row& row) {
  const bool by_corners = squeeze(block.value("DEFINITION")) == "OFFSETTONODES";
  const bool by_distribution = !by_corners && block.value("DEFINITION") != "NODES" && row.has(0) && !parse_real(row.text(0));
  if (!by_corners && !by_distribution) return false;
  ElementDirections directions;
  if (block.value("SYSTEM") == "CYLINDRICAL")
    row.error("directions of single elements are rectangular; leave SYSTEM=CYLINDRICAL out");
  else if (by_corners)
    read_corners(row, directions);
  else
    directions.distribution = row.name(0);
  if (by_distribution) row.at_most(1);
  builder.element_directions[static_cast<std::int32_t>(builder.model.orientations.size())] = directions;
  return true;
}

void read_orientation(Builder& builder, const Block& block) {
  Orientation orientation;
  const auto full = builder.define(builder.orientations, block.value("NAME"),
                                   static_cast<std::int32_t>(builder.model.orientations.size()), block);
  if (!full) return;
  orientation.name = *full;
  if (block.lines.empty()) {
    builder.error(block, block.location, "it has no data; add the points a, b (and c)");
  } else {
    Row row(builder, block, block.lines[0]);
    if (!read_element_directions(builder, block, row)) read_axes(builder, block, row, orientation);
  }
  if (block.lines.size() > 1) {
    Row row(builder, block, block.lines[1]);
    const std::int64_t axis = row.integer_or(0, 1, "axis of the additional rotation");
    orientation.additional_rotation = row.real_or(1, 0.0, "angle in degrees") * std::numbers::pi / 180.0;
    row.at_most(2);
    if (row.ok() && (axis < 1 || axis > 3)) row.error(fmt::format("axis {} does not exist; give 1, 2 or 3", axis));
    orientation.rotation_axis = static_cast<int>(axis) - 1;
  }
  builder.model.orientations.push_back(std::move(orientation));
}

std::optional<Axes> axes_of_corners(const Model& model, const ElementDirections& directions, ElementRef element) {
  const auto& table = model.elements[element.table];
  std::array<Point, 3> place;
  for (int i = 0; i < 3; ++i) {
    if (directions.corner[i] >= table.type->nodes) return std::nullopt;
    place[i] = model.nodes.coordinates[table.connectivity[static_cast<std::size_t>(element.row) * table.type->nodes + directions.corner[i]]];
  }
  return axes_of_points(place[2], place[0], place[1]);
}

void read_transform(Builder& builder, const Block& block) {
  NodalTransform transform;
  if (!builder.nodes_of(block.value("NSET"), block, block.location, transform.nodes)) return;
  if (block.lines.empty()) return builder.error(block, block.location, "it has no data; add the points a and b");
  Row row(builder, block, block.lines[0]);
  const Point a = row.point(0, "point a"), b = row.point(3, "point b");
  row.at_most(6);
  if (!row.ok()) return;
  auto& directions = transform.directions;
  std::optional<std::array<Point, 3>> axes;
  if (block.value("TYPE", "R") == "C") {
    directions.system = Orientation::System::cylindrical;
    directions.origin = builder.scope->place(a);
    axes = cylindrical_axes(a, b);
  } else {
    axes = axes_of_points({}, a, b);
  }
  if (!axes) return row.error("points a and b define no axes; correct them");
  for (int k = 0; k < 3; ++k) directions.axes[k] = builder.scope->turn((*axes)[k]);
  builder.model.transforms.push_back(std::move(transform));
}

const RegisterKeyword orientation{{"ORIENTATION",
                                   Phase::surfaces,
                                   Place::model,
                                   {required(name("NAME")), choice("SYSTEM", {"RECTANGULAR", "CYLINDRICAL"}),
                                    choice("DEFINITION", {"COORDINATES", "NODES", "OFFSET TO NODES"})},
                                   read_orientation}};
const RegisterKeyword transform{
    {"TRANSFORM", Phase::surfaces, Place::model, {required(name("NSET")), choice("TYPE", {"R", "C"})}, read_transform}};

}  // namespace

std::optional<std::int32_t> require_directions(Builder& builder, std::string_view name, const Block& block, Location location) {
  const auto row = builder.require(builder.orientations, name, block, location);
  if (!row || !builder.element_directions.contains(*row)) return row;
  builder.error(block, location,
                fmt::format("orientation {} has the directions of single elements, which only solids, membranes and shells take; give one that is "
                            "the same everywhere",
                            name));
  return std::nullopt;
}

bool give_directions(Builder& builder, const Block& block, std::int32_t row, const std::vector<ElementRef>& elements) {
  const auto found = builder.element_directions.find(row);
  if (found == builder.element_directions.end()) return true;
  Model& model = builder.model;
  const auto& directions = found->second;
  const Distribution* distribution = nullptr;
  if (!directions.distribution.empty()) {
    const auto place = builder.require(builder.distributions, directions.distribution, block, block.location);
    if (!place) return false;
    distribution = &builder.distribution[*place];
    if (distribution->of_lengths) {
      builder.error(block, block.location,
                    fmt::format("orientation {} names distribution {} of lengths; name one of directions", model.orientations[row].name,
                                directions.distribution));
      return false;
    }
  }
  const auto axes_of = [&](ElementRef element) -> std::optional<Axes> {
    return distribution == nullptr ? axes_of_corners(model, directions, element) : distribution->directions.of(element);
  };
  auto& orientation = model.orientations[row];
  for (const auto element : elements) {
    const auto kind = model.elements[element.table].type->section;
    if (kind != Section::Kind::solid && kind != Section::Kind::membrane && kind != Section::Kind::shell)
      return require_directions(builder, orientation.name, block, block.location).has_value();
    const auto axes = axes_of(element);
    if (!axes) {
      builder.error(block, block.location,
                    fmt::format("orientation {} gives element {} no directions; {}", orientation.name, model.element_name(element),
                                distribution == nullptr ? "its OFFSET TO NODES must name three nodes of it that lie on no line"
                                                        : "name it under the *DISTRIBUTION, or give a line with an empty first field for all others"));
      return false;
    }
    orientation.of_element.emplace_back(element, *axes);
  }
  std::ranges::sort(orientation.of_element);
  return true;
}

}  // namespace balocco::deck
