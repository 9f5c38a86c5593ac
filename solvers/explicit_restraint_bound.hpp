// What springs, dashpots and connectors take from the increment of an explicit step.
#pragma once

#include "explicit_restraints.hpp"

namespace balocco {

/// Each element takes of a node's mass (or of a rigid body's, or of a linkage's) the share that its stiffness has in all of them
/// there, so that the bound is sum mu over its nodes, mu = K / m: exact for one spring between two masses, and for long chains. Where
/// elements of the model bring some of that mass, the bound of one end need not be that of the other: sqrt(mu_a) sum sqrt(mu), which
/// is small at the heavy one, is added to the elements that move with that end, and no others. Keeps State::restrained and the bound in
/// the state. Collective.
RestraintBound find_restraint_bound(Analysis& analysis, const NodalRestraints& restraints, const RigidDynamics& bodies,
                                    ExplicitLinkages& linkages);

}  // namespace balocco
