// The ranks of a job, and the few collectives that solvers need, so that no MPI call appears in them.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "math/exact_sum.hpp"

namespace balocco {

class Communicator {
 public:
  explicit Communicator(MPI_Comm handle = MPI_COMM_WORLD);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  MPI_Comm handle() const { return handle_; }

  double minimum(double value) const;
  double maximum(double value) const;
  std::int64_t sum(std::int64_t value) const;
  bool any(bool value) const;
  /// Sums in place; order-free only if the addends are multiples of one quantum.
  void sum(std::span<double> values) const;
  void maximum(std::span<double> values) const;
  /// Merges accumulators of all ranks, exactly.
  void sum(std::span<ExactSum> sums) const;
  /// The value and the payload of the rank with the smallest value; ties go to the smallest payload.
  struct Located {
    double value;
    std::int64_t payload;
  };
  Located minimum(Located local) const;
  void broadcast(std::string& text) const;  // from root

  /// Runs `work` on every rank; if it throws on any, every rank throws the message of the lowest such rank (same type).
  void together(const std::function<void()>& work) const;

 private:
  MPI_Comm handle_;
  int rank_ = 0, size_ = 1;
};

}  // namespace balocco
