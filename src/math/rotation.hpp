// Finite rotations: unit quaternions (w, x, y, z) and their matrices, over double, Pack or Dual.
#pragma once

#include <array>
#include <cmath>

#include "math/tensor.hpp"

namespace balocco {

template <class T>
using Quaternion = std::array<T, 4>;

/// The rotation `b` followed by `a`.
template <class T>
Quaternion<T> product(const Quaternion<T>& a, const Quaternion<T>& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

/// Rotation matrix of a unit quaternion.
template <class T>
Matrix3<T> rotation_matrix(const Quaternion<T>& q) {
  const auto& [w, x, y, z] = q;
  return {{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),  //
           2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),  //
           2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)}};
}

/// The quaternion of the rotation exp(spin x).
inline Quaternion<double> exponential(const Vector3<double>& spin) {
  const double square = dot(spin, spin);
  // sin(angle / 2) / angle and cos(angle / 2) by their series where six terms are exact to the last bit but one.
  if (square < 0.25) {
    const double h = 0.25 * square;
    const double sine = 1.0 - h / 6.0 * (1.0 - h / 20.0 * (1.0 - h / 42.0 * (1.0 - h / 72.0 * (1.0 - h / 110.0))));
    const double cosine =
        1.0 - h / 2.0 * (1.0 - h / 12.0 * (1.0 - h / 30.0 * (1.0 - h / 56.0 * (1.0 - h / 90.0 * (1.0 - h / 132.0)))));
    return {cosine, 0.5 * sine * spin[0], 0.5 * sine * spin[1], 0.5 * sine * spin[2]};
  }
  const double angle = std::sqrt(square), factor = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), factor * spin[0], factor * spin[1], factor * spin[2]};
}

/// `orientation` turned by the rotation vector `spin` (global directions: applied on the left), unit again.
inline Quaternion<double> turned(const Quaternion<double>& orientation, const Vector3<double>& spin) {
  Quaternion<double> q = product(exponential(spin), orientation);
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& component : q) component /= norm;
  return q;
}

/// The rotation vector of least angle (at most pi) of a unit quaternion.
inline Vector3<double> rotation_vector(const Quaternion<double>& q) {
  const double sine = std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double sign = q[0] < 0.0 ? -1.0 : 1.0;
  const double factor = sine > 1e-9 ? 2.0 * sign * std::atan2(sine, sign * q[0]) / sine : 2.0 * sign;
  return {{factor * q[1], factor * q[2], factor * q[3]}};
}

}  // namespace balocco
