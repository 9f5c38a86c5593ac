// *HYPERELASTIC, NEO HOOKE: U = C10 (I1 J^-2/3 - 3) + (J - 1)^2 / D1.
#pragma once

#include "materials/law_of.hpp"
#include "materials/stretch.hpp"
#include "math/inverse_cube_root.hpp"

namespace balocco {

/// Bulk modulus 2 / D1. D1 = 0 asks for an incompressible material, which neither solver can take: as Abaqus/Explicit
/// does, the bulk modulus is then 20 times the shear modulus mu0 (Poisson's ratio 0.475).
inline double bulk_modulus(double d1, double shear_modulus) {
  return d1 > 0.0 ? 2.0 / d1 : 20.0 * shear_modulus;
}

struct NeoHooke {
  static constexpr bool compiled_whole = true;  // law_of.hpp
  double c10, bulk;

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian);
    const T isochoric = (2.0 * c10) * (root * root);
    const T spherical = bulk * (c.jacobian - 1.0) - (1.0 / 3.0) * (isochoric * (c.first * (root * root * root)));
    Matrix3<T> stress;
    for (int k = 0; k < 9; ++k) stress.component[k] = isochoric * f.component[k] + spherical * c.cofactor.component[k];
    return stress;
  }

  // With t = F^-T : dF, A = F^-1 dF, j = J^-2/3:
  //   d2U = 2 C10 j |dF|^2 - (8/3) C10 j t (F : dF) + (4/9) C10 j I1 t^2 + K (2 J - 1) J t^2 + k tr(A A),
  //   k = (2/3) C10 j I1 - K (J - 1) J,  tr(A A) <= |F^-1|^2 |dF|^2,
  // and F : dF = (I1/3) t + y, |y| <= eta |dF|, eta^2 = |F - (I1/3) F^-T|^2 = I1 (I1 tr(C^-1) / 9 - 1), zero where C ~
  // I.
  template <class T>
  TangentBound<T> bound(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian);
    const T isochoric = c10 * (root * root);
    const T inverse_square = (root * root * root) * (root * root * root);
    const T trace_of_inverse = c.second * inverse_square;
    const T eta = square_root(maximum(c.first * ((1.0 / 9.0) * (c.first * trace_of_inverse) - 1.0), T(0.0)));
    const T inverse_stretch = largest_eigenvalue_bound(trace_of_inverse, c.first * inverse_square);
    const T k = (2.0 / 3.0) * (isochoric * c.first) - bulk * ((c.jacobian - 1.0) * c.jacobian);
    const T volumetric = bulk * ((2.0 * c.jacobian - 1.0) * c.jacobian) - (4.0 / 9.0) * (isochoric * c.first) +
                         (4.0 / 3.0) * (isochoric * eta);
    return {maximum(volumetric, T(0.0)),
            isochoric + 0.5 * (absolute(k) * inverse_stretch) + (2.0 / 3.0) * (isochoric * eta)};
  }

  template <class T>
  T energy(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian);
    const T volume_change = c.jacobian - 1.0;
    return c10 * (c.first * root * root - 3.0) + 0.5 * bulk * volume_change * volume_change;
  }
};

}  // namespace balocco
