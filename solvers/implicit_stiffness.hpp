// The assembled stiffness of the free slots, and its product with given motions of any slots.
#pragma once

#include <span>
#include <vector>

#include "implicit_dof_map.hpp"
#include "implicit_petsc.hpp"

namespace balocco {

/// Blocks are added in the same order every time: once without values, which records the pattern, then with values.
class ImplicitStiffness {
 public:
  ImplicitStiffness(const ImplicitDofMap& map, const Communicator& communicator) : map_(map), communicator_(communicator) {}

  /// Adds a block (row-major, three rows and columns for each of `motions`) that couples the slots which `motions`
  /// name. While the pattern is recorded `block` is empty.
  void add(std::span<const NodeMotion> motions, std::span<const double> block);
  /// Adds the product of a block with a motion of which each node does its share, to one value a slot.
  void add_product(std::span<const NodeMotion> motions, std::span<const double> block, std::span<const double> shares, const Point& motion,
                   std::vector<double>& product) const;
  void finish_pattern();
  /// The pattern is recorded anew, and gives another matrix().
  void forget_pattern();

  /// Begins a new assembly; `motion` (one value a slot) is what product() multiplies.
  void start(std::span<const double> motion);
  /// Factor on the blocks that follow, 1 after start().
  void set_weight(double weight) { weight_ = weight; }
  /// Hands the values to the matrix. Collective.
  void finish();

  Mat matrix() const { return matrix_; }
  /// This rank's part of stiffness * motion, for each slot.
  std::vector<double>& product() { return product_; }

 private:
  void record(std::span<const std::int32_t> slots);
  const double* reduce(std::span<const NodeMotion> motions, std::span<const double> block);

  const ImplicitDofMap& map_;
  const Communicator& communicator_;
  PetscMatrix matrix_;
  bool recording_ = true;
  std::vector<PetscInt> rows_, columns_;  // of the pattern, while it is recorded
  std::vector<double> values_;
  std::size_t next_ = 0;
  std::vector<double> motion_, product_;
  bool has_motion_ = false;
  double weight_ = 1.0;
  std::vector<std::int32_t> slots_;  // of the block at hand
  std::vector<double> reduced_;
};

}  // namespace balocco
