// Curves of the car's shape: through a few described points, straight or smooth.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "math/tensor.hpp"

namespace balocco::car {

using Vector = Vector3<double>;

inline double length(const Vector& v) {
  return std::sqrt(dot(v, v));
}

inline Vector unit(const Vector& v) {
  return (1.0 / length(v)) * v;
}

/// On the other side of the car.
inline Vector mirrored(const Vector& v) {
  return {v[0], -v[1], v[2]};
}

/// A function y(x) through rows (x, y): piecewise cubic with the slopes of parabolas through three neighbours, which have no
/// overshoot where the rows run evenly; straight beyond the ends. Rows in rising order of x.
class Graph {
 public:
  Graph() = default;
  explicit Graph(std::vector<std::array<double, 2>> rows);
  double operator()(double x) const;
  double first() const { return rows_.front()[0]; }
  double last() const { return rows_.back()[0]; }

 private:
  std::vector<std::array<double, 2>> rows_;
  std::vector<double> slopes_;
};

/// A line in space by its arc length: straight from point to point.
class Curve {
 public:
  explicit Curve(std::vector<Vector> points);
  double length() const { return lengths_.back(); }
  Vector at(double arc_length) const;
  /// Arc lengths of the described points.
  const std::vector<double>& corners() const { return lengths_; }
  /// A smooth line, told by enough points of it for any mesh.
  static Curve of(double from, double to, const std::function<Vector(double)>& place);
  /// A smooth line through a few points (centripetal Catmull-Rom).
  static Curve through(const std::vector<Vector>& points);

 private:
  std::vector<Vector> points_;
  std::vector<double> lengths_;
};

/// Parameters from the first break to the last at most `size` apart, every break among them.
std::vector<double> stations(const std::vector<double>& breaks, double size);

}  // namespace balocco::car
