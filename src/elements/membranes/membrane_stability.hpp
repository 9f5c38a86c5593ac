// Stable increment of a free membrane element with lumped masses: a safe bound of its largest frequency that is exact for flat
// rectangles at rest. T = double or Pack.
#pragma once

#include <array>

#include "elements/membranes/membrane_kernel.hpp"

namespace balocco {

/// Symmetric 3 x 3 matrix of (E11, E22, 2E12): 11 22 33 12 13 23.
template <class T>
using Symmetric3 = std::array<T, 6>;

/// Largest eigenvalue of A B, both 2 x 2, symmetric and not indefinite.
template <class T>
T largest_eigenvalue(const Metric<T>& a, const Metric<T>& b) {
  const T half_trace = 0.5 * (a.c11 * b.c11 + a.c22 * b.c22) + a.c12 * b.c12;
  const T discriminant = half_trace * half_trace - metric_determinant(a) * metric_determinant(b);
  return half_trace + square_root(maximum(discriminant, T(0.0)));
}

template <class T>
T determinant(const Symmetric3<T>& a) {
  return a[0] * (a[1] * a[2] - a[5] * a[5]) - a[3] * (a[3] * a[2] - a[5] * a[4]) + a[4] * (a[3] * a[5] - a[1] * a[4]);
}

/// Largest eigenvalue of A B, both symmetric and not indefinite, from above: Newton's method on the characteristic polynomial
/// from the bound of Wolkowicz & Styan (1980), mean + sqrt(2) * deviation, falls monotonically towards the largest root.
template <class T>
T largest_eigenvalue(const Symmetric3<T>& a, const Symmetric3<T>& b) {
  const T p[9] = {a[0] * b[0] + a[3] * b[3] + a[4] * b[4], a[0] * b[3] + a[3] * b[1] + a[4] * b[5],
                  a[0] * b[4] + a[3] * b[5] + a[4] * b[2], a[3] * b[0] + a[1] * b[3] + a[5] * b[4],
                  a[3] * b[3] + a[1] * b[1] + a[5] * b[5], a[3] * b[4] + a[1] * b[5] + a[5] * b[2],
                  a[4] * b[0] + a[5] * b[3] + a[2] * b[4], a[4] * b[3] + a[5] * b[1] + a[2] * b[5],
                  a[4] * b[4] + a[5] * b[5] + a[2] * b[2]};
  const T trace = p[0] + p[4] + p[8];
  const T minors = p[0] * p[4] - p[1] * p[3] + p[0] * p[8] - p[2] * p[6] + p[4] * p[8] - p[5] * p[7];
  const T product = determinant(a) * determinant(b);
  const T mean = trace * (1.0 / 3.0);
  T root = mean + 2.0 * square_root(maximum(mean * mean - minors * (1.0 / 3.0), T(0.0)));
  const T least_slope = 1e-6 * (trace * trace) + 1e-300;  // at a multiple root slope and value vanish together
  for (int i = 0; i < 3; ++i) {
    const T value = ((root - trace) * root + minors) * root - product;
    const T slope = (3.0 * root - 2.0 * trace) * root + minors;
    root = root - maximum(value, T(0.0)) / maximum(slope, least_slope);
  }
  return root;
}

/// Largest eigenvalue of the sum of two non-negative matrices with largest eigenvalues `first` and `second`, whose ranges meet
/// at an angle of squared cosine `coupling`.
template <class T>
T coupled_eigenvalue(const T& first, const T& second, const T& coupling) {
  const T difference = 0.5 * (first - second);
  return 0.5 * (first + second) + square_root(difference * difference + coupling * (first * second));
}

/// What the bound needs to know of the current state of an element.
template <class T>
struct MembraneState {
  Metric<T> stretch;          // of the mean tangents
  Symmetric3<T> stiffness;    // upper bound of dS/dE over the points
  T tension;                  // largest principal stress S over the points, at least 0
  Vector3<T> hourglass;       // q (quadrilaterals)
};

/// Damping that acts beside the stiffness.
template <class T>
struct MembraneDamping {
  T viscosity;  // of the surface's rate of dilatation (stress times time)
  T beta;       // stiffness-proportional, relative to MembraneState::stiffness (time)
};

template <class T, int nodes, int points>
struct MembraneStability {
  using Layout = MembraneLayout<nodes, points>;

  /// B M^-1 B^T of the strain-displacement operator: 11, 22, 2x12 and couplings.
  static Symmetric3<T> strain_operator(const Metric<T>& c, const Metric<T>& p) {
    return {c.c11 * p.c11,
            c.c22 * p.c22,
            c.c11 * p.c22 + c.c22 * p.c11 + 2.0 * (c.c12 * p.c12),
            c.c12 * p.c12,
            c.c11 * p.c12 + c.c12 * p.c11,
            c.c22 * p.c12 + c.c12 * p.c22};
  }

  /// Stiffness of the hourglass amplitude, in the basis of the tangents.
  static Metric<T> hourglass_stiffness(const double* reference, const Symmetric3<T>& d) {
    if constexpr (Layout::one_point_quadrilateral) {
      const auto k = [&](int i) { return reference_value<T>(reference, Layout::hourglass_stiffness + i); };
      const T inverse_volume = 1.0 / MembraneKernel<T, nodes, points>::volume(reference, 0);
      return {k(0) * inverse_volume, k(1) * inverse_volume, k(2) * inverse_volume};
    } else {
      const T h11 = reference_value<T>(reference, Layout::mean_gg), h22 = reference_value<T>(reference, Layout::mean_gg + 1),
              h12 = reference_value<T>(reference, Layout::mean_gg + 2);
      return {d[0] * h11 + d[2] * h22 + 2.0 * (d[4] * h12), d[1] * h22 + d[2] * h11 + 2.0 * (d[5] * h12),
              d[3] * h12 + d[2] * h12 + d[4] * h11 + d[5] * h22};
    }
  }

  /// Stable increment 2 / omega * (sqrt(1 + xi^2) - xi), omega and xi from the largest eigenvalues of stiffness and damping.
  static T increment(const double* reference, const MembraneState<T>& state, const MembraneDamping<T>& damping) {
    const auto value = [&](int i) { return reference_value<T>(reference, i); };
    const Metric<T> p{value(Layout::mass_gradient), value(Layout::mass_gradient + 1), value(Layout::mass_gradient + 2)};
    const Metric<T>& c = state.stretch;
    const T material = largest_eigenvalue(state.stiffness, strain_operator(c, p));
    const Metric<T> unit{T(1.0), T(1.0), T(0.0)};
    T stiffness = material + state.tension * largest_eigenvalue(unit, p);
    const T area_square = metric_determinant(c);
    const Metric<T> inverse{c.c22 / area_square, c.c11 / area_square, T(0.0) - c.c12 / area_square};
    T dilatation = p.c11 * inverse.c11 + p.c22 * inverse.c22 + 2.0 * (p.c12 * inverse.c12);
    T damped = material;
    if constexpr (Layout::quadrilateral) {
      const T norm = value(Layout::mass_gamma), coupling = value(Layout::mass_gamma + 1);
      const T gradient = value(Layout::mass_gamma + 2), residual = value(Layout::mass_gamma + 3);
      const Metric<T> gg{value(Layout::mean_gg), value(Layout::mean_gg + 1), value(Layout::mean_gg + 2)};
      const Metric<T> k = hourglass_stiffness(reference, state.stiffness);
      T mode = largest_eigenvalue(k, c);
      if constexpr (Layout::one_point_quadrilateral) {
        const T normal = value(Layout::hourglass_stiffness + 3) / MembraneKernel<T, nodes, points>::volume(reference, 0);
        mode = maximum(mode, normal);
      } else {
        damped = coupled_eigenvalue(material, norm * mode, coupling);
        dilatation = coupled_eigenvalue(
            dilatation, norm * (gg.c11 * inverse.c11 + gg.c22 * inverse.c22 + 2.0 * (gg.c12 * inverse.c12)), coupling);
      }
      stiffness = coupled_eigenvalue(stiffness, norm * (mode + state.tension * (gg.c11 + gg.c22)), coupling);
      // The tangents vary over the element by q g, at most that much relative to the smallest stretch.
      const T half = 0.5 * (c.c11 + c.c22), difference = 0.5 * (c.c11 - c.c22);
      const T least = half - square_root(difference * difference + c.c12 * c.c12);
      const T variation = 1.0 + residual + gradient * square_root(dot(state.hourglass, state.hourglass) / least);
      stiffness = stiffness * (variation * variation);
      damped = damped * (variation * variation);
      dilatation = dilatation * (variation * variation);
    }
    const T omega = square_root(stiffness);
    const T ratio = 0.5 * (damping.viscosity * dilatation + damping.beta * damped) / omega;
    return 2.0 * (square_root(1.0 + ratio * ratio) - ratio) / omega;
  }
};

}  // namespace balocco
