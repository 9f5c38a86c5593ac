#include "deck/profile.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace balocco::deck {

namespace {

using Vector2 = std::array<double, 2>;

Vector2 operator-(const Vector2& a, const Vector2& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
Vector2 along(const Vector2& from, const Vector2& direction, double s) {
  return {from[0] + s * direction[0], from[1] + s * direction[1]};
}
double dot2(const Vector2& a, const Vector2& b) {
  return a[0] * b[0] + a[1] * b[1];
}
double cross2(const Vector2& a, const Vector2& b) {
  return a[0] * b[1] - a[1] * b[0];
}
double length(const Vector2& a) {
  return std::hypot(a[0], a[1]);
}
Vector2 left_of(const Vector2& a) {
  return {-a[1], a[0]};
}
Vector2 unit(const Vector2& a) {
  return {a[0] / length(a), a[1] / length(a)};
}

/// Unit direction of travel at a point of a segment.
Vector2 tangent(const ProfileSegment& segment, const Vector2& at) {
  if (segment.kind == ProfileSegment::Kind::line) return unit(segment.end - segment.start);
  const Vector2 turned = left_of(unit(at - segment.centre));
  return segment.counter_clockwise ? turned : Vector2{-turned[0], -turned[1]};
}

/// The curve at distance `offset` to the left of a segment: a line through `point`, or a circle.
struct Offset {
  bool line = true;
  Vector2 point{}, direction{};
  double radius = 0.0;
};

Offset offset_of(const ProfileSegment& segment, double offset) {
  if (segment.kind == ProfileSegment::Kind::line) {
    const Vector2 direction = unit(segment.end - segment.start);
    return {true, along(segment.start, left_of(direction), offset), direction, 0.0};
  }
  const double radius = length(segment.start - segment.centre);
  return {false, segment.centre, {}, segment.counter_clockwise ? radius - offset : radius + offset};
}

std::vector<Vector2> line_and_circle(const Offset& line, const Offset& circle) {
  const Vector2 to_centre = circle.point - line.point;
  const double s = dot2(to_centre, line.direction), distance = cross2(line.direction, to_centre);
  const double half = circle.radius * circle.radius - distance * distance;
  if (half < 0.0) return {};
  return {along(line.point, line.direction, s - std::sqrt(half)),
          along(line.point, line.direction, s + std::sqrt(half))};
}

std::vector<Vector2> circle_and_circle(const Offset& a, const Offset& b) {
  const Vector2 between = b.point - a.point;
  const double d = length(between);
  if (d == 0.0) return {};
  const double s = (d * d + a.radius * a.radius - b.radius * b.radius) / (2.0 * d);
  const double half = a.radius * a.radius - s * s;
  if (half < 0.0) return {};
  const Vector2 foot = along(a.point, unit(between), s);
  return {along(foot, left_of(unit(between)), std::sqrt(half)), along(foot, left_of(unit(between)), -std::sqrt(half))};
}

std::vector<Vector2> intersections(const Offset& a, const Offset& b) {
  if (a.line && b.line) {
    const double sine = cross2(a.direction, b.direction);
    if (sine == 0.0) return {};
    return {along(a.point, a.direction, cross2(b.point - a.point, b.direction) / sine)};
  }
  if (a.line) return line_and_circle(a, b);
  if (b.line) return line_and_circle(b, a);
  return circle_and_circle(a, b);
}

/// Point of the segment (or of its continuation) nearest to the centre of a tangent arc.
Vector2 touching_point(const ProfileSegment& segment, const Vector2& centre) {
  if (segment.kind == ProfileSegment::Kind::line) {
    const Vector2 direction = unit(segment.end - segment.start);
    return along(segment.start, direction, dot2(centre - segment.start, direction));
  }
  const double radius = length(segment.start - segment.centre);
  return along(segment.centre, unit(centre - segment.centre), radius);
}

/// Angle travelled on an arc from its start to a point, in its direction of travel, 0 .. 2 pi.
double travelled(const ProfileSegment& arc, const Vector2& to) {
  const Vector2 a = arc.start - arc.centre, b = to - arc.centre;
  double angle = std::atan2(cross2(a, b), dot2(a, b));
  if (!arc.counter_clockwise) angle = -angle;
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

bool inside(const ProfileSegment& segment, const Vector2& point) {
  if (segment.kind == ProfileSegment::Kind::line) {
    const Vector2 whole = segment.end - segment.start;
    const double s = dot2(point - segment.start, whole) / dot2(whole, whole);
    return s >= 0.0 && s <= 1.0;
  }
  return travelled(segment, point) <= travelled(segment, segment.end);
}

std::optional<ProfileSegment> fillet(const ProfileSegment& first, const ProfileSegment& second, double radius,
                                     bool left) {
  const double offset = left ? radius : -radius;
  const Offset a = offset_of(first, offset), b = offset_of(second, offset);
  if ((!a.line && a.radius <= 0.0) || (!b.line && b.radius <= 0.0)) return std::nullopt;
  std::optional<Vector2> centre;
  for (const auto& candidate : intersections(a, b)) {
    if (!centre || length(candidate - first.end) < length(*centre - first.end)) centre = candidate;
  }
  if (!centre) return std::nullopt;
  const ProfileSegment arc{ProfileSegment::Kind::arc, touching_point(first, *centre), touching_point(second, *centre), *centre, left};
  return inside(first, arc.start) && inside(second, arc.end) ? std::optional(arc) : std::nullopt;
}

ProfileSegment segment_of(Row& row, const std::string& word, const Vector2& start) {
  ProfileSegment segment;
  segment.start = start;
  segment.end = {row.real(1, "first coordinate of the end"), row.real(2, "second coordinate of the end")};
  if (word == "CIRCL") {
    segment.kind = ProfileSegment::Kind::arc;
    segment.centre = {row.real(3, "first coordinate of the centre"), row.real(4, "second coordinate of the centre")};
    segment.counter_clockwise = cross2(segment.start - segment.centre, segment.end - segment.centre) > 0.0;
  }
  row.at_most(word == "CIRCL" ? 5 : 3);
  if (!row.ok()) return segment;
  if (!(length(segment.end - segment.start) > 0.0)) row.error("the segment has no length; correct its end");
  const double radius = length(segment.start - segment.centre);
  // 1e-4: hand-written coordinates carry five or six digits.
  if (segment.kind == ProfileSegment::Kind::arc && std::abs(length(segment.end - segment.centre) - radius) > 1e-4 * radius) {
    row.error(fmt::format("the arc's ends have distances {} and {} from its centre; make them equal", radius,
                          length(segment.end - segment.centre)));
  }
  return segment;
}

}  // namespace

std::vector<ProfileSegment> read_profile(Builder& builder, const Block& block, std::span<const DataLine> lines) {
  std::vector<ProfileSegment> profile;
  std::optional<Vector2> point;
  for (const auto& line : lines) {
    Row row(builder, block, line);
    const std::string word = row.name(0);
    if (word == "START" && !point) {
      point = Vector2{row.real(1, "first coordinate"), row.real(2, "second coordinate")};
      row.at_most(3);
    } else if ((word == "LINE" || word == "CIRCL") && point) {
      profile.push_back(segment_of(row, word, *point));
      point = profile.back().end;
    } else {
      row.error(point ? fmt::format("'{}' is not supported here; a profile goes on with LINE or CIRCL", word)
                      : fmt::format("'{}' found; a profile begins with START", word));
    }
    if (!row.ok()) return {};
  }
  if (profile.empty()) builder.error(block, block.location, "the profile has no segment; add LINE or CIRCL lines");
  return profile;
}

std::vector<ProfileSegment> round_corners(const std::vector<ProfileSegment>& profile, double radius) {
  std::vector<ProfileSegment> result;
  for (const auto& next : profile) {
    if (result.empty() || radius <= 0.0) {
      result.push_back(next);
      continue;
    }
    ProfileSegment& last = result.back();
    const double turn = cross2(tangent(last, last.end), tangent(next, next.start));
    // Already smooth to the digits of a deck: nothing to round.
    if (std::abs(turn) < 1e-6 && dot2(tangent(last, last.end), tangent(next, next.start)) > 0.0) {
      result.push_back(next);
      continue;
    }
    const auto arc = fillet(last, next, radius, turn > 0.0);
    if (!arc) {
      throw std::invalid_argument(
          fmt::format("the corner at ({}, {}) has no room for it", next.start[0], next.start[1]));
    }
    last.end = arc->start;
    result.push_back(*arc);
    result.push_back(next);
    result.back().start = arc->end;
  }
  return result;
}

}  // namespace balocco::deck
