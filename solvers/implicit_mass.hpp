// The inertia of implicit procedures: lumped masses, consistent ones of quadratic elements, and the rotary inertia of the material,
// moved as the constraints move them.
#pragma once

#include <functional>

#include "implicit_stiffness.hpp"

namespace balocco {

/// What has inertia: the displacement of a local node, or its spin (its body's on a reference node).
struct Inertial {
  std::int32_t node = -1;
  bool spins = false;
};

/// The mass itself, or mass-proportional damping: that of each material times its alpha.
enum class InertiaKind { mass, damping };

/// Block: row-major, three rows and columns for each of the freedoms, where the state stands.
using VisitInertia = std::function<void(std::span<const Inertial> freedoms, std::span<const double> block)>;

/// Visits this rank's part of the mass of the model, always in the same order. Rotations have the inertia of the material, not that
/// which the explicit loop gives them for its increment's sake.
void for_each_inertia(const Analysis& analysis, InertiaKind kind, const VisitInertia& visit);

/// How the slots move what has inertia.
NodeMotion motion_of(const Analysis& analysis, const ImplicitDofMap& map, Inertial freedom);

/// Assembles transpose(A) M A at the positions of the state, A being the motion of nodes and bodies by the slots. Collective.
void assemble_mass(const Analysis& analysis, const ImplicitDofMap& map, ImplicitStiffness& mass);

/// Component of a slot (translation or rotation) in a unit motion along axis `mode` < 3, or in a unit turn about axis
/// `mode` - 3 through the global origin, of the model as a rigid whole.
double rigid_motion(const Analysis& analysis, const ImplicitDofMap& map, std::int32_t slot, int mode);

}  // namespace balocco
