// Joints that rigid bodies make needless.
#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"

namespace balocco {

/// Leaves out joints (*MPC of type BEAM, kinematic couplings) between nodes that one rigid body carries for good and turns: so a
/// part of a welded structure becomes rigid by one line. Joints of connectors stay: they have forces to tell. @return a note
/// where there were any.
std::optional<std::string> drop_implied_joints(Model& model);

}  // namespace balocco
