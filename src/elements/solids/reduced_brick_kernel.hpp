// The one force kernel of C3D8R, templated over the scalar: Pack in the explicit loop, double for energies and outputs,
// Dual in the implicit solver. `Reference` gives component k of the element's record (reduced_brick_reference.hpp) as
// reference[k].
#pragma once

#include <array>

#include "elements/solids/hexahedron.hpp"
#include "elements/record_reference.hpp"
#include "elements/solids/reduced_brick_reference.hpp"
#include "materials/stretch.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// F = sum_k c_k (x) beta_k.
template <class T, class Reference>
Matrix3<T> mean_deformation_gradient(const HexahedronCoefficients<T>& c, const Reference& reference) {
  Matrix3<T> f;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      T sum = c[0][i] * reference[brick_record::mean_gradient + j];
      for (int k = 1; k < 7; ++k) sum = sum + c[k][i] * reference[brick_record::mean_gradient + 3 * k + j];
      f(i, j) = sum;
    }
  }
  return f;
}

/// q_a = c_(3+a) - F C_(3+a): what no affine motion has.
template <class T, class Reference>
std::array<Vector3<T>, 4> hourglass_vectors(const HexahedronCoefficients<T>& c, const Matrix3<T>& f,
                                            const Reference& reference) {
  std::array<Vector3<T>, 4> q;
  for (int a = 0; a < 4; ++a) {
    const auto x = reference[brick_record::hourglass_map + 3 * a],
               y = reference[brick_record::hourglass_map + 3 * a + 1],
               z = reference[brick_record::hourglass_map + 3 * a + 2];
    for (int i = 0; i < 3; ++i) q[a][i] = c[3 + a][i] - (f(i, 0) * x + f(i, 1) * y + f(i, 2) * z);
  }
  return q;
}

/// Natural strains of the classes zeta, eta, xi (3 each) and of mode xi eta zeta; bilinear in (c, q).
template <class T>
std::array<T, 12> hourglass_strains(const HexahedronCoefficients<T>& c, const std::array<Vector3<T>, 4>& q) {
  const T q1c1 = dot(q[0], c[0]), q2c2 = dot(q[1], c[1]), q3c3 = dot(q[2], c[2]);
  return {dot(q[1], c[0]), dot(q[0], c[1]), q1c1 + q2c2, dot(q[2], c[0]), dot(q[0], c[2]), q1c1 + q3c3,
          dot(q[2], c[1]), dot(q[1], c[2]), q2c2 + q3c3, dot(q[3], c[0]), dot(q[3], c[1]), dot(q[3], c[2])};
}

/// The record of an isotropic element as that of an anisotropic one. Plane stress in the two axes of a class has the moduli
/// 2 G (h^ac h^bd + nu / (1 - nu) h^ab h^cd), h the inverse of their metric: h11, h12 and h22 say all, times the root of k11 / h11^2.
template <class Reference>
struct IsotropicShape {
  const Reference& record;
  double poisson;

  auto operator[](int k) const {
    const int entry = k - brick_record::stiffness, moduli = 18, root = brick_record::stiffness + 3 * (entry / 6);
    if (entry < 0) return record[k];
    if (entry >= moduli) return record[k - moduli / 2];
    const auto h11 = record[root], h12 = record[root + 1], h22 = record[root + 2];
    switch (entry % 6) {
      case 0: return h11 * h11;
      case 1: return (1.0 - poisson) * (h12 * h12) + poisson * (h11 * h22);
      case 2: return h11 * h12;
      case 3: return h22 * h22;
      case 4: return h22 * h12;
      default: return (0.5 * (1.0 - poisson)) * (h11 * h22) + (0.5 * (1.0 + poisson)) * (h12 * h12);
    }
  }
};

/// Generalised stresses of those strains.
template <class T, class Reference>
std::array<T, 12> hourglass_stresses(const std::array<T, 12>& strain, const Reference& reference) {
  std::array<T, 12> stress;
  for (int c = 0; c < 3; ++c) {
    const int k = brick_record::stiffness + 6 * c, e = 3 * c;
    const auto k12 = reference[k + 1], k13 = reference[k + 2], k23 = reference[k + 4];
    stress[e] = reference[k] * strain[e] + k12 * strain[e + 1] + k13 * strain[e + 2];
    stress[e + 1] = k12 * strain[e] + reference[k + 3] * strain[e + 1] + k23 * strain[e + 2];
    stress[e + 2] = k13 * strain[e] + k23 * strain[e + 1] + reference[k + 5] * strain[e + 2];
  }
  for (int i = 0; i < 3; ++i) stress[9 + i] = reference[brick_record::stiffness + 18 + i] * strain[9 + i];
  return stress;
}

/// Energy of those strains.
template <class T>
T hourglass_energy(const std::array<T, 12>& strain, const auto& reference) {
  const auto stress = hourglass_stresses(strain, reference);
  T energy = T(0.0);
  for (int k = 0; k < 12; ++k) energy = energy + 0.5 * strain[k] * stress[k];
  return energy;
}

/// Energy of hourglass vectors: that of their strains, or with HOURGLASS=STIFFNESS (not `enhanced`) k |q|^2 / 2.
template <class T>
T hourglass_energy(const HexahedronCoefficients<T>& c, const std::array<Vector3<T>, 4>& q, const auto& reference, bool enhanced) {
  if (enhanced) return hourglass_energy(hourglass_strains(c, q), reference);
  T energy = T(0.0);
  for (const auto& vector : q) energy = energy + 0.5 * reference[brick_record::stiffness] * dot(vector, vector);
  return energy;
}

/// Conjugates g_k of the coefficients c_k, from V P and the hourglass stresses: dE = V P : dF + sum_a g_a . (dc_i . q_a
/// + c_i . dq_a).
template <class T, class Reference>
HexahedronCoefficients<T> conjugates_with_stresses(const HexahedronCoefficients<T>& c,
                                                   const std::array<Vector3<T>, 4>& q, const std::array<T, 12>& s,
                                                   Matrix3<T> stress, const Reference& reference) {
  // Component i of mode a multiplies c_i . q_a.
  const Matrix3<T> g{{s[2] + s[5], s[1], s[4], s[0], s[2] + s[8], s[7], s[3], s[6], s[5] + s[8]}};
  std::array<Vector3<T>, 4> r;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) r[a][i] = g(a, 0) * c[0][i] + g(a, 1) * c[1][i] + g(a, 2) * c[2][i];
  for (int i = 0; i < 3; ++i) r[3][i] = s[9] * c[0][i] + s[10] * c[1][i] + s[11] * c[2][i];
  for (int a = 0; a < 4; ++a)
    for (int j = 0; j < 3; ++j) {
      const auto map = reference[brick_record::hourglass_map + 3 * a + j];
      for (int i = 0; i < 3; ++i) stress(i, j) = stress(i, j) - r[a][i] * map;
    }
  HexahedronCoefficients<T> result;
  for (int k = 0; k < 7; ++k) {
    const int b = brick_record::mean_gradient + 3 * k;
    const auto x = reference[b], y = reference[b + 1], z = reference[b + 2];
    for (int i = 0; i < 3; ++i) {
      T sum = stress(i, 0) * x + stress(i, 1) * y + stress(i, 2) * z;
      if (k >= 3)
        sum = sum + r[k - 3][i];
      else
        sum = sum + (g(0, k) * q[0][i] + g(1, k) * q[1][i] + g(2, k) * q[2][i] + s[9 + k] * q[3][i]);
      result[k][i] = sum;
    }
  }
  return result;
}

/// The same with HOURGLASS=STIFFNESS: energy k |q|^2 / 2, so that r_a = k q_a needs no axes.
template <class T, class Reference>
HexahedronCoefficients<T> conjugates_with_scalar(const std::array<Vector3<T>, 4>& force, Matrix3<T> stress,
                                                 const Reference& reference) {
  for (int a = 0; a < 4; ++a)
    for (int j = 0; j < 3; ++j) {
      const auto map = reference[brick_record::hourglass_map + 3 * a + j];
      for (int i = 0; i < 3; ++i) stress(i, j) = stress(i, j) - force[a][i] * map;
    }
  HexahedronCoefficients<T> result;
  for (int k = 0; k < 7; ++k) {
    const int b = brick_record::mean_gradient + 3 * k;
    for (int i = 0; i < 3; ++i) {
      result[k][i] = stress(i, 0) * reference[b] + stress(i, 1) * reference[b + 1] + stress(i, 2) * reference[b + 2];
      if (k >= 3) result[k][i] = result[k][i] + force[k - 3][i];
    }
  }
  return result;
}

/// Nodal forces (1/8) sum_k h_k(node) g_k.
template <class T>
std::array<Vector3<T>, 8> nodal_forces(const HexahedronCoefficients<T>& conjugates) {
  std::array<Vector3<T>, 8> forces;
  for (int i = 0; i < 3; ++i) {
    std::array<T, 7> g;
    std::array<T, 8> f;
    for (int k = 0; k < 7; ++k) g[k] = conjugates[k][i];
    hadamard_transpose(g, f);
    for (int node = 0; node < 8; ++node) forces[node][i] = f[node];
  }
  return forces;
}

}  // namespace balocco
