// Loads of quadratic elements in implicit steps are those of consistent masses (elements/consistent_mass.hpp), as those of the C3D8 of
// pointwise dilatation.
#pragma once

#include "analysis.hpp"

namespace balocco {

/// True while the current step is an implicit one.
bool loads_are_consistent(const Analysis& analysis);

/// What a centrifugal load adds to sums of share * acceleration at each node, share being row_sums(): the force on a
/// node depends on where the others of its element are. `force`: 4 doubles a node, the fourth is the rounding constant.
void add_centrifugal_coupling(const Analysis& analysis, const BodyLoad& load, double magnitude, const double* position,
                              double* force);

}  // namespace balocco
