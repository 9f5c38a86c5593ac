// Stresses that go on in a reference configuration other than that in which they arose (*IMPORT, STATE=YES, UPDATE=YES).
#pragma once

#include <vector>

#include "analysis.hpp"

namespace balocco {

/// Cauchy stresses of solids at their integration points, per row of Model::elements: those of one element after the other.
using PointStresses = std::vector<std::vector<double>>;

/// Of the solids of Model::state_import, on all ranks alike. Collective.
PointStresses stresses_of_imported_solids(const Analysis& analysis);

/// Makes them the stresses of the undeformed elements. A model of the same elements.
void start_from_stresses(const PointStresses& stresses, Analysis& analysis);

}  // namespace balocco
