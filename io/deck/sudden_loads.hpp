// *STEP, AMPLITUDE=STEP.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// Loads and displacements that the current static step says without a curve act from its start on. What it takes away is refused.
void act_at_once(Builder& builder);

}  // namespace balocco::deck
