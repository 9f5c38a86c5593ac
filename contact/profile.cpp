#include "profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace balocco {

namespace {

PlanePoint operator-(const PlanePoint& a, const PlanePoint& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
double dot(const PlanePoint& a, const PlanePoint& b) {
  return a[0] * b[0] + a[1] * b[1];
}
double cross(const PlanePoint& a, const PlanePoint& b) {
  return a[0] * b[1] - a[1] * b[0];
}
double square_of(const PlanePoint& a) {
  return dot(a, a);
}

// Sine of the turn below which two pieces are tangent: far above round-off, far below what anyone means as a corner.
constexpr double smooth_turn = 1e-9;

}  // namespace

Profile::Profile(std::span<const ProfileSegment> segments) {
  for (const ProfileSegment& segment : segments)
    if (segment.kind == ProfileSegment::Kind::arc || segment.start != segment.end)
      pieces_.push_back(make_piece(segment));
  if (pieces_.empty()) return;
  corners_.resize(pieces_.size() + 1);
  for (std::size_t i = 1; i < pieces_.size(); ++i) corners_[i] = make_corner(i - 1, i, pieces_[i].start);
  join_ends();
  find_top();
}

Profile::Piece Profile::make_piece(const ProfileSegment& segment) {
  Piece piece;
  piece.start = segment.start;
  piece.end = segment.end;
  if (segment.kind == ProfileSegment::Kind::line) {
    const PlanePoint chord = segment.end - segment.start;
    const double length = std::sqrt(square_of(chord));
    piece.direction = {chord[0] / length, chord[1] / length};
    piece.normal = {-piece.direction[1], piece.direction[0]};
    piece.to = length;
    return piece;
  }
  piece.arc = true;
  piece.centre = segment.centre;
  piece.side = segment.counter_clockwise ? -1.0 : 1.0;
  const PlanePoint a = segment.start - segment.centre, b = segment.end - segment.centre;
  piece.radius = std::sqrt(square_of(a));
  piece.full_circle = segment.start == segment.end;
  const double turn = segment.counter_clockwise ? 1.0 : -1.0;
  piece.more_than_half = turn * cross(a, b) < 0.0;
  double angle = std::atan2(turn * cross(a, b), dot(a, b));
  if (angle < 0.0 || piece.full_circle) angle += 2.0 * std::acos(-1.0);
  const double c = std::cos(0.5 * angle), s = turn * std::sin(0.5 * angle), scale = piece.side / piece.radius;
  piece.normal = {scale * (c * a[0] - s * a[1]), scale * (s * a[0] + c * a[1])};
  return piece;
}

PlanePoint Profile::normal_at(const Piece& piece, const PlanePoint& point) {
  if (!piece.arc) return piece.normal;
  const PlanePoint arm = point - piece.centre;
  const double scale = piece.side / std::sqrt(square_of(arm));
  return {scale * arm[0], scale * arm[1]};
}

Profile::Corner Profile::make_corner(std::size_t before, std::size_t after, const PlanePoint& at) const {
  const PlanePoint a = normal_at(pieces_[before], at), b = normal_at(pieces_[after], at);
  return {at, {a[0] + b[0], a[1] + b[1]}, std::abs(cross(a, b)) < smooth_turn && dot(a, b) > 0.0, false};
}

/// Closes a chain that ends where it starts; otherwise lets lines at its ends run on.
void Profile::join_ends() {
  Piece& first = pieces_.front();
  Piece& last = pieces_.back();
  if (first.start == last.end) {
    corners_.front() = corners_.back() = make_corner(pieces_.size() - 1, 0, first.start);
    return;
  }
  if (!first.arc) first.from = -std::numeric_limits<double>::infinity();
  if (!last.arc) last.to = std::numeric_limits<double>::infinity();
  corners_.front() = {first.start, normal_at(first, first.start), false, true};
  corners_.back() = {last.end, normal_at(last, last.end), false, true};
}

/// Between parallel ends that run on to both sides the body lies below the highest point of the chain.
void Profile::find_top() {
  const Piece& first = pieces_.front();
  const Piece& last = pieces_.back();
  if (!std::isinf(first.from) || !std::isinf(last.to) || first.normal != last.normal) return;
  up_ = first.normal;
  double top = dot(up_, first.start), extent = std::hypot(first.start[0], first.start[1]);
  for (const Piece& piece : pieces_) {
    top = std::max(top, dot(up_, piece.end));
    extent = std::max(extent, std::hypot(piece.end[0], piece.end[1]));
    if (piece.arc && sweeps(piece, up_)) top = std::max(top, dot(up_, piece.centre) + piece.radius);
  }
  top_ = top + 1e-12 * extent;  // far above round-off in the height of a point
}

/// Whether the direction of `arm` from the centre lies within the arc.
bool Profile::sweeps(const Piece& arc, const PlanePoint& arm) {
  if (arc.full_circle) return true;
  const bool past_start = -arc.side * cross(arc.start - arc.centre, arm) >= 0.0;
  const bool before_end = -arc.side * cross(arm, arc.end - arc.centre) >= 0.0;
  return arc.more_than_half ? past_start || before_end : past_start && before_end;
}

/// Square of the distance; `end` tells what is nearest: 0 the piece's inside, -1 its start, 1 its end.
double Profile::distance_to(const Piece& piece, const PlanePoint& point, int& end) {
  end = 0;
  if (!piece.arc) {
    const PlanePoint arm = point - piece.start;
    const double along = dot(arm, piece.direction);
    if (along >= piece.from && along <= piece.to) {
      const double height = dot(arm, piece.normal);
      return height * height;
    }
    end = along < piece.from ? -1 : 1;
    return end < 0 ? square_of(arm) : square_of(point - piece.end);
  }
  const PlanePoint arm = point - piece.centre;
  if (sweeps(piece, arm)) {
    const double height = std::sqrt(square_of(arm)) - piece.radius;
    return height * height;
  }
  const double to_start = square_of(point - piece.start), to_end = square_of(point - piece.end);
  end = to_start <= to_end ? -1 : 1;
  return end < 0 ? to_start : to_end;
}

bool Profile::past_end(const PlanePoint& point) const {
  const int piece = find(point).piece;
  const Piece& line = pieces_[piece];
  if (line.arc) return false;
  const PlanePoint arm = point - line.start, chord = line.end - line.start;
  const double along = dot(arm, line.direction);
  return (std::isinf(line.from) && along < 0.0) || (std::isinf(line.to) && along > dot(chord, line.direction));
}

Profile::Feature Profile::find(const PlanePoint& point) const {
  Feature nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
    int end = 0;
    const double square = distance_to(pieces_[i], point, end);
    if (!(square < least)) continue;
    least = square;
    const int corner = end < 0 ? i : i + 1;
    const bool on_piece = end == 0 || corners_[corner].smooth || square == 0.0;
    nearest = {i, on_piece ? -1 : corner};
  }
  return nearest;
}

}  // namespace balocco
