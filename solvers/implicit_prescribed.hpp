// Motions that an implicit step prescribes, as functions of time.
#pragma once

#include <span>
#include <vector>

#include "implicit_dof_map.hpp"

namespace balocco {

/// A degree of freedom that a boundary condition moves. `slot` as in implicit_dof_map.hpp.
struct PrescribedMotion {
  std::int32_t slot = -1;
  const BoundaryCondition* condition = nullptr;
  double start = 0.0;  // displacement or rotation when the step began
};

/// The step's boundary conditions on this rank's nodes; of several on one degree of freedom the last holds. Conditions that an earlier step put on a node
/// which a rigid body carries by now have no effect. @throws InputError if this step's own condition is on a carried
/// node.
std::vector<PrescribedMotion> prescribed_motions(const Analysis& analysis, const Step& step);
std::vector<std::int32_t> slots_of(const std::vector<PrescribedMotion>& motions);

/// u(t) = persistence * u(0) + motion: displacement (rotation) of a condition's dof at `step_time` from that at the
/// step's start.
struct MotionLaw {
  double persistence = 1.0;
  double motion = 0.0;
};
MotionLaw motion_law(const Model& model, const Step& step, const BoundaryCondition& condition, double step_time,
                     double total_time);

/// Makes what holds prescribed motions, of the forces out of balance on each slot, the reactions; accelerations become zero.
void show_reactions(Analysis& analysis, const ImplicitDofMap& map, std::span<const double> residual);

}  // namespace balocco
