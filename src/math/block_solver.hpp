// Sparse symmetric systems of small blocks by L D L^T, without pivots: definite ones, and those that become so when some blocks change
// their sign. The order of elimination and the places of all blocks are found once; factors are found in place, and nothing allocates.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/lanes.hpp"

namespace balocco {

class BlockSolver {
 public:
  /// Rows, each with the columns of its block in its lanes.
  using Block = std::array<Lanes, pack_size>;
  using Pair = std::array<std::int32_t, 2>;

  /// @param sizes rows of each block of unknowns, at most pack_size
  /// @param pairs blocks that the matrix couples
  /// @param kept how many of the last blocks are eliminated last
  void lay_out(std::vector<std::int32_t> sizes, const std::vector<Pair>& pairs, std::int32_t kept);
  /// Whether the block of two unknowns stands with the rows of the first.
  bool in_order(std::int32_t first, std::int32_t second) const { return turn_[first] <= turn_[second]; }
  /// Number of the block of two unknowns in order.
  std::int32_t place(std::int32_t first, std::int32_t second) const;

  /// Of each block of the matrix: (row, column, block), numbers of unknowns.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto& pivot : pivots_)
      for (auto b = pivot.first; b < pivot.last; ++b) visit(pivot.unknown, column_[b], blocks_[b]);
  }
  void clear();
  Block& block(std::int32_t place) { return blocks_[place]; }
  const Block& block(std::int32_t place) const { return blocks_[place]; }
  /// Replaces the blocks by their factors. @return false where next to nothing is left of a diagonal.
  bool factorize();
  /// The solution replaces the right-hand side.
  void solve(std::span<double> right);

 private:
  /// What eliminating one block changes: to -= transpose(from) other.
  struct Update {
    std::int32_t from = -1, other = -1, to = -1, rows = 0;
  };
  struct Pivot {
    std::int32_t unknown = -1, size = 0;
    std::int32_t first = 0, last = 0;                // blocks: its diagonal, then those beside it
    std::int32_t first_update = 0, last_update = 0;
  };

  std::vector<std::vector<std::int32_t>> eliminate(const std::vector<Pair>& pairs, std::int32_t kept);
  bool eliminate(const Pivot& pivot);
  void substitute_forward(const Pivot& pivot);
  void substitute_backward(const Pivot& pivot);

  std::vector<std::int32_t> size_, first_row_, turn_;  // by unknowns
  std::vector<Pivot> pivots_;                          // in turn
  std::vector<std::int32_t> column_;                   // by blocks: unknowns of their lanes
  std::vector<Block> blocks_;
  std::vector<Update> updates_;
  std::vector<Lanes> inverse_;                         // by pivots: of D
  std::vector<Lanes> right_, solution_;                // by unknowns
};

}  // namespace balocco
