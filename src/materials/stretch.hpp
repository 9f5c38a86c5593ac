// Invariants of a deformation gradient and bounds of its principal stretches, free of branches and of eigenvectors.
#pragma once

#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

template <class T>
T absolute(const T& x) {
  return maximum(x, -x);
}

/// Invariants of C = F^T F with what they are made of.
template <class T>
struct Invariants {
  Matrix3<T> cofactor;  // det(F) F^-T
  T jacobian;           // det(F)
  T first, second;      // tr C, tr cof C
};

template <class T>
Invariants<T> invariants(const Matrix3<T>& deformation_gradient) {
  Invariants<T> result;
  result.cofactor = cofactor(deformation_gradient);
  result.jacobian = determinant(deformation_gradient, result.cofactor);
  result.first = double_contraction(deformation_gradient, deformation_gradient);
  result.second = double_contraction(result.cofactor, result.cofactor);
  return result;
}

/// Upper bound of the largest eigenvalue of a symmetric 3 x 3 matrix with invariants tr and tr cof: mean + sqrt(2/3)
/// |deviator| (equality where the two smaller ones coincide).
template <class T>
T largest_eigenvalue_bound(const T& trace, const T& trace_of_cofactor) {
  const T discriminant = maximum(trace * trace - 3.0 * trace_of_cofactor, T(0.0));
  return (1.0 / 3.0) * (trace + 2.0 * square_root(discriminant));
}

}  // namespace balocco
