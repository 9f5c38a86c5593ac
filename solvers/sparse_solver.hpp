// Large sparse systems of the explicit loop, on one rank. Eigen stays out of sight: its headers cost seconds in every file.
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace balocco {

class SparseSolver {
 public:
  struct Entry {
    int row = 0, column = 0;
    double value = 0.0;
  };

  SparseSolver();
  SparseSolver(SparseSolver&&) noexcept;
  ~SparseSolver();

  /// Factorises the `size` x `size` matrix, whose pattern is that of the first one. @return false if it is singular.
  bool factorize(const std::vector<Entry>& entries, int size);
  /// The solution replaces the right-hand side.
  void solve(std::span<double> right);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace balocco
