#include "implicit_slot_exchange.hpp"

#include <vector>

namespace balocco {

SlotExchange::SlotExchange(const ImplicitDofMap& map, const Communicator& communicator) : map_(map) {
  std::vector<PetscInt> numbers;
  for (std::int32_t slot = 0; slot < map.slots(); ++slot) numbers.push_back(map.global_slot(slot));
  petsc(VecCreateMPI(communicator.handle(), static_cast<PetscInt>(map.owned_slots().size()), PETSC_DETERMINE,
                     owned_.address()));
  petsc(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, map.slots(), nullptr, copies_.address()));
  PetscIndices indices;
  petsc(ISCreateGeneral(PETSC_COMM_SELF, map.slots(), numbers.data(), PETSC_COPY_VALUES, indices.address()));
  petsc(VecScatterCreate(owned_, indices, copies_, nullptr, scatter_.address()));
}

void SlotExchange::sum(std::span<double> values) {
  petsc(VecPlaceArray(copies_, values.data()));
  petsc(VecSet(owned_, 0.0));
  petsc(VecScatterBegin(scatter_, copies_, owned_, ADD_VALUES, SCATTER_REVERSE));
  petsc(VecScatterEnd(scatter_, copies_, owned_, ADD_VALUES, SCATTER_REVERSE));
  petsc(VecScatterBegin(scatter_, owned_, copies_, INSERT_VALUES, SCATTER_FORWARD));
  petsc(VecScatterEnd(scatter_, owned_, copies_, INSERT_VALUES, SCATTER_FORWARD));
  petsc(VecResetArray(copies_));
}

void SlotExchange::from_equations(std::span<const double> equations, std::span<double> values) {
  std::size_t next = 0;
  double* array = nullptr;
  petsc(VecGetArray(owned_, &array));
  for (std::size_t i = 0; i < map_.owned_slots().size(); ++i) {
    const auto slot = map_.owned_slots()[i];
    array[i] = map_.role(slot) == ImplicitDofMap::Role::free ? equations[next++] : values[slot];
  }
  petsc(VecRestoreArray(owned_, &array));
  petsc(VecPlaceArray(copies_, values.data()));
  petsc(VecScatterBegin(scatter_, owned_, copies_, INSERT_VALUES, SCATTER_FORWARD));
  petsc(VecScatterEnd(scatter_, owned_, copies_, INSERT_VALUES, SCATTER_FORWARD));
  petsc(VecResetArray(copies_));
}

}  // namespace balocco
