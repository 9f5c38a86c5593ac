#include "deck/geometry.hpp"

#include <cmath>
#include <numbers>

namespace balocco::deck {

Point between(const Point& from, const Point& to, double fraction) {
  Point result;
  for (int i = 0; i < 3; ++i) result[i] = from[i] + fraction * (to[i] - from[i]);
  return result;
}

Point subtract(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double norm(const Point& a) {
  return std::sqrt(dot(a, a));
}

std::optional<std::array<Point, 3>> axes_of_points(const Point& origin, const Point& first, const Point& second) {
  Point x = subtract(first, origin);
  const Point in_plane = subtract(second, origin);
  Point z = cross(x, in_plane);
  // Three points are taken to lie on a line when the sine of the angle between them is at the level of round-off.
  if (!(norm(z) > 1e-12 * norm(x) * norm(in_plane))) return std::nullopt;
  for (Point* axis : {&x, &z}) {
    const double length = norm(*axis);
    for (double& component : *axis) component /= length;
  }
  return std::array<Point, 3>{x, cross(z, x), z};
}

std::array<Point, 3> axes_about(const Point& axis) {
  // Start from the global direction that is most nearly perpendicular.
  Point start{};
  int smallest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axis[i]) < std::abs(axis[smallest])) smallest = i;
  }
  start[smallest] = 1.0;
  Point second = cross(axis, start);
  const double length = norm(second);
  for (double& component : second) component /= length;
  return {cross(second, axis), second, axis};
}

Point Circle::point(double fraction) const {
  const double c = std::cos(fraction * angle), s = std::sin(fraction * angle);
  Point result;
  for (int i = 0; i < 3; ++i) result[i] = centre[i] + c * first[i] + s * second[i];
  return result;
}

std::optional<Circle> circle_of(Builder& builder, const Block& block, Row& row, const Point& from, const Point& to) {
  Circle circle;
  if (row.has(3)) {
    const auto node = builder.require_node(row.integer(3, "centre node"), block, row.location());
    if (!node) return std::nullopt;
    circle.centre = builder.model.nodes.coordinates[*node];
  } else {
    for (int i = 0; i < 3; ++i) circle.centre[i] = row.real(4 + i, "centre of the circle");
  }
  circle.first = subtract(from, circle.centre);
  const Point last = subtract(to, circle.centre);
  Point normal = cross(circle.first, last);
  if (row.has(7)) {
    for (int i = 0; i < 3; ++i) normal[i] = row.real(7 + i, "normal of the circle's plane");
  }
  if (!row.ok()) return std::nullopt;
  const double length = norm(normal), radius = norm(circle.first);
  // 1e-4: hand-written coordinates carry five or six digits.
  if (!(length > 0.0) || std::abs(norm(last) - radius) > 1e-4 * radius) {
    row.error(
        "the two end nodes and the centre define no circle; correct the centre (equal distances to both ends), and "
        "give "
        "the normal when the three lie on a line");
    return std::nullopt;
  }
  for (double& component : normal) component /= length;
  circle.second = cross(normal, circle.first);
  circle.angle = std::atan2(dot(last, circle.second), dot(last, circle.first));
  if (circle.angle <= 0.0) circle.angle += 2.0 * std::numbers::pi;
  return circle;
}

double biased(std::int64_t k, std::int64_t n, double bias) {
  if (bias == 1.0) return static_cast<double>(k) / static_cast<double>(n);
  const double ratio = 1.0 / bias;
  return (std::pow(ratio, static_cast<double>(k)) - 1.0) / (std::pow(ratio, static_cast<double>(n)) - 1.0);
}

Point Shift::move(const Point& point) const {
  Point result = centre;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[i] += rotation[i][j] * (point[j] + translation[j] - centre[j]);
  }
  return result;
}

std::optional<Shift> shift_of(Builder& builder, const Block& block) {
  Shift shift;
  bool good = true;
  if (!block.lines.empty()) {
    Row row(builder, block, block.lines[0]);
    for (int i = 0; i < 3; ++i) shift.translation[i] = row.real_or(i, 0.0, "translation");
    row.at_most(3);
    good = row.ok();
  }
  if (block.lines.size() > 1) {
    Row row(builder, block, block.lines[1]);
    good = read_rotation(row, shift.centre, shift.rotation) && good;
  }
  return good ? std::optional(shift) : std::nullopt;
}

std::array<Point, 3> rotation_about(const Point& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto& [x, y, z] = axis;
  return {{{c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s},
           {y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s},
           {z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)}}};
}

bool read_rotation(Row& row, Point& centre, std::array<Point, 3>& rotation) {
  Point first{}, axis{};
  for (int i = 0; i < 3; ++i) {
    first[i] = row.real_or(i, 0.0, "first point of the rotation axis");
    axis[i] = row.real_or(3 + i, 0.0, "second point of the rotation axis") - first[i];
  }
  const double angle = row.real_or(6, 0.0, "angle of rotation in degrees") * std::numbers::pi / 180.0;
  row.at_most(7);
  if (!row.ok()) return false;
  const double length = norm(axis);
  if (length == 0.0) {
    row.error("the two points of the rotation axis coincide; give two different points");
    return false;
  }
  for (double& component : axis) component /= length;
  centre = first;
  rotation = rotation_about(axis, angle);
  return true;
}

}  // namespace balocco::deck
