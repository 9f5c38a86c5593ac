// *ELASTIC, TYPE=ANISOTROPIC: S = D : E in the section's material directions, with all of D's 21 moduli.
#pragma once

#include <array>
#include <span>

#include "materials/isotropic_elastic.hpp"

namespace balocco {

struct AnisotropicElastic {
  static constexpr bool compiled_whole = true;  // law_of.hpp
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

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& deformation_gradient) const {
    return deformation_gradient * second_piola(green_lagrange_strain(deformation_gradient));
  }

  template <class T>
  TangentBound<T> bound(const Matrix3<T>& deformation_gradient) const {
    const Matrix3<T> s = second_piola(green_lagrange_strain(deformation_gradient));
    T largest = T(0.0);  // Gershgorin
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      largest = maximum(largest, s(i, i) + absolute(s(i, j)) + absolute(s(i, k)));
    }
    return quadratic_energy_bound(invariants(deformation_gradient), lambda, mu, largest);
  }

  template <class T>
  T energy(const Matrix3<T>& deformation_gradient) const {
    const Matrix3<T> strain = green_lagrange_strain(deformation_gradient);
    return 0.5 * double_contraction(second_piola(strain), strain);
  }
};

}  // namespace balocco
