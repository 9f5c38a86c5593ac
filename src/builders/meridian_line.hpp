// The carcass line of a section: a symmetric spline through the described points.
#pragma once

#include <array>
#include <vector>

#include "builders/tyre_spec.hpp"

namespace balocco {

/// What is found at one arc length of the right half of the line.
struct LinePoint {
  double radius = 0.0, axial = 0.0;
  std::array<double, 2> normal{};  // (radial, axial), unit, outwards
  double base = 0.0, cap = 0.0;    // rubber outside, linear in arc length between the described points
};

/// Cubic spline over chord length through the points and their mirror images: smooth at the crown, straight at the
/// toes.
class MeridianLine {
 public:
  explicit MeridianLine(const TyreSpec& spec);
  /// Arc length from the crown to the end of a region.
  double region_end(Region region) const { return region_ends_[static_cast<int>(region)]; }
  /// @param arc_length from the crown, 0 to region_end(Region::bead).
  LinePoint at(double arc_length) const;

 private:
  struct Knot {
    double parameter, radius, axial, radius_curvature, axial_curvature;
  };
  void solve_curvatures(double Knot::*value, double Knot::*curvature);
  /// Value and derivative of one coordinate.
  std::array<double, 2> evaluate(double parameter, double Knot::*value, double Knot::*curvature) const;
  double parameter_at(double arc_length) const;

  std::vector<Knot> knots_;                     // from the left toe to the right one
  std::vector<std::array<double, 2>> lengths_;  // (parameter, arc length from the crown) of the right half
  std::vector<std::array<double, 3>> rubber_;   // (arc length, base, cap)
  std::array<double, region_count> region_ends_{};
};

}  // namespace balocco
