// Couplings whose clouds rigid bodies carry.
#pragma once

#include "model/model.hpp"

namespace balocco {

/// A distributing coupling of all freedoms, whose cloud one body carries in all steps, holds its reference node as a rigid arm does. It
/// becomes a joint to the reference node of the body, which costs as little as its cloud was large. @return how many did
std::int32_t join_rigid_clouds(Model& model);

}  // namespace balocco
