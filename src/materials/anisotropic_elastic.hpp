// *ELASTIC, TYPE=ANISOTROPIC: S = D : E in the section's material directions, with all of D's 21 moduli.
#pragma once

#include <array>
#include <span>

#include "materials/directional_elastic.hpp"

namespace balocco {

struct AnisotropicElastic : DirectionalElastic<AnisotropicElastic> {
  static constexpr std::array<std::array<int, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  std::array<double, 36> moduli;  // of S11 S22 S33 S12 S13 S23 over E11 E22 E33 2E12 2E13 2E23
  double lambda, mu;              // D <= lambda I x I + 2 mu Id

  /// `triangle`: the upper one of the moduli, column by column. @throws InputError if they are not positive definite
  static AnisotropicElastic from_moduli(std::span<const double> triangle);

  template <class T>
  Matrix3<T> second_piola(const Matrix3<T>& strain) const {
    Matrix3<T> s;
    for (int row = 0; row < 6; ++row) {
      T sum = T(0.0);
      for (int column = 0; column < 6; ++column)
        sum = sum + ((column < 3 ? 1.0 : 2.0) * moduli[6 * row + column]) * strain(pairs[column][0], pairs[column][1]);
      s(pairs[row][0], pairs[row][1]) = s(pairs[row][1], pairs[row][0]) = sum;
    }
    return s;
  }
};

}  // namespace balocco
