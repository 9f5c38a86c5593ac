// The one force kernel of the fully integrated solids. Linear bricks and wedges are free of volumetric locking by the variational
// mean dilatation: energy = sum_q w_q W(Fbar_q), Fbar = s F, s = (Jbar / J)^(1/3), Jbar = (1/V) sum_q w_q J_q (Simo, Taylor
// and Pister 1985); the others have s = 1, the plain sum_q w_q W(F_q), and Jbar for bulk viscosity alone. Templated over the
// scalar: Pack in the explicit loop, double, Dual in the implicit solver.
#pragma once

#include <array>

#include "elements/solids/full_solid_shapes.hpp"
#include "math/inverse_cube_root.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Shapes with incompatible modes: x + F0 sum_m alpha_m (1 - xi_m^2), F0 at the centre, whose three vectors alpha (in reference
/// directions, so that they turn with the element) are where the energy is least. Their gradients are taken as
/// (j0 / j) dxi/dX at the centre, which keeps the patch test (Taylor, Beresford and Wilson 1976; Simo, Armero and Taylor 1993).
template <class Shape>
inline constexpr bool has_bubbles = requires { Shape::bubbles; };

template <class T>
using BubbleAmplitudes = std::array<Vector3<T>, 3>;

/// An element's record: per point the inverse of dX/dxi (9) and the weight, then these.
template <class Shape>
struct FullSolidRecord {
  static constexpr int point(int q) { return 10 * q; }
  static constexpr int volume = 10 * Shape::points;
  static constexpr int length =
      volume + 1;  // shortest side of a box: 2 / sqrt(largest eigenvalue of the mean gradients)
  static constexpr int laplacian_bound = volume + 2;  // largest eigenvalue of sum_q w B_I . B_J
  static constexpr int centre = volume + 3;             // bubbles: inverse of dX/dxi at the centre,
  static constexpr int bubble = centre + 9;             //   that times -2 j0,
  static constexpr int bubble_flexibility = bubble + 9;  //   inverse of the stiffness of the amplitudes in the reference configuration
  static constexpr int size = has_bubbles<Shape> ? bubble_flexibility + 81 : volume + 3;
};

template <class T, class Shape>
struct FullSolidKinematics {
  std::array<Matrix3<T>, Shape::points> modified;  // Fbar
  std::array<T, Shape::points> scale;              // s
  std::array<T, Shape::points> jacobian;           // J
  T mean_jacobian;                                 // Jbar
  Matrix3<T> centre;                               // bubbles: F0,
  std::array<Matrix3<T>, has_bubbles<Shape> ? Shape::points : 0> bubble;  // H, F = dx/dX + F0 H
};

/// dx/dxi at a point.
template <class Shape, class T>
Matrix3<T> natural_gradient(const std::array<Vector3<T>, Shape::modes>& c, int q) {
  static constexpr auto quadrature = Shape::quadrature();
  Matrix3<T> natural;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      // Natural modes: mode j is the natural coordinate j itself.
      T sum = Shape::natural_modes ? c[j][i] : quadrature[q].derivative[0][j] * c[0][i];
      for (int k = Shape::natural_modes ? 3 : 1; k < Shape::modes; ++k)
        if (quadrature[q].derivative[k][j] != 0.0) sum = sum + quadrature[q].derivative[k][j] * c[k][i];
      natural(i, j) = sum;
    }
  }
  return natural;
}

/// F at a point.
template <class Shape, class T, class Reference>
Matrix3<T> deformation_gradient(const std::array<Vector3<T>, Shape::modes>& c, int q, const Reference& reference) {
  const Matrix3<T> natural = natural_gradient<Shape>(c, q);
  const int base = FullSolidRecord<Shape>::point(q);
  Matrix3<T> f;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      f(i, j) = natural(i, 0) * reference[base + j] + natural(i, 1) * reference[base + 3 + j] +
                natural(i, 2) * reference[base + 6 + j];
  return f;
}

/// dx/dX at the centre of a shape with natural modes.
template <class Shape, class T, class Reference>
Matrix3<T> centre_gradient(const std::array<Vector3<T>, Shape::modes>& c, const Reference& reference) {
  const int base = FullSolidRecord<Shape>::centre;
  Matrix3<T> f;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      f(i, j) = c[0][i] * reference[base + j] + c[1][i] * reference[base + 3 + j] + c[2][i] * reference[base + 6 + j];
  return f;
}

/// H at a point.
template <class Shape, class T, class Reference>
Matrix3<T> bubble_gradient(const BubbleAmplitudes<T>& amplitude, int q, const Reference& reference) {
  using Record = FullSolidRecord<Shape>;
  const auto inverse_weight = 1.0 / reference[Record::point(q) + 9];
  Matrix3<T> h{};
  for (int m = 0; m < 3; ++m)
    for (int k = 0; k < 3; ++k) {
      const T scaled = (Shape::place(q, m) * inverse_weight) * amplitude[m][k];
      for (int j = 0; j < 3; ++j) h(k, j) = h(k, j) + scaled * reference[Record::bubble + 3 * m + j];
    }
  return h;
}

template <class Shape, class T, class Reference>
FullSolidKinematics<T, Shape> full_solid_kinematics(const std::array<Vector3<T>, Shape::modes>& c, const Reference& reference,
                                                    const BubbleAmplitudes<T>& amplitude = {}) {
  using Record = FullSolidRecord<Shape>;
  FullSolidKinematics<T, Shape> k;
  T volume = T(0.0);
  if constexpr (has_bubbles<Shape>) k.centre = centre_gradient<Shape>(c, reference);
  for (int q = 0; q < Shape::points; ++q) {
    k.modified[q] = deformation_gradient<Shape>(c, q, reference);
    if constexpr (has_bubbles<Shape>) {
      k.bubble[q] = bubble_gradient<Shape>(amplitude, q, reference);
      k.modified[q] = k.modified[q] + k.centre * k.bubble[q];
    }
    k.jacobian[q] = determinant(k.modified[q], cofactor(k.modified[q]));
    volume = volume + k.jacobian[q] * reference[Record::point(q) + 9];
  }
  k.mean_jacobian = volume / T(reference[Record::volume]);
  if constexpr (!Shape::mean_dilatation) {
    k.scale.fill(T(1.0));
    return k;
  }
  const T inverse = 1.0 / k.mean_jacobian;
  for (int q = 0; q < Shape::points; ++q) {
    k.scale[q] = inverse_cube_root(k.jacobian[q] * inverse);
    for (auto& component : k.modified[q].component) component = k.scale[q] * component;
  }
  return k;
}

/// Adds to `g` what a force on dF at a point is on the coefficients.
template <class Shape, class T, class Reference>
void add_conjugates(const Matrix3<T>& force, int q, const Reference& reference, std::array<Vector3<T>, Shape::modes>& g) {
  static constexpr auto quadrature = Shape::quadrature();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int row = FullSolidRecord<Shape>::point(q) + 3 * j;
      const T natural = force(i, 0) * reference[row] + force(i, 1) * reference[row + 1] + force(i, 2) * reference[row + 2];
      if constexpr (Shape::natural_modes) g[j][i] = g[j][i] + natural;
      for (int mode = Shape::natural_modes ? 3 : 0; mode < Shape::modes; ++mode)
        if (quadrature[q].derivative[mode][j] != 0.0) g[mode][i] = g[mode][i] + quadrature[q].derivative[mode][j] * natural;
    }
  }
}

/// Conjugates of the coefficients from Pbar at the points and a viscous mean stress (Cauchy) that works on Jbar:
///   dE = sum w Pbar : dFbar + V stress dJbar;  with p = sum w Pbar : Fbar / (3 V) + Jbar stress this is sum_q T_q :
///   dF_q, T_q = w s [Pbar + (p J/Jbar - Pbar : Fbar / 3) Fbar^-T],  Fbar^-T = cof(Fbar) / Jbar. Without the mean
/// dilatation T_q = w [P + stress cof(F)].
template <class Shape, class T, class Reference>
std::array<Vector3<T>, Shape::modes> full_solid_conjugates(const FullSolidKinematics<T, Shape>& k,
                                                           const std::array<Matrix3<T>, Shape::points>& stress,
                                                           const T& mean_stress, const Reference& reference) {
  using Record = FullSolidRecord<Shape>;
  std::array<T, Shape::points> spherical;
  if constexpr (Shape::mean_dilatation) {
    T pressure = T(0.0);
    for (int q = 0; q < Shape::points; ++q) {
      spherical[q] = (1.0 / 3.0) * double_contraction(stress[q], k.modified[q]);
      pressure = pressure + spherical[q] * reference[Record::point(q) + 9];
    }
    pressure = pressure / T(reference[Record::volume]) + k.mean_jacobian * mean_stress;
    const T inverse = 1.0 / k.mean_jacobian;
    for (int q = 0; q < Shape::points; ++q) spherical[q] = inverse * (pressure * (k.jacobian[q] * inverse) - spherical[q]);
  } else {
    spherical.fill(mean_stress);
  }

  std::array<Vector3<T>, Shape::modes> g{};
  Matrix3<T> on_centre{};
  for (int q = 0; q < Shape::points; ++q) {
    const int base = Record::point(q);
    const T weight = k.scale[q] * reference[base + 9];
    const Matrix3<T> cof = cofactor(k.modified[q]);
    Matrix3<T> total;
    for (int i = 0; i < 9; ++i) total.component[i] = weight * (stress[q].component[i] + spherical[q] * cof.component[i]);
    add_conjugates<Shape>(total, q, reference, g);
    if constexpr (has_bubbles<Shape>) on_centre = on_centre + total * transpose(k.bubble[q]);
  }
  if constexpr (has_bubbles<Shape>)
    for (int n = 0; n < 3; ++n)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) g[n][i] = g[n][i] + on_centre(i, j) * reference[Record::centre + 3 * n + j];
  return g;
}

}  // namespace balocco
