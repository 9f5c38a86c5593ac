// Nodes that rigid bodies carry for good, and what that makes of constraints between them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Body of each node of the model that is its reference node or tied to it from the start to the end; -1: none.
std::vector<std::int32_t> lasting_bodies(const Model& model);
/// Springs and dashpots in directions that do not turn, unlike those along the line between their nodes, strain even in a rigid body.
bool strains_in_bodies(const Section& section);
/// Whether an element of these nodes moves with one of them for good: it cannot strain and is not computed.
bool rests_for_good(std::span<const std::int32_t> nodes, const std::vector<std::int32_t>& body_of);

/// Leaves out joints (*MPC of type BEAM, kinematic couplings) between nodes that one rigid body carries for good and turns: so a
/// part of a welded structure becomes rigid by one line. Joints of connectors stay: they have forces to tell. @return a note
/// where there were any.
std::optional<std::string> drop_implied_joints(Model& model);

/// A distributing coupling of all freedoms, whose cloud one body carries likewise, holds its reference node as a rigid arm does: it becomes
/// a joint to the reference node of the body, which costs as little as its cloud was large.
void join_rigid_clouds(Model& model);

/// A node that a rigid arm (*MPC of type BEAM, a coupling) joins to what a body carries for good moves as one with it: the body carries it
/// too, and the joint goes. Nodes with boundary conditions, of other bodies, or with a connector to the same body keep their joints.
void carry_joined_nodes(Model& model);

}  // namespace balocco
