// Which degrees of freedom the equations of a step know.
#pragma once

#include <bitset>
#include <vector>

#include "analysis.hpp"

namespace balocco {

/// Degrees of freedom of a node, in its own directions: 0-2 translations, 3-5 rotations.
using Freedoms = std::bitset<6>;

/// By model node: those that an element of this step, a constraint or, in implicit dynamics, inertia speaks of, on any rank. What
/// rigid bodies carry and lead is not counted. Collective.
std::vector<Freedoms> used_freedoms(const Analysis& analysis);

/// @throws InputError, alike on every rank, where a concentrated load of the present step acts on a degree of freedom that nothing uses.
void refuse_loads_on_nothing(const Analysis& analysis, const std::vector<Freedoms>& used);

}  // namespace balocco
