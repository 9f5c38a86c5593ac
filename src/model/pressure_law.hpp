// Pressure of soft contact as a function of the overclosure of the surfaces: value, slope and the work done on the way.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace balocco {

/// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE. Of an overclosure d:
///   hard         no law: the enforcement is the procedure's own;
///   linear       k d where d > 0; with a tension s, of nodes, k d (1/2 + arctan(d / e) / pi), e = pi s / k (mesh_contact.hpp);
///   exponential  p0 / (e - 1) x (exp(x) - 1) with x = 1 + d / c0 where x > 0: zero at the clearance c0, p0 at the clearance zero
///                (Abaqus Theory Guide, "Contact pressure definition");
///   table        straight lines between the rows, zero before the first, on with the last slope behind the last.
struct PressureLaw {
  enum class Kind { hard, linear, exponential, table };

  Kind kind = Kind::hard;
  double slope = 0.0;                // linear: k, pressure per length
  double tension = 0.0;              // linear: s, the pull at great clearance (CalculiX), a pressure
  double spring_clearance = 0.0;     // and the clearance up to which it pulls; 0: a thousandth of the edge of a node's area
  double clearance = 0.0;            // exponential: c0
  double pressure = 0.0;             // exponential: p0
  double greatest_slope = 0.0;       // exponential, in explicit steps; 0: that of the automatic penalty stiffness
  struct Row {
    double overclosure = 0.0, pressure = 0.0;
    bool operator==(const Row&) const = default;
  };
  std::vector<Row> rows;  // table: two or more, the overclosures ascending, the first pressure zero

  struct Value {
    double pressure = 0.0, slope = 0.0;  // the slope by the overclosure, >= 0
  };

  bool is_soft() const { return kind != Kind::hard; }
  /// Up to which there is no pressure.
  double start() const;
  /// Behind `straight_from` the law goes on with the slope that it has there. Not of hard laws; linear ones here have no tension.
  Value at(double overclosure, double straight_from = std::numeric_limits<double>::infinity()) const;
  /// Work per area on the way from start() to an overclosure.
  double energy(double overclosure, double straight_from = std::numeric_limits<double>::infinity()) const;
  /// Mean of the pressure between two overclosures.
  double mean_pressure(double from, double to, double straight_from) const;
  /// The greatest slope that a law has anywhere: not of exponential ones, which have none.
  double steepest() const;
  /// Overclosure at which an exponential law has a slope; start() where that is not positive.
  double where_slope_is(double slope) const;

  bool operator==(const PressureLaw&) const = default;
};

}  // namespace balocco
