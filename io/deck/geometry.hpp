// Geometry of the mesh generation and coordinate-system keywords.
#pragma once

#include <array>
#include <optional>

#include "deck/builder.hpp"

namespace balocco::deck {

Point between(const Point& from, const Point& to, double fraction);
Point subtract(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
double dot(const Point& a, const Point& b);
double norm(const Point& a);

/// Orthonormal axes: the first from `origin` to `first`, the second in the plane of `second`; none if the points lie on
/// a line.
std::optional<std::array<Point, 3>> axes_of_points(const Point& origin, const Point& first, const Point& second);

/// Any two directions that make a right-handed orthonormal triad with the unit vector `axis` as the third.
std::array<Point, 3> axes_about(const Point& axis);

/// Arc from a point to another about a centre.
struct Circle {
  Point centre, first, second;  // `first`: centre to start, `second`: perpendicular, towards the end, as long
  double angle = 0.0;

  Point point(double fraction) const;
};

/// Centre of *NGEN, LINE=C from fields 3 (node) or 4-6 (point), with the normal in fields 7-9 where needed.
std::optional<Circle> circle_of(Builder& builder, const Block& block, Row& row, const Point& from, const Point& to);

/// Fraction of the way of the k-th of n intervals whose lengths grow by the factor 1 / bias.
double biased(std::int64_t k, std::int64_t n, double bias);

/// Translation, then rotation about an axis (*NCOPY, SHIFT).
struct Shift {
  Point translation{}, centre{};
  std::array<Point, 3> rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  Point move(const Point& point) const;
};
std::optional<Shift> shift_of(Builder& builder, const Block& block);

/// Rotation by `angle` (radians) about the unit vector `axis`.
std::array<Point, 3> rotation_about(const Point& axis, double angle);

/// Reads "ax, ay, az, bx, by, bz, angle in degrees" and turns `centre` and `rotation` accordingly; told if it cannot
/// be.
bool read_rotation(Row& row, Point& centre, std::array<Point, 3>& rotation);

}  // namespace balocco::deck
