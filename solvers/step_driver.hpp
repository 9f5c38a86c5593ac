// Values of boundary conditions and loads over a step, the same for every procedure.
#pragma once

#include <vector>

#include "analysis.hpp"

namespace balocco {

/// Factor on a load's magnitude at `step_time`: its amplitude's value, or the procedure's default (static: ramp; explicit: 1).
double amplitude_factor(const Model& model, const Step& step, std::int32_t amplitude, double step_time, double total_time);

/// Whether a prescribed displacement holds its node where the step finds it: it is FIXED, or an earlier step said it and its
/// curve (a curve over total time goes on) ended there.
bool has_arrived(const Model& model, const BoundaryCondition& condition);

/// Magnitude of a load that stood at `previous` when the step started.
double load_magnitude(const Model& model, const Step& step, double previous, double magnitude, std::int32_t amplitude,
                      double step_time, double total_time);

/// Force or moment of that magnitude on a local node, global directions: one that follows has turned with the node.
Point concentrated_vector(const Analysis& analysis, const ConcentratedLoad& load, double magnitude);
/// Times of the step at which its output requests ask for results (*TIME POINTS), sorted: increments that are not fixed end there.
std::vector<double> asked_times(const Step& step);

/// Gravity on what rigid bodies carry acts on their nodes, or is left out where a caller gives it to the bodies themselves.
enum class CarriedGravity { on_nodes, left_out };
bool is_left_out(const Analysis& analysis, const BodyLoad& load, std::int32_t local_node, CarriedGravity carried);

/// Adds concentrated loads and moments (owners only), pressure and body loads at `step_time` to `forces` (rounded), and moments on
/// reference nodes to `moments` (per rigid body; every rank computes the same).
void add_external_forces(const Analysis& analysis, const Step& step, double step_time, double total_time,
                         const double* position, const NodalForces& forces, std::vector<Point>& moments,
                         CarriedGravity carried = CarriedGravity::on_nodes);

}  // namespace balocco
