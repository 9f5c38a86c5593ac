#include "sparse_solver.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <array>

namespace balocco {

class SparseSolver::Implementation {
 public:
  bool factorize(const std::vector<Entry>& entries, int size);
  void solve(std::span<double> right);

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  void lay_out(const std::vector<Entry>& entries, int size);

  Matrix matrix_;
  std::vector<std::array<std::ptrdiff_t, 2>> places_;  // of each entry among the values of the matrix, twice where it is off the diagonal
  Eigen::SparseLU<Matrix> factors_;
  Eigen::VectorXd right_, solution_;
};

void SparseSolver::Implementation::lay_out(const std::vector<Entry>& entries, int size) {
  std::vector<Eigen::Triplet<double>> triplets;
  for (const auto& [row, column, value] : entries) {
    triplets.emplace_back(row, column, 0.0);
    triplets.emplace_back(column, row, 0.0);
  }
  matrix_.resize(size, size);
  matrix_.setFromTriplets(triplets.begin(), triplets.end());
  const auto place = [&](int row, int column) -> std::ptrdiff_t { return &matrix_.coeffRef(row, column) - matrix_.valuePtr(); };
  for (const auto& [row, column, value] : entries) places_.push_back({place(row, column), row == column ? -1 : place(column, row)});
  factors_.analyzePattern(matrix_);
}

bool SparseSolver::Implementation::factorize(const std::vector<Entry>& entries, int size) {
  if (places_.empty()) lay_out(entries, size);
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  for (std::size_t e = 0; e < entries.size(); ++e)
    for (const auto place : places_[e])
      if (place >= 0) matrix_.valuePtr()[place] += entries[e].value;
  factors_.factorize(matrix_);
  return factors_.info() == Eigen::Success;
}

void SparseSolver::Implementation::solve(std::span<double> right) {
  right_ = Eigen::Map<const Eigen::VectorXd>(right.data(), static_cast<Eigen::Index>(right.size()));
  solution_ = factors_.solve(right_);
  std::ranges::copy(solution_, right.begin());
}

SparseSolver::SparseSolver() : implementation_(std::make_unique<Implementation>()) {}
SparseSolver::SparseSolver(SparseSolver&&) noexcept = default;
SparseSolver::~SparseSolver() = default;

bool SparseSolver::factorize(const std::vector<Entry>& entries, int size) { return implementation_->factorize(entries, size); }

void SparseSolver::solve(std::span<double> right) { implementation_->solve(right); }

}  // namespace balocco
