// Springs and dashpots in an explicit step: elements without mass move with the masses of the nodes that they hold, which
// bound the increment and the forces.
#pragma once

#include <vector>

#include "explicit_linkages.hpp"

namespace balocco {

/// What springs and dashpots do to each local node, summed over all elements and ranks, the same bits on every copy; empty where the
/// model has none of the kind.
struct NodalRestraints {
  std::vector<Restraint> translation;
  std::vector<Restraint> rotation;  // nodes that turn
};

/// Collective.
NodalRestraints nodal_restraints(const Analysis& analysis);

/// Each element takes of a node's mass (or of a rigid body's) the share that its stiffness has in all of them there, so that the bound
/// is sum K / m over its nodes: exact for one spring between two masses, and for long chains. Collective.
RestraintBound restraint_bound(const Analysis& analysis, const NodalRestraints& restraints, const RigidDynamics& bodies,
                               ExplicitLinkages& linkages);

/// Refuses nodes that a spring or dashpot would have to move without a mass, or turn without a rotary inertia. @throws InputError
void refuse_massless_restraints(const Analysis& analysis, const Step& step, const ExplicitLinkages& linkages);

}  // namespace balocco
