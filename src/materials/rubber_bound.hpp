// Bound of the tangent of rubber whose energy is W(I1 J^-2/3, I2 J^-4/3) + U(J).
#pragma once

#include "materials/stretch.hpp"
#include "materials/tangent_bound.hpp"

namespace balocco {

/// Derivatives of W against its two invariants.
template <class T>
struct RubberDerivatives {
  T first = T(0.0), second = T(0.0), first_first = T(0.0), first_second = T(0.0), second_second = T(0.0);
};

/// With t = F^-T : dF, L = dF F^-1, X = G G^T, G = cof F, n = |F^-1|, a = W1 J^-2/3, b = W2 J^-4/3:
///   d2U = (U'' J^2 + U' J) t^2 - U' J tr(L L); the terms in a as in NeoHooke; those in b
///   b [ (4/9) I2 t^2 - (8/3) t (L : X) - (2/3) I2 tr(L L) + 4 (L L) : X + 2 |L^T G|^2 ],
/// where L : X = (I2/3) t + y, |y| <= eta2 |dF|, eta2^2 = ((4/9) I2^3 - (5/3) I1 I2 J^2 + 3 J^4) / J^2,
/// X = I2/3 I + Y, |Y|_2 <= sqrt(2/3) |Y| with |Y|^2 = (2/3) I2^2 - 2 I1 J^2, and |L^T G| <= J n^2 |dF|.
/// Second derivatives of W: |d(I1 J^-2/3)| <= 2 J^-2/3 eta1 |dF|, |d(I2 J^-4/3)| <= 2 J^-4/3 eta2 |dF|.
template <class T>
struct RubberBound {
  TangentBound<T> linear;  // without the second derivatives of W
  T eta1, eta2;            // |d(I1 J^-2/3)| / (2 J^-2/3 |dF|) and |d(I2 J^-4/3)| / (2 J^-4/3 |dF|) at most

  TangentBound<T> with(const RubberDerivatives<T>& w, const T& j2) const {
    const T one = j2 * eta1, two = (j2 * j2) * eta2, zero = T(0.0);
    const T bent = maximum(w.first_first, zero) * (one * one) + 2.0 * (absolute(w.first_second) * (one * two)) +
                   maximum(w.second_second, zero) * (two * two);
    return {linear.volumetric, linear.shear + 2.0 * bent};
  }
};

/// @param root J^-1/3 @param first, second derivatives W1, W2 @param slope U' J @param curvature U'' J^2 + U' J
template <class T, class Coefficient>
RubberBound<T> rubber_bound(const Invariants<T>& c, const T& root, const Coefficient& first, const Coefficient& second,
                            const T& slope, const T& curvature) {
  const T j2 = root * root, inverse_square = (root * root * root) * (root * root * root);
  const T square = c.jacobian * c.jacobian;
  const T a = first * j2, b = second * (j2 * j2), size_a = absolute(a), size_b = absolute(b);
  const T trace_of_inverse = c.second * inverse_square;
  const T zero = T(0.0);
  const T eta1 = square_root(maximum(c.first * ((1.0 / 9.0) * (c.first * trace_of_inverse) - 1.0), zero));
  const T cube = (4.0 / 9.0) * (c.second * c.second * c.second) - (5.0 / 3.0) * (c.first * c.second * square);
  const T eta2 = square_root(maximum((cube + 3.0 * (square * square)) * inverse_square, zero));
  const T deviator = square_root(maximum((4.0 / 9.0) * (c.second * c.second) - (4.0 / 3.0) * (c.first * square), zero));
  const T n2 = largest_eigenvalue_bound(trace_of_inverse, c.first * inverse_square);
  const T k = (2.0 / 3.0) * (a * c.first + b * c.second) - slope;
  const T cross = size_a * eta1 + size_b * eta2;
  const T volumetric = curvature - (4.0 / 9.0) * (a * c.first + b * c.second) + (4.0 / 3.0) * cross;
  const T shear =
      size_a + 0.5 * (absolute(k) * n2) + (2.0 / 3.0) * cross + size_b * (square * (n2 * n2) + 2.0 * (n2 * deviator));
  return {{maximum(volumetric, zero), shear}, eta1, eta2};
}

}  // namespace balocco
