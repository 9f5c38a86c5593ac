// The order in which State::contact holds the places of a contact pair: one convention for contact and for checkpoints.
#pragma once

#include <cstdint>
#include <vector>

#include "domain.hpp"
#include "model/model.hpp"

namespace balocco {

/// A place of a slave surface (elements/slave_places.hpp) on this rank.
struct LocalPlace {
  std::int64_t row = -1;   // among those of the pair
  std::int32_t node = -1;  // local: where it is kept
};

/// Those of a pair in order: point i of State::contact[pair] belongs to the i-th of them, also in RigidContact and MeshContact.
std::vector<LocalPlace> local_slave_places(const Model& model, std::int32_t pair, const Domain& domain);

}  // namespace balocco
