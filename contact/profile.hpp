// Plane geometry of a rigid profile: signed distance and outward normal from a connected chain of straight lines and
// arcs.
//
// The outward normal is to the left of the direction in which the chain runs; the distance is positive outside. Lines
// at the ends of an open chain go on straight without end (a road stays flat), arcs stop: beyond the free end of an arc
// there is no body. The nearest piece is chosen by values, ties go to the lower index; the distance is then one formula
// in T, so that dual numbers carry its exact derivative.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "math/dual.hpp"
#include "math/scalar.hpp"
#include "model/model.hpp"

namespace balocco {

using PlanePoint = std::array<double, 2>;

template <class T>
struct ProfilePoint {
  T distance;               // negative inside
  std::array<T, 2> normal;  // unit, outward
};

class Profile {
 public:
  Profile() = default;
  /// `segments` is connected, end to start; lines of no length are skipped.
  explicit Profile(std::span<const ProfileSegment> segments);

  bool empty() const { return pieces_.empty(); }

  /// True only if the point lies above everything: told without a search for open roads whose two ends are parallel.
  bool surely_outside(const PlanePoint& point) const { return point[0] * up_[0] + point[1] * up_[1] > top_; }

  /// Whether the nearest point lies where an end of the chain was continued.
  bool past_end(const PlanePoint& point) const;

  template <class T>
  ProfilePoint<T> nearest(const std::array<T, 2>& point) const {
    const Feature feature = find({value_of(point[0]), value_of(point[1])});
    if (feature.corner >= 0) return from_corner(corners_[feature.corner], point);
    const Piece& piece = pieces_[feature.piece];
    return piece.arc ? from_arc(piece, point) : from_line(piece, point);
  }

 private:
  struct Piece {
    bool arc = false;
    PlanePoint start{}, end{};
    PlanePoint direction{}, normal{};  // line: unit; arc: `normal` is the outward one half-way along
    double from = 0.0, to = 0.0;       // line: range of the coordinate along `direction` from `start`
    PlanePoint centre{};
    double radius = 0.0;
    double side = 1.0;  // arc: +1 body inside the circle (turns right), -1 body outside it (turns left)
    bool more_than_half = false, full_circle = false;
  };
  /// The point between two pieces, or at a free end of an arc.
  struct Corner {
    PlanePoint at{};
    PlanePoint normal_sum{};  // of the outward normals of both pieces: tells inside from outside
    bool smooth = false;      // tangents agree: the formulae of the pieces meet
    bool free_end = false;
  };
  struct Feature {
    int piece = 0;
    int corner = -1;  // -1: the piece itself is nearest, or its continuation across a smooth corner
  };

  static Piece make_piece(const ProfileSegment& segment);
  static PlanePoint normal_at(const Piece& piece, const PlanePoint& point);
  static bool sweeps(const Piece& arc, const PlanePoint& arm);
  static double distance_to(const Piece& piece, const PlanePoint& point, int& end);
  Corner make_corner(std::size_t before, std::size_t after, const PlanePoint& at) const;
  void join_ends();
  void find_top();
  Feature find(const PlanePoint& point) const;

  template <class T>
  static ProfilePoint<T> from_line(const Piece& line, const std::array<T, 2>& point) {
    const T distance = (point[0] - line.start[0]) * line.normal[0] + (point[1] - line.start[1]) * line.normal[1];
    return {distance, {T(line.normal[0]), T(line.normal[1])}};
  }

  template <class T>
  static ProfilePoint<T> from_arc(const Piece& arc, const std::array<T, 2>& point) {
    const T x = point[0] - arc.centre[0], y = point[1] - arc.centre[1];
    const T square = x * x + y * y;
    if (value_of(square) == 0.0)  // at the centre every direction is as near: the middle one
      return {x * arc.normal[0] + y * arc.normal[1] - arc.side * arc.radius, {T(arc.normal[0]), T(arc.normal[1])}};
    const T radius = square_root(square);
    const T factor = arc.side / radius;
    return {(radius - arc.radius) * arc.side, {x * factor, y * factor}};
  }

  template <class T>
  static ProfilePoint<T> from_corner(const Corner& corner, const std::array<T, 2>& point) {
    const T x = point[0] - corner.at[0], y = point[1] - corner.at[1];
    const double along = value_of(x) * corner.normal_sum[0] + value_of(y) * corner.normal_sum[1];
    const double sign = corner.free_end || along >= 0.0 ? 1.0 : -1.0;
    const T radius = square_root(x * x + y * y);
    const T factor = sign / radius;
    return {radius * sign, {x * factor, y * factor}};
  }

  std::vector<Piece> pieces_;
  std::vector<Corner> corners_;                           // corner i is the start of piece i; one more ends the last
  PlanePoint up_{};                                       // common outward normal of both ends
  double top_ = std::numeric_limits<double>::infinity();  // how far the chain reaches along `up_`
};

}  // namespace balocco
