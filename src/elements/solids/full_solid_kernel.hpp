// The one force kernel of the fully integrated solids (C3D8, C3D6), free of volumetric locking by the variational mean
// dilatation: energy = sum_q w_q W(Fbar_q), Fbar = s F, s = (Jbar / J)^(1/3), Jbar = (1/V) sum_q w_q J_q (Simo, Taylor
// and Pister 1985). Templated over the scalar: Pack in the explicit loop, double, Dual in the implicit solver.
#pragma once

#include <array>

#include "elements/solids/full_solid_shapes.hpp"
#include "math/inverse_cube_root.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// An element's record: per point the inverse of dX/dxi (9) and the weight, then these.
template <class Shape>
struct FullSolidRecord {
  static constexpr int point(int q) { return 10 * q; }
  static constexpr int volume = 10 * Shape::points;
  static constexpr int length =
      volume + 1;  // shortest side of a box: 2 / sqrt(largest eigenvalue of the mean gradients)
  static constexpr int laplacian_bound = volume + 2;  // largest eigenvalue of sum_q w B_I . B_J
  static constexpr int size = volume + 3;
};

template <class T, class Shape>
struct FullSolidKinematics {
  std::array<Matrix3<T>, Shape::points> modified;  // Fbar
  std::array<T, Shape::points> scale;              // s
  std::array<T, Shape::points> jacobian;           // J
  T mean_jacobian;                                 // Jbar
};

/// dx/dxi at a point.
template <class Shape, class T>
Matrix3<T> natural_gradient(const std::array<Vector3<T>, Shape::modes>& c, int q) {
  static constexpr auto quadrature = Shape::quadrature();
  Matrix3<T> natural;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      T sum = c[j][i];  // mode j is the natural coordinate j itself
      for (int k = 3; k < Shape::modes; ++k)
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

template <class Shape, class T, class Reference>
FullSolidKinematics<T, Shape> full_solid_kinematics(const std::array<Vector3<T>, Shape::modes>& c,
                                                    const Reference& reference) {
  using Record = FullSolidRecord<Shape>;
  FullSolidKinematics<T, Shape> k;
  T volume = T(0.0);
  for (int q = 0; q < Shape::points; ++q) {
    k.modified[q] = deformation_gradient<Shape>(c, q, reference);
    k.jacobian[q] = determinant(k.modified[q], cofactor(k.modified[q]));
    volume = volume + k.jacobian[q] * reference[Record::point(q) + 9];
  }
  k.mean_jacobian = volume / T(reference[Record::volume]);
  const T inverse = 1.0 / k.mean_jacobian;
  for (int q = 0; q < Shape::points; ++q) {
    k.scale[q] = inverse_cube_root(k.jacobian[q] * inverse);
    for (auto& component : k.modified[q].component) component = k.scale[q] * component;
  }
  return k;
}

/// Conjugates of the coefficients from Pbar at the points and a viscous mean stress (Cauchy) that works on Jbar:
///   dE = sum w Pbar : dFbar + V stress dJbar;  with p = sum w Pbar : Fbar / (3 V) + Jbar stress this is sum_q T_q :
///   dF_q, T_q = w s [Pbar + (p J/Jbar - Pbar : Fbar / 3) Fbar^-T],  Fbar^-T = cof(Fbar) / Jbar.
template <class Shape, class T, class Reference>
std::array<Vector3<T>, Shape::modes> full_solid_conjugates(const FullSolidKinematics<T, Shape>& k,
                                                           const std::array<Matrix3<T>, Shape::points>& stress,
                                                           const T& mean_stress, const Reference& reference) {
  using Record = FullSolidRecord<Shape>;
  static constexpr auto quadrature = Shape::quadrature();
  std::array<T, Shape::points> work;
  T pressure = T(0.0);
  for (int q = 0; q < Shape::points; ++q) {
    work[q] = (1.0 / 3.0) * double_contraction(stress[q], k.modified[q]);
    pressure = pressure + work[q] * reference[Record::point(q) + 9];
  }
  pressure = pressure / T(reference[Record::volume]) + k.mean_jacobian * mean_stress;
  const T inverse = 1.0 / k.mean_jacobian;

  std::array<Vector3<T>, Shape::modes> g{};
  for (int q = 0; q < Shape::points; ++q) {
    const int base = Record::point(q);
    const T weight = k.scale[q] * reference[base + 9];
    const T spherical = inverse * (pressure * (k.jacobian[q] * inverse) - work[q]);
    const Matrix3<T> cof = cofactor(k.modified[q]);
    Matrix3<T> total;
    for (int i = 0; i < 9; ++i) total.component[i] = weight * (stress[q].component[i] + spherical * cof.component[i]);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int row = base + 3 * j;
        const T natural =
            total(i, 0) * reference[row] + total(i, 1) * reference[row + 1] + total(i, 2) * reference[row + 2];
        g[j][i] = g[j][i] + natural;
        for (int mode = 3; mode < Shape::modes; ++mode)
          if (quadrature[q].derivative[mode][j] != 0.0)
            g[mode][i] = g[mode][i] + quadrature[q].derivative[mode][j] * natural;
      }
    }
  }
  return g;
}

}  // namespace balocco
