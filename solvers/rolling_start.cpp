#include "rolling_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "math/rotation.hpp"

namespace balocco {

namespace {

using Order = std::vector<std::size_t>;

constexpr double turn = 2.0 * std::numbers::pi, widest_gap = 0.125 * turn, same_place = 1e-6;

/// A node about the axis, undeformed.
struct Cylindrical {
  double along = 0.0, radius = 0.0, angle = 0.0;
};

std::vector<Cylindrical> about(const std::vector<Vector3<double>>& points, const RotationAxis& axis) {
  const auto& e = axis.direction;
  const Vector3<double> aside = std::abs(e[0]) < 0.9 ? Vector3<double>{{1.0, 0.0, 0.0}} : Vector3<double>{{0.0, 1.0, 0.0}};
  const auto first = cross(e, aside), second = cross(e, first);
  std::vector<Cylindrical> result;
  for (const auto& point : points) {
    const auto arm = point - axis.point;
    const auto across = arm - dot(arm, e) * e;
    result.push_back({dot(arm, e), std::sqrt(dot(across, across)), std::atan2(dot(arm, second), dot(arm, first))});
  }
  return result;
}

/// Numbers the runs of `order` in which a value grows by no more than a tolerance from one to the next, within runs of `outer`.
template <class Value>
std::vector<std::size_t> runs(const Order& order, const std::vector<std::size_t>& outer, double tolerance, Value value) {
  std::vector<std::size_t> run(order.size(), 0);
  std::size_t number = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool ends = i > 0 && (outer[order[i]] != outer[order[i - 1]] || value(order[i]) - value(order[i - 1]) > tolerance);
    run[order[i]] = ends ? ++number : number;
  }
  return run;
}

/// Circles, each of its points by rising angle.
std::vector<std::vector<std::size_t>> circles(const std::vector<Cylindrical>& points) {
  double largest = 0.0;
  for (const auto& point : points) largest = std::max(largest, point.radius);
  const double tolerance = same_place * largest;
  std::vector<std::size_t> order(points.size()), none(points.size(), 0);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto along = [&](std::size_t i) { return points[i].along; };
  const auto radius = [&](std::size_t i) { return points[i].radius; };
  std::ranges::stable_sort(order, {}, along);
  const auto layer = runs(order, none, tolerance, along);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::pair(layer[i], radius(i)); });
  const auto circle = runs(order, layer, tolerance, radius);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::pair(circle[i], points[i].angle); });
  std::vector<std::vector<std::size_t>> result;
  for (const auto i : order) {
    if (circle[i] == result.size()) result.emplace_back();
    result.back().push_back(i);
  }
  return result;
}

/// The angle from one point of a circle to the one that comes `step` places later.
double gap(const std::vector<Cylindrical>& points, const std::vector<std::size_t>& circle, std::size_t from, std::size_t step) {
  const auto to = from + step;
  return points[circle[to % circle.size()]].angle - points[circle[from]].angle + turn * static_cast<double>(to / circle.size());
}

bool closes(const std::vector<Cylindrical>& points, const std::vector<std::size_t>& circle) {
  for (std::size_t i = 0; i < circle.size(); ++i)
    if (gap(points, circle, i, 1) > widest_gap) return false;
  return true;
}

}  // namespace

Flow flow_through_shape(const std::vector<Vector3<double>>& undeformed, const std::vector<Vector3<double>>& deformed,
                        const RotationAxis& before, const RotationAxis& now) {
  Flow flow(undeformed.size());
  const auto points = about(undeformed, before);
  for (const auto& circle : circles(points)) {
    if (!closes(points, circle)) continue;
    const auto size = circle.size();
    for (std::size_t i = 0; i < size; ++i) {
      // Neighbours at another angle: nodes may lie in one place.
      std::size_t ahead = 1, behind = 1;
      while (gap(points, circle, i, ahead) < same_place) ++ahead;
      while (gap(points, circle, (i + size - behind) % size, behind) < same_place) ++behind;
      const auto next = circle[(i + ahead) % size], last = circle[(i + size - behind) % size];
      const double h = gap(points, circle, i, ahead), b = gap(points, circle, (i + size - behind) % size, behind);
      // Neighbours' arms as if turned to here: of a circle that is still one they are all alike.
      const auto turned_here = [&](std::size_t neighbour, double angle) {
        return rotation_matrix(exponential(angle * now.direction)) * (deformed[neighbour] - now.point);
      };
      const auto here = deformed[circle[i]] - now.point;
      const auto forward = (1.0 / h) * (turned_here(next, -h) - here), backward = (1.0 / b) * (here - turned_here(last, b));
      flow[circle[i]] = (1.0 / (h + b)) * (b * forward + h * backward);
    }
  }
  return flow;
}

}  // namespace balocco
