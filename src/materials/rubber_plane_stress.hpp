// Neo-Hooke (C01 = 0) and Mooney-Rivlin rubber in plane stress and in a line: the transverse stretch follows from the
// law itself.
//
// At fixed J the energy is C10 J^-2/3 I1 + C01 J^-4/3 I2; J then makes it stationary. Subtracting the vanishing
// transverse stress from the others removes the bulk modulus, hence its round-off, from the stress. Condensing J can
// only lower the tangent, so the second derivative at fixed J bounds it.
#pragma once

#include <array>

#include "materials/stretch.hpp"
#include "math/inverse_cube_root.hpp"
#include "math/pack.hpp"

namespace balocco {

struct RubberConstants {
  double c10, c01, bulk;
};

/// Newton from J = 1 on g(J) = 0 with its slope, `iterations` times: the residual of the transverse stress falls to
/// round-off for stretches in [0.3, 5] and bulk moduli from one shear modulus up.
template <class T, class Residual>
T solve_volume_ratio(const Residual& residual) {
  constexpr int iterations = 8;
  T jacobian = T(1.0);
  for (int i = 0; i < iterations; ++i) {
    const auto [value, slope] = residual(jacobian);
    jacobian = jacobian - value / slope;
  }
  return jacobian;
}

struct RubberPlane {
  RubberConstants constants;

  /// C33 and the factors 2 C10 J^-2/3 and 2 C01 J^-4/3 that belong to the in-plane C.
  template <class T>
  struct Point {
    T c11, c22, c12, trace, determinant, c33, first, second, jacobian;
  };

  template <class T>
  Point<T> prepare(const std::array<T, 3>& strain) const {
    Point<T> p;
    p.c11 = 1.0 + 2.0 * strain[0];
    p.c22 = 1.0 + 2.0 * strain[1];
    p.c12 = strain[2];
    p.trace = p.c11 + p.c22;
    p.determinant = p.c11 * p.c22 - p.c12 * p.c12;
    const T inverse = 1.0 / p.determinant;
    // C33 S33 / 2 = 0 with C33 = J^2 / D
    p.jacobian = solve_volume_ratio<T>([&](const T& j) {
      const T root = inverse_cube_root(j), j2 = root * root, inverse_j = j2 * root;
      const T c33 = j * j * inverse;
      const T a = (2.0 / 3.0 * constants.c10) * j2, b = (2.0 / 3.0 * constants.c01) * (j2 * j2);
      const T term_a = a * (2.0 * c33 - p.trace), term_b = b * (p.trace * c33 - 2.0 * p.determinant);
      const T value = term_a + term_b + constants.bulk * (j * (j - 1.0));
      const T slope =
          inverse_j * (4.0 * (a * c33) + 2.0 * (b * (p.trace * c33)) - (2.0 / 3.0) * term_a - (4.0 / 3.0) * term_b) +
          constants.bulk * (2.0 * j - 1.0);
      return std::array<T, 2>{value, slope};
    });
    const T root = inverse_cube_root(p.jacobian), j2 = root * root;
    p.c33 = p.jacobian * p.jacobian * inverse;
    p.first = (2.0 * constants.c10) * j2;
    p.second = (2.0 * constants.c01) * (j2 * j2);
    return p;
  }

  /// S = 2 C10 J^-2/3 (I - c C^-1) + 2 C01 J^-4/3 (c I + (D - c tr C) C^-1), c = C33, D = det C in the plane.
  template <class T>
  std::array<T, 3> stress(const Point<T>& p) const {
    const T along = p.first + p.second * p.c33;
    const T inverse = (p.second * (p.determinant - p.c33 * p.trace) - p.first * p.c33) / p.determinant;
    return {along + inverse * p.c22, along + inverse * p.c11, -(inverse * p.c12)};
  }

  // At fixed J, with x = C^-1 : dE, N = |C^-1/2 dE C^-1/2|^2 <= n^2 |dE|^2, x^2 <= |C^-1|^2 |dE|^2:
  //   dS : dE = 2 a c (N + x^2) + 2 b [(D + A c) x^2 - 2 c x tr dE + (A c - D) N],  a = 2 C10 J^-2/3, b = 2 C01 J^-4/3,
  //   A = tr C,
  // and tr dE = x / m + y with m = tr(C^-1) / 2, |y| <= r |dE|, r = |I - C^-1 / m|.
  template <class T>
  T bound(const Point<T>& p) const {
    const T inverse = 1.0 / p.determinant;
    const T half_trace = 0.5 * (p.trace * inverse);
    const T radius_square = maximum(half_trace * half_trace - inverse, T(0.0));
    const T radius = square_root(radius_square);
    const T largest = half_trace + radius, n = largest * largest,
            norm = 2.0 * (half_trace * half_trace + radius_square);
    const T skew = 1.4142135623730951 * radius / half_trace;
    const T size = absolute(p.second), c_trace = p.c33 * p.trace;
    const T quadratic = maximum(p.determinant + c_trace - 2.0 * (p.c33 / half_trace), T(0.0)) + p.c33 * skew;
    return p.first * p.c33 * (n + norm) +
           size * (quadratic * norm + absolute(c_trace - p.determinant) * n + p.c33 * skew);
  }

  double energy(const std::array<double, 3>& strain) const {
    const Point<double> p = prepare(strain);
    const double i1 = p.trace + p.c33, i2 = p.determinant + p.c33 * p.trace;
    const double root = inverse_cube_root(p.jacobian), j2 = root * root, change = p.jacobian - 1.0;
    return constants.c10 * (i1 * j2 - 3.0) + constants.c01 * (i2 * j2 * j2 - 3.0) +
           0.5 * constants.bulk * change * change;
  }

  double transverse_stretch(const std::array<double, 3>& strain) const { return square_root(prepare(strain).c33); }
};

struct RubberLine {
  RubberConstants constants;

  template <class T>
  struct Point {
    T axial, transverse, first, second, jacobian;  // C11, C22 = C33, 2 C10 J^-2/3, 2 C01 J^-4/3
  };

  template <class T>
  Point<T> prepare(const std::array<T, 1>& strain) const {
    Point<T> p;
    p.axial = 1.0 + 2.0 * strain[0];
    const T inverse_stretch = 1.0 / square_root(p.axial);
    // C22 S22 / 2 = 0 with C22 = J / sqrt(C11)
    p.jacobian = solve_volume_ratio<T>([&](const T& j) {
      const T root = inverse_cube_root(j), j2 = root * root, inverse_j = j2 * root;
      const T c = j * inverse_stretch;
      const T a = (2.0 / 3.0 * constants.c10) * j2, b = (2.0 / 3.0 * constants.c01) * (j2 * j2);
      const T term_a = a * (c - p.axial), term_b = b * (c * (c - p.axial));
      const T value = term_a + term_b + constants.bulk * (j * (j - 1.0));
      const T slope =
          inverse_j * (a * c + b * (c * (2.0 * c - p.axial)) - (2.0 / 3.0) * term_a - (4.0 / 3.0) * term_b) +
          constants.bulk * (2.0 * j - 1.0);
      return std::array<T, 2>{value, slope};
    });
    const T root = inverse_cube_root(p.jacobian), j2 = root * root;
    p.transverse = p.jacobian * inverse_stretch;
    p.first = (2.0 * constants.c10) * j2;
    p.second = (2.0 * constants.c01) * (j2 * j2);
    return p;
  }

  template <class T>
  std::array<T, 1> stress(const Point<T>& p) const {
    return {(p.first + p.second * p.transverse) * ((p.axial - p.transverse) / p.axial)};
  }

  // Half of dS/dE at fixed J: dC22/dC11 = -C22 / (2 C11).
  template <class T>
  T bound(const Point<T>& p) const {
    const T ratio = p.transverse / p.axial;
    const T mooney = 2.0 * (ratio * ratio) - 0.5 * ratio;
    return 1.5 * (p.first * (ratio / p.axial)) + absolute(p.second * mooney);
  }

  double energy(const std::array<double, 1>& strain) const {
    const Point<double> p = prepare(strain);
    const double i1 = p.axial + 2.0 * p.transverse, i2 = p.transverse * (p.transverse + 2.0 * p.axial);
    const double root = inverse_cube_root(p.jacobian), j2 = root * root, change = p.jacobian - 1.0;
    return constants.c10 * (i1 * j2 - 3.0) + constants.c01 * (i2 * j2 * j2 - 3.0) +
           0.5 * constants.bulk * change * change;
  }

  double transverse_stretch(const std::array<double, 1>& strain) const { return prepare(strain).transverse; }
};

}  // namespace balocco
