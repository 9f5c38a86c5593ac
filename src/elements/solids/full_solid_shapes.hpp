// Shapes and quadratures of the fully integrated solids, in coefficients: x = c_0 + sum_k c_k h_k. Every shape says
//   natural_modes    whether h_1 .. h_3 are the natural coordinates themselves
//   mean_dilatation  whether its volume changes by the mean of its points (full_solid_kernel.hpp) or at each by its own
//   explicit_steps   whether it has an explicit kernel
//   bubbles          declared where it has incompatible modes
//   mass_share       each node's part of a lumped mass.
#pragma once

#include <array>

#include "elements/solids/hexahedron.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// A quadrature point: derivatives of h_k with respect to the natural coordinates and the weight in them.
template <int mode_count>
struct ShapePoint {
  std::array<std::array<double, 3>, mode_count> derivative{};
  double weight = 0.0;
};

template <int nodes>
constexpr std::array<double, nodes> equal_shares() {
  std::array<double, nodes> shares{};
  for (double& share : shares) share = 1.0 / nodes;
  return shares;
}

/// Trilinear brick, 2 x 2 x 2 Gauss points, the first natural coordinate running fastest.
template <bool mean>
struct BrickShape {
  static constexpr int nodes = 8, modes = 7, points = 8;
  static constexpr bool natural_modes = true, mean_dilatation = mean, explicit_steps = true;
  static constexpr auto mass_share = equal_shares<nodes>();

  /// Natural coordinate of a point.
  static constexpr double place(int q, int axis) {
    constexpr double gauss = 0.57735026918962576451;  // 1 / sqrt(3)
    return (q >> axis) % 2 == 0 ? -gauss : gauss;
  }

  static constexpr std::array<ShapePoint<modes>, points> quadrature() {
    std::array<ShapePoint<modes>, points> table{};
    for (int q = 0; q < points; ++q) {
      const double x = place(q, 0), y = place(q, 1), z = place(q, 2);
      table[q].derivative = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, z, y}, {z, 0, x}, {y, x, 0}, {y * z, x * z, x * y}}};
      table[q].weight = 1.0;
    }
    return table;
  }

  template <class T>
  static std::array<Vector3<T>, modes> coefficients(const std::array<Vector3<T>, nodes>& x) {
    return balocco::coefficients(x);
  }
  template <class T>
  static std::array<Vector3<T>, nodes> nodal(const std::array<Vector3<T>, modes>& conjugates) {
    std::array<Vector3<T>, nodes> result;
    for (int i = 0; i < 3; ++i) {
      std::array<T, modes> g;
      std::array<T, nodes> f;
      for (int k = 0; k < modes; ++k) g[k] = conjugates[k][i];
      hadamard_transpose(g, f);
      for (int node = 0; node < nodes; ++node) result[node][i] = f[node];
    }
    return result;
  }
};

using HexahedronShape = BrickShape<true>;
using PlainHexahedronShape = BrickShape<false>;

/// The brick with incompatible modes (full_solid_kernel.hpp).
struct IncompatibleBrickShape : PlainHexahedronShape {
  static constexpr bool bubbles = true;
};

/// Linear wedge, h = {xi, eta, zeta, xi zeta, eta zeta} on the triangle xi, eta >= 0, xi + eta <= 1, -1 <= zeta <= 1.
/// Three points on the triangle by two along the axis: with one on the triangle a twist about the axis through it would
/// cost no energy.
struct WedgeShape {
  static constexpr int nodes = 6, modes = 5, points = 6;
  static constexpr bool natural_modes = true, mean_dilatation = true, explicit_steps = true;
  static constexpr auto mass_share = equal_shares<nodes>();

  static constexpr std::array<ShapePoint<modes>, points> quadrature() {
    constexpr double g = 0.57735026918962576451;
    constexpr double a = 1.0 / 6.0, b = 2.0 / 3.0;
    constexpr double triangle[3][2] = {{a, a}, {b, a}, {a, b}};
    std::array<ShapePoint<modes>, points> table{};
    for (int q = 0; q < points; ++q) {
      const double x = triangle[q % 3][0], y = triangle[q % 3][1], z = q < 3 ? -g : g;
      table[q].derivative = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {z, 0, x}, {0, z, y}}};
      table[q].weight = 1.0 / 6.0;
    }
    return table;
  }

  template <class T>
  static std::array<Vector3<T>, modes> coefficients(const std::array<Vector3<T>, nodes>& x) {
    std::array<Vector3<T>, modes> c;
    for (int i = 0; i < 3; ++i) {
      const T xi_low = x[1][i] - x[0][i], xi_high = x[4][i] - x[3][i];
      const T eta_low = x[2][i] - x[0][i], eta_high = x[5][i] - x[3][i];
      c[0][i] = 0.5 * (xi_low + xi_high);
      c[1][i] = 0.5 * (eta_low + eta_high);
      c[2][i] = 0.5 * (x[3][i] - x[0][i]);
      c[3][i] = 0.5 * (xi_high - xi_low);
      c[4][i] = 0.5 * (eta_high - eta_low);
    }
    return c;
  }
  template <class T>
  static std::array<Vector3<T>, nodes> nodal(const std::array<Vector3<T>, modes>& g) {
    std::array<Vector3<T>, nodes> f;
    for (int i = 0; i < 3; ++i) {
      f[1][i] = 0.5 * (g[0][i] - g[3][i]);
      f[4][i] = 0.5 * (g[0][i] + g[3][i]);
      f[2][i] = 0.5 * (g[1][i] - g[4][i]);
      f[5][i] = 0.5 * (g[1][i] + g[4][i]);
      f[0][i] = -(f[1][i] + f[2][i] + 0.5 * g[2][i]);
      f[3][i] = 0.5 * g[2][i] - (f[4][i] + f[5][i]);
    }
    return f;
  }
};

}  // namespace balocco
