// What two decks must have in common for the state of one to be a state of the other.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "constraints/constraint.hpp"
#include "model/model.hpp"

namespace balocco {

/// Names of the parts of a model ("nodes", "elements" ...) with digests of what they say: steps, loads and outputs are not among them.
std::vector<std::pair<std::string, std::string>> model_digests(const Model& model);

/// Of single members, whatever else the model has: the ids of an element's nodes, less `node_shift`; what decides what a section's histories mean; the
/// rows of a constraint and the ids of its nodes.
std::uint64_t digest_of_element(const Model& model, const ElementTable& table, std::int32_t row, std::int64_t node_shift = 0);
std::uint64_t digest_of_section(const Model& model, const Section& section);
std::uint64_t digest_of_constraint(const Model& model, const Constraint& constraint);

}  // namespace balocco
