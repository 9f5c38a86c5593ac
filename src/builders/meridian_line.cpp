#include "builders/meridian_line.hpp"

#include <algorithm>
#include <cmath>

namespace balocco {
namespace {

constexpr int samples_per_span =
    64;  // arc length by chords: relative error below 1e-5 for spans that turn by less than 45 degrees

}  // namespace

MeridianLine::MeridianLine(const TyreSpec& spec) {
  std::vector<SectionPoint> points{
      {spec.crown_radius, 0.0, spec.regions[0].points[0].base, spec.regions[0].points[0].cap}};
  std::vector<std::size_t> last_of_region;
  for (const auto& region : spec.regions) {
    points.insert(points.end(), region.points.begin(), region.points.end());
    last_of_region.push_back(points.size() - 1);
  }
  for (auto point = points.rbegin(); point + 1 != points.rend(); ++point)
    knots_.push_back({0.0, point->radius, -point->axial, 0.0, 0.0});
  for (const auto& point : points) knots_.push_back({0.0, point.radius, point.axial, 0.0, 0.0});
  const std::size_t crown = points.size() - 1;
  for (std::size_t i = 1; i < knots_.size(); ++i)
    knots_[i].parameter = knots_[i - 1].parameter +
                          std::hypot(knots_[i].radius - knots_[i - 1].radius, knots_[i].axial - knots_[i - 1].axial);
  const double middle = knots_[crown].parameter;
  for (auto& knot : knots_) knot.parameter -= middle;
  solve_curvatures(&Knot::radius, &Knot::radius_curvature);
  solve_curvatures(&Knot::axial, &Knot::axial_curvature);

  lengths_.push_back({0.0, 0.0});
  rubber_.push_back({0.0, points[0].base, points[0].cap});
  double radius = points[0].radius, axial = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double start = knots_[crown + i - 1].parameter, end = knots_[crown + i].parameter;
    for (int sample = 1; sample <= samples_per_span; ++sample) {
      const double parameter = start + (end - start) * sample / samples_per_span;
      const double next_radius = evaluate(parameter, &Knot::radius, &Knot::radius_curvature)[0];
      const double next_axial = evaluate(parameter, &Knot::axial, &Knot::axial_curvature)[0];
      lengths_.push_back({parameter, lengths_.back()[1] + std::hypot(next_radius - radius, next_axial - axial)});
      radius = next_radius;
      axial = next_axial;
    }
    rubber_.push_back({lengths_.back()[1], points[i].base, points[i].cap});
    for (int r = 0; r < region_count; ++r)
      if (last_of_region[r] == i) region_ends_[r] = lengths_.back()[1];
    if (last_of_region[static_cast<int>(Region::sidewall)] == i) rubber_.back()[2] = spec.rim_strip_top;
  }
}

void MeridianLine::solve_curvatures(double Knot::*value, double Knot::*curvature) {
  // Natural cubic spline: a tridiagonal system for the second derivatives, solved by elimination from both ends
  // inwards.
  const std::size_t n = knots_.size();
  std::vector<double> diagonal(n, 1.0), right(n, 0.0), upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = knots_[i].parameter - knots_[i - 1].parameter,
                 after = knots_[i + 1].parameter - knots_[i].parameter;
    const double slope_change =
        (knots_[i + 1].*value - knots_[i].*value) / after - (knots_[i].*value - knots_[i - 1].*value) / before;
    const double factor = before / diagonal[i - 1];
    diagonal[i] = 2.0 * (before + after) - factor * upper[i - 1];
    right[i] = 6.0 * slope_change - factor * right[i - 1];
    upper[i] = after;
  }
  knots_[n - 1].*curvature = 0.0;
  for (std::size_t i = n - 1; i-- > 0;)
    knots_[i].*curvature = i == 0 ? 0.0 : (right[i] - upper[i] * knots_[i + 1].*curvature) / diagonal[i];
}

std::array<double, 2> MeridianLine::evaluate(double parameter, double Knot::*value, double Knot::*curvature) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, parameter,
                                      [](double p, const Knot& knot) { return p < knot.parameter; });
  const Knot &right = *above, &left = *(above - 1);
  const double span = right.parameter - left.parameter;
  const double a = (right.parameter - parameter) / span, b = 1.0 - a;
  const double position = a * left.*value + b * right.*value +
                          ((a * a * a - a) * left.*curvature + (b * b * b - b) * right.*curvature) * span * span / 6.0;
  const double slope = (right.*value - left.*value) / span +
                       ((3.0 * b * b - 1.0) * right.*curvature - (3.0 * a * a - 1.0) * left.*curvature) * span / 6.0;
  return {position, slope};
}

double MeridianLine::parameter_at(double arc_length) const {
  const auto above =
      std::lower_bound(lengths_.begin() + 1, lengths_.end() - 1, arc_length,
                       [](const std::array<double, 2>& entry, double length) { return entry[1] < length; });
  const auto &right = *above, &left = *(above - 1);
  return left[0] + (right[0] - left[0]) * (arc_length - left[1]) / (right[1] - left[1]);
}

LinePoint MeridianLine::at(double arc_length) const {
  const double parameter = parameter_at(arc_length);
  const auto [radius, radius_slope] = evaluate(parameter, &Knot::radius, &Knot::radius_curvature);
  const auto [axial, axial_slope] = evaluate(parameter, &Knot::axial, &Knot::axial_curvature);
  const double length = std::hypot(radius_slope, axial_slope);
  LinePoint point{radius, axial, {axial_slope / length, -radius_slope / length}, 0.0, 0.0};
  const auto above = std::lower_bound(rubber_.begin() + 1, rubber_.end() - 1, arc_length,
                                      [](const std::array<double, 3>& entry, double s) { return entry[0] < s; });
  const auto &right = *above, &left = *(above - 1);
  const double share = (arc_length - left[0]) / (right[0] - left[0]);
  point.base = left[1] + share * (right[1] - left[1]);
  point.cap = left[2] + share * (right[2] - left[2]);
  return point;
}

}  // namespace balocco
