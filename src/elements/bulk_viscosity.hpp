// Bulk viscosity and the stable increment of solids, over packs or doubles.
#pragma once

#include "math/scalar.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Logarithmic volume rate over an increment, from the Jacobians at its ends: 2 (J - J0) / ((J + J0) dt) = d(ln J)/dt
/// to third order, without a logarithm.
template <class T>
T volume_rate(const T& jacobian, const T& old_jacobian, double inverse_increment) {
  return (2.0 * inverse_increment) * ((jacobian - old_jacobian) / (jacobian + old_jacobian));
}

/// Work of a viscous stress over a change of its strain, half with the stress before, half with the one after, as central differences
/// weigh forces. The new stress alone would book a dissipation of vibrations near the limit of stability, whose rates alternate,
/// that does not take place.
template <class T>
T viscous_work(const T& old_stress, const T& new_stress, const T& change) {
  return 0.5 * ((old_stress + new_stress) * change);
}

/// Linear and quadratic coefficients of bulk viscosity with what they multiply.
struct BulkViscosity {
  double linear = 0.0;     // b1 rho c_d: stress = linear L d
  double quadratic = 0.0;  // b2^2 rho: stress = quadratic L^2 |d| min(d, 0)

  BulkViscosity(double b1, double b2, double density, double wave_speed)
      : linear(b1 * density * wave_speed), quadratic(b2 * b2 * density) {}

  /// Viscous mean stress for volume rate d, positive in expansion.
  template <class T>
  T stress(const T& length, const T& d) const {
    const T compression = maximum(-d, T(0.0));
    return length * (linear * d - (quadratic * length) * (compression * compression));
  }
  /// Its slope with respect to d.
  template <class T>
  T slope(const T& length, const T& d) const {
    return length * (linear + (2.0 * quadratic * length) * maximum(-d, T(0.0)));
  }
};

/// The increment at which central differences with velocities half a step behind are neutrally stable for a mode of
/// squared circular frequency `omega_square` and damping `rate` = 2 xi omega: (omega dt / 2)^2 + rate dt / 2 = 1, that
/// is 2 / omega (sqrt(1 + xi^2) - xi).
template <class T>
T neutral_increment(const T& omega_square, const T& rate) {
  const T half = 0.5 * rate;
  return 2.0 / (half + square_root(half * half + omega_square));
}

}  // namespace balocco
