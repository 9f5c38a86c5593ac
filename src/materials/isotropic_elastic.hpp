// *ELASTIC, TYPE=ISOTROPIC: St. Venant-Kirchhoff, S = lambda tr(E) I + 2 mu E with the Green-Lagrange strain E.
#pragma once

#include "materials/law_of.hpp"
#include "materials/stretch.hpp"

namespace balocco {

/// E = (H + H^T + H^T H) / 2 with H = F - I: exact to round-off of the displacement gradient, however small the strain.
template <class T>
Matrix3<T> green_lagrange_strain(const Matrix3<T>& deformation_gradient) {
  const Matrix3<T> gradient = deformation_gradient - Matrix3<T>::identity();
  Matrix3<T> strain;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const T quadratic =
          gradient(0, i) * gradient(0, j) + gradient(1, i) * gradient(1, j) + gradient(2, i) * gradient(2, j);
      strain(i, j) = 0.5 * (gradient(i, j) + gradient(j, i) + quadratic);
      strain(j, i) = strain(i, j);
    }
  }
  return strain;
}

/// Bound of the second variation of a quadratic energy E : D : E / 2 with D <= lambda I x I + 2 mu Id and stress S
/// whose largest eigenvalue is at most `largest_stress`:  d2W = dE : D : dE + S : dF^T dF with dE = sym(F^T dF), |dE|
/// <= |F|_2 |dF|, and tr dE = F : dF = F^-T : dF + (F - F^-T) : dF, where |F - F^-T| = d; Young's inequality with
/// weight d parts the square.
template <class T>
TangentBound<T> quadratic_energy_bound(const Invariants<T>& c, double lambda, double mu, const T& largest_stress) {
  const T distance = square_root(maximum(c.first + c.second / (c.jacobian * c.jacobian) - 6.0, T(0.0)));
  const T stretch = largest_eigenvalue_bound(c.first, c.second);
  return {lambda * (1.0 + distance),
          mu * stretch + 0.5 * (lambda * (distance * (1.0 + distance)) + maximum(largest_stress, T(0.0)))};
}

struct IsotropicElastic {
  static constexpr bool compiled_whole = true;  // law_of.hpp
  double lambda, mu;  // Lame's constants

  static IsotropicElastic from_young(double young, double poisson) {
    return {young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson))};
  }

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& deformation_gradient) const {
    Matrix3<T> second_piola = green_lagrange_strain(deformation_gradient);
    const T pressure = lambda * (second_piola(0, 0) + second_piola(1, 1) + second_piola(2, 2));
    for (auto& s : second_piola.component) s = (2.0 * mu) * s;
    for (int i = 0; i < 3; ++i) second_piola(i, i) = second_piola(i, i) + pressure;
    return deformation_gradient * second_piola;
  }

  template <class T>
  TangentBound<T> bound(const Matrix3<T>& deformation_gradient) const {
    const Invariants<T> c = invariants(deformation_gradient);
    const T largest_strain = 0.5 * (largest_eigenvalue_bound(c.first, c.second) - 1.0);
    const T largest_stress = (0.5 * lambda) * (c.first - 3.0) + (2.0 * mu) * largest_strain;
    return quadratic_energy_bound(c, lambda > 0.0 ? lambda : 0.0, mu, largest_stress);
  }

  template <class T>
  T energy(const Matrix3<T>& deformation_gradient) const {
    const Matrix3<T> e = green_lagrange_strain(deformation_gradient);
    const T trace = e(0, 0) + e(1, 1) + e(2, 2);
    return 0.5 * lambda * trace * trace + mu * double_contraction(e, e);
  }
};

}  // namespace balocco
