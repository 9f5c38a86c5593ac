// What rigid bodies make of constraints between nodes that they carry for good.
#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"

namespace balocco {

/// Leaves out joints (*MPC of type BEAM, kinematic couplings) between nodes that one rigid body carries for good and turns: so a
/// part of a welded structure becomes rigid by one line. Joints of connectors stay: they have forces to tell. @return a note
/// where there were any.
std::optional<std::string> drop_implied_joints(Model& model);

/// A distributing coupling of all freedoms, whose cloud one body carries likewise, holds its reference node as a rigid arm does: it becomes
/// a joint to the reference node of the body, which costs as little as its cloud was large.
void join_rigid_clouds(Model& model);

}  // namespace balocco
