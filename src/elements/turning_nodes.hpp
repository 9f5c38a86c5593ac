// Which nodes of a model rotate.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Per model row: true for nodes of elements whose nodes turn (ElementType::turns), for those of springs and dashpots that
/// act on rotations, for those whose rotation a constraint speaks of, and for those of ROTARYI elements unless they are reference
/// nodes of rigid bodies, which hold that inertia themselves.
std::vector<bool> turning_nodes(const Model& model);

}  // namespace balocco
