// What is left to do for shells when the whole deck is read.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// Checks nodal thicknesses, finds the normals at the corners, and warns where those of neighbours oppose each other.
void finish_shells(Builder& builder);

}  // namespace balocco::deck
