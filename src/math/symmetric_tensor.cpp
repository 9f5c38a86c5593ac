#include "math/symmetric_tensor.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace balocco {

namespace {

using Matrix = Eigen::Matrix3d;

Matrix as_eigen(const double* a) {
  Matrix m;
  m << a[0], a[3], a[4], a[3], a[1], a[5], a[4], a[5], a[2];
  return m;
}

void copy(const Matrix& m, double* a) {
  const double values[6] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
  for (int i = 0; i < 6; ++i) a[i] = values[i];
}

}  // namespace

SymmetricTensor<double> apply(const IsotropicFunction& function, const SymmetricTensor<double>& a) {
  const Eigen::SelfAdjointEigenSolver<Matrix> pairs(as_eigen(a.component.data()));
  Eigen::Vector3d values;
  for (int i = 0; i < 3; ++i) values(i) = function.value(pairs.eigenvalues()(i), function.data);
  SymmetricTensor<double> result;
  copy(pairs.eigenvectors() * values.asDiagonal() * pairs.eigenvectors().transpose(), result.component.data());
  return result;
}

void apply_derivative(const IsotropicFunction& function, const SymmetricTensor<double>& a, int count, const double* da,
                      double* df) {
  const Eigen::SelfAdjointEigenSolver<Matrix> pairs(as_eigen(a.component.data()));
  const Eigen::Vector3d& value = pairs.eigenvalues();
  const Matrix& n = pairs.eigenvectors();
  Matrix difference;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double gap = value(i) - value(j), size = 1.0 + std::fabs(value(i)) + std::fabs(value(j));
      difference(i, j) =
          std::fabs(gap) > 1e-5 * size  // nearer, the mean of the slopes is right to the square of that
              ? (function.value(value(i), function.data) - function.value(value(j), function.data)) / gap
              : 0.5 * (function.slope(value(i), function.data) + function.slope(value(j), function.data));
    }
  }
  for (int k = 0; k < count; ++k) {
    const Matrix local = n.transpose() * as_eigen(da + 6 * k) * n;
    copy(n * local.cwiseProduct(difference) * n.transpose(), df + 6 * k);
  }
}

}  // namespace balocco
