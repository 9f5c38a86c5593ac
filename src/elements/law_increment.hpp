// The time in which laws flow and relax where one element is computed at a time.
#pragma once

#include "elements/nodal_motion.hpp"
#include "materials/material_law.hpp"

namespace balocco {

/// Statics, where nodes have no velocities, are at rate zero: all that can relax has. Elsewhere it is the increment's; 0: the forces of
/// the state as it is.
inline double law_increment(const NodalMotion& motion) { return motion.velocity == nullptr ? quasi_static : motion.increment; }

}  // namespace balocco
