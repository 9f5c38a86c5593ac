// Small symmetric positive definite systems by L D L^T: no pivots, which would hang on the units of the rows, no square roots, which do
// not scale with every power of two, and plain loops, which round alike on every processor.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

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

/// Of any size, found at run time.
class DefiniteSystem {
 public:
  /// Factorises the `size` x `size` matrix (row-major; its lower half is read). Allocates nothing where the size is that of the last
  /// one. @return false if the matrix is singular to rounding, or not positive.
  bool factorize(std::span<const double> matrix, std::size_t size) {
    size_ = size;
    lower_.assign(matrix.begin(), matrix.end());
    scaled_.resize(size);
    for (std::size_t j = 0; j < size; ++j) {
      double* const row = &lower_[j * size];
      double pivot = row[j];
      for (std::size_t k = 0; k < j; ++k) {
        scaled_[k] = row[k] * lower_[k * size + k];
        pivot -= row[k] * scaled_[k];
      }
      if (!(pivot > 1e-14 * row[j])) return false;
      row[j] = pivot;
      const double inverse = 1.0 / pivot;
      for (std::size_t i = j + 1; i < size; ++i) {
        double* const below = &lower_[i * size];
        double sum = below[j];
        for (std::size_t k = 0; k < j; ++k) sum -= below[k] * scaled_[k];
        below[j] = inverse * sum;
      }
    }
    return true;
  }

  /// The solution replaces the right-hand side.
  void solve(std::span<double> right) const {
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t k = 0; k < i; ++k) right[i] -= lower_[i * size_ + k] * right[k];
    for (std::size_t i = 0; i < size_; ++i) right[i] /= lower_[i * size_ + i];
    for (std::size_t i = size_; i-- > 0;)
      for (std::size_t k = i + 1; k < size_; ++k) right[i] -= lower_[k * size_ + i] * right[k];
  }

 private:
  std::size_t size_ = 0;
  std::vector<double> lower_, scaled_;  // unit lower triangle, and D on the diagonal
};

}  // namespace balocco
