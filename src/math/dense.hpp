// Small matrices of fixed size for code that runs once an element or in statics, where expression templates cost more to compile than
// they save; and what is asked of symmetric matrices, compiled once.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "math/tensor.hpp"

namespace balocco {

/// Row-major, zero at first.
template <int rows, int columns>
struct Dense {
  std::array<double, rows * columns> component{};

  double& operator()(int i, int j) { return component[columns * i + j]; }
  double operator()(int i, int j) const { return component[columns * i + j]; }

  static Dense identity()
    requires(rows == columns)
  {
    Dense result;
    for (int i = 0; i < rows; ++i) result(i, i) = 1.0;
    return result;
  }

  Dense& operator+=(const Dense& b) {
    for (int i = 0; i < rows * columns; ++i) component[i] += b.component[i];
    return *this;
  }
  Dense& operator-=(const Dense& b) {
    for (int i = 0; i < rows * columns; ++i) component[i] -= b.component[i];
    return *this;
  }
  friend Dense operator+(Dense a, const Dense& b) { return a += b; }
  friend Dense operator*(double s, Dense a) {
    for (double& value : a.component) value *= s;
    return a;
  }
};

/// product = A B, all row-major; A has `inner` columns and B has `columns`.
void multiply_dense(std::span<const double> a, std::span<const double> b, std::span<double> product, int inner, int columns);

template <int rows, int inner, int columns>
Dense<rows, columns> operator*(const Dense<rows, inner>& a, const Dense<inner, columns>& b) {
  Dense<rows, columns> product;
  multiply_dense(a.component, b.component, product.component, inner, columns);
  return product;
}

template <int rows, int columns>
Dense<columns, rows> transpose(const Dense<rows, columns>& a) {
  Dense<columns, rows> result;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) result(j, i) = a(i, j);
  return result;
}

/// Solves A X = B (both row-major, `columns` right-hand sides) by rows with pivots; X replaces B, where A is not singular.
void solve_dense(std::span<const double> a, std::span<double> b, int columns);

/// A^-1 B.
template <int rows, int columns>
Dense<rows, columns> solution(Dense<rows, rows> a, Dense<rows, columns> b) {
  solve_dense(a.component, b.component, columns);
  return b;
}
template <int size>
Dense<size, size> inverse(const Dense<size, size>& a) {
  return solution(a, Dense<size, size>::identity());
}

/// Of a symmetric `size` x `size` matrix, rising.
std::vector<double> symmetric_eigenvalues(std::span<const double> matrix, int size);
template <int size>
double largest_eigenvalue(const Dense<size, size>& symmetric) {
  return symmetric_eigenvalues(symmetric.component, size).back();
}

/// Stretches of a deformation gradient, falling.
Vector3<double> singular_values(const Matrix3<double>& f);

}  // namespace balocco
