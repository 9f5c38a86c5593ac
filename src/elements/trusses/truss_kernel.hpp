// Kinematics and force of a straight bar, one text for T = double, Pack and Dual.
#pragma once

#include "math/dual.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Green strain (l^2 - L^2) / (2 L^2) of the vector from the first to the second node.
/// @param inverse_square 1 / L^2
template <class T, class C>
T truss_strain(const Vector3<T>& axis, const C& inverse_square) {
  return 0.5 * (inverse_square * dot(axis, axis) - 1.0);
}

/// Force on the second node, S V x / L^2 (the first node gets its opposite). @param scale V / L^2 = A / L
template <class T, class C>
Vector3<T> truss_force(const Vector3<T>& axis, const T& stress, const C& scale) {
  const T factor = scale * stress;
  return {{factor * axis[0], factor * axis[1], factor * axis[2]}};
}

}  // namespace balocco
