#include "elements/shells/shell_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/element_type.hpp"
#include "elements/surface_directions.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

using Vector = Vector3<double>;

constexpr std::array<double, 4> corner_xi{-1.0, 1.0, 1.0, -1.0}, corner_eta{-1.0, -1.0, 1.0, 1.0},
    hourglass{1.0, -1.0, 1.0, -1.0};

double length(const Vector& v) {
  return std::sqrt(dot(v, v));
}
Vector vector_of(const Point& p) {
  return {{p[0], p[1], p[2]}};
}

struct Element {
  const Model& model;
  ElementRef reference;

  const ElementTable& table() const { return model.elements[reference.table]; }
  [[noreturn]] void fail(const char* what) const {
    throw InputError(fmt::format("{}: error: *ELEMENT: shell {} {}", model.where(table().location[reference.row]),
                                 table().id[reference.row], what));
  }
};

/// Coordinates of the corners in the mean plane, and above it.
struct Flat {
  std::array<double, 4> x{}, y{}, z{};
};

/// Derivatives of the shape functions by the natural coordinates.
struct Shape {
  std::array<double, 4> value{}, by_xi{}, by_eta{};
};

Shape quadrilateral_shape(double xi, double eta) {
  Shape shape;
  for (int i = 0; i < 4; ++i) {
    shape.value[i] = 0.25 * (1.0 + corner_xi[i] * xi) * (1.0 + corner_eta[i] * eta);
    shape.by_xi[i] = 0.25 * corner_xi[i] * (1.0 + corner_eta[i] * eta);
    shape.by_eta[i] = 0.25 * corner_eta[i] * (1.0 + corner_xi[i] * xi);
  }
  return shape;
}

Shape triangle_shape(double r, double s) {
  return {{1.0 - r - s, r, s, 0.0}, {-1.0, 1.0, 0.0, 0.0}, {-1.0, 0.0, 1.0, 0.0}};
}

/// Directions at the middle, the corners in them, and the directors.
Flat flatten(const Element& element, const Section& section, ShellGeometry& geometry) {
  const ElementTable& table = element.table();
  const auto first = static_cast<std::size_t>(element.reference.row) * geometry.corners;
  Vector centre;
  const Vector origin = vector_of(element.model.nodes.coordinates[table.connectivity[first]]);
  for (int i = 0; i < geometry.corners; ++i) {
    const Vector corner = vector_of(element.model.nodes.coordinates[table.connectivity[first + i]]);
    geometry.edge[i] = corner - origin;
    centre = centre + (1.0 / geometry.corners) * corner;
  }
  const auto& x = geometry.edge;
  const Vector one = geometry.corners == 4 ? x[2] : x[1], other = geometry.corners == 4 ? x[3] - x[1] : x[2];
  const Vector area = cross(one, other);
  const double longest = std::max(length(one), length(other));
  if (!(length(area) > 1e-10 * longest * longest)) element.fail("has no area; correct its nodes");
  geometry.normal = (1.0 / length(area)) * area;
  const auto orientation = section.orientation < 0 ? Orientation{} : element.model.orientations[section.orientation].of(element.reference);
  const auto directions = surface_directions(section.orientation < 0 ? nullptr : &orientation, centre, geometry.normal);
  if (!directions)
    element.fail("has a normal along the direction that its *ORIENTATION projects onto it; choose another axis there");
  geometry.direction1 = directions->first;
  geometry.direction2 = directions->second;

  Flat flat;
  for (int i = 0; i < geometry.corners; ++i) {
    const Vector arm = x[i] - (centre - origin);
    flat.x[i] = dot(arm, geometry.direction1);
    flat.y[i] = dot(arm, geometry.direction2);
    flat.z[i] = dot(arm, geometry.normal);
    geometry.director[i] = geometry.normal;
    if (!table.corner_normal.empty()) geometry.director[i] = vector_of(table.corner_normal[first + i]);
    if (!(dot(geometry.director[i], geometry.normal) > 0.1))
      element.fail(
          "has a corner whose normal lies in its surface or points to its other side; correct *NORMAL or the nodes");
  }
  return flat;
}

ShellPoint point_at(const Element& element, const Flat& flat, const Shape& shape, std::array<double, 2> natural,
                    double weight) {
  double j11 = 0.0, j12 = 0.0, j21 = 0.0, j22 = 0.0;
  for (int i = 0; i < 4; ++i) {
    j11 += shape.by_xi[i] * flat.x[i];
    j12 += shape.by_xi[i] * flat.y[i];
    j21 += shape.by_eta[i] * flat.x[i];
    j22 += shape.by_eta[i] * flat.y[i];
  }
  const double determinant = j11 * j22 - j12 * j21;
  if (!(determinant > 0.0)) element.fail("is folded or has an inner angle beyond 180 degrees; correct its nodes");
  return {weight * determinant,
          natural,
          {j22 / determinant, -j12 / determinant, -j21 / determinant, j11 / determinant},
          {},
          shape.value};
}

/// dN_I / d(direction) at a point.
std::array<double, 2> gradient(const ShellPoint& point, const Shape& shape, int i) {
  const auto& d = point.natural_gradient;
  return {d[0] * shape.by_xi[i] + d[1] * shape.by_eta[i], d[2] * shape.by_xi[i] + d[3] * shape.by_eta[i]};
}

void add_points(const Element& element, const Flat& flat, ShellGeometry& geometry) {
  std::array<Shape, 4> shape;
  geometry.points = geometry.corners;
  for (int q = 0; q < geometry.points; ++q) {
    const std::array<double, 2> natural =
        geometry.corners == 4 ? std::array{corner_xi[q] / std::sqrt(3.0), corner_eta[q] / std::sqrt(3.0)}
                              : std::array{q == 1 ? 2.0 / 3.0 : 1.0 / 6.0, q == 2 ? 2.0 / 3.0 : 1.0 / 6.0};
    shape[q] =
        geometry.corners == 4 ? quadrilateral_shape(natural[0], natural[1]) : triangle_shape(natural[0], natural[1]);
    geometry.point[q] = point_at(element, flat, shape[q], natural, geometry.corners == 4 ? 1.0 : 1.0 / 6.0);
    geometry.area += geometry.point[q].area;
  }
  for (int q = 0; q < geometry.points; ++q)
    for (int i = 0; i < geometry.corners; ++i) {
      const auto [b1, b2] = gradient(geometry.point[q], shape[q], i);
      const double share = geometry.point[q].area / geometry.area;
      geometry.gradient1[i] += share * b1;
      geometry.gradient2[i] += share * b2;
      geometry.nodal_area[i] += shape[q].value[i] * geometry.point[q].area;
    }
  if (geometry.corners == 3) return;

  double along1 = 0.0, along2 = 0.0, square = 0.0;
  for (int i = 0; i < 4; ++i) {
    along1 += hourglass[i] * flat.x[i];
    along2 += hourglass[i] * flat.y[i];
  }
  for (int i = 0; i < 4; ++i) {
    geometry.gamma[i] = hourglass[i] - geometry.gradient1[i] * along1 - geometry.gradient2[i] * along2;
    geometry.warp += geometry.gamma[i] * flat.z[i];
    square += geometry.gamma[i] * geometry.gamma[i];
  }
  for (int q = 0; q < 4; ++q)
    for (int i = 0; i < 4; ++i) {
      const auto [b1, b2] = gradient(geometry.point[q], shape[q], i);
      geometry.point[q].hourglass_gradient[0] += (b1 - geometry.gradient1[i]) * geometry.gamma[i] / square;
      geometry.point[q].hourglass_gradient[1] += (b2 - geometry.gradient2[i]) * geometry.gamma[i] / square;
    }
  for (int i = 0; i < 4; ++i)
    for (int line = 0; line < 2; ++line) {
      const double natural = 0.25 * (line == 0 ? corner_xi[i] : corner_eta[i]);
      geometry.mid_line[line][0] += natural * flat.x[i];
      geometry.mid_line[line][1] += natural * flat.y[i];
    }
}

}  // namespace

ShellGeometry shell_geometry(const Model& model, ElementRef reference, const Section& section) {
  const Element element{model, reference};
  ShellGeometry geometry;
  geometry.corners = element.table().type->nodes;
  const Flat flat = flatten(element, section, geometry);
  add_points(element, flat, geometry);
  double longest = 0.0;
  for (int i = 0; i < geometry.corners; ++i)
    longest = std::max(longest, length(geometry.edge[(i + 1) % geometry.corners] - geometry.edge[i]));
  geometry.length = (geometry.corners == 3 ? 2.0 : 1.0) * geometry.area / longest;
  return geometry;
}

}  // namespace balocco
