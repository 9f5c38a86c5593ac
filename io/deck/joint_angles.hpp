// Freedom 6 of the nodes that show an axis of *MPC REVOLUTE or UNIVERSAL: *BOUNDARY prescribes the joint's angle there, *CLOAD a moment
// in the joint that drives the angle on. Source: Abaqus Theory Guide, "Revolute MPC".
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// @return false: this freedom is no angle of a joint.
bool prescribes_angle(Builder& builder, std::int32_t node, int dof, const BoundaryCondition& condition);
/// Likewise; `load` has magnitude, amplitude and where it is said.
bool loads_angle(Builder& builder, std::int32_t node, int dof, const ConcentratedLoad& load);

/// Whether a motion or load is one of these, not of a connector.
template <class Actuation>
bool is_of_angle(const Model& model, const Actuation& actuation) {
  return std::get<Guide>(model.constraints[actuation.guide].kind).rows[actuation.row].angle_node >= 0;
}

}  // namespace balocco::deck
