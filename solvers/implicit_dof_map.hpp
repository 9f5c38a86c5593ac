// Which degrees of freedom the static solver solves for, and how nodes move with them.
//
// A slot is one displacement of a local node, one rotation of a node that turns, one rotation of a rigid body, all counted in
// the node's *TRANSFORM directions, or, behind them, the multiplier of a row of a constraint. A slot is free (it has an equation), prescribed, or absent: nodes carried by rigid bodies
// move with the six slots of the reference node (tied ones turn with them too), and nodes that nothing holds or pulls do not
// move at all.
//
// Rotations are finite: an increment of the three rotation slots is a spin s in global axes, R <- exp(s) R. Residual moments are
// conjugate to such spins, and the tangent is the derivative of the residual by them at the present configuration; as spins do
// not commute it is unsymmetric away from equilibrium, by half the cross product of the residual moment. Statics leave that out of it:
// what stays is the second derivative of the energy, and Newton's method converges as fast.
#pragma once

#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "analysis.hpp"

namespace balocco {

/// Where the slots of a kind begin.
struct SlotLayout {
  std::int32_t nodes = 0, turning = 0;  // of the domain
  std::int32_t bodies = 0;

  explicit SlotLayout(const Analysis& analysis)
      : nodes(analysis.domain.size()),
        turning(analysis.domain.turning),
        bodies(static_cast<std::int32_t>(analysis.model.rigid_bodies.size())) {}
  /// `dof` 0-2 of any node, 3-5 of nodes that turn.
  std::int32_t slot(std::int32_t node, int dof) const { return dof < 3 ? 3 * node + dof : 3 * (nodes + node) + dof - 3; }
  std::int32_t rotation_slot(std::int32_t body, int axis) const { return 3 * (nodes + turning + body) + axis; }
  std::int32_t first_multiplier() const { return rotation_slot(bodies, 0); }
};

/// dx = sum over k < count of coefficient[3 * k ..] * dq[slots[k]]: motion of a node by at most six slots.
struct NodeMotion {
  int count = 0;
  std::array<std::int32_t, 6> slots{};
  std::array<Point, 6> direction{};
};

class ImplicitDofMap {
 public:
  enum class Role : std::int8_t { free, prescribed, absent };

  /// `prescribed`: the slots whose motion the step prescribes, alike on every copy of a node. Collective.
  ImplicitDofMap(const Analysis& analysis, std::span<const std::int32_t> prescribed);

  std::int32_t slots() const { return static_cast<std::int32_t>(role_.size()); }
  std::int32_t slot(std::int32_t node, int dof) const { return layout_.slot(node, dof); }
  std::int32_t rotation_slot(std::int32_t body, int axis) const { return layout_.rotation_slot(body, axis); }
  /// Slot of a local constraint's first row; the others follow.
  std::int32_t multiplier_slot(std::size_t local_constraint) const { return first_multiplier_[local_constraint]; }
  /// Multipliers are the last slots.
  std::int32_t first_multiplier() const { return layout_.first_multiplier(); }
  bool is_multiplier(std::int32_t slot) const { return slot >= layout_.first_multiplier(); }
  /// Row in State::multiplier of such a slot.
  std::int32_t constraint_row(std::int32_t slot) const { return constraint_row_[slot - layout_.first_multiplier()]; }
  /// Node whose displacement or rotation, or whose body's rotation a slot is; of a multiplier the first of its constraint.
  std::int32_t node_of(std::int32_t slot) const;
  bool is_rotation(std::int32_t slot) const { return slot >= 3 * layout_.nodes && !is_multiplier(slot); }
  /// Body whose rotation a slot is, or -1.
  std::int32_t body_of(std::int32_t slot) const {
    return is_multiplier(slot) ? -1 : std::max(slot / 3 - layout_.nodes - layout_.turning, -1);
  }
  /// First of the three slots that turn a node: its body's or its own.
  std::int32_t first_spin_slot(std::int32_t node) const;

  Role role(std::int32_t slot) const { return role_[slot]; }
  bool owned(std::int32_t slot) const { return analysis_.domain.owned[node_of(slot)]; }
  /// Number of the slot over all ranks, contiguous for each rank in the order of owned_slots().
  PetscInt global_slot(std::int32_t slot) const { return global_slot_[slot]; }
  /// Number of the slot's equation over all ranks, contiguous for each rank in the order of owned_free_slots();
  /// negative: none.
  PetscInt equation(std::int32_t slot) const { return equation_[slot]; }
  const std::vector<std::int32_t>& owned_slots() const { return owned_slots_; }
  const std::vector<std::int32_t>& owned_free_slots() const { return owned_free_slots_; }
  PetscInt equations() const { return equations_; }
  PetscInt first_equation() const { return first_equation_; }

  /// Directions of a node's slots (rows), identity where it has no *TRANSFORM.
  const Matrix3<double>& directions(std::int32_t node) const;
  bool has_own_directions(std::int32_t node) const { return directions_[node] != nullptr; }

  /// Rows of constraints that say nothing new where the state stands, and have no equation: rows of State::multiplier, of this rank's constraints.
  std::vector<std::int32_t> dependent_constraint_rows() const;
  /// How many multipliers there are over all ranks. Collective.
  int multipliers() const;

  NodeMotion motion(std::int32_t node) const;
  NodeMotion spin(std::int32_t body) const;
  /// Spin of a node that turns: its body's or its own.
  NodeMotion nodal_spin(std::int32_t node) const;

  /// "node 12, dof 3" of a slot, in the deck's numbers.
  std::string describe(std::int32_t slot) const;
  /// The same for an equation that any rank owns. Collective.
  std::string describe_equation(PetscInt equation) const;

 private:
  void list_multipliers();
  void find_roles(std::span<const std::int32_t> prescribed);
  void drop_dependent_rows();
  std::size_t table_index(std::int32_t slot) const;
  void number();
  NodeMotion spin_by(std::int32_t first_slot) const;

  const Analysis& analysis_;
  SlotLayout layout_;
  std::vector<Role> role_;
  std::vector<PetscInt> global_slot_, equation_;
  std::vector<std::int32_t> first_multiplier_, constraint_row_, constraint_node_;  // per local constraint; per multiplier slot
  std::vector<std::int32_t> owned_slots_, owned_free_slots_;
  std::vector<const Matrix3<double>*> directions_;
  PetscInt equations_ = 0, first_equation_ = 0;
};

}  // namespace balocco
