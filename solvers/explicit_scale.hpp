// The rounding constants of nodal forces: what makes sums exact, and at the same time the mark of a run that blew up.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "explicit_restraints.hpp"

namespace balocco {

/// Smallest stable increment of the undeformed elements, resting ones too, over all ranks. Collective.
double undeformed_increment(const Model& model, const Communicator& communicator, const Domain& domain,
                            std::span<const std::unique_ptr<ElementGroup>> groups);

struct ForceScale {
  std::vector<double> rounding_constant;  // per local node and for the scratch node, the same bits on every copy
  std::vector<double> moment_constant;    // likewise for moments: per node that turns
  std::vector<double> lever;              // per node that turns: the shortest edge beside it, which turns moments into forces
};

/// Fixed for a step by the undeformed model, its own masses and the step's loads, so that a restart on any number of ranks finds
/// the same. Collective.
ForceScale force_scale(const Analysis& analysis, const Step& step, const NodalRestraints& restraints);

/// Force beyond which a sum rounded with `constant` is no longer sure to be exact: 2 x the largest sum it was made for.
constexpr double overflow_fraction = 0.66;  // of the constant; 2 x largest sum is 2/3 of it

}  // namespace balocco
