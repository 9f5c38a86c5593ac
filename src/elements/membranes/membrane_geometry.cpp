#include "elements/membranes/membrane_geometry.hpp"

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
    hourglass_mode{1.0, -1.0, 1.0, -1.0};
constexpr double gauss = 0.57735026918962576451;  // 1 / sqrt(3)

double length(const Vector& v) { return std::sqrt(dot(v, v)); }
Vector unit(const Vector& v) { return (1.0 / length(v)) * v; }
Vector vector_of(const Point& p) { return {{p[0], p[1], p[2]}}; }

/// Nodes of one element and who it is, for messages.
struct Element {
  std::array<Vector, 4> node;
  int nodes = 0;
  const Model& model;
  ElementRef reference;
  const Section& section;

  [[noreturn]] void fail(const std::string& what) const {
    const ElementTable& table = model.elements[reference.table];
    throw InputError(fmt::format("{}: error: *ELEMENT: membrane {} {}", model.where(table.location[reference.row]),
                                 table.id[reference.row], what));
  }
};

Element read_element(const Model& model, ElementRef reference, const Section& section) {
  const ElementTable& table = model.elements[reference.table];
  Element element{{}, table.type->nodes, model, reference, section};
  for (int i = 0; i < element.nodes; ++i) {
    const auto row = table.connectivity[static_cast<std::size_t>(reference.row) * element.nodes + i];
    element.node[i] = vector_of(model.nodes.coordinates[row]);
  }
  return element;
}

/// Shape functions and their derivatives by the natural coordinates at one of them.
struct Shape4 {
  std::array<double, 4> value{}, by_xi{}, by_eta{};
};

Shape4 quadrilateral_shape(double xi, double eta) {
  Shape4 shape;
  for (int i = 0; i < 4; ++i) {
    shape.value[i] = 0.25 * (1.0 + corner_xi[i] * xi) * (1.0 + corner_eta[i] * eta);
    shape.by_xi[i] = 0.25 * corner_xi[i] * (1.0 + corner_eta[i] * eta);
    shape.by_eta[i] = 0.25 * corner_eta[i] * (1.0 + corner_xi[i] * xi);
  }
  return shape;
}

Shape4 triangle_shape() { return {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0}, {-1.0, 1.0, 0.0, 0.0}, {-1.0, 0.0, 1.0, 0.0}}; }

Vector interpolate(const Element& element, const std::array<double, 4>& weight) {
  Vector sum;
  for (int i = 0; i < element.nodes; ++i) sum = sum + weight[i] * element.node[i];
  return sum;
}

/// Local directions at `point` of the surface with unit `normal`.
void set_directions(const Element& element, const Vector& point, const Vector& normal, MembranePoint& result) {
  const auto row = element.section.orientation;
  const auto orientation = row < 0 ? Orientation{} : element.model.orientations[row].of(element.reference);
  const auto directions = surface_directions(row < 0 ? nullptr : &orientation, point, normal);
  if (!directions)
    element.fail("has a normal along the direction that its *ORIENTATION projects onto it; choose another axis there");
  result.direction1 = directions->first;
  result.direction2 = directions->second;
}

MembranePoint integration_point(const Element& element, const Shape4& shape, double weight) {
  const Vector by_xi = interpolate(element, shape.by_xi), by_eta = interpolate(element, shape.by_eta);
  const Vector area_vector = cross(by_xi, by_eta);
  const double size = length(area_vector);
  const double longest = std::max(length(by_xi), length(by_eta));
  if (!(size > 1e-10 * longest * longest)) element.fail("has no area; correct its nodes");
  MembranePoint point;
  set_directions(element, interpolate(element, shape.value), (1.0 / size) * area_vector, point);
  // dN/d(direction) by the inverse of the 2 x 2 Jacobian in the local directions.
  const double j11 = dot(by_xi, point.direction1), j12 = dot(by_xi, point.direction2);
  const double j21 = dot(by_eta, point.direction1), j22 = dot(by_eta, point.direction2);
  const double determinant = j11 * j22 - j12 * j21;
  for (int i = 0; i < element.nodes; ++i) {
    point.gradient1[i] = (j22 * shape.by_xi[i] - j12 * shape.by_eta[i]) / determinant;
    point.gradient2[i] = (j11 * shape.by_eta[i] - j21 * shape.by_xi[i]) / determinant;
  }
  point.area = weight * size;
  return point;
}

/// A quadrilateral seen along its mean normal: where the mean gradients of the one-point element live.
struct Projection {
  MembranePoint frame;
  std::array<double, 4> x{}, y{}, z{};
};

Projection project(const Element& element) {
  const Vector diagonal_area = cross(element.node[2] - element.node[0], element.node[3] - element.node[1]);
  const double size = length(diagonal_area);
  const double longest = std::max(length(element.node[2] - element.node[0]), length(element.node[3] - element.node[1]));
  if (!(size > 1e-10 * longest * longest)) element.fail("has no area; correct its nodes");
  Projection result;
  const Vector centre = interpolate(element, {0.25, 0.25, 0.25, 0.25}), normal = (1.0 / size) * diagonal_area;
  set_directions(element, centre, normal, result.frame);
  for (int i = 0; i < 4; ++i) {
    const Vector arm = element.node[i] - centre;
    result.x[i] = dot(arm, result.frame.direction1);
    result.y[i] = dot(arm, result.frame.direction2);
    result.z[i] = dot(arm, normal);
  }
  return result;
}

/// The four Gauss points of the projected, flat quadrilateral; checks that it is convex.
std::array<MembranePoint, 4> projected_points(const Element& element, const Projection& flat) {
  std::array<MembranePoint, 4> points;
  for (int q = 0; q < 4; ++q) {
    const Shape4 shape = quadrilateral_shape(gauss * corner_xi[q], gauss * corner_eta[q]);
    double j11 = 0.0, j12 = 0.0, j21 = 0.0, j22 = 0.0;
    for (int i = 0; i < 4; ++i) {
      j11 += shape.by_xi[i] * flat.x[i];
      j12 += shape.by_xi[i] * flat.y[i];
      j21 += shape.by_eta[i] * flat.x[i];
      j22 += shape.by_eta[i] * flat.y[i];
    }
    const double determinant = j11 * j22 - j12 * j21;
    if (!(determinant > 0.0)) element.fail("is folded or has an inner angle beyond 180 degrees; correct its nodes");
    points[q] = flat.frame;
    points[q].area = determinant;
    for (int i = 0; i < 4; ++i) {
      points[q].gradient1[i] = (j22 * shape.by_xi[i] - j12 * shape.by_eta[i]) / determinant;
      points[q].gradient2[i] = (j11 * shape.by_eta[i] - j21 * shape.by_xi[i]) / determinant;
    }
  }
  return points;
}

void set_mean_gradients(MembraneGeometry& geometry, const std::array<MembranePoint, 4>& points, int count) {
  geometry.area = 0.0;
  for (int q = 0; q < count; ++q) geometry.area += points[q].area;
  for (int q = 0; q < count; ++q)
    for (int i = 0; i < 4; ++i) {
      geometry.mean_gradient1[i] += points[q].area / geometry.area * points[q].gradient1[i];
      geometry.mean_gradient2[i] += points[q].area / geometry.area * points[q].gradient2[i];
    }
}

/// Angle of the orthonormal axes that lie closest to the two mid-lines of the element.
double element_axis_angle(const Projection& flat) {
  double xi1 = 0.0, xi2 = 0.0, eta1 = 0.0, eta2 = 0.0;
  for (int i = 0; i < 4; ++i) {
    xi1 += corner_xi[i] * flat.x[i];
    xi2 += corner_xi[i] * flat.y[i];
    eta1 += corner_eta[i] * flat.x[i];
    eta2 += corner_eta[i] * flat.y[i];
  }
  const double xi = std::hypot(xi1, xi2), eta = std::hypot(eta1, eta2);
  return std::atan2(xi2 / xi - eta1 / eta, xi1 / xi + eta2 / eta);
}

void set_hourglass(MembraneGeometry& geometry, const std::array<MembranePoint, 4>& points, const Projection& flat) {
  HourglassMode& mode = geometry.hourglass;
  const auto &mean1 = geometry.mean_gradient1, &mean2 = geometry.mean_gradient2;
  double h_x = 0.0, h_y = 0.0, mean_square = 0.0, gamma_square = 0.0;
  for (int i = 0; i < 4; ++i) {
    h_x += hourglass_mode[i] * flat.x[i];
    h_y += hourglass_mode[i] * flat.y[i];
    mean_square += mean1[i] * mean1[i] + mean2[i] * mean2[i];
  }
  for (int i = 0; i < 4; ++i) {
    mode.gamma[i] = hourglass_mode[i] - mean1[i] * h_x - mean2[i] * h_y;
    mode.warp += mode.gamma[i] * flat.z[i];
    gamma_square += mode.gamma[i] * mode.gamma[i];
  }
  for (const MembranePoint& point : points) {
    double g1 = 0.0, g2 = 0.0, residual = 0.0;
    for (int i = 0; i < 4; ++i) {
      g1 += (point.gradient1[i] - mean1[i]) * mode.gamma[i] / gamma_square;
      g2 += (point.gradient2[i] - mean2[i]) * mode.gamma[i] / gamma_square;
    }
    for (int i = 0; i < 4; ++i)
      residual += std::pow(point.gradient1[i] - mean1[i] - g1 * mode.gamma[i], 2) +
                  std::pow(point.gradient2[i] - mean2[i] - g2 * mode.gamma[i], 2);
    const double share = point.area / geometry.area;
    mode.mean_gg.c11 += share * g1 * g1;
    mode.mean_gg.c22 += share * g2 * g2;
    mode.mean_gg.c12 += share * g1 * g2;
    mode.greatest_gradient = std::max(mode.greatest_gradient, std::hypot(g1, g2));
    mode.gradient_residual = std::max(mode.gradient_residual, std::sqrt(residual / mean_square));
  }
  mode.axis_angle = element_axis_angle(flat);
}

MembraneGeometry triangle_geometry(const Element& element) {
  MembraneGeometry geometry;
  geometry.points = 1;
  geometry.point[0] = integration_point(element, triangle_shape(), 0.5);
  set_mean_gradients(geometry, geometry.point, 1);
  std::fill_n(geometry.nodal_area.begin(), 3, geometry.area / 3.0);
  return geometry;
}

MembraneGeometry quadrilateral_geometry(const Element& element, int points) {
  MembraneGeometry geometry;
  geometry.points = points;
  const Projection flat = project(element);
  std::array<MembranePoint, 4> quadrature = projected_points(element, flat);
  if (points == 4)
    for (int q = 0; q < 4; ++q)
      quadrature[q] = integration_point(element, quadrilateral_shape(gauss * corner_xi[q], gauss * corner_eta[q]), 1.0);
  set_mean_gradients(geometry, quadrature, 4);
  set_hourglass(geometry, quadrature, flat);
  for (int q = 0; q < 4; ++q) {
    const Shape4 shape = quadrilateral_shape(gauss * corner_xi[q], gauss * corner_eta[q]);
    for (int i = 0; i < 4; ++i) geometry.nodal_area[i] += shape.value[i] * quadrature[q].area;
  }
  if (points == 4) {
    geometry.point = quadrature;
  } else {
    geometry.point[0] = flat.frame;
    geometry.point[0].gradient1 = geometry.mean_gradient1;
    geometry.point[0].gradient2 = geometry.mean_gradient2;
    geometry.point[0].area = geometry.area;
  }
  return geometry;
}

}  // namespace

MembraneGeometry membrane_geometry(const Model& model, ElementRef reference, const Section& section, int points) {
  const Element element = read_element(model, reference, section);
  MembraneGeometry geometry = element.nodes == 3 ? triangle_geometry(element) : quadrilateral_geometry(element, points);
  double longest = 0.0;
  for (int i = 0; i < element.nodes; ++i)
    longest = std::max(longest, length(element.node[(i + 1) % element.nodes] - element.node[i]));
  geometry.characteristic_length = (element.nodes == 3 ? 2.0 : 1.0) * geometry.area / longest;
  return geometry;
}

}  // namespace balocco
