// Solids whose coefficients are nodal: x = x_0 + sum_k N_k (x_k - x_0). Linear and quadratic tetrahedra, the brick of 20 nodes.
// They do not average their dilatation; nodes in Abaqus's order, corners before the middles of the edges.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "elements/solids/full_solid_shapes.hpp"
#include "model/model.hpp"

namespace balocco {

/// A place in natural coordinates and its weight.
struct Station {
  std::array<double, 3> at{};
  double weight = 0.0;
};

/// What nodal shapes share; `Shape` has value(node, at), slope(node, axis, at) and stations(), where forces are integrated.
template <class Shape, int node_count, int point_count>
struct NodalShape {
  static constexpr int nodes = node_count, modes = node_count - 1, points = point_count;
  static constexpr bool mean_dilatation = false;

  static constexpr std::array<ShapePoint<modes>, points> quadrature() {
    constexpr auto stations = Shape::stations();
    std::array<ShapePoint<modes>, points> table{};
    for (int q = 0; q < points; ++q) {
      table[q].weight = stations[q].weight;
      for (int mode = 0; mode < modes; ++mode)
        for (int axis = 0; axis < 3; ++axis) table[q].derivative[mode][axis] = Shape::slope(mode + 1, axis, stations[q].at);
    }
    return table;
  }

  template <class T>
  static std::array<Vector3<T>, modes> coefficients(const std::array<Vector3<T>, nodes>& x) {
    std::array<Vector3<T>, modes> c;
    for (int mode = 0; mode < modes; ++mode) c[mode] = x[mode + 1] - x[0];
    return c;
  }
  template <class T>
  static std::array<Vector3<T>, nodes> nodal(const std::array<Vector3<T>, modes>& g) {
    std::array<Vector3<T>, nodes> f;
    Vector3<T> sum = g[0];
    for (int mode = 1; mode < modes; ++mode) sum = sum + g[mode];
    for (int i = 0; i < 3; ++i) f[0][i] = -sum[i];
    for (int mode = 0; mode < modes; ++mode) f[mode + 1] = g[mode];
    return f;
  }

  /// Shares of a mass lumped by the diagonal of the consistent one of an element with straight edges (Hinton, Rock and
  /// Zienkiewicz 1976): all positive.
  static constexpr std::array<double, nodes> diagonal_shares() {
    std::array<double, nodes> shares{};
    double sum = 0.0;
    for (const Station& station : Shape::mass_stations())
      for (int node = 0; node < nodes; ++node) {
        const double value = Shape::value(node, station.at);
        shares[node] += station.weight * value * value;
        sum += station.weight * value * value;
      }
    for (double& share : shares) share /= sum;
    return shares;
  }
};

/// Gauss's n points on -1 .. 1: (place, weight).
template <int n>
constexpr std::array<std::array<double, 2>, n> gauss_line() {
  constexpr double two = 0.57735026918962576451, three = 0.77459666924148337704;  // 1 / sqrt(3), sqrt(3 / 5)
  if constexpr (n == 2)
    return {{{-two, 1.0}, {two, 1.0}}};
  else
    return {{{-three, 5.0 / 9.0}, {0.0, 8.0 / 9.0}, {three, 5.0 / 9.0}}};
}

/// Those points in three directions, the first running fastest.
template <int n>
constexpr std::array<Station, n * n * n> gauss_stations() {
  constexpr auto line = gauss_line<n>();
  std::array<Station, n * n * n> stations{};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        stations[(k * n + j) * n + i] = {{line[i][0], line[j][0], line[k][0]}, line[i][1] * line[j][1] * line[k][1]};
  return stations;
}

/// Six points of the triangle xi, eta >= 0, xi + eta <= 1, exact to the fourth degree (Dunavant 1985).
constexpr std::array<Station, 6> six_triangle_stations() {
  constexpr double a = 0.44594849091596488632, b = 0.09157621350977074346;
  constexpr double w_a = 0.11169079483900573285, w_b = 0.05497587182766093382;
  constexpr double far_a = 1.0 - 2.0 * a, far_b = 1.0 - 2.0 * b;
  return {{{{a, a, 0.0}, w_a}, {{far_a, a, 0.0}, w_a}, {{a, far_a, 0.0}, w_a},
           {{b, b, 0.0}, w_b}, {{far_b, b, 0.0}, w_b}, {{b, far_b, 0.0}, w_b}}};
}

/// Stations of a triangle by n Gauss points along the third axis, those of the triangle running fastest.
template <int count, int n>
constexpr std::array<Station, count * n> product_stations(const std::array<Station, count>& triangle) {
  constexpr auto line = gauss_line<n>();
  std::array<Station, count * n> stations{};
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < count; ++i)
      stations[k * count + i] = {{triangle[i].at[0], triangle[i].at[1], line[k][0]}, triangle[i].weight * line[k][1]};
  return stations;
}

/// Those of wedges: three points, exact to the second degree, by n.
template <int n>
constexpr std::array<Station, 3 * n> wedge_stations() {
  constexpr double a = 1.0 / 6.0, b = 2.0 / 3.0;
  return product_stations<3, n>(std::array<Station, 3>{{{{a, a, 0.0}, a}, {{b, a, 0.0}, a}, {{a, b, 0.0}, a}}});
}

/// Four points of the unit tetrahedron, exact to the second degree.
constexpr std::array<Station, 4> four_tetrahedron_stations() {
  constexpr double a = 0.13819660112501051518, b = 1.0 - 3.0 * a, w = 1.0 / 24.0;  // a = (5 - sqrt(5)) / 20
  return {{{{a, a, a}, w}, {{b, a, a}, w}, {{a, b, a}, w}, {{a, a, b}, w}}};
}

/// Fifteen points, exact to the fifth degree (Keast 1986).
constexpr std::array<Station, 15> fifteen_tetrahedron_stations() {
  constexpr double root = 3.87298334620741688518;  // sqrt(15)
  constexpr double a = (7.0 - root) / 34.0, b = (7.0 + root) / 34.0, c = (10.0 - 2.0 * root) / 40.0, d = 0.5 - c;
  constexpr double w_a = (2665.0 + 14.0 * root) / 226800.0, w_b = (2665.0 - 14.0 * root) / 226800.0, w_c = 5.0 / 567.0;
  constexpr double far_a = 1.0 - 3.0 * a, far_b = 1.0 - 3.0 * b;
  return {{{{0.25, 0.25, 0.25}, 8.0 / 405.0},
           {{a, a, a}, w_a}, {{far_a, a, a}, w_a}, {{a, far_a, a}, w_a}, {{a, a, far_a}, w_a},
           {{b, b, b}, w_b}, {{far_b, b, b}, w_b}, {{b, far_b, b}, w_b}, {{b, b, far_b}, w_b},
           {{c, c, d}, w_c}, {{c, d, c}, w_c}, {{d, c, c}, w_c}, {{d, d, c}, w_c}, {{d, c, d}, w_c}, {{c, d, d}, w_c}}};
}

/// Barycentric coordinate of a corner of the unit tetrahedron, and its derivative.
constexpr double barycentric(int corner, const std::array<double, 3>& at) {
  return corner == 0 ? 1.0 - at[0] - at[1] - at[2] : at[corner - 1];
}
constexpr double barycentric_slope(int corner, int axis) { return corner == 0 ? -1.0 : corner - 1 == axis ? 1.0 : 0.0; }

struct TetrahedronShape : NodalShape<TetrahedronShape, 4, 1> {
  static constexpr bool natural_modes = true, explicit_steps = true;
  static constexpr auto mass_share = equal_shares<4>();
  static constexpr double value(int node, const std::array<double, 3>& at) { return barycentric(node, at); }
  static constexpr double slope(int node, int axis, const std::array<double, 3>&) { return barycentric_slope(node, axis); }
  static constexpr std::array<Station, 1> stations() { return {{{{0.25, 0.25, 0.25}, 1.0 / 6.0}}}; }
  static constexpr auto mass_stations() { return four_tetrahedron_stations(); }
};

inline constexpr std::array<std::array<int, 2>, 6> tetrahedron_edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

struct QuadraticTetrahedronShape : NodalShape<QuadraticTetrahedronShape, 10, 4> {
  static constexpr bool natural_modes = false, explicit_steps = true;
  static constexpr double value(int node, const std::array<double, 3>& at) {
    if (node >= 4) return 4.0 * barycentric(tetrahedron_edges[node - 4][0], at) * barycentric(tetrahedron_edges[node - 4][1], at);
    const double own = barycentric(node, at);
    return own * (2.0 * own - 1.0);
  }
  static constexpr double slope(int node, int axis, const std::array<double, 3>& at) {
    if (node < 4) return (4.0 * barycentric(node, at) - 1.0) * barycentric_slope(node, axis);
    const auto [first, second] = tetrahedron_edges[node - 4];
    return 4.0 * (barycentric(first, at) * barycentric_slope(second, axis) + barycentric(second, at) * barycentric_slope(first, axis));
  }
  static constexpr auto stations() { return four_tetrahedron_stations(); }
  static constexpr auto mass_stations() { return fifteen_tetrahedron_stations(); }
  static constexpr std::array<double, 10> mass_share{1.0 / 36.0, 1.0 / 36.0, 1.0 / 36.0, 1.0 / 36.0, 4.0 / 27.0,
                                                     4.0 / 27.0, 4.0 / 27.0, 4.0 / 27.0, 4.0 / 27.0, 4.0 / 27.0};
};

inline constexpr std::array<std::array<int, 2>, 12> hexahedron_edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Serendipity brick of 20 nodes with n x n x n Gauss points: 3 in full, 2 in reduced integration.
template <int n>
struct SerendipityShape : NodalShape<SerendipityShape<n>, 20, n * n * n> {
  static constexpr bool natural_modes = false, explicit_steps = false;

  /// -1, 0 or 1: natural coordinate of a node.
  static constexpr double place(int node, int axis) {
    if (node < 8) return hexahedron_signs[node][axis];
    const auto [first, second] = hexahedron_edges[node - 8];
    return 0.5 * (hexahedron_signs[first][axis] + hexahedron_signs[second][axis]);
  }
  /// Factor of one direction, 1 + x x_I, or 1 - x^2 where the node is in the middle; and its derivative.
  static constexpr double factor(double place, double x) { return place == 0.0 ? 1.0 - x * x : 1.0 + place * x; }
  static constexpr double factor_slope(double place, double x) { return place == 0.0 ? -2.0 * x : place; }

  static constexpr double value(int node, const std::array<double, 3>& at) {
    double product = node < 8 ? 0.125 : 0.25, sum = -2.0;
    for (int axis = 0; axis < 3; ++axis) {
      product *= factor(place(node, axis), at[axis]);
      sum += place(node, axis) * at[axis];
    }
    return node < 8 ? product * sum : product;
  }
  static constexpr double slope(int node, int axis, const std::array<double, 3>& at) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double own = factor(place(node, axis), at[axis]), own_slope = factor_slope(place(node, axis), at[axis]);
    const double others = factor(place(node, next), at[next]) * factor(place(node, last), at[last]);
    if (node >= 8) return 0.25 * own_slope * others;
    const double sum = place(node, 0) * at[0] + place(node, 1) * at[1] + place(node, 2) * at[2] - 2.0;
    return 0.125 * others * (own_slope * sum + own * place(node, axis));
  }
  static constexpr auto stations() { return gauss_stations<n>(); }
  static constexpr auto mass_stations() { return gauss_stations<3>(); }
  static constexpr std::array<double, 20> mass_share = NodalShape<SerendipityShape<n>, 20, n * n * n>::diagonal_shares();
};

/// Triangle times line, xi, eta >= 0, xi + eta <= 1, -1 <= zeta <= 1: corners of the lower face, then of the upper.
struct WedgeValues {
  static constexpr int nodes = 6;
  static constexpr double triangle(int corner, const std::array<double, 3>& at) {
    return corner == 0 ? 1.0 - at[0] - at[1] : at[corner - 1];
  }
  static constexpr double triangle_slope(int corner, int axis) { return corner == 0 ? -1.0 : corner - 1 == axis ? 1.0 : 0.0; }
  static constexpr double side(int node) { return node < 3 ? -1.0 : 1.0; }
  static constexpr double value(int node, const std::array<double, 3>& at) {
    return triangle(node % 3, at) * 0.5 * (1.0 + side(node) * at[2]);
  }
  static constexpr double slope(int node, int axis, const std::array<double, 3>& at) {
    if (axis == 2) return 0.5 * side(node) * triangle(node % 3, at);
    return triangle_slope(node % 3, axis) * 0.5 * (1.0 + side(node) * at[2]);
  }
  static constexpr auto stations() { return wedge_stations<2>(); }
};

inline constexpr std::array<std::array<int, 2>, 9> wedge_edges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};

/// Serendipity wedge of 15 nodes with three points on the triangle by n along the axis.
template <int n>
struct SerendipityWedgeShape : NodalShape<SerendipityWedgeShape<n>, 15, 3 * n> {
  static constexpr bool natural_modes = false, explicit_steps = false;
  static constexpr double value(int node, const std::array<double, 3>& at) {
    if (node >= 12) return WedgeValues::triangle(node - 12, at) * (1.0 - at[2] * at[2]);
    const auto [first, second] = corners_of(node);
    const double own = WedgeValues::triangle(first % 3, at), side = WedgeValues::side(first) * at[2];
    if (node >= 6) return 2.0 * own * WedgeValues::triangle(second % 3, at) * (1.0 + side);
    return 0.5 * own * (1.0 + side) * (2.0 * own + side - 2.0);
  }
  static constexpr double slope(int node, int axis, const std::array<double, 3>& at) {
    if (node >= 12)
      return axis == 2 ? -2.0 * at[2] * WedgeValues::triangle(node - 12, at)
                       : WedgeValues::triangle_slope(node - 12, axis) * (1.0 - at[2] * at[2]);
    const auto [first, second] = corners_of(node);
    const double own = WedgeValues::triangle(first % 3, at), other = WedgeValues::triangle(second % 3, at);
    const double sign = WedgeValues::side(first), side = sign * at[2];
    const double own_slope = WedgeValues::triangle_slope(first % 3, axis),
                 other_slope = WedgeValues::triangle_slope(second % 3, axis);
    if (node >= 6) return axis == 2 ? 2.0 * own * other * sign : 2.0 * (own_slope * other + own * other_slope) * (1.0 + side);
    return axis == 2 ? 0.5 * own * sign * (2.0 * own + 2.0 * side - 1.0)
                     : 0.5 * own_slope * (1.0 + side) * (4.0 * own + side - 2.0);
  }
  static constexpr auto stations() { return wedge_stations<n>(); }
  static constexpr auto mass_stations() { return product_stations<6, 3>(six_triangle_stations()); }
  static constexpr std::array<double, 15> mass_share = NodalShape<SerendipityWedgeShape<n>, 15, 3 * n>::diagonal_shares();

 private:
  /// The corners between which a node lies; a corner itself, twice.
  static constexpr std::array<int, 2> corners_of(int node) { return node < 6 ? std::array{node, node} : wedge_edges[node - 6]; }
};

using QuadraticWedgeShape = SerendipityWedgeShape<3>;

/// What shape_products needs of the trilinear brick.
struct TrilinearValues {
  static constexpr int nodes = 8;
  static constexpr double value(int node, const std::array<double, 3>& at) {
    const auto [x, y, z] = hexahedron_signs[node];
    return 0.125 * (1.0 + x * at[0]) * (1.0 + y * at[1]) * (1.0 + z * at[2]);
  }
  static constexpr double slope(int node, int axis, const std::array<double, 3>& at) {
    const auto& sign = hexahedron_signs[node];
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    return 0.125 * sign[axis] * (1.0 + sign[next] * at[next]) * (1.0 + sign[last] * at[last]);
  }
  static constexpr auto stations() { return gauss_stations<2>(); }
  static constexpr auto mass_stations() { return gauss_stations<2>(); }
};

/// ElementType::point_shapes.
template <class Shape>
void point_shapes(int point, std::span<double> values) {
  for (int node = 0; node < Shape::nodes; ++node) values[node] = Shape::value(node, Shape::stations()[point].at);
}

/// Integrals of N_I N_J (ElementType::shape_products).
template <class Shape>
void shape_products(std::span<const Point> nodes, std::span<double> products) {
  std::fill(products.begin(), products.end(), 0.0);
  for (const Station& station : Shape::mass_stations()) {
    Matrix3<double> jacobian{};
    std::array<double, Shape::nodes> value;
    for (int node = 0; node < Shape::nodes; ++node) {
      value[node] = Shape::value(node, station.at);
      for (int axis = 0; axis < 3; ++axis) {
        const double slope = Shape::slope(node, axis, station.at);
        for (int i = 0; i < 3; ++i) jacobian(i, axis) += slope * (nodes[node][i] - nodes[0][i]);
      }
    }
    const double weight = station.weight * determinant(jacobian, cofactor(jacobian));
    for (int a = 0; a < Shape::nodes; ++a)
      for (int b = 0; b < Shape::nodes; ++b) products[Shape::nodes * a + b] += weight * value[a] * value[b];
  }
}

}  // namespace balocco
