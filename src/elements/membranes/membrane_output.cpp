#include "elements/membranes/membrane_output.hpp"

#include <cmath>

namespace balocco {

namespace {

struct Symmetric2 {
  double c11, c22, c12;
};

/// Square root of C = 1 + 2E (Hoger & Carlson 1984): U = (C + sqrt(det C)) / sqrt(tr C + 2 sqrt(det C)).
Symmetric2 right_stretch(const std::array<double, 3>& strain) {
  const double c11 = 1.0 + 2.0 * strain[0], c22 = 1.0 + 2.0 * strain[1], c12 = strain[2];
  const double root = std::sqrt(c11 * c22 - c12 * c12), scale = 1.0 / std::sqrt(c11 + c22 + 2.0 * root);
  return {scale * (c11 + root), scale * (c22 + root), scale * c12};
}

}  // namespace

std::array<double, 6> plane_cauchy_stress(const std::array<double, 3>& green_strain, const std::array<double, 3>& stress,
                                          double thickness_ratio) {
  const auto [u11, u22, u12] = right_stretch(green_strain);
  const auto [s11, s22, s12] = stress;
  const double inverse_volume_ratio = 1.0 / ((u11 * u22 - u12 * u12) * thickness_ratio);
  const double a11 = u11 * s11 + u12 * s12, a12 = u11 * s12 + u12 * s22;  // U S
  const double a21 = u12 * s11 + u22 * s12, a22 = u12 * s12 + u22 * s22;
  return {inverse_volume_ratio * (a11 * u11 + a12 * u12), inverse_volume_ratio * (a21 * u12 + a22 * u22), 0.0,
          inverse_volume_ratio * (a11 * u12 + a12 * u22), 0.0, 0.0};
}

std::array<double, 6> plane_logarithmic_strain(const std::array<double, 3>& green_strain, double thickness_ratio) {
  // Principal values ln(1 + 2E) / 2 in the principal directions of E; log1p keeps small strains exact.
  const double mean = 0.5 * (green_strain[0] + green_strain[1]), deviation = 0.5 * (green_strain[0] - green_strain[1]);
  const double radius = std::hypot(deviation, 0.5 * green_strain[2]);
  const double upper = 0.5 * std::log1p(2.0 * (mean + radius)), lower = 0.5 * std::log1p(2.0 * (mean - radius));
  const double centre = 0.5 * (upper + lower), ratio = radius > 0.0 ? 0.5 * (upper - lower) / radius : 0.0;
  return {centre + ratio * deviation, centre - ratio * deviation, std::log(thickness_ratio), ratio * green_strain[2], 0.0,
          0.0};
}

double mises_stress(const std::array<double, 6>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

}  // namespace balocco
