// Small general systems by L U with row pivots, in plain loops, which round alike on every processor.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace balocco {

class PivotingSolver {
 public:
  /// Factorises the `size` x `size` matrix (row-major). Pivots are the largest relative to their rows, so that the units of rows do
  /// not matter. Allocates nothing where the size is that of the last one. @return false if the matrix is singular.
  bool factorize(std::span<const double> matrix, std::size_t size) {
    size_ = size;
    factors_.assign(matrix.begin(), matrix.end());
    order_.resize(size);
    right_.resize(size);
    scale_.assign(size, 0.0);
    for (std::size_t i = 0; i < size; ++i) {
      order_[i] = i;
      for (std::size_t j = 0; j < size; ++j) scale_[i] = std::fmax(scale_[i], std::abs(at(i, j)));
      if (scale_[i] == 0.0) return false;
    }
    for (std::size_t k = 0; k < size; ++k)
      if (!eliminate(k)) return false;
    return true;
  }

  /// The solution replaces the right-hand side.
  void solve(std::span<double> right) {
    for (std::size_t i = 0; i < size_; ++i) {
      double sum = right[order_[i]];
      for (std::size_t j = 0; j < i; ++j) sum -= at(i, j) * right_[j];
      right_[i] = sum;
    }
    for (std::size_t i = size_; i-- > 0;) {
      double sum = right_[i];
      for (std::size_t j = i + 1; j < size_; ++j) sum -= at(i, j) * right[j];
      right[i] = sum / at(i, i);
    }
  }

 private:
  double& at(std::size_t i, std::size_t j) { return factors_[order_[i] * size_ + j]; }

  bool eliminate(std::size_t k) {
    std::size_t best = k;
    double largest = 0.0;
    for (std::size_t i = k; i < size_; ++i)
      if (const double value = std::abs(at(i, k)) / scale_[order_[i]]; value > largest) {
        largest = value;
        best = i;
      }
    if (!(largest > 1e-14)) return false;
    std::swap(order_[k], order_[best]);
    for (std::size_t i = k + 1; i < size_; ++i) {
      const double factor = at(i, k) /= at(k, k);
      if (factor == 0.0) continue;
      for (std::size_t j = k + 1; j < size_; ++j) at(i, j) -= factor * at(k, j);
    }
    return true;
  }

  std::size_t size_ = 0;
  std::vector<double> factors_, scale_, right_;
  std::vector<std::size_t> order_;
};

}  // namespace balocco
