#include "sparse_solver.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cmath>

namespace balocco {

class SparseSolver::Implementation {
 public:
  bool factorize(const std::vector<Entry>& entries, int size, bool factorable);
  void solve(std::span<double> right);

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  void lay_out(const std::vector<Entry>& entries, int size);
  bool factorizes_without_pivots();

  Matrix matrix_;
  std::vector<std::array<std::ptrdiff_t, 2>> places_;  // of each entry among the values of the matrix, twice where it is off the diagonal
  Eigen::SimplicialLDLT<Matrix> factors_;
  Eigen::SparseLU<Matrix> pivoted_factors_;
  Eigen::VectorXd right_, solution_;
  bool pivots_ = false, pivots_laid_out_ = false;
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

bool SparseSolver::Implementation::factorizes_without_pivots() {
  factors_.factorize(matrix_);
  if (factors_.info() != Eigen::Success) return false;
  // What elimination leaves of a diagonal: next to nothing where the order was a bad one.
  constexpr double least_left = 1e-9;
  const auto& order = factors_.permutationP().indices();
  for (Eigen::Index i = 0; i < matrix_.rows(); ++i)
    if (!(std::abs(factors_.vectorD()[order.size() > 0 ? order[i] : i]) > least_left * std::abs(matrix_.coeff(i, i)))) return false;
  return true;
}

bool SparseSolver::Implementation::factorize(const std::vector<Entry>& entries, int size, bool factorable) {
  if (places_.empty()) lay_out(entries, size);
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  for (std::size_t e = 0; e < entries.size(); ++e)
    for (const auto place : places_[e])
      if (place >= 0) matrix_.valuePtr()[place] += entries[e].value;
  pivots_ = !factorable || !factorizes_without_pivots();
  if (!pivots_) return true;
  if (!pivots_laid_out_) pivoted_factors_.analyzePattern(matrix_);
  pivots_laid_out_ = true;
  pivoted_factors_.factorize(matrix_);
  return pivoted_factors_.info() == Eigen::Success;
}

void SparseSolver::Implementation::solve(std::span<double> right) {
  right_ = Eigen::Map<const Eigen::VectorXd>(right.data(), static_cast<Eigen::Index>(right.size()));
  if (pivots_)
    solution_ = pivoted_factors_.solve(right_);
  else
    solution_ = factors_.solve(right_);
  std::ranges::copy(solution_, right.begin());
}

SparseSolver::SparseSolver() : implementation_(std::make_unique<Implementation>()) {}
SparseSolver::SparseSolver(SparseSolver&&) noexcept = default;
SparseSolver::~SparseSolver() = default;

bool SparseSolver::factorize(const std::vector<Entry>& entries, int size, bool factorable) {
  return implementation_->factorize(entries, size, factorable);
}

void SparseSolver::solve(std::span<double> right) { implementation_->solve(right); }

}  // namespace balocco
