// Dual numbers: a value and its N partial derivatives. The implicit solver instantiates element, material and contact
// kernels with them, so that its tangent is the exact derivative of the force that the explicit loop integrates.
#pragma once

#include <array>
#include <cmath>

namespace balocco {

template <int N>
struct Dual {
  double value = 0.0;
  std::array<double, N> derivative{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: a constant is a dual with zero derivatives
  /// The independent variable number `direction`.
  Dual(double variable, int direction) : value(variable) { derivative[direction] = 1.0; }

  Dual& operator+=(const Dual& other) { return *this = *this + other; }
  Dual& operator-=(const Dual& other) { return *this = *this - other; }
  Dual& operator*=(const Dual& other) { return *this = *this * other; }

  friend Dual operator+(const Dual& a, const Dual& b) { return combine(a.value + b.value, 1.0, a, 1.0, b); }
  friend Dual operator-(const Dual& a, const Dual& b) { return combine(a.value - b.value, 1.0, a, -1.0, b); }
  friend Dual operator*(const Dual& a, const Dual& b) { return combine(a.value * b.value, b.value, a, a.value, b); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
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

  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }

  friend Dual square_root(const Dual& a) {
    const double root = std::sqrt(a.value);
    return chain(root, 0.5 / root, a);
  }
  friend Dual maximum(const Dual& a, const Dual& b) { return a.value > b.value ? a : b; }
  friend Dual select(bool condition, const Dual& yes, const Dual& no) { return condition ? yes : no; }

  /// A function of one dual: its value and its slope at `a`.
  static Dual chain(double value, double slope, const Dual& a) {
    Dual result(value);
    for (int i = 0; i < N; ++i) result.derivative[i] = slope * a.derivative[i];
    return result;
  }

 private:
  static Dual combine(double value, double slope_a, const Dual& a, double slope_b, const Dual& b) {
    Dual result(value);
    for (int i = 0; i < N; ++i) result.derivative[i] = slope_a * a.derivative[i] + slope_b * b.derivative[i];
    return result;
  }
};

/// The plain value of a scalar of any kind.
inline double value_of(double x) { return x; }
template <int N>
double value_of(const Dual<N>& x) {
  return x.value;
}

}  // namespace balocco
