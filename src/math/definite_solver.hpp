// Small symmetric positive definite systems by L D L^T: no pivots, which would hang on the units of the rows, no square roots, which do
// not scale with every power of two, and plain loops, which round alike on every processor.
#pragma once

#include <array>

namespace balocco {

/// Factors of a symmetric positive definite N x N matrix (its lower half is read).
template <int N>
class DefiniteSolver {
 public:
  template <class Matrix>
  explicit DefiniteSolver(const Matrix& matrix) {
    for (int j = 0; j < N; ++j) {
      for (int i = j; i < N; ++i) {
        double sum = matrix(i, j);
        for (int k = 0; k < j; ++k) sum -= lower_[i][k] * lower_[j][k] * lower_[k][k];
        lower_[i][j] = i == j ? sum : sum / lower_[j][j];
      }
    }
  }

  /// Solution for a right-hand side.
  template <class Vector>
  Vector solve(Vector right) const {
    for (int i = 0; i < N; ++i)
      for (int k = 0; k < i; ++k) right[i] -= lower_[i][k] * right[k];
    for (int i = 0; i < N; ++i) right[i] /= lower_[i][i];
    for (int i = N - 1; i >= 0; --i)
      for (int k = i + 1; k < N; ++k) right[i] -= lower_[k][i] * right[k];
    return right;
  }

 private:
  std::array<std::array<double, N>, N> lower_{};  // unit lower triangle, and D on the diagonal
};

}  // namespace balocco
