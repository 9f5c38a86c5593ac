// What two decks must have in common for the state of one to be a state of the other.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Names of the parts of a model ("nodes", "elements" ...) with digests of what they say: steps, loads and outputs are not among them.
std::vector<std::pair<std::string, std::string>> model_digests(const Model& model);

}  // namespace balocco
