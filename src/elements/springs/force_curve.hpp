// The force of a spring over its relative displacement, or of a dashpot over its relative velocity.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace balocco {

/// A straight line through the origin, or a table of (argument, force): straight between its points, constant beyond its ends
/// (Abaqus Analysis User's Guide, "Springs" and "Dashpots"). Bump and rebound may differ: nothing asks for symmetry.
class ForceCurve {
 public:
  /// @param table (argument, force) with rising arguments; empty: force = slope * argument.
  ForceCurve(double slope, std::span<const std::array<double, 2>> table);

  struct Value {
    double force = 0.0, slope = 0.0;
  };
  /// At a corner the slope is that of the piece on the right, at the last point of the table that of the piece that ends there: a
  /// table that starts at rest is stiff from the start.
  Value at(double argument) const;
  /// Integral of the force from 0 to `argument`.
  double integral(double argument) const;

  /// Bounds over all arguments.
  double steepest() const;
  double largest_force() const;  // of the table; 0 for a straight line, which has no bound
  /// Largest pull per length of a spring of that natural length: what makes a taut spring stiff sideways.
  double tautness(double natural_length) const;

 private:
  double integral_from_first_point(double argument) const;

  double slope_;
  std::vector<std::array<double, 2>> table_;
};

}  // namespace balocco
