// Constraints that cannot do what they say.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Whether a row of Model::constraints is a guide that does more than tell motions: it stops, locks, rubs, drives or loads.
bool is_acting_guide(const Model& model, std::size_t index);

/// Connectors between nodes of one rigid body, which nothing can move.
std::vector<std::pair<Location, std::string>> check_constraints(const Model& model);

}  // namespace balocco
