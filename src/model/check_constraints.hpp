// Constraints that cannot do what they say.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Connectors between nodes of one rigid body, which nothing can move.
std::vector<std::pair<Location, std::string>> check_constraints(const Model& model);

}  // namespace balocco
