// *HYPERELASTIC, YEOH, POLYNOMIAL and REDUCED POLYNOMIAL:
// U = sum C_ij (I1 J^-2/3 - 3)^i (I2 J^-4/3 - 3)^j + sum (J - 1)^2k / D_k.
#pragma once

#include <array>
#include <cmath>

#include "materials/law_of.hpp"
#include "materials/rubber_bound.hpp"
#include "materials/stretch.hpp"
#include "math/inverse_cube_root.hpp"

namespace balocco {

struct PolynomialRubber {
  static constexpr int order = 3;
  std::array<std::array<double, order + 1>, order + 1> coefficient{};  // [i][j]
  std::array<double, order> bulk{};                                   // 1 / D_k, 0: no such term

  static PolynomialRubber mooney_rivlin(double c10, double c01, double bulk_modulus) {
    PolynomialRubber law;
    law.coefficient[1][0] = c10;
    law.coefficient[0][1] = c01;
    law.bulk[0] = 0.5 * bulk_modulus;
    return law;
  }

  /// Twice the sum of the linear coefficients.
  double shear_modulus() const { return 2.0 * (coefficient[1][0] + coefficient[0][1]); }

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian), j2 = root * root, inverse = j2 * root;
    const RubberDerivatives<T> w = derivatives(c, j2);
    const T a = 2.0 * (w.first * j2), b = 2.0 * (w.second * (j2 * j2));
    const T spherical =
        pressure(c.jacobian)[0] - inverse * ((1.0 / 3.0) * (a * c.first) + (2.0 / 3.0) * (b * c.second));
    const Matrix3<T> product = (f * transpose(f)) * f;
    const T along = a + b * c.first;
    Matrix3<T> stress;
    for (int k = 0; k < 9; ++k)
      stress.component[k] = along * f.component[k] - b * product.component[k] + spherical * c.cofactor.component[k];
    return stress;
  }

  template <class T>
  TangentBound<T> bound(const Matrix3<T>& f) const {
    const Invariants<T> c = invariants(f);
    const T root = inverse_cube_root(c.jacobian);
    const std::array<T, 2> u = pressure(c.jacobian);
    const T j2 = root * root;
    const RubberDerivatives<T> w = derivatives(c, j2);
    return rubber_bound(c, root, w.first, w.second, T(u[0] * c.jacobian), T((u[1] * c.jacobian + u[0]) * c.jacobian))
        .with(w, j2);
  }

  double energy(const Matrix3<double>& f) const {
    const Invariants<double> c = invariants(f);
    const double root = inverse_cube_root(c.jacobian), j2 = root * root, change = c.jacobian - 1.0;
    const double x = c.first * j2 - 3.0, y = c.second * (j2 * j2) - 3.0;
    double sum = 0.0, volume = 1.0;
    for (int i = 0; i <= order; ++i)
      for (int j = 0; i + j <= order; ++j)
        if (coefficient[i][j] != 0.0) sum += coefficient[i][j] * std::pow(x, i) * std::pow(y, j);
    for (const double k : bulk) {
      volume *= change * change;
      sum += k * volume;
    }
    return sum;
  }

 private:
  template <class T>
  RubberDerivatives<T> derivatives(const Invariants<T>& c, const T& j2) const {
    return derivatives_at(T(c.first * j2 - 3.0), T(c.second * (j2 * j2) - 3.0));
  }
  template <class T>
  RubberDerivatives<T> derivatives_at(const T& x, const T& y) const {
    std::array<T, order + 1> px, py;
    px[0] = py[0] = T(1.0);
    for (int i = 1; i <= order; ++i) {
      px[i] = px[i - 1] * x;
      py[i] = py[i - 1] * y;
    }
    RubberDerivatives<T> w;
    for (int i = 0; i <= order; ++i) {
      for (int j = 0; i + j <= order; ++j) {
        const double k = coefficient[i][j];
        if (k == 0.0) continue;
        if (i > 0) w.first = w.first + (k * i) * (px[i - 1] * py[j]);
        if (j > 0) w.second = w.second + (k * j) * (px[i] * py[j - 1]);
        if (i > 1) w.first_first = w.first_first + (k * i * (i - 1)) * (px[i - 2] * py[j]);
        if (j > 1) w.second_second = w.second_second + (k * j * (j - 1)) * (px[i] * py[j - 2]);
        if (i > 0 && j > 0) w.first_second = w.first_second + (k * i * j) * (px[i - 1] * py[j - 1]);
      }
    }
    return w;
  }

  /// First and second derivative of the volumetric part against J.
  template <class T>
  std::array<T, 2> pressure(const T& jacobian) const {
    const T change = jacobian - 1.0, square = change * change;
    T slope = T(0.0), curvature = T(0.0), factor = T(1.0);
    for (int k = 0; k < order; ++k) {
      const double twice = 2.0 * (k + 1);
      slope = slope + (twice * bulk[k]) * (factor * change);
      curvature = curvature + (twice * (twice - 1.0) * bulk[k]) * factor;
      factor = factor * square;
    }
    return {slope, curvature};
  }
};

}  // namespace balocco
