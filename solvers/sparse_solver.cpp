#include "sparse_solver.hpp"

#include <Eigen/SparseLU>
#include <algorithm>

namespace balocco {

struct SparseSolver::Implementation {
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors;
  bool analyzed = false;
};

SparseSolver::SparseSolver() : implementation_(std::make_unique<Implementation>()) {}
SparseSolver::SparseSolver(SparseSolver&&) noexcept = default;
SparseSolver::~SparseSolver() = default;

bool SparseSolver::factorize(const std::vector<Entry>& entries, int size) {
  std::vector<Eigen::Triplet<double>> triplets;
  for (const auto& [row, column, value] : entries) triplets.emplace_back(row, column, value);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  if (!implementation_->analyzed) implementation_->factors.analyzePattern(matrix);
  implementation_->analyzed = true;
  implementation_->factors.factorize(matrix);
  return implementation_->factors.info() == Eigen::Success;
}

void SparseSolver::solve(std::span<double> right) {
  const Eigen::Map<const Eigen::VectorXd> given(right.data(), static_cast<Eigen::Index>(right.size()));
  const Eigen::VectorXd solution = implementation_->factors.solve(given);
  std::ranges::copy(solution, right.begin());
}

}  // namespace balocco
