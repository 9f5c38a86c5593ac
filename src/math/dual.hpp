// Dual numbers: a value and its N partial derivatives. The implicit solver instantiates element, material and contact
// kernels with them, so that its tangent is the exact derivative of the force that the explicit loop integrates. Over
// packs they serve the local iterations of material laws.
#pragma once

#include <array>
#include <cmath>
#include <concepts>

#include "math/scalar.hpp"

namespace balocco {

template <int N, class Real = double>
struct Dual {
  Real value = 0.0;
  std::array<Real, N> derivative{};

  Dual() = default;
  /// A constant is a dual with zero derivatives.
  template <class Constant>
    requires std::convertible_to<Constant, Real>
  Dual(const Constant& constant) : value(constant) {}  // NOLINT
  /// The independent variable number `direction`.
  Dual(const Real& variable, int direction) : value(variable) { derivative[direction] = 1.0; }

  Dual& operator+=(const Dual& other) { return *this = *this + other; }
  Dual& operator-=(const Dual& other) { return *this = *this - other; }
  Dual& operator*=(const Dual& other) { return *this = *this * other; }

  friend Dual operator+(const Dual& a, const Dual& b) { return combine(a.value + b.value, 1.0, a, 1.0, b); }
  friend Dual operator-(const Dual& a, const Dual& b) { return combine(a.value - b.value, 1.0, a, -1.0, b); }
  friend Dual operator*(const Dual& a, const Dual& b) { return combine(a.value * b.value, b.value, a, a.value, b); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Real quotient = a.value / b.value;
    return combine(quotient, 1.0 / b.value, a, -quotient / b.value, b);
  }
  friend Dual operator-(const Dual& a) { return chain(-a.value, -1.0, a); }
  friend Dual operator+(const Dual& a, double b) { return chain(a.value + b, 1.0, a); }
  friend Dual operator+(double a, const Dual& b) { return chain(a + b.value, 1.0, b); }
  friend Dual operator-(const Dual& a, double b) { return chain(a.value - b, 1.0, a); }
  friend Dual operator-(double a, const Dual& b) { return chain(a - b.value, -1.0, b); }
  friend Dual operator*(const Dual& a, double b) { return chain(a.value * b, b, a); }
  friend Dual operator*(double a, const Dual& b) { return chain(a * b.value, a, b); }
  friend Dual operator/(const Dual& a, double b) { return chain(a.value / b, 1.0 / b, a); }
  friend Dual operator/(double a, const Dual& b) { return chain(a / b.value, -a / (b.value * b.value), b); }

  friend auto operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend auto operator>(const Dual& a, const Dual& b) { return a.value > b.value; }

  friend Dual square_root(const Dual& a) {
    const Real root = square_root(a.value);
    return chain(root, 0.5 / root, a);
  }
  friend Dual maximum(const Dual& a, const Dual& b) { return select(a.value > b.value, a, b); }
  template <class Condition>
  friend Dual select(const Condition& condition, const Dual& yes, const Dual& no) {
    Dual result(select(condition, yes.value, no.value));
    for (int i = 0; i < N; ++i) result.derivative[i] = select(condition, yes.derivative[i], no.derivative[i]);
    return result;
  }

  friend Dual exponential(const Dual& a) {
    const Real e = exponential(a.value);
    return chain(e, e, a);
  }

  /// A function of one dual: its value and its slope at `a`.
  static Dual chain(const Real& value, const Real& slope, const Dual& a) {
    Dual result(value);
    for (int i = 0; i < N; ++i) result.derivative[i] = slope * a.derivative[i];
    return result;
  }

 private:
  static Dual combine(const Real& value, const Real& slope_a, const Dual& a, const Real& slope_b, const Dual& b) {
    Dual result(value);
    for (int i = 0; i < N; ++i) result.derivative[i] = slope_a * a.derivative[i] + slope_b * b.derivative[i];
    return result;
  }
};

/// The plain value of a scalar of any kind.
inline double value_of(double x) { return x; }
template <PackOfLanes T>
const T& value_of(const T& x) {
  return x;
}
template <int N, class Real>
const Real& value_of(const Dual<N, Real>& x) {
  return x.value;
}

}  // namespace balocco
