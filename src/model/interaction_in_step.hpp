// What the interaction of a contact pair is in a step, after *CHANGE FRICTION and *CHANGE SURFACE BEHAVIOR.
#pragma once

#include "model/model.hpp"

namespace balocco {

/// Its properties at the end of a step (a row of Model::steps, or behind the last). Of a pair without one: hard and without friction.
const Interaction& interaction_in_step(const Model& model, const ContactPair& pair, std::int32_t step);

/// Coulomb's coefficient at a time of a step: where that changes it and loads grow over it, on the straight line from the coefficient
/// before.
double friction_in_step(const Model& model, const ContactPair& pair, std::int32_t step, double step_time);

/// Whether a step begins with another law of pressure than the one before it ended with.
bool changes_law(const Model& model, const ContactPair& pair, std::int32_t step);

/// Whether any step's version of the interaction needs the penalty stiffness of the slave (slave_surface.hpp).
bool needs_penalty_stiffness(const Model& model, const ContactPair& pair);

}  // namespace balocco
