// Nodes: *NODE *SYSTEM *NGEN *NFILL *NCOPY.
#include "deck/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/builder.hpp"
#include "deck/node_maps.hpp"

#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

constexpr std::int64_t greatest_id = 999'999'999'999;

/// First free multiple of a thousand after the ids in use, so that shifted ids stay readable.
std::int64_t free_offset(const std::vector<std::int64_t>& ids) {
  const auto largest = std::max_element(ids.begin(), ids.end());
  return largest == ids.end() ? 0 : (*largest / 1000 + 1) * 1000;
}

bool valid_id(Builder& builder, const Block& block, Location location, std::int64_t id, const char* what) {
  if (id > 0 && id <= greatest_id) return true;
  builder.error(block, location, fmt::format("{} id {} is out of range; ids are positive", what, id));
  return false;
}

Point in_system(const NodeSystem& system, const Point& local) {
  Point result = system.origin;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) result[i] += system.axes[k][i] * local[k];
  }
  return result;
}

/// Where a point given in a cylindrical or spherical *NODE, SYSTEM= lies.
Point from_system(const std::string& system, const Point& given) {
  constexpr double degree = 0.017453292519943295;
  const auto& [first, second, third] = given;
  if (system == "C") return {first * std::cos(second * degree), first * std::sin(second * degree), third};
  if (system == "S") {
    return {first * std::cos(third * degree) * std::cos(second * degree),
            first * std::cos(third * degree) * std::sin(second * degree), first * std::sin(third * degree)};
  }
  return given;
}

void read_nodes(Builder& builder, const Block& block) {
  const std::string system = block.value("SYSTEM", "R");
  const std::int32_t set = block.has("NSET") ? builder.node_set_row(block.value("NSET")) : -1;
  builder.model.nodes.row_of_id.reserve(builder.model.nodes.id.size() + block.lines.size());
  std::vector<std::string_view> fields;
  for (const auto& line : block.lines) {
    split(line.text, fields);
    const auto id = fields.empty() ? std::nullopt : parse_integer(fields[0]);
    std::array<double, 6> numbers{};  // coordinates, and the normal of shells there
    bool good = id.has_value() && fields.size() <= 7;
    for (std::size_t i = 1; good && i < fields.size(); ++i) {
      const auto value = fields[i].empty() ? 0.0 : parse_real(fields[i]);
      good = value.has_value();
      if (good) numbers[i - 1] = *value;
    }
    const Point given{numbers[0], numbers[1], numbers[2]}, normal{numbers[3], numbers[4], numbers[5]};
    if (!good) {
      Row row(builder, block, line);  // the slow way, for its message
      row.integer(0, "node id");
      for (int i = 1; i < 7; ++i) row.real_or(i, 0.0, i < 4 ? "coordinate" : "component of the normal");
      row.at_most(7);
      continue;
    }
    const auto added = add_node(builder, block, line.location, *id,
                                builder.scope->place(in_system(builder.node_system, from_system(system, given))));
    if (added && set >= 0) builder.add_to_node_set(set, *added);
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (added && length > 0.0)
      builder.normals.at_node[*added] = builder.scope->turn({normal[0] / length, normal[1] / length, normal[2] / length});
  }
}

void read_system(Builder& builder, const Block& block) {
  builder.node_system = {};
  if (block.lines.empty()) return;
  Row row(builder, block, block.lines[0]);
  Point a{}, b{}, c{};
  for (int i = 0; i < 3; ++i) a[i] = row.real_or(i, 0.0, "origin");
  if (!row.has(3) && block.lines.size() == 1) {
    builder.node_system.origin = a;
    return;
  }
  for (int i = 0; i < 3; ++i) b[i] = row.real_or(3 + i, 0.0, "point on the first axis");
  row.at_most(6);
  if (block.lines.size() < 2) {  // Abaqus: rotation about the global third axis
    const Point x{b[0] - a[0], b[1] - a[1], 0.0};
    c = {a[0] - x[1], a[1] + x[0], a[2]};
    b[2] = a[2];
  } else {
    Row second(builder, block, block.lines[1]);
    for (int i = 0; i < 3; ++i) c[i] = second.real_or(i, 0.0, "point of the first plane");
    if (!second.ok()) return;
  }
  const auto axes = axes_of_points(a, b, c);
  if (!row.ok()) return;
  if (!axes) {
    row.error("the three points lie on a line; give points that span a plane");
    return;
  }
  builder.node_system = {a, *axes};
}

/// *NGEN: nodes between two end nodes, on a straight line or on a circle about a third node or point.
void generate_nodes(Builder& builder, const Block& block) {
  const std::int32_t set = block.has("NSET") ? builder.node_set_row(block.value("NSET")) : -1;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const std::int64_t first = row.integer(0, "first end node"), last = row.integer(1, "last end node");
    const std::int64_t increment = row.integer_or(2, 1, "increment of the ids");
    row.at_most(block.has("LINE") ? 10 : 3);
    if (!row.ok()) continue;
    if (increment == 0 || (last - first) % increment != 0 || (last - first) / increment < 1) {
      row.error(fmt::format("increment {} does not lead from node {} to node {}; correct it", increment, first, last));
      continue;
    }
    const auto begin = builder.require_node(first, block, line.location);
    const auto end = builder.require_node(last, block, line.location);
    if (!begin || !end) continue;
    const Point from = builder.model.nodes.coordinates[*begin], to = builder.model.nodes.coordinates[*end];
    std::optional<Circle> circle;
    if (block.has("LINE")) {
      circle = circle_of(builder, block, row, from, to);
      if (!circle) continue;
    }
    const std::int64_t count = (last - first) / increment;
    if (set >= 0) builder.add_to_node_set(set, *begin);
    for (std::int64_t k = 1; k < count; ++k) {
      const double s = static_cast<double>(k) / static_cast<double>(count);
      const auto added = add_node(builder, block, line.location, first + k * increment,
                                  circle ? circle->point(s) : between(from, to, s));
      if (added && set >= 0) builder.add_to_node_set(set, *added);
    }
    if (set >= 0) builder.add_to_node_set(set, *end);
  }
}

/// *NFILL: nodes between corresponding nodes of two sets.
void fill_nodes(Builder& builder, const Block& block) {
  const std::int32_t set = block.has("NSET") ? builder.node_set_row(block.value("NSET")) : -1;
  const double bias = block.real("BIAS", 1.0);
  if (bias <= 0.0) return builder.error(block, block.location, "BIAS must be positive; correct it");
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    std::vector<std::int32_t> from, to;
    const bool known = builder.nodes_of(row.text(0), block, line.location, from) &
                       builder.nodes_of(row.text(1), block, line.location, to);
    const std::int64_t intervals = row.integer(2, "number of intervals"),
                       increment = row.integer_or(3, 1, "id increment");
    row.at_most(4);
    if (!row.ok() || !known) continue;
    if (intervals < 1) {
      row.error("the number of intervals must be positive; correct it");
      continue;
    }
    for (std::size_t n = 0; n < std::min(from.size(), to.size()); ++n) {
      const Point start = builder.model.nodes.coordinates[from[n]], end = builder.model.nodes.coordinates[to[n]];
      const std::int64_t id = builder.model.nodes.id[from[n]] - builder.scope->node_offset.value_or(0);
      for (std::int64_t k = 1; k < intervals; ++k) {
        const auto added = add_node(builder, block, line.location, id + k * increment,
                                    between(start, end, biased(k, intervals, bias)));
        if (added && set >= 0) builder.add_to_node_set(set, *added);
      }
      if (set >= 0) {
        builder.add_to_node_set(set, from[n]);
        builder.add_to_node_set(set, to[n]);
      }
    }
  }
}

/// How *NCOPY finds the place of a copy. Empty: an error was told.
std::function<Point(const Point&)> copy_map(Builder& builder, const Block& block) {
  const int kinds = (block.has("SHIFT") ? 1 : 0) + (block.has("REFLECT") ? 1 : 0) + (block.has("POLE") ? 1 : 0);
  if (kinds != 1) {
    builder.error(block, block.location, "say how the copies are placed, once: SHIFT, REFLECT=POINT, LINE or MIRROR, or POLE");
    return {};
  }
  if (block.has("REFLECT")) return reflection_of(builder, block);
  if (block.has("POLE")) return pole_of(builder, block);
  const auto shift = shift_of(builder, block);
  if (!shift) return {};
  return [shift = *shift](const Point& point) { return shift.move(point); };
}

/// *NCOPY: copies of a set, moved and turned, or reflected.
void copy_nodes(Builder& builder, const Block& block) {
  std::vector<std::int32_t> old;
  if (!builder.nodes_of(block.value("OLD SET"), block, block.location, old)) return;
  const auto map = copy_map(builder, block);
  if (!map) return;
  if (block.has("MULTIPLE") && !block.has("SHIFT"))
    return builder.error(block, block.location, "MULTIPLE goes with SHIFT; leave it out");
  const std::int32_t set = block.has("NEW SET") ? builder.node_set_row(block.value("NEW SET")) : -1;
  const std::int64_t change = block.integer("CHANGE NUMBER", 0);
  const std::int32_t multiple = std::max(1, block.integer("MULTIPLE", 1));
  std::vector<Point> points;
  for (const auto row : old) points.push_back(builder.model.nodes.coordinates[row]);
  for (std::int32_t copy = 1; copy <= multiple; ++copy) {
    for (std::size_t n = 0; n < old.size(); ++n) {
      points[n] = map(points[n]);
      const std::int64_t id = builder.model.nodes.id[old[n]] - builder.scope->node_offset.value_or(0) + copy * change;
      const auto added = add_node(builder, block, block.location, id, points[n]);
      if (added && set >= 0) builder.add_to_node_set(set, *added);
    }
  }
}

const RegisterKeyword node{
    {"NODE", Phase::nodes, Place::model, {name("NSET"), choice("SYSTEM", {"R", "C", "S"}), text("INPUT")}, read_nodes}};
const RegisterKeyword system_{{"SYSTEM", Phase::nodes, Place::model, {}, read_system}};
const RegisterKeyword ngen{{"NGEN", Phase::nodes, Place::model, {name("NSET"), choice("LINE", {"C"})}, generate_nodes}};
const RegisterKeyword nfill{{"NFILL", Phase::nodes, Place::model, {name("NSET"), real("BIAS")}, fill_nodes}};
const RegisterKeyword ncopy{{"NCOPY",
                             Phase::nodes,
                             Place::model,
                             {required(integer("CHANGE NUMBER")), required(name("OLD SET")), name("NEW SET"),
                              flag("SHIFT"),
                              choice("REFLECT", {"POINT", "LINE", "MIRROR"}), flag("POLE"), integer("MULTIPLE")},
                             copy_nodes}};

}  // namespace

std::optional<std::int32_t> add_node(Builder& builder, const Block& block, Location location, std::int64_t id,
                                     const Point& point) {
  if (!valid_id(builder, block, location, id, "node")) return std::nullopt;
  auto& nodes = builder.model.nodes;
  auto& scope = *builder.scope;
  if (!scope.node_offset) scope.node_offset = free_offset(nodes.id);
  scope.largest_node = std::max(scope.largest_node, id);
  const auto [place, added] = nodes.row_of_id.emplace(id + *scope.node_offset, nodes.size());
  if (!added) {
    builder.error(block, location,
                  fmt::format("node {} is defined twice, first at {}; give one of them another id", id,
                              builder.model.where(nodes.location[place->second])));
    return std::nullopt;
  }
  nodes.id.push_back(id + *scope.node_offset);
  if (!builder.model.instances.empty()) nodes.instance.push_back(scope.instance);
  if (scope.instance >= 0) builder.model.instances[scope.instance].node_offset = *scope.node_offset;
  if (scope.node_set >= 0) builder.add_to_node_set(scope.node_set, place->second);
  nodes.coordinates.push_back(point);
  nodes.location.push_back(location);
  return place->second;
}

std::int32_t add_ground_node(Builder& builder, Location location, const Point& point) {
  auto& nodes = builder.model.nodes;
  const auto row = nodes.size();
  const auto id = std::ranges::max(nodes.id) + 1;
  nodes.row_of_id.emplace(id, row);
  nodes.id.push_back(id);
  if (!builder.model.instances.empty()) nodes.instance.push_back(-1);
  nodes.coordinates.push_back(point);
  nodes.location.push_back(location);
  builder.ground_nodes.insert(row);
  return row;
}

std::int64_t element_offset(Builder& builder) {
  if (!builder.scope->element_offset) {
    std::int64_t offset = 0;
    for (const auto& table : builder.model.elements) offset = std::max(offset, free_offset(table.id));
    builder.scope->element_offset = offset;
  }
  return *builder.scope->element_offset;
}

}  // namespace balocco::deck
