// The trilinear hexahedron in Hadamard coefficients: x = sum_k c_k h_k with
//   h = {1, xi, eta, zeta, eta zeta, xi zeta, xi eta, xi eta zeta},  c_k = (1/8) sum_I h_k(node I) x_I,
// so that a one-point brick works on 7 coefficients instead of 8 nodes, found by butterflies (24 additions a
// component).
#pragma once

#include <array>
#include <span>

#include "math/tensor.hpp"

namespace balocco {

/// Signs of (xi, eta, zeta) at the nodes, in Abaqus's order.
inline constexpr std::array<std::array<int, 3>, 8> hexahedron_signs{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

/// Coefficients 1 .. 7 (index 0 .. 6); the mean position c_0 strains nothing.
template <class T>
using HexahedronCoefficients = std::array<Vector3<T>, 7>;

/// One component of the coefficients from that component of the nodes.
template <class T>
void hadamard(const std::array<T, 8>& x, std::array<T, 7>& c) {
  const T s0 = x[0] + x[1], d0 = x[1] - x[0];  // along xi on the four edges
  const T s1 = x[3] + x[2], d1 = x[2] - x[3];
  const T s2 = x[4] + x[5], d2 = x[5] - x[4];
  const T s3 = x[7] + x[6], d3 = x[6] - x[7];
  const T ss0 = s0 + s1, sd0 = s1 - s0, ds0 = d0 + d1, dd0 = d1 - d0;  // then along eta
  const T ss1 = s2 + s3, sd1 = s3 - s2, ds1 = d2 + d3, dd1 = d3 - d2;
  c[0] = 0.125 * (ds0 + ds1);
  c[1] = 0.125 * (sd0 + sd1);
  c[2] = 0.125 * (ss1 - ss0);
  c[3] = 0.125 * (sd1 - sd0);
  c[4] = 0.125 * (ds1 - ds0);
  c[5] = 0.125 * (dd0 + dd1);
  c[6] = 0.125 * (dd1 - dd0);
}

/// The transpose: nodal values (1/8) sum_k h_k(node) g_k of one component.
template <class T>
void hadamard_transpose(const std::array<T, 7>& g, std::array<T, 8>& f) {
  const T ds0 = g[0] - g[4], ds1 = g[0] + g[4];
  const T sd0 = g[1] - g[3], sd1 = g[1] + g[3];
  const T dd0 = g[5] - g[6], dd1 = g[5] + g[6];
  const T s0 = -(g[2] + sd0), s1 = sd0 - g[2], s2 = g[2] - sd1, s3 = g[2] + sd1;
  const T d0 = ds0 - dd0, d1 = ds0 + dd0, d2 = ds1 - dd1, d3 = ds1 + dd1;
  f[0] = 0.125 * (s0 - d0);
  f[1] = 0.125 * (s0 + d0);
  f[2] = 0.125 * (s1 + d1);
  f[3] = 0.125 * (s1 - d1);
  f[4] = 0.125 * (s2 - d2);
  f[5] = 0.125 * (s2 + d2);
  f[6] = 0.125 * (s3 + d3);
  f[7] = 0.125 * (s3 - d3);
}

template <class T>
HexahedronCoefficients<T> coefficients(const std::array<Vector3<T>, 8>& nodes) {
  HexahedronCoefficients<T> result;
  for (int i = 0; i < 3; ++i) {
    std::array<T, 8> x;
    std::array<T, 7> c;
    for (int node = 0; node < 8; ++node) x[node] = nodes[node][i];
    hadamard(x, c);
    for (int k = 0; k < 7; ++k) result[k][i] = c[k];
  }
  return result;
}

/// Reference geometry of a one-point brick.
struct HexahedronGeometry {
  HexahedronCoefficients<double> coefficients;   // C_1 .. C_7
  std::array<Vector3<double>, 7> mean_gradient;  // beta_k = (1/V) integral of grad h_k dV: F = sum c_k (x) beta_k
  double volume = 0.0;
  double smallest_jacobian = 0.0;  // least det dX/dxi over the Gauss points and the nodes

  explicit HexahedronGeometry(std::span<const Vector3<double>, 8> nodes);
};

}  // namespace balocco
