// *HYPERELASTIC, OGDEN: U = sum 2 mu_i / alpha_i^2 (l1^alpha_i + l2^alpha_i + l3^alpha_i - 3) + sum (J - 1)^2i / D_i with
// the stretches l of J^-1/3 F. Eigenpairs are found lane by lane: some hundred nanoseconds a point.
#pragma once

#include <cmath>
#include <vector>

#include "materials/law_of.hpp"
#include "materials/stretch.hpp"
#include "math/inverse_cube_root.hpp"
#include "math/symmetric_tensor.hpp"

namespace balocco {

struct Ogden {
  struct Term {
    double modulus, exponent, bulk;  // mu, alpha, 1 / D (0: no such term)
  };
  std::vector<Term> terms;

  double shear_modulus() const {
    double sum = 0.0;
    for (const Term& term : terms) sum += term.modulus;
    return sum;
  }

  /// P = F Cbar^-1 dev M J^-2/3 + U'(J) cof F with M = sum 2 mu / alpha Cbar^(alpha/2) = M(0) + f((Cbar - I) / 2).
  template <class T>
  Matrix3<T> stress(const Matrix3<T>& f) const {
    const Matrix3<T> cof = cofactor(f);
    const T jacobian = determinant(f, cof), root = inverse_cube_root(jacobian);
    const Matrix3<T> isochoric = root * f;
    const SymmetricTensor<T> strain = green_strain(isochoric - Matrix3<T>::identity());
    const SymmetricTensor<T> power = isotropic_function({value, slope, this}, strain);
    const SymmetricTensor<T> deviator = power.plus_identity((-1.0 / 3.0) * trace(power));
    const SymmetricTensor<T> metric = inverse((T(2.0) * strain).plus_identity(T(1.0)));
    return root * (isochoric * full(commuting_product(metric, deviator))) + pressure(jacobian)[0] * cof;
  }

  /// In terms of the logarithmic principal stretches e: d tau_i / d e_j <= 2 m with m = sum |mu| max(l^alpha); the shear of
  /// two directions brings x coth x <= cosh x, x = e_i - e_j, and the stress itself no more than 3 |tau| |l|^2.
  template <class T>
  TangentBound<T> bound(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian), j2 = root * root, inverse_square = 1.0 / (c.jacobian * c.jacobian);
    const T n2 = largest_eigenvalue_bound(c.second * inverse_square, c.first * inverse_square);
    const T large = j2 * largest_eigenvalue_bound(c.first, c.second), small = 1.0 / (n2 / j2);
    T modulus = T(0.0), size = T(0.0);
    for (const Term& term : terms) {
      const T most = maximum(power(large, 0.5 * term.exponent), power(small, 0.5 * term.exponent));
      modulus = modulus + std::fabs(term.modulus) * most;
      size = size + std::fabs(2.0 * term.modulus / term.exponent) * (most - 1.0);
    }
    const auto [slope, curvature] = pressure(c.jacobian);
    const T ratio = square_root(large / small);
    const T stress = 1.7320508075688772 * (maximum(size, T(0.0)) + absolute(slope * c.jacobian));
    return {maximum((curvature * c.jacobian + slope) * c.jacobian, T(0.0)),
            n2 * (0.5 * (modulus * (ratio + 1.0 / ratio)) + 1.5 * stress)};
  }

  double energy(const Matrix3<double>& f) const;

 private:
  static double value(double strain, const void* law);  // sum 2 mu / alpha (c^(alpha/2) - 1), c = 1 + 2 strain
  static double slope(double strain, const void* law);

  template <class T>
  std::array<T, 2> pressure(const T& jacobian) const {
    const T change = jacobian - 1.0, square = change * change;
    T first = T(0.0), second = T(0.0), factor = T(1.0);
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const double twice = 2.0 * (static_cast<double>(k) + 1.0);
      first = first + (twice * terms[k].bulk) * (factor * change);
      second = second + (twice * (twice - 1.0) * terms[k].bulk) * factor;
      factor = factor * square;
    }
    return {first, second};
  }
};

}  // namespace balocco
