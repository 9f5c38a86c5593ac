#include "math/dense.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace balocco {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

void multiply_dense(std::span<const double> a, std::span<const double> b, std::span<double> product, int inner, int columns) {
  const auto rows = static_cast<int>(product.size()) / columns;
  std::ranges::fill(product, 0.0);
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < inner; ++k)
      for (int j = 0; j < columns; ++j) product[columns * i + j] += a[inner * i + k] * b[columns * k + j];
}

void solve_dense(std::span<const double> a, std::span<double> b, int columns) {
  const auto size = static_cast<Eigen::Index>(b.size()) / columns;
  const Eigen::Map<const Rows> matrix(a.data(), size, size);
  Eigen::Map<Rows> right(b.data(), size, columns);
  right = Rows(matrix.partialPivLu().solve(Rows(right)));
}

std::vector<double> symmetric_eigenvalues(std::span<const double> matrix, int size) {
  const Rows copy = Eigen::Map<const Rows>(matrix.data(), size, size);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(copy, Eigen::EigenvaluesOnly);
  return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

Vector3<double> singular_values(const Matrix3<double>& f) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> gradient(f.component.data());
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd{Eigen::Matrix3d(gradient)};
  return {svd.singularValues()[0], svd.singularValues()[1], svd.singularValues()[2]};
}

}  // namespace balocco
