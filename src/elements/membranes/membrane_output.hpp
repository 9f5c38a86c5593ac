// Stress and strain of a plane point in its material axes, for output.
#pragma once

#include <array>

namespace balocco {

/// Cauchy stress 11 22 33 12 13 23 in local axes that turn with the material: R^T sigma R = U S U / det(U) / thickness ratio, for
/// F = R U, Green strain E11 E22 2E12 and second Piola-Kirchhoff stress S11 S22 S12.
std::array<double, 6> plane_cauchy_stress(const std::array<double, 3>& green_strain, const std::array<double, 3>& stress,
                                          double thickness_ratio);

/// Logarithmic strain ln U, 11 22 33 12 13 23 with engineering shears (2 x tensor component) as Abaqus's LE.
std::array<double, 6> plane_logarithmic_strain(const std::array<double, 3>& green_strain, double thickness_ratio);

/// Mises stress of 11 22 33 12 13 23.
double mises_stress(const std::array<double, 6>& stress);

}  // namespace balocco
