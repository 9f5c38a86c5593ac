// What bounds the increment of an explicit step from above.
#pragma once

namespace balocco {

/// Bounds of the eigenvalues of M^-1 K and M^-1 C: squared circular frequency and damping rate (twice the damping ratio times the
/// circular frequency).
struct FrequencyBound {
  double omega_square = 0.0, rate = 0.0;

  bool operator==(const FrequencyBound&) const = default;
};

}  // namespace balocco
