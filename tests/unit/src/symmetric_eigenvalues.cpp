#include "symmetric_eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace balocco::test {

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace balocco::test
