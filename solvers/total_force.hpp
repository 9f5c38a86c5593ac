// TF: the forces that hold a node: loads, reactions and those of constraints together.
#pragma once

#include <span>

#include "analysis.hpp"

namespace balocco {

/// What the elements and the deformable contact of each local node resist, three values a node, and reactions on the reference nodes of bodies. Of
/// dynamic states, whose masses resist too, reactions alone. Collective.
void total_force(const Analysis& analysis, std::span<double> values);

}  // namespace balocco
