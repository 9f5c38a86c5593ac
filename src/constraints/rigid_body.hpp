// Kinematics of rigid bodies: where their nodes are, and attaching or releasing nodes.
#pragma once

#include "math/tensor.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace balocco {

/// Rotation matrix of a body (body frame -> global).
Matrix3<double> rotation_matrix(const RigidBodyState& body);

/// Current vector from the reference node to a carried node.
Point rigid_arm(const Matrix3<double>& rotation, const RigidNode& node);

/// Turns a body by the rotation vector `spin` (global directions, applied on the left) and keeps its quaternion unit.
void rotate(RigidBodyState& body, const Point& spin);

/// Moves the reference nodes of bodies with POSITION=CENTER OF MASS to their centres of mass: from there all displacements count.
/// @throws InputError for a body without mass.
void place_reference_nodes(Model& model);

/// Bodies of the undeformed model, with the nodes that they carry from the start.
std::vector<RigidBodyState> initial_rigid_bodies(const Model& model);

/// Attaches `row` to the body where it stands now (`position`), or releases it (no effect if the body does not carry it).
void attach(RigidBodyState& body, std::int32_t row, bool tie, const Point& position);
void release(RigidBodyState& body, std::int32_t row);

}  // namespace balocco
