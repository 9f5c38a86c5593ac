#include "builders/car/body_shape.hpp"

#include <algorithm>
#include <cmath>

namespace balocco::car {
namespace {

/// From 0 to 1 between a and b, with level ends.
double smooth_step(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Vector BodyShape::skin_normal(double x, double z) const {
  constexpr double step = 1.0;  // mm
  const double along = (side(x + step, z) - side(x - step, z)) / (2.0 * step),
               up = (side(x, z + step) - side(x, z - step)) / (2.0 * step);
  return unit(Vector{-along, 1.0, -up});
}

Vector BodyShape::skin(double x, double z, double depth) const {
  return Vector{x, side(x, z), z} - depth * skin_normal(x, z);
}

double BodyShape::rear_height(double x) const {
  return body_.floor_height + (body_.rear_floor_height - body_.floor_height) * smooth_step(body_.kick_front, body_.kick_rear, x);
}

double BodyShape::well(double x, double y) const {
  constexpr double wall = 0.25;  // of the radius over which its side slopes
  const double distance = std::hypot(x - body_.well_centre, y) / body_.well_radius;
  return body_.well_depth * (1.0 - smooth_step(1.0 - wall, 1.0, distance));
}

double BodyShape::floor_half_width(double x) const {
  return body_.floor_half_width -
         (body_.floor_half_width - body_.rear_floor_half_width) * smooth_step(body_.kick_front, body_.kick_rear - 200.0, x);
}

Vector BodyShape::floor(double x, double station) const {
  const double height = body_.tunnel_height * (1.0 - smooth_step(body_.kick_front + 200.0, body_.kick_front, x));
  const std::array<double, 6> aside{floor_half_width(x), body_.tunnel_foot,  body_.tunnel_crown,
                                    -body_.tunnel_crown, -body_.tunnel_foot, -floor_half_width(x)};
  const std::array<double, 6> up{0.0, 0.0, height, height, 0.0, 0.0};
  const int piece = std::clamp(static_cast<int>(station), 0, 4);
  const double part = station - piece, y = aside[piece] + part * (aside[piece + 1] - aside[piece]);
  return {x, y, floor_height(x, y) + up[piece] + part * (up[piece + 1] - up[piece])};
}

Curve BodyShape::firewall_line(double y) const {
  auto points = body_.firewall;
  for (auto& point : points) point[1] = y;
  return Curve::through(points);
}

Vector BodyShape::firewall(double up, double station) const {
  const auto foot = floor(body_.firewall.front()[0], station);
  const auto line = firewall_line(foot[1]);
  auto place = line.at(up * line.length());
  place[2] += (foot[2] - body_.floor_height) * std::max(0.0, 1.0 - 2.0 * up);  // the tunnel runs out up the wall
  return place;
}

Vector BodyShape::arch_point(double wheel_x, double radius, double angle, double y) const {
  return {wheel_x + radius * std::cos(angle), y, profile_.wheel_height + radius * std::sin(angle)};
}

double BodyShape::arch_height(double wheel_x, double x, double otherwise) const {
  const double aside = std::abs(x - wheel_x), radius = profile_.arch_radius;
  return aside >= radius ? otherwise : std::max(otherwise, profile_.wheel_height + std::sqrt(radius * radius - aside * aside));
}

}  // namespace balocco::car
