// *NMAP: nodes from coordinates in a local system, or moved, turned and stretched. Reflections of *NCOPY.
#include "deck/node_maps.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "deck/geometry.hpp"
#include "deck/register.hpp"

namespace balocco::deck {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

Point along(const Point& origin, double distance, const Point& direction) {
  Point result = origin;
  for (int i = 0; i < 3; ++i) result[i] += distance * direction[i];
  return result;
}

std::optional<Point> unit(const Point& vector) {
  const double length = norm(vector);
  if (!(length > 0.0)) return std::nullopt;
  return Point{vector[0] / length, vector[1] / length, vector[2] / length};
}

/// Factors of the three coordinates on an optional data line.
Point scale_factors(Builder& builder, const Block& block, std::size_t line) {
  Point scale{1.0, 1.0, 1.0};
  if (line >= block.lines.size()) return scale;
  Row row(builder, block, block.lines[line]);
  for (int i = 0; i < 3; ++i) scale[i] = row.real_or(i, 1.0, "factor");
  row.at_most(3);
  return scale;
}

/// The one number of a data line.
std::optional<double> number(Builder& builder, const Block& block, std::size_t line, const char* what) {
  if (line >= block.lines.size()) {
    builder.error(block, block.location, fmt::format("the {} is missing; add it on data line {}", what, line + 1));
    return std::nullopt;
  }
  Row row(builder, block, block.lines[line]);
  const double value = row.real(0, what);
  row.at_most(1);
  return row.ok() ? std::optional(value) : std::nullopt;
}

/// Points of the data lines of a block: coordinates, or nodes.
class Points {
 public:
  Points(Builder& builder, const Block& block)
      : builder_(builder), block_(block), by_nodes_(block.value("DEFINITION") == "NODES") {}

  bool has(std::size_t line, int index) const {
    return line < block_.lines.size() && Row(builder_, block_, block_.lines[line]).has(by_nodes_ ? index : 3 * index);
  }
  std::optional<Point> at(std::size_t line, int index, const char* what) {
    if (line >= block_.lines.size()) {
      builder_.error(block_, block_.location, fmt::format("{} is missing; add it on data line {}", what, line + 1));
      return std::nullopt;
    }
    Row row(builder_, block_, block_.lines[line]);
    if (by_nodes_) {
      const auto id = row.integer(index, what);
      const auto node = row.ok() ? builder_.require_node(id, block_, row.location()) : std::nullopt;
      return node ? std::optional(builder_.model.nodes.coordinates[*node]) : std::nullopt;
    }
    Point point{};
    for (int i = 0; i < 3; ++i) point[i] = row.real_or(3 * index + i, 0.0, what);
    return row.ok() ? std::optional(point) : std::nullopt;
  }

 private:
  Builder& builder_;
  const Block& block_;
  bool by_nodes_;
};

/// What becomes of a point's coordinates.
using Map = std::function<Point(const Point&)>;

Map in_local_system(const std::string& type, const Point& a, const std::array<Point, 3>& axes) {
  return [type, a, axes](const Point& x) {
    Point local = x;
    if (type == "CYLINDRICAL") local = {x[0] * std::cos(degree * x[1]), x[0] * std::sin(degree * x[1]), x[2]};
    if (type == "SPHERICAL") {
      const double across = x[0] * std::cos(degree * x[2]);
      local = {across * std::cos(degree * x[1]), across * std::sin(degree * x[1]), x[0] * std::sin(degree * x[2])};
    }
    return along(along(along(a, local[0], axes[0]), local[1], axes[1]), local[2], axes[2]);
  };
}

/// RECTANGULAR, CYLINDRICAL, SPHERICAL and DIAMOND: points a, b and c, d; the third line scales the coordinates that are given.
Map system_map(Builder& builder, const Block& block, const std::string& type) {
  Points points(builder, block);
  const auto a = points.at(0, 0, "point a");
  if (!a) return {};
  const auto scale = scale_factors(builder, block, 2);
  const auto scaled = [scale](Map map) -> Map {
    return [scale, map = std::move(map)](const Point& x) { return map({scale[0] * x[0], scale[1] * x[1], scale[2] * x[2]}); };
  };
  if (type == "RECTANGULAR" && !points.has(0, 1) && !points.has(1, 0))
    return scaled(in_local_system(type, *a, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
  const auto b = points.at(0, 1, "point b"), c = points.at(1, 0, "point c");
  if (!b || !c) return {};
  std::optional<std::array<Point, 3>> axes;
  if (type == "DIAMOND") {
    const auto d = points.at(1, 1, "point d");
    if (!d) return {};
    const auto x = unit(subtract(*b, *a)), y = unit(subtract(*c, *a)), z = unit(subtract(*d, *a));
    if (x && y && z && dot(cross(*x, *y), *z) != 0.0) axes = {*x, *y, *z};
  } else if (const auto of_points = axes_of_points(*a, *b, *c); of_points && type == "RECTANGULAR") {
    axes = of_points;
  } else if (of_points) {  // the line from a to b is the third axis, c shows where the first one points
    axes = {(*of_points)[1], (*of_points)[2], (*of_points)[0]};
  }
  if (!axes) {
    builder.error(block, block.location, "the points that define the system lie on a line, or in a plane; give others");
    return {};
  }
  return scaled(in_local_system(type, *a, *axes));
}

Map rotation_map(Builder& builder, const Block& block) {
  Points points(builder, block);
  const auto a = points.at(0, 0, "point a of the axis"), b = points.at(0, 1, "point b of the axis"),
             c = points.at(1, 0, "point c, the centre");
  const auto angle = number(builder, block, 2, "angle in degrees");
  if (!a || !b || !c || !angle) return {};
  const auto axis = unit(subtract(*b, *a));
  if (!axis) {
    builder.error(block, block.location, "points a and b of the axis coincide; give two different points");
    return {};
  }
  return [shift = Shift{.translation = {}, .centre = *c, .rotation = rotation_about(*axis, degree * *angle)}](const Point& x) {
    return shift.move(x);
  };
}

Map translation_map(Builder& builder, const Block& block) {
  Points points(builder, block);
  const auto a = points.at(0, 0, "point a of the axis"), b = points.at(0, 1, "point b of the axis");
  const auto distance = number(builder, block, 1, "distance");
  if (!a || !b || !distance) return {};
  const auto axis = unit(subtract(*b, *a));
  if (!axis) {
    builder.error(block, block.location, "points a and b of the axis coincide; give two different points");
    return {};
  }
  return [distance = *distance, axis = *axis](const Point& x) { return along(x, distance, axis); };
}

Map scale_map(Builder& builder, const Block& block) {
  Points points(builder, block);
  const auto a = points.at(0, 0, "point a");
  if (!a) return {};
  return [a = *a, scale = scale_factors(builder, block, 1)](const Point& x) {
    Point result{};
    for (int i = 0; i < 3; ++i) result[i] = a[i] + scale[i] * (x[i] - a[i]);
    return result;
  };
}

void map_nodes(Builder& builder, const Block& block) {
  std::vector<std::int32_t> nodes;
  if (!builder.nodes_of(block.value("NSET"), block, block.location, nodes)) return;
  const std::string type = block.value("TYPE");
  const Map map = type == "ROTATION"      ? rotation_map(builder, block)
                  : type == "TRANSLATION" ? translation_map(builder, block)
                  : type == "SCALE"       ? scale_map(builder, block)
                                          : system_map(builder, block, type);
  if (!map) return;
  for (const auto row : nodes) builder.model.nodes.coordinates[row] = map(builder.model.nodes.coordinates[row]);
}

const RegisterKeyword nmap{{.keyword = "NMAP",
                            .phase = Phase::nodes,
                            .parameters = {required(name("NSET")),
                                           required(choice("TYPE", {"RECTANGULAR", "CYLINDRICAL", "SPHERICAL", "DIAMOND",
                                                                    "ROTATION", "TRANSLATION", "SCALE"})),
                                           choice("DEFINITION", {"COORDINATES", "NODES"})},
                            .handler = map_nodes}};

}  // namespace

std::function<Point(const Point&)> reflection_of(Builder& builder, const Block& block) {
  Points points(builder, block);
  const std::string kind = block.value("REFLECT");
  const auto a = points.at(0, 0, "point a");
  if (!a) return {};
  if (kind == "POINT") return [a = *a](const Point& x) { return Point{2.0 * a[0] - x[0], 2.0 * a[1] - x[1], 2.0 * a[2] - x[2]}; };
  const auto b = points.at(0, 1, "point b");
  if (!b) return {};
  const auto in_line = unit(subtract(*b, *a));
  if (kind == "LINE" && in_line)
    return [a = *a, direction = *in_line](const Point& x) {
      const Point foot = along(a, dot(subtract(x, a), direction), direction);
      return Point{2.0 * foot[0] - x[0], 2.0 * foot[1] - x[1], 2.0 * foot[2] - x[2]};
    };
  const auto c = kind == "MIRROR" ? points.at(1, 0, "point c") : std::nullopt;
  if (kind == "MIRROR" && !c) return {};
  const auto normal = c ? unit(cross(subtract(*b, *a), subtract(*c, *a))) : std::nullopt;
  if (normal) return [a = *a, normal = *normal](const Point& x) { return along(x, -2.0 * dot(subtract(x, a), normal), normal); };
  builder.error(block, block.location, "the points of the line or plane of reflection coincide, or lie on a line; give others");
  return {};
}

std::function<Point(const Point&)> pole_of(Builder& builder, const Block& block) {
  if (block.lines.empty()) {
    builder.error(block, block.location,
                  "the pole is missing; add a data line with its node, or with its coordinates in fields 2 to 4");
    return {};
  }
  Row row(builder, block, block.lines[0]);
  Point pole{};
  if (row.has(0)) {
    const auto node = builder.require_node(row.integer(0, "pole node"), block, row.location());
    if (!node) return {};
    pole = builder.model.nodes.coordinates[*node];
  } else {
    for (int i = 0; i < 3; ++i) pole[i] = row.real(1 + i, "coordinate of the pole");
  }
  row.at_most(4);
  if (!row.ok()) return {};
  return [pole](const Point& x) { return Point{2.0 * x[0] - pole[0], 2.0 * x[1] - pole[1], 2.0 * x[2] - pole[2]}; };
}

}  // namespace balocco::deck
