// The viscous stress of stiffness-proportional Rayleigh damping.
#pragma once

#include <array>

#include "math/tensor.hpp"

namespace balocco {

/// Second Piola-Kirchhoff stress `stiffness` : sym(F^T dF/dt); returns also its power per volume through `power`.
template <class T>
Matrix3<T> rate_stress(const std::array<double, 36>& stiffness, const Matrix3<T>& f, const Matrix3<T>& f_rate,
                       T& power) {
  static constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  const Matrix3<T> product = transpose(f) * f_rate;
  std::array<T, 6> rate;
  for (int a = 0; a < 3; ++a) rate[a] = product(a, a);
  for (int a = 3; a < 6; ++a) rate[a] = product(voigt[a][0], voigt[a][1]) + product(voigt[a][1], voigt[a][0]);
  Matrix3<T> stress;
  power = T(0.0);
  for (int a = 0; a < 6; ++a) {
    T sum = stiffness[6 * a] * rate[0];
    for (int b = 1; b < 6; ++b) sum = sum + stiffness[6 * a + b] * rate[b];
    stress(voigt[a][0], voigt[a][1]) = stress(voigt[a][1], voigt[a][0]) = sum;
    power = power + sum * rate[a];
  }
  return stress;
}

}  // namespace balocco
