// *EXPANSION: isotropic thermal expansion of a material.
#pragma once

#include <array>
#include <vector>

namespace balocco {

/// Secant coefficients alpha(T), 1/temperature, from a reference temperature; linear between the rows, constant beyond them.
struct ThermalExpansion {
  double reference = 0.0;                   // ZERO
  std::vector<std::array<double, 2>> rows;  // (alpha, temperature), temperatures rising; never empty

  double coefficient(double temperature) const;
  /// alpha(T) (T - ZERO) - alpha(T0) (T0 - ZERO): thermal strain of matter that was free of it at `initial`.
  double strain(double temperature, double initial) const;
};

}  // namespace balocco
