#include "implicit_stiffness.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace balocco {

namespace {

/// Whether the slots are the nodes' displacements along the global axes, so that blocks need no reduction.
bool moves_plainly(std::span<const NodeMotion> motions) {
  constexpr std::array<Point, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  return std::ranges::all_of(motions, [&](const NodeMotion& motion) {
    return motion.count == 3 && std::equal(axes.begin(), axes.end(), motion.direction.begin());
  });
}

}  // namespace

void ImplicitStiffness::add(std::span<const NodeMotion> motions, std::span<const double> block) {
  slots_.clear();
  for (const auto& motion : motions)
    slots_.insert(slots_.end(), motion.slots.begin(), motion.slots.begin() + motion.count);
  if (recording_) return record(slots_);
  const double* const reduced = moves_plainly(motions) ? block.data() : reduce(motions, block);
  const auto size = slots_.size();
  for (std::size_t i = 0; i < size; ++i) {
    const double* row = reduced + i * size;
    if (map_.equation(slots_[i]) >= 0)
      for (std::size_t j = 0; j < size; ++j)
        if (map_.equation(slots_[j]) >= 0) values_[next_++] = weight_ * row[j];
    if (has_motion_)
      for (std::size_t j = 0; j < size; ++j) product_[slots_[i]] += weight_ * row[j] * motion_[slots_[j]];
  }
}

void ImplicitStiffness::add_product(std::span<const NodeMotion> motions, std::span<const double> block, std::span<const double> shares,
                                    const Point& motion, std::vector<double>& product) const {
  const auto width = 3 * motions.size();
  for (std::size_t a = 0; a < motions.size(); ++a)
    for (int l = 0; l < motions[a].count; ++l)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t b = 0; b < shares.size(); ++b)
          for (std::size_t j = 0; shares[b] != 0.0 && j < 3; ++j)
            product[motions[a].slots[l]] +=
                weight_ * motions[a].direction[l][i] * block[(3 * a + i) * width + 3 * b + j] * shares[b] * motion[j];
}

void ImplicitStiffness::record(std::span<const std::int32_t> slots) {
  for (const auto i : slots)
    for (const auto j : slots)
      if (map_.equation(i) >= 0 && map_.equation(j) >= 0) {
        rows_.push_back(map_.equation(i));
        columns_.push_back(map_.equation(j));
      }
}

/// transpose(A) * block * A, A being the directions in which the slots move the nodes.
const double* ImplicitStiffness::reduce(std::span<const NodeMotion> motions, std::span<const double> block) {
  const auto size = slots_.size(), width = 3 * motions.size();
  reduced_.resize(size * size);
  std::size_t first_row = 0;
  for (std::size_t a = 0; a < motions.size(); first_row += motions[a++].count) {
    std::size_t first_column = 0;
    for (std::size_t b = 0; b < motions.size(); first_column += motions[b++].count) {
      for (int l = 0; l < motions[b].count; ++l) {
        const auto& direction = motions[b].direction[l];
        Point image;
        for (int i = 0; i < 3; ++i) {
          const double* entry = &block[(3 * a + i) * width + 3 * b];
          image[i] = entry[0] * direction[0] + entry[1] * direction[1] + entry[2] * direction[2];
        }
        for (int k = 0; k < motions[a].count; ++k) {
          const auto& row = motions[a].direction[k];
          reduced_[(first_row + k) * size + first_column + l] =
              row[0] * image[0] + row[1] * image[1] + row[2] * image[2];
        }
      }
    }
  }
  return reduced_.data();
}

void ImplicitStiffness::finish_pattern() {
  const auto local = static_cast<PetscInt>(map_.owned_free_slots().size());
  petsc(MatCreate(communicator_.handle(), matrix_.address()));
  petsc(MatSetSizes(matrix_, local, local, PETSC_DETERMINE, PETSC_DETERMINE));
  petsc(MatSetType(matrix_, MATAIJ));
  values_.resize(rows_.size());
  petsc(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(rows_.size()), rows_.data(), columns_.data()));
  std::exchange(rows_, {});
  std::exchange(columns_, {});
  product_.resize(map_.slots());
  recording_ = false;
}

void ImplicitStiffness::forget_pattern() {
  matrix_.reset();
  recording_ = true;
}

void ImplicitStiffness::start(std::span<const double> motion) {
  weight_ = 1.0;
  motion_.assign(motion.begin(), motion.end());
  has_motion_ = std::ranges::any_of(motion_, [](double q) { return q != 0.0; });
  std::ranges::fill(product_, 0.0);
  next_ = 0;
}

void ImplicitStiffness::finish() {
  if (next_ != values_.size()) throw std::logic_error("the stiffness was assembled in another order than its pattern was recorded in");
  petsc(MatSetValuesCOO(matrix_, values_.data(), INSERT_VALUES));
}

}  // namespace balocco
