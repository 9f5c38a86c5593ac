#include "constraints/host_solids.hpp"

#include <algorithm>
#include <cmath>

#include "elements/element_type.hpp"
#include "elements/solids/nodal_shapes.hpp"
#include "math/tensor.hpp"

namespace balocco {

namespace {

constexpr int most_nodes = 20;
constexpr double stretch = 0.1;  // of bounds, so that points a little outside find their solid

using Natural = std::array<double, 3>;

/// How far natural coordinates lie outside of a cube -1 .. 1, of the unit tetrahedron, of the wedge.
double beyond_cube(const Natural& at) { return std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])}) - 1.0; }
double beyond_tetrahedron(const Natural& at) { return std::max({-at[0], -at[1], -at[2], at[0] + at[1] + at[2] - 1.0}); }
double beyond_wedge(const Natural& at) { return std::max({-at[0], -at[1], at[0] + at[1] - 1.0, std::abs(at[2]) - 1.0}); }

/// A kind of solid: its shape functions, where the search for a point begins, and what is inside.
struct Kind {
  int nodes;
  double (*value)(int, const Natural&);
  double (*slope)(int, int, const Natural&);
  Natural centre;
  double (*beyond)(const Natural&);
};

template <class Values>
Kind kind_of(Natural centre, double (*beyond)(const Natural&)) {
  return {Values::nodes, [](int node, const Natural& at) { return Values::value(node, at); },
          [](int node, int axis, const Natural& at) { return Values::slope(node, axis, at); }, centre, beyond};
}

std::optional<Kind> find_kind(const ElementType& type) {
  if (type.section != Section::Kind::solid) return std::nullopt;
  constexpr double third = 1.0 / 3.0;
  switch (type.shape) {
    case Shape::hexahedron:
      return kind_of<TrilinearValues>({}, beyond_cube);
    case Shape::quadratic_hexahedron:
      return kind_of<SerendipityShape<3>>({}, beyond_cube);
    case Shape::tetrahedron:
      return kind_of<TetrahedronShape>({0.25, 0.25, 0.25}, beyond_tetrahedron);
    case Shape::quadratic_tetrahedron:
      return kind_of<QuadraticTetrahedronShape>({0.25, 0.25, 0.25}, beyond_tetrahedron);
    case Shape::wedge:
      return kind_of<WedgeValues>({third, third, 0.0}, beyond_wedge);
    case Shape::quadratic_wedge:
      return kind_of<QuadraticWedgeShape>({third, third, 0.0}, beyond_wedge);
    default:
      return std::nullopt;
  }
}

}  // namespace

bool HostSolids::takes(const ElementType& type) { return find_kind(type).has_value(); }

HostSolids::HostSolids(const Model& model, std::vector<ElementRef> elements) : model_(model) {
  std::vector<std::array<Point, 2>> bounds;
  double sum = 0.0;
  for (const auto element : elements) {
    const auto& table = model.elements[element.table];
    auto& [low, high] = bounds.emplace_back(std::array<Point, 2>{Point{1e300, 1e300, 1e300}, Point{-1e300, -1e300, -1e300}});
    for (int i = 0; i < table.type->nodes; ++i)
      for (int c = 0; c < 3; ++c) {
        const double x = model.nodes.coordinates[table.connectivity[element.row * table.type->nodes + i]][c];
        low[c] = std::min(low[c], x);
        high[c] = std::max(high[c], x);
      }
    sum += (high[0] - low[0] + high[1] - low[1] + high[2] - low[2]) / 3.0;
  }
  if (elements.empty()) return;
  mean_size_ = sum / static_cast<double>(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    auto [low, high] = bounds[i];
    for (int c = 0; c < 3; ++c) {
      low[c] -= stretch * mean_size_;
      high[c] += stretch * mean_size_;
    }
    const Cell first = cell_of(low), last = cell_of(high);
    for (auto x = first[0]; x <= last[0]; ++x)
      for (auto y = first[1]; y <= last[1]; ++y)
        for (auto z = first[2]; z <= last[2]; ++z) cells_[{x, y, z}].push_back(elements[i]);
  }
}

HostSolids::Cell HostSolids::cell_of(const Point& point) const {
  Cell cell;
  for (int c = 0; c < 3; ++c) cell[c] = static_cast<std::int64_t>(std::floor(point[c] / mean_size_));
  return cell;
}

/// Newton's method for the natural coordinates.
std::optional<HostPoint> HostSolids::place(ElementRef element, const Point& point) const {
  const auto& table = model_.elements[element.table];
  const auto kind = *find_kind(*table.type);
  const auto node = [&](int i) { return table.connectivity[element.row * kind.nodes + i]; };
  Natural at = kind.centre;
  for (int iteration = 0; iteration < 20; ++iteration) {
    Vector3<double> missed{point};
    Matrix3<double> jacobian{};
    for (int i = 0; i < kind.nodes; ++i) {
      const Vector3<double> x{model_.nodes.coordinates[node(i)]};
      missed = missed - kind.value(i, at) * x;
      for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < 3; ++c) jacobian(c, axis) += kind.slope(i, axis, at) * x[c];
    }
    const auto adjugate = cofactor(jacobian);
    const auto step = (1.0 / determinant(jacobian, adjugate)) * (transpose(adjugate) * missed);
    for (int axis = 0; axis < 3; ++axis) at[axis] += step[axis];
    if (!(dot(step, step) < 100.0)) return std::nullopt;  // it is far away
    if (dot(step, step) < 1e-26) break;
  }
  HostPoint result{.nodes = {}, .weights = {}, .outside = std::max(0.0, kind.beyond(at)) * mean_size_};
  for (int i = 0; i < kind.nodes; ++i) {
    const double weight = kind.value(i, at);
    if (std::abs(weight) < 1e-12) continue;
    result.nodes.push_back(node(i));
    result.weights.push_back(weight);
  }
  return result;
}

std::optional<HostPoint> HostSolids::at(const Point& point, double tolerance) const {
  if (cells_.empty()) return std::nullopt;
  const auto cell = cells_.find(cell_of(point));
  if (cell == cells_.end()) return std::nullopt;
  std::optional<HostPoint> nearest;
  for (const auto element : cell->second) {
    auto found = place(element, point);
    if (found && found->outside <= tolerance && (!nearest || found->outside < nearest->outside)) nearest = std::move(found);
  }
  return nearest;
}

}  // namespace balocco
