// *HYPERELASTIC, MOONEY-RIVLIN: U = C10 (I1 J^-2/3 - 3) + C01 (I2 J^-4/3 - 3) + (J - 1)^2 / D1.
#pragma once

#include "materials/law_of.hpp"
#include "materials/neo_hooke.hpp"
#include "materials/rubber_bound.hpp"
#include "materials/stretch.hpp"
#include "math/inverse_cube_root.hpp"

namespace balocco {

struct MooneyRivlin {
  static constexpr bool compiled_whole = true;  // law_of.hpp
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

  template <class T>
  TangentBound<T> bound(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T slope = bulk * ((c.jacobian - 1.0) * c.jacobian), curvature = bulk * ((2.0 * c.jacobian - 1.0) * c.jacobian);
    return rubber_bound(c, inverse_cube_root(c.jacobian), c10, c01, slope, curvature).linear;
  }

  template <class T>
  T energy(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian), j2 = root * root, volume_change = c.jacobian - 1.0;
    return c10 * (c.first * j2 - 3.0) + c01 * (c.second * j2 * j2 - 3.0) + 0.5 * bulk * volume_change * volume_change;
  }
};

}  // namespace balocco
