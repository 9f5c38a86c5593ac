// What *MPC REVOLUTE and UNIVERSAL show on the nodes of their axes: the joint's angle as their rotation about the third direction, its
// rate, and the moment that holds a prescribed one.
#pragma once

#include <span>

#include "analysis.hpp"

namespace balocco {

/// Three values a local node.
void add_joint_angles(const Analysis& analysis, std::span<double> rotation);
/// `spin` has the angular velocities of nodes.
void add_joint_rates(const Analysis& analysis, std::span<double> spin);
void add_joint_reactions(const Analysis& analysis, std::span<double> moment);

}  // namespace balocco
