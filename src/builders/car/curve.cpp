#include "builders/car/curve.hpp"

#include <algorithm>

namespace balocco::car {

Graph::Graph(std::vector<std::array<double, 2>> rows) : rows_(std::move(rows)), slopes_(rows_.size(), 0.0) {
  const auto count = static_cast<int>(rows_.size());
  const auto slope = [&](int i) { return (rows_[i + 1][1] - rows_[i][1]) / (rows_[i + 1][0] - rows_[i][0]); };
  for (int i = 0; i < count && count > 1; ++i) {
    if (i == 0 || i + 1 == count) {
      slopes_[i] = slope(i == 0 ? 0 : count - 2);
      continue;
    }
    const double before = rows_[i][0] - rows_[i - 1][0], after = rows_[i + 1][0] - rows_[i][0];
    slopes_[i] = (after * slope(i - 1) + before * slope(i)) / (before + after);
  }
}

double Graph::operator()(double x) const {
  if (x <= first()) return rows_.front()[1] + slopes_.front() * (x - first());
  if (x >= last()) return rows_.back()[1] + slopes_.back() * (x - last());
  const auto after = std::upper_bound(rows_.begin(), rows_.end(), x, [](double value, const auto& row) { return value < row[0]; });
  const auto i = static_cast<std::size_t>(after - rows_.begin()) - 1;
  const double span = rows_[i + 1][0] - rows_[i][0], t = (x - rows_[i][0]) / span, u = 1.0 - t;
  return (1.0 + 2.0 * t) * u * u * rows_[i][1] + (1.0 + 2.0 * u) * t * t * rows_[i + 1][1] +
         span * t * u * (u * slopes_[i] - t * slopes_[i + 1]);
}

Curve::Curve(std::vector<Vector> points) : points_(std::move(points)), lengths_{0.0} {
  for (std::size_t i = 1; i < points_.size(); ++i) lengths_.push_back(lengths_.back() + car::length(points_[i] - points_[i - 1]));
}

Vector Curve::at(double arc_length) const {
  const auto after = std::upper_bound(lengths_.begin(), lengths_.end(), arc_length);
  const auto i = std::clamp<std::ptrdiff_t>(after - lengths_.begin() - 1, 0, static_cast<std::ptrdiff_t>(points_.size()) - 2);
  const double part = (arc_length - lengths_[i]) / (lengths_[i + 1] - lengths_[i]);
  return points_[i] + part * (points_[i + 1] - points_[i]);
}

Curve Curve::of(double from, double to, const std::function<Vector(double)>& place) {
  constexpr int pieces = 200;  // of 4 m at most: a chord leaves the curve by less than its sheet is thick
  std::vector<Vector> points;
  for (int i = 0; i <= pieces; ++i) points.push_back(place(from + (to - from) * i / pieces));
  return Curve(std::move(points));
}

Curve Curve::through(const std::vector<Vector>& points) {
  std::vector<double> knots{0.0};  // square roots of the chords keep the line from looping where the points lie unevenly
  for (std::size_t i = 1; i < points.size(); ++i) knots.push_back(knots.back() + std::sqrt(car::length(points[i] - points[i - 1])));
  std::array<Graph, 3> coordinate;
  for (int c = 0; c < 3; ++c) {
    std::vector<std::array<double, 2>> rows;
    for (std::size_t i = 0; i < points.size(); ++i) rows.push_back({knots[i], points[i][c]});
    coordinate[c] = Graph(std::move(rows));
  }
  return of(0.0, knots.back(), [&](double t) { return Vector{coordinate[0](t), coordinate[1](t), coordinate[2](t)}; });
}

std::vector<double> stations(const std::vector<double>& breaks, double size) {
  std::vector<double> all{breaks.front()};
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double span = breaks[i] - breaks[i - 1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(span) / size - 1e-6)));
    for (int k = 1; k <= pieces; ++k) all.push_back(k == pieces ? breaks[i] : breaks[i - 1] + span * k / pieces);
  }
  return all;
}

}  // namespace balocco::car
