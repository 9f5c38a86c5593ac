// Large sparse symmetric systems of the explicit loop that want pivots, on one rank. Eigen stays out of sight: its headers cost seconds
// in every file.
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace balocco {

class SparseSolver {
 public:
  /// Of (row, column) and of (column, row).
  struct Entry {
    int row = 0, column = 0;
    double value = 0.0;
  };

  SparseSolver();
  SparseSolver(SparseSolver&&) noexcept;
  ~SparseSolver();

  /// Factorises the `size` x `size` matrix that is the sum of the entries, whose places and turn are those of the first time.
  /// @return false if it is singular.
  bool factorize(const std::vector<Entry>& entries, int size);
  /// The solution replaces the right-hand side.
  void solve(std::span<double> right);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace balocco
