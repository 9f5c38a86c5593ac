// Halo exchange: every copy of a shared node ends with the sum of the contributions of all ranks, bit for bit the same.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "communicator.hpp"
#include "elements/nodal_motion.hpp"

namespace balocco {

/// Local nodes shared with one neighbour, in the same (global) order on both sides.
struct SharedNodes {
  int rank = -1;
  std::vector<std::int32_t> nodes;
};

/// Sums of nodal vectors (4 doubles a node, of which the first 3 travel) over the copies of shared nodes: one vector of every node
/// and a second one of nodes that turn, or several such fields, in one message per neighbour. Addends must be rounded with the node's
/// rounding constant, so that the sum is exact and every copy holds the same bits. Requests are persistent: a cycle allocates nothing.
class Halo {
 public:
  /// Exchanges that may be under way at the same time have tags of their own.
  enum class Tag : int { domain = 4711, step, owners };
  /// Local nodes [0, turning) have the second vector. `fields`: how many such pairs are summed together.
  Halo(const Communicator& communicator, std::vector<SharedNodes> neighbours, std::int32_t turning, Tag tag, std::size_t fields = 1);
  ~Halo();
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;

  const std::vector<SharedNodes>& neighbours() const { return neighbours_; }

  /// Packs the partial sums of shared nodes and starts the messages. Later additions by this rank to shared nodes must be
  /// made alike on every copy. Of `fields` the first ones count, as many as the halo was made for; their moments may be null where
  /// they are null in finish_sum too.
  void begin_sum(std::span<const NodalForces> fields);
  void begin_sum(double* forces) { begin_sum(std::array<NodalForces, 1>{{{forces}}}); }
  /// Waits and adds what the neighbours sent.
  void finish_sum(std::span<const NodalForces> fields);
  void finish_sum(double* forces) { finish_sum(std::array<NodalForces, 1>{{{forces}}}); }

 private:
  std::size_t fields_;
  std::vector<SharedNodes> neighbours_;
  std::vector<std::vector<std::int32_t>> turning_;  // those of each neighbour's nodes that turn
  std::vector<std::vector<double>> outgoing_, incoming_;
  std::vector<MPI_Request> requests_;  // receives, then sends
};

/// Gives the other copies of nodes the values of their owners', 4 numbers a node, of which there may be fewer than local nodes: the first.
/// For rare occasions. Collective.
void copy_from_owners(const Communicator& communicator, const std::vector<SharedNodes>& neighbours, const std::vector<bool>& owned,
                      std::span<double> values);

}  // namespace balocco
