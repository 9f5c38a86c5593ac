// Slot values (implicit_dof_map.hpp) between the copies of shared nodes and bodies: the owner sums and hands the sum
// back, so every copy holds the same bits.
#pragma once

#include <span>

#include "implicit_dof_map.hpp"
#include "implicit_petsc.hpp"

namespace balocco {

class SlotExchange {
 public:
  SlotExchange(const ImplicitDofMap& map, const Communicator& communicator);

  /// Replaces the copies' contributions (one value a slot) by their sum. Collective.
  void sum(std::span<double> values);
  /// Values of the equations this rank owns -> the free slots of every copy; prescribed and absent slots keep theirs.
  /// Collective.
  void from_equations(std::span<const double> equations, std::span<double> values);

 private:
  const ImplicitDofMap& map_;
  PetscVector owned_, copies_;
  PetscScatter scatter_;
};

}  // namespace balocco
