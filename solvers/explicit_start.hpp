// How the first dynamic step starts from the state that the steps before left: velocities, balance of forces,
// plausibility.
#pragma once

#include <vector>

#include "analysis.hpp"

namespace balocco {

/// Sets initial velocities on the current positions, later lines over earlier ones: a translation sets one component, a
/// rotation all three, to the rigid spin of the deformed shape. A rigid body takes the field at its reference node if
/// that node, or every node it carries, is in the set. An axis through the reference node of a body in its set moves and
/// turns with that body. What rolls on a contact pair's master runs through its loaded shape. Collective.
void apply_initial_velocities(Analysis& analysis, const Step& step, Observer& observer);

/// Warns when the speed of a driven road and the spin of a rotating tyre on it do not fit a rolling radius. Collective.
void check_rolling_radius(const Analysis& analysis, const Step& step, Observer& observer);

}  // namespace balocco
