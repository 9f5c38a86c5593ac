// *HYPERELASTIC, MOONEY-RIVLIN: U = C10 (I1 J^-2/3 - 3) + C01 (I2 J^-4/3 - 3) + (J - 1)^2 / D1.
#pragma once

#include "materials/law_of.hpp"
#include "materials/neo_hooke.hpp"
#include "materials/stretch.hpp"
#include "math/inverse_cube_root.hpp"

namespace balocco {

struct MooneyRivlin {
  double c10, c01, bulk;

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian);
    const T j2 = root * root;              // J^-2/3
    const T inverse = root * root * root;  // 1 / J
    const T a = (2.0 * c10) * j2, b = (2.0 * c01) * (j2 * j2);
    const T spherical =
        bulk * (c.jacobian - 1.0) - inverse * ((1.0 / 3.0) * (a * c.first) + (2.0 / 3.0) * (b * c.second));
    // d I2 / dF = 2 (I1 F - F C) = 2 (I1 I - F F^T) F
    const Matrix3<T> left = f * transpose(f);
    const Matrix3<T> product = left * f;
    const T along = a + b * c.first;
    Matrix3<T> stress;
    for (int k = 0; k < 9; ++k)
      stress.component[k] = along * f.component[k] - b * product.component[k] + spherical * c.cofactor.component[k];
    return stress;
  }

  // As in NeoHooke; the second term, with X = G G^T, G = cof F, L = dF F^-1, n = |F^-1|, gives
  //   C01 J^-4/3 [ (4/9) I2 t^2 - (8/3) t (L : X) - (2/3) I2 tr(L L) + 4 (L L) : X + 2 |L^T G|^2 ],
  // where L : X = (I2/3) t + y, |y| <= eta |dF|, eta^2 = ((4/9) I2^3 - (5/3) I1 I2 J^2 + 3 J^4) / J^2,
  // X = I2/3 I + Y, |Y|_2 <= sqrt(2/3) |Y| with |Y|^2 = (2/3) I2^2 - 2 I1 J^2, and |L^T G| <= J n^2 |dF|.
  template <class T>
  TangentBound<T> bound(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian);
    const T j2 = root * root, inverse_square = (root * root * root) * (root * root * root);
    const T square = c.jacobian * c.jacobian;
    const T a = c10 * j2, b = c01 * (j2 * j2), size_a = absolute(a), size_b = absolute(b);
    const T trace_of_inverse = c.second * inverse_square;
    const T zero = T(0.0);
    const T eta1 = square_root(maximum(c.first * ((1.0 / 9.0) * (c.first * trace_of_inverse) - 1.0), zero));
    const T cube = (4.0 / 9.0) * (c.second * c.second * c.second) - (5.0 / 3.0) * (c.first * c.second * square);
    const T eta2 = square_root(maximum((cube + 3.0 * (square * square)) * inverse_square, zero));
    const T deviator =
        square_root(maximum((4.0 / 9.0) * (c.second * c.second) - (4.0 / 3.0) * (c.first * square), zero));
    const T n2 = largest_eigenvalue_bound(trace_of_inverse, c.first * inverse_square);
    const T k = (2.0 / 3.0) * (a * c.first + b * c.second) - bulk * ((c.jacobian - 1.0) * c.jacobian);
    const T cross = size_a * eta1 + size_b * eta2;
    const T volumetric = bulk * ((2.0 * c.jacobian - 1.0) * c.jacobian) - (4.0 / 9.0) * (a * c.first + b * c.second) +
                         (4.0 / 3.0) * cross;
    const T shear =
        size_a + 0.5 * (absolute(k) * n2) + (2.0 / 3.0) * cross + size_b * (square * (n2 * n2) + 2.0 * (n2 * deviator));
    return {maximum(volumetric, zero), shear};
  }

  double energy(const Matrix3<double>& f) const {
    const Invariants<double> c = invariants(f);
    const double root = inverse_cube_root(c.jacobian), j2 = root * root, volume_change = c.jacobian - 1.0;
    return c10 * (c.first * j2 - 3.0) + c01 * (c.second * j2 * j2 - 3.0) + 0.5 * bulk * volume_change * volume_change;
  }
};

}  // namespace balocco
