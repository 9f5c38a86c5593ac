// x^(-1/3) by one sequence of operations for doubles and packs, so that a lane equals the scalar bit for bit.
#pragma once

#include "math/dual.hpp"
#include "math/scalar.hpp"

namespace balocco {

/// Accurate to round-off (2 units in the last place) for x in [0.04, 25]; degrades smoothly outside. x > 0.
template <class T>
T inverse_cube_root(const T& x) {
  // Self-reciprocal rational start, y(1/x) = 1/y(x), minimax on [0.04, 25]: relative error 2.1e-2.
  const T square = x * x;
  const T middle = 16.11704069829035 * x;
  T y = (4.187540056036305 + middle + square) / (1.0 + middle + 4.187540056036305 * square);
  // (1 - e)^(-1/3) = 1 + e/3 + 2 e^2/9 + 14 e^3/81 + 35 e^4/243 + ..., e = 1 - x y^3: 2e-2 -> 1e-7 -> 1e-20.
  T e = 1.0 - x * (y * y * y);
  y = y + y * (e * (1.0 / 3.0 + e * (2.0 / 9.0 + e * (14.0 / 81.0 + e * (35.0 / 243.0)))));
  e = 1.0 - x * (y * y * y);
  return y + y * (e * (1.0 / 3.0 + e * (2.0 / 9.0)));
}

template <int N, class Real>
Dual<N, Real> inverse_cube_root(const Dual<N, Real>& x) {
  const Real y = inverse_cube_root(x.value);
  return Dual<N, Real>::chain(y, -(1.0 / 3.0) * (y / x.value), x);
}

}  // namespace balocco
