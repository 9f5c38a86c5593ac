// What a point adds to the tangent of a solid with mean dilatation (full_solid_static.hpp has the whole).
#pragma once

#include <array>

#include "math/tensor.hpp"

namespace balocco {

/// With the whole dilatation gbar of the element, dF scaled at the point, H = Fbar^-T, a = w (A : Fbar + P), b = w (Fbar : A + P), pi = w P : Fbar / 3
/// and kappa = w Fbar : A : Fbar / 9 + pi / 3, the second derivative of w W(Fbar) and of the mean is
///   dF : [w A - (a H + H b) / 3 + (kappa + mean) H H + (pi - mean) H x H] : dF + dF : (a / 3 - kappa H) gbar + gbar (b / 3 - kappa H) : dF
///   + kappa gbar gbar,   (H x H)(ia, jb) = H(ib) H(ja),
/// where `mean` is what the point has of the element's pressure.
struct MeanDilatationSlope {
  MeanDilatationSlope(const Matrix3<double>& modified, const Matrix3<double>& stress, const std::array<double, 81>& tangent, double weight,
                      double mean) {
    const Matrix3<double> cof = cofactor(modified);
    const double determinant_inverse = 1.0 / determinant(modified, cof);
    Matrix3<double> a = stress, b = stress;
    for (int i = 0; i < 9; ++i) {
      inverse.component[i] = determinant_inverse * cof.component[i];
      for (int j = 0; j < 9; ++j) {
        a.component[i] += tangent[9 * i + j] * modified.component[j];
        b.component[j] += tangent[9 * i + j] * modified.component[i];
      }
    }
    const double third = weight / 3.0;
    const double pressure = third * double_contraction(stress, modified);
    squared = third / 3.0 * double_contraction(a, modified);  // P : Fbar came along in a
    for (int i = 0; i < 9; ++i) {
      before.component[i] = third * a.component[i] - squared * inverse.component[i];
      behind.component[i] = third * b.component[i] - squared * inverse.component[i];
    }
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 9; ++j)
        of_point[9 * i + j] = weight * tangent[9 * i + j] - third * (a.component[i] * inverse.component[j] + inverse.component[i] * b.component[j]) +
                              (squared + mean) * inverse.component[i] * inverse.component[j] +
                              (pressure - mean) * inverse(i / 3, j % 3) * inverse(j / 3, i % 3);
  }

  std::array<double, 81> of_point;  // row-major, by the components of dF
  Matrix3<double> inverse;          // H
  Matrix3<double> before, behind;   // of gbar
  double squared;                   // kappa
};

}  // namespace balocco
