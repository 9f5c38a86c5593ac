// The order in which State::contact holds the points of a contact pair: one convention for contact and for checkpoints.
#pragma once

#include <cstdint>
#include <vector>

#include "domain.hpp"
#include "model/model.hpp"

namespace balocco {

/// Local nodes of the slave surface of a contact pair on this rank, in the order of their model rows: point i of
/// State::contact[pair] belongs to the i-th of them (as in RigidContact::nodes).
std::vector<std::int32_t> local_slave_nodes(const Model& model, std::int32_t pair, const Domain& domain);

}  // namespace balocco
