#include "math/block_solver.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace balocco {

/// The block with the fewest neighbours first. @return neighbours of each at its turn, in theirs.
std::vector<std::vector<std::int32_t>> BlockSolver::eliminate(const std::vector<Pair>& pairs, std::int32_t kept) {
  const auto count = static_cast<std::int32_t>(size_.size());
  std::vector<std::set<std::int32_t>> neighbours(size_.size());
  for (const auto& [i, j] : pairs) {
    if (i == j) continue;
    neighbours[i].insert(j);
    neighbours[j].insert(i);
  }
  std::set<std::array<std::int32_t, 3>> waiting;  // by whether they are kept, and number of neighbours
  const auto key = [&](std::int32_t i) { return std::array{i < count - kept ? 0 : 1, static_cast<std::int32_t>(neighbours[i].size()), i}; };
  for (std::int32_t i = 0; i < count; ++i) waiting.insert(key(i));
  turn_.assign(size_.size(), 0);
  std::vector<std::vector<std::int32_t>> beside(size_.size());
  for (std::int32_t turn = 0; turn < count; ++turn) {
    const auto next = (*waiting.begin())[2];
    waiting.erase(waiting.begin());
    turn_[next] = turn;
    beside[next].assign(neighbours[next].begin(), neighbours[next].end());
    for (const auto i : beside[next]) {
      waiting.erase(key(i));
      neighbours[i].erase(next);
      for (const auto j : beside[next])
        if (i != j) neighbours[i].insert(j);
      waiting.insert(key(i));
    }
  }
  for (auto& list : beside) std::ranges::sort(list, {}, [&](std::int32_t i) { return turn_[i]; });
  return beside;
}

void BlockSolver::lay_out(std::vector<std::int32_t> sizes, const std::vector<Pair>& pairs, std::int32_t kept) {
  size_ = std::move(sizes);
  first_row_.clear();
  std::int32_t rows = 0;
  for (const auto size : size_) {
    first_row_.push_back(rows);
    rows += size;
  }
  const auto beside = eliminate(pairs, kept);
  pivots_.assign(size_.size(), {});
  for (std::size_t i = 0; i < size_.size(); ++i) pivots_[turn_[i]].unknown = static_cast<std::int32_t>(i);
  column_.clear();
  for (auto& pivot : pivots_) {
    pivot.size = size_[pivot.unknown];
    pivot.first = static_cast<std::int32_t>(column_.size());
    column_.push_back(pivot.unknown);
    column_.insert(column_.end(), beside[pivot.unknown].begin(), beside[pivot.unknown].end());
    pivot.last = static_cast<std::int32_t>(column_.size());
  }
  updates_.clear();
  for (auto& pivot : pivots_) {
    pivot.first_update = static_cast<std::int32_t>(updates_.size());
    for (auto i = pivot.first + 1; i < pivot.last; ++i)
      for (auto j = i; j < pivot.last; ++j) updates_.push_back({i, j, place(column_[i], column_[j]), size_[column_[i]]});
    pivot.last_update = static_cast<std::int32_t>(updates_.size());
  }
  blocks_.resize(column_.size());
  inverse_.resize(size_.size());
  right_.resize(size_.size());
  solution_.resize(size_.size());
}

std::int32_t BlockSolver::place(std::int32_t first, std::int32_t second) const {
  const auto& pivot = pivots_[turn_[first]];
  const auto found = std::find(column_.begin() + pivot.first, column_.begin() + pivot.last, second);
  return static_cast<std::int32_t>(found - column_.begin());
}

void BlockSolver::clear() { std::ranges::fill(blocks_, Block{}); }

bool BlockSolver::factorize() {
  return std::ranges::all_of(pivots_, [&](const Pivot& pivot) { return eliminate(pivot); });
}

/// What is left is L^T: above the diagonal at once, beside it D L^T until the updates are done.
bool BlockSolver::eliminate(const Pivot& pivot) {
  constexpr double least_left = 1e-9;  // of what the diagonal was: next to nothing where rows depend on each other
  auto& diagonal = blocks_[pivot.first];
  auto& inverse = inverse_[turn_[pivot.unknown]];
  std::array<double, pack_size> before{};
  for (int r = 0; r < pivot.size; ++r) before[r] = std::abs(diagonal[r][r]);
  for (int r = 0; r < pivot.size; ++r) {  // one number at a time: each row waits for the one before
    if (!(std::abs(diagonal[r][r]) > least_left * before[r])) return false;
    inverse[r] = 1.0 / diagonal[r][r];
    for (int i = r + 1; i < pivot.size; ++i) {
      const double factor = diagonal[r][i] * inverse[r];
      for (int j = i; j < pivot.size; ++j) diagonal[i][j] -= factor * diagonal[r][j];
    }
    for (int i = r + 1; i < pivot.size; ++i) diagonal[r][i] *= inverse[r];
  }
  for (auto b = pivot.first + 1; b < pivot.last; ++b) {
    auto& block = blocks_[b];
    for (int i = 1; i < pivot.size; ++i) {
      Pack row = block[i].pack();
      for (int r = 0; r < i; ++r) row -= diagonal[r][i] * block[r].pack();
      block[i].set(row);
    }
  }
  for (auto u = pivot.first_update; u < pivot.last_update; ++u) {
    const auto& [from, other, to, rows] = updates_[u];
    const auto &left = blocks_[from], &right = blocks_[other];
    auto& block = blocks_[to];
    for (int a = 0; a < rows; ++a) {
      auto sum = block[a].pack();
      for (int r = 0; r < pivot.size; ++r) sum -= (left[r][a] * inverse[r]) * right[r].pack();
      block[a].set(sum);
    }
  }
  for (auto b = pivot.first + 1; b < pivot.last; ++b)
    for (int r = 0; r < pivot.size; ++r) blocks_[b][r].set(inverse[r] * blocks_[b][r].pack());
  return true;
}

/// Rows wait for those of their own block alone, one number at a time; what they change elsewhere goes by lanes.
void BlockSolver::substitute_forward(const Pivot& pivot) {
  const auto& diagonal = blocks_[pivot.first];
  auto& right = right_[pivot.unknown];
  for (int r = 0; r < pivot.size; ++r)
    for (int i = r + 1; i < pivot.size; ++i) right[i] -= diagonal[r][i] * right[r];
  for (auto b = pivot.first + 1; b < pivot.last; ++b) {
    auto& below = right_[column_[b]];
    Pack sum = below.pack();
    for (int r = 0; r < pivot.size; ++r) sum -= right[r] * blocks_[b][r].pack();
    below.set(sum);
  }
}

void BlockSolver::substitute_backward(const Pivot& pivot) {
  const auto& diagonal = blocks_[pivot.first];
  auto& solution = solution_[pivot.unknown];
  solution.set(right_[pivot.unknown].pack() * inverse_[turn_[pivot.unknown]].pack());
  for (int r = 0; r < pivot.size; ++r)
    for (auto b = pivot.first + 1; b < pivot.last; ++b) solution[r] -= sum_of(blocks_[b][r].pack() * solution_[column_[b]].pack());
  for (int c = pivot.size; c-- > 0;)
    for (int r = 0; r < c; ++r) solution[r] -= diagonal[r][c] * solution[c];
}

void BlockSolver::solve(std::span<double> right) {
  for (std::size_t i = 0; i < size_.size(); ++i) {
    right_[i] = {};
    for (int r = 0; r < size_[i]; ++r) right_[i][r] = right[first_row_[i] + r];
  }
  for (const auto& pivot : pivots_) substitute_forward(pivot);
  for (auto turn = pivots_.size(); turn-- > 0;) substitute_backward(pivots_[turn]);
  for (std::size_t i = 0; i < size_.size(); ++i)
    for (int r = 0; r < size_[i]; ++r) right[first_row_[i] + r] = solution_[i][r];
}

}  // namespace balocco
