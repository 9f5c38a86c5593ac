// Smooth functions of a square, for tensors a 1 + b D whose D D = d^2 1: no eigenvector, no singularity where d vanishes.
#pragma once

#include <type_traits>

#include "math/dual.hpp"

namespace balocco {

namespace even_detail {

/// sum_k c_k y^k by Horner's rule, c_k = 1 / coefficient(k).
template <class V>
V series(const V& y, int last, double (*coefficient)(int)) {
  V sum = V(1.0 / coefficient(last));
  for (int k = last - 1; k >= 0; --k) sum = sum * y + 1.0 / coefficient(k);
  return sum;
}

inline constexpr double near = 0.01;  // |y| below which nine terms are exact to round-off

}  // namespace even_detail

/// atanh(sqrt(y)) / sqrt(y) for 0 <= y < 1, with its derivative.
template <class T>
T inverse_hyperbolic_tangent_ratio(const T& y) {
  using V = std::decay_t<decltype(value_of(y))>;
  const V value = value_of(y);
  V ratio = even_detail::series(value, 9, [](int k) { return 2.0 * k + 1.0; });
  V slope = even_detail::series(value, 8, [](int k) { return (2.0 * k + 3.0) / (k + 1.0); });
  const auto far = value > even_detail::near;
  if (any(far)) {
    const V root = square_root(value), inverse = 1.0 / maximum(value, V(even_detail::near));
    const V exact = 0.5 * logarithm((1.0 + root) / (1.0 - root)) * (root * inverse);
    ratio = select(far, exact, ratio);
    slope = select(far, 0.5 * (1.0 / (1.0 - value) - exact) * inverse, slope);
  }
  return T(ratio) + (y - T(value)) * T(slope);
}

/// ln(x), quick where x is near 1: 2 atanh((x - 1) / (x + 1)).
template <class T>
T smooth_logarithm(const T& x) {
  const T half = (x - 1.0) / (x + 1.0);
  return 2.0 * (half * inverse_hyperbolic_tangent_ratio(T(half * half)));
}

/// cosh(sqrt(y)) and sinh(sqrt(y)) / sqrt(y) for y >= 0.
template <class V>
V hyperbolic_cosine_of_root(const V& y) {
  V result = even_detail::series(y, 6, [](int k) { double f = 1.0; for (int i = 2; i <= 2 * k; ++i) f *= i; return f; });
  const auto far = y > even_detail::near;
  if (any(far)) {
    const V grown = exponential(square_root(y));
    result = select(far, 0.5 * (grown + 1.0 / grown), result);
  }
  return result;
}
template <class V>
V hyperbolic_sine_ratio_of_root(const V& y) {
  V result = even_detail::series(y, 6, [](int k) { double f = 1.0; for (int i = 2; i <= 2 * k + 1; ++i) f *= i; return f; });
  const auto far = y > even_detail::near;
  if (any(far)) {
    const V root = square_root(y), grown = exponential(root);
    result = select(far, 0.5 * (grown - 1.0 / grown) / maximum(root, V(even_detail::near)), result);
  }
  return result;
}

}  // namespace balocco
