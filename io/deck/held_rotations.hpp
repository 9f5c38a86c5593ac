// Which rotations *MPC BEAM and kinematic couplings hold: those of nodes that turn, which is known when all constraints are read.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// Completes these joints. Takes out those that hold nothing, as they speak of rotations of nodes that do not turn.
void hold_rotations(Builder& builder);

}  // namespace balocco::deck
