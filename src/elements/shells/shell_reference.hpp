// The reference data of one shell element as its kernels read them.
#pragma once

#include <span>

#include "elements/shells/shell_geometry.hpp"
#include "elements/shells/shell_kernel.hpp"
#include "sections/shell_section.hpp"

namespace balocco {

/// Behind the kernel's own data: what the integration over the surface and the stable increment need.
template <int corners, int points>
struct ShellRecord : ShellLayout<corners> {
  using Layout = ShellLayout<corners>;
  static constexpr bool one_point_quadrilateral = corners == 4 && points == 1;
  // One-point quadrilaterals: stiffness of the modes, 11, 22, 12 of membrane, coupling, bending.
  static constexpr int hourglass = Layout::size;
  // Each point: area, thickness and, of several, the strain of a unit mode (rows 11, 22, 2x12; columns mode 1, 2).
  static constexpr int point_size = points == 1 ? 2 : 8;
  static constexpr int point = hourglass + (one_point_quadrilateral ? 9 : 0);
  static constexpr int eigenvalue = point + points * point_size;  // largest squared frequency at rest
  static constexpr int tension = eigenvalue + 1;                  // squared frequency by a unit of stress
  static constexpr int viscosity = tension + 1;                   // thickness * density * wave speed * length
  static constexpr int dilatation = viscosity + 1;                // squared frequency by a unit of surface modulus
  static constexpr int shear_share = dilatation + 1;              // triangles: part of the shear stiffness that they keep
  static constexpr int size = shear_share + (corners == 3 ? 1 : 0);
};

struct ShellHourglassOptions {
  HourglassControl control = HourglassControl::enhanced;
  double scale = 1.0;
};

/// Fills one lane of a record: component c goes to record[c * pack_size]. `thickness` are those of the corners. What
/// the stable increment needs is left to set_shell_stability.
template <int corners, int points>
void fill_shell_reference(const ShellGeometry& geometry, const ShellSection& section, std::span<const double> thickness,
                          const ShellHourglassOptions& hourglass, double* record);

/// The stable increment's data, from the stiffness at rest (6 freedoms a corner, row-major) and the inertia of the
/// corners.
template <int corners, int points>
void set_shell_stability(const ShellGeometry& geometry, const ShellSection& section, std::span<const double> stiffness,
                         std::span<const double> mass, std::span<const double> rotary_inertia, double* record);

/// Transverse shear strains 2E13 (row 0) and 2E23 at a point of unit edge measures (ShellModes::shear).
template <int corners>
std::array<std::array<double, corners>, 2> shell_shear_strain(const ShellPoint& point);

/// Isotropic rotary inertia of a corner per mass: that of its tributary plate, but in the explicit loop never so small
/// that bending and transverse shear vibrate faster than the membrane (Hughes, Cohen & Haroun, Nucl. Eng. Des. 46,
/// 1978).
double rotary_inertia_per_mass(const ShellSection& section, double thickness);
double scaled_rotary_inertia_per_mass(const ShellSection& section, double thickness, double area);

}  // namespace balocco
