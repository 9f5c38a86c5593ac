// *HYPERFOAM: U = sum 2 mu_i / alpha_i^2 [l1^alpha_i + l2^alpha_i + l3^alpha_i - 3 + (J^(-alpha_i beta_i) - 1) /
// beta_i] with the principal stretches l of F and beta = nu / (1 - 2 nu) (Storakers 1986). nu = 0: no lateral
// contraction.
#pragma once

#include <cmath>
#include <vector>

#include "materials/law_of.hpp"
#include "materials/stretch.hpp"
#include "math/symmetric_tensor.hpp"

namespace balocco {

struct Hyperfoam {
  struct Term {
    double modulus, exponent, beta;  // mu, alpha, nu / (1 - 2 nu)
  };
  std::vector<Term> terms;

  /// P = F C^-1 M with M = sum 2 mu / alpha (C^(alpha/2) - J^(-alpha beta)); C^(alpha/2) - 1 is a function of the
  /// strain.
  template <class T>
  Matrix3<T> stress(const Matrix3<T>& f) const {
    const Matrix3<T> cof = cofactor(f);
    const T jacobian = determinant(f, cof);
    const SymmetricTensor<T> strain = green_strain(f - Matrix3<T>::identity());
    T pressure = T(0.0);
    for (const Term& term : terms)
      pressure = pressure + (2.0 * term.modulus / term.exponent) * (1.0 - to_the(jacobian, -term.exponent * term.beta));
    const SymmetricTensor<T> kirchhoff = isotropic_function({value, slope, this}, strain).plus_identity(pressure);
    const SymmetricTensor<T> metric = inverse((T(2.0) * strain).plus_identity(T(1.0)));
    return f * full(commuting_product(metric, kirchhoff));
  }

  /// As of Ogden's: d tau_i / d e_j = sum 2 mu (l_i^alpha delta_ij + beta J^(-alpha beta)); the shear of two directions
  /// brings x coth x <= cosh x, and the stress itself no more than 3 |tau| |l|^2.
  template <class T>
  TangentBound<T> bound(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T inverse_square = 1.0 / (c.jacobian * c.jacobian);
    const T n2 = largest_eigenvalue_bound(c.second * inverse_square, c.first * inverse_square);
    const T large = largest_eigenvalue_bound(c.first, c.second), small = 1.0 / n2;
    T modulus = T(0.0), size = T(0.0), volumetric = T(0.0);
    for (const Term& term : terms) {
      const T most = maximum(power(large, 0.5 * term.exponent), power(small, 0.5 * term.exponent));
      const T least = minimum_of(power(large, 0.5 * term.exponent), power(small, 0.5 * term.exponent));
      const T hydrostatic = power(c.jacobian, -term.exponent * term.beta);
      modulus = modulus + std::fabs(term.modulus) * most;
      size = size + std::fabs(2.0 * term.modulus / term.exponent) *
                        maximum(absolute(most - hydrostatic), absolute(least - hydrostatic));
      volumetric = volumetric + std::fabs(2.0 * term.modulus * term.beta) * hydrostatic;
    }
    const T ratio = square_root(large / small);
    return {volumetric, n2 * (0.5 * (modulus * (ratio + 1.0 / ratio)) + 1.5 * (1.7320508075688772 * size))};
  }

  double energy(const Matrix3<double>& f) const;

 private:
  static double value(double strain, const void* law);  // sum 2 mu / alpha (c^(alpha/2) - 1), c = 1 + 2 strain
  static double slope(double strain, const void* law);

  template <class T>
  static T minimum_of(const T& a, const T& b) {
    return -maximum(-a, -b);
  }
  static double to_the(double base, double exponent) { return power(base, exponent); }
  static Pack to_the(const Pack& base, double exponent) { return power(base, exponent); }
  template <int N, class Real>
  static Dual<N, Real> to_the(const Dual<N, Real>& base, double exponent) {
    return Dual<N, Real>::chain(power(base.value, exponent), exponent * power(base.value, exponent - 1.0), base);
  }
};

}  // namespace balocco
