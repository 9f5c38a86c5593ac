// The mass matrix of the free slots: lumped masses, consistent ones of quadratic elements, and the rotary inertia of the material,
// moved as the constraints move them.
#pragma once

#include "implicit_stiffness.hpp"

namespace balocco {

/// Assembles transpose(A) M A at the positions of the state, A being the motion of nodes and bodies by the slots. Collective.
void assemble_mass(const Analysis& analysis, const ImplicitDofMap& map, ImplicitStiffness& mass);

/// Component of a slot (translation or rotation) in a unit motion along axis `mode` < 3, or in a unit turn about axis
/// `mode` - 3 through the global origin, of the model as a rigid whole.
double rigid_motion(const Analysis& analysis, const ImplicitDofMap& map, std::int32_t slot, int mode);

}  // namespace balocco
