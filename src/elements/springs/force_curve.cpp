#include "elements/springs/force_curve.hpp"

#include <algorithm>
#include <cmath>

namespace balocco {

ForceCurve::ForceCurve(double slope, std::span<const std::array<double, 2>> table)
    : slope_(slope), table_(table.begin(), table.end()) {}

ForceCurve::Value ForceCurve::at(double argument) const {
  if (table_.empty()) return {slope_ * argument, slope_};
  auto right = std::ranges::upper_bound(table_, argument, {}, [](const auto& point) { return point[0]; });
  if (right == table_.end() && argument == table_.back()[0]) --right;  // its last piece ends here
  if (right == table_.begin()) return {table_.front()[1], 0.0};
  if (right == table_.end()) return {table_.back()[1], 0.0};
  const auto& [x0, f0] = *(right - 1);
  const auto& [x1, f1] = *right;
  const double slope = (f1 - f0) / (x1 - x0);
  return {f0 + slope * (argument - x0), slope};
}

double ForceCurve::integral(double argument) const {
  if (table_.empty()) return 0.5 * slope_ * argument * argument;
  return integral_from_first_point(argument) - integral_from_first_point(0.0);
}

double ForceCurve::integral_from_first_point(double argument) const {
  const auto& first = table_.front();
  if (argument <= first[0]) return first[1] * (argument - first[0]);
  double sum = 0.0;
  auto left = first;
  for (const auto& point : table_) {
    if (point[0] >= argument) break;
    sum += 0.5 * (left[1] + point[1]) * (point[0] - left[0]);
    left = point;
  }
  return sum + 0.5 * (left[1] + at(argument).force) * (argument - left[0]);
}

double ForceCurve::steepest() const {
  double steepest = std::abs(slope_);
  for (std::size_t i = 1; i < table_.size(); ++i)
    steepest = std::max(steepest, std::abs((table_[i][1] - table_[i - 1][1]) / (table_[i][0] - table_[i - 1][0])));
  return steepest;
}

double ForceCurve::largest_force() const {
  double largest = 0.0;
  for (const auto& point : table_) largest = std::max(largest, std::abs(point[1]));
  return largest;
}

// Along a piece, force / length is a ratio of two linear functions and rises or falls throughout: corners decide.
double ForceCurve::tautness(double natural_length) const {
  double largest = std::max(slope_, 0.0);
  for (const auto& [elongation, force] : table_)
    if (natural_length + elongation > 0.0) largest = std::max(largest, force / (natural_length + elongation));
  return largest;
}

}  // namespace balocco
