// Compiled once: Eigen's solver takes seconds in each source that names it.
#pragma once

#include <Eigen/Core>

namespace balocco::test {

/// Eigenvalues of a symmetric matrix (its lower half is read), ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace balocco::test
