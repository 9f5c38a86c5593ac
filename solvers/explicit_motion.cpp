#include "explicit_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

using Kind = BoundaryCondition::Kind;

/// Displacements that have arrived and displacements without a course in time hold the node where it is.
bool holds(const Model& model, const BoundaryCondition& condition) {
  return condition.amplitude < 0 || has_arrived(model, condition);
}

double component_of(const double* vector, const Point& direction) {
  return vector[0] * direction[0] + vector[1] * direction[1] + vector[2] * direction[2];
}

void add_to(double* vector, double factor, const Point& direction) {
  for (int c = 0; c < 3; ++c) vector[c] += factor * direction[c];
}

double value_after(double delay, const Model& model, const Step& step, const BoundaryCondition& condition, const Instant& instant) {
  return condition.magnitude *
         amplitude_factor(model, step, condition.amplitude, instant.step_time + delay, instant.total_time + delay);
}

/// Those of `constraints`, which are in order of their nodes, that hold one node.
auto on_node(auto& constraints, std::int32_t node) {
  const auto place = [](const auto& constraint) { return constraint.node; };
  return std::span(std::ranges::lower_bound(constraints, node, {}, place), std::ranges::upper_bound(constraints, node, {}, place));
}

}  // namespace

double prescribed_velocity(const Model& model, const Step& step, const BoundaryCondition& condition,
                           const Instant& instant, const MotionComponent& motion) {
  const auto value = [&](double delay) { return value_after(delay, model, step, condition, instant); };
  switch (condition.kind) {
    case Kind::velocity:
      return value(0.5 * instant.next);
    case Kind::acceleration:
      return motion.velocity + instant.average() * value(0.0);
    default:
      if (holds(model, condition)) return 0.0;
      if (instant.next == 0.0) return motion.velocity;  // the step is over: no course to follow
      return (value(instant.next) - motion.displacement) / instant.next;
  }
}

double prescribed_initial_velocity(const Model& model, const Step& step, const BoundaryCondition& condition,
                                   const Instant& instant, const MotionComponent& motion) {
  const Instant now{instant.step_time, instant.total_time, 0.0, 0.0};
  if (condition.kind != Kind::displacement) return prescribed_velocity(model, step, condition, now, motion);
  if (holds(model, condition)) return 0.0;
  const double shortly = 1e-6 * step.duration();
  return (value_after(shortly, model, step, condition, now) - value_after(0.0, model, step, condition, now)) / shortly;
}

void refuse_jump(const Model& model, const BoundaryCondition& condition, double displacement) {
  if (condition.kind != Kind::displacement || condition.fixed || condition.propagated || condition.amplitude >= 0)
    return;
  constexpr double tolerance = 1e-6;  // of the displacement: rounding of the steps before
  if (condition.magnitude == 0.0 ||
      std::abs(condition.magnitude - displacement) <= tolerance * std::abs(condition.magnitude))
    return;
  throw InputError(fmt::format(
      "{}: error: *BOUNDARY: a displacement of {} without AMPLITUDE would make node {} jump from {} at the start of an "
      "explicit step; give it an AMPLITUDE or prescribe a velocity",
      model.where({condition.file, condition.line}), condition.magnitude, model.nodes.id[condition.node],
      displacement));
}

NodalConstraints::NodalConstraints(const Analysis& analysis, const Step& step, NodalFreedom freedom) : freedom_(freedom) {
  const Model& model = analysis.model;
  const bool rotations = freedom == NodalFreedom::rotation;
  for (const auto& condition : step.boundary) {
    const auto node = analysis.domain.local_node[condition.node];
    if (node < 0 || (condition.dof >= 3) != rotations || analysis.reference_of(node) >= 0) continue;
    if (const auto body = rotations ? analysis.turning_body(node) : analysis.carrier(node); body >= 0) {
      if (condition.propagated) continue;  // the node was attached after the condition was said
      throw InputError(
          fmt::format("{}: error: *BOUNDARY: node {} moves with a rigid body; constrain its reference node {}",
                      model.where({condition.file, condition.line}), model.nodes.id[condition.node],
                      model.nodes.id[model.rigid_bodies[body].reference_node]));
    }
    if (rotations && std::ranges::count(analysis.rotary_tensors, node, &Analysis::RotaryTensor::node) > 0)
      continue;  // GyroscopicNodes' business
    constraints_.push_back({.node = node,
                            .direction = analysis.directions.direction(condition.node, condition.dof % 3),
                            .condition = &condition});
  }
  std::ranges::stable_sort(constraints_, {}, &Constraint::node);
}

std::vector<double>& NodalConstraints::velocity(Analysis& analysis) const {
  return freedom_ == NodalFreedom::rotation ? analysis.current.angular_velocity : analysis.current.velocity;
}

const std::vector<double>& NodalConstraints::inertia(const Analysis& analysis) const {
  return freedom_ == NodalFreedom::rotation ? analysis.scaled_inertia().rotary : analysis.scaled_inertia().mass;
}

MotionComponent NodalConstraints::motion(const Analysis& analysis, const Constraint& constraint) const {
  if (freedom_ == NodalFreedom::rotation)
    return {component_of(&analysis.current.rotation[4 * constraint.node], constraint.direction),
            component_of(&analysis.current.angular_velocity[4 * constraint.node], constraint.direction)};
  const auto& origin = analysis.model.nodes.coordinates[constraint.condition->node];
  const double* position = &analysis.current.position[4 * constraint.node];
  return {component_of(position, constraint.direction) - component_of(origin.data(), constraint.direction),
          component_of(&analysis.current.velocity[4 * constraint.node], constraint.direction)};
}

void NodalConstraints::refuse_jumps(const Analysis& analysis) const {
  for (const auto& constraint : constraints_)
    refuse_jump(analysis.model, *constraint.condition, motion(analysis, constraint).displacement);
}

void NodalConstraints::set_initial_velocities(Analysis& analysis, const Step& step, const Instant& instant) const {
  for (const auto& constraint : constraints_) {
    const auto now = motion(analysis, constraint);
    const double wanted = prescribed_initial_velocity(analysis.model, step, *constraint.condition, instant, now);
    add_to(&velocity(analysis)[4 * constraint.node], wanted - now.velocity, constraint.direction);
  }
}

std::span<const NodalConstraints::Constraint> NodalConstraints::of_node(std::int32_t node) const {
  return on_node(constraints_, node);
}

void NodalConstraints::find_velocities(const Analysis& analysis, const Step& step, const Instant& instant) {
  for (auto& constraint : constraints_) {
    const auto now = motion(analysis, constraint);
    constraint.old_velocity = now.velocity;
    constraint.new_velocity = prescribed_velocity(analysis.model, step, *constraint.condition, instant, now);
    if (freedom_ == NodalFreedom::translation) std::copy_n(&analysis.current.position[4 * constraint.node], 3, constraint.position.data());
  }
}

void NodalConstraints::find_reactions(const Analysis& analysis, const Instant& instant, const double* force) {
  for (auto& constraint : constraints_) {
    const double acceleration = (constraint.new_velocity - constraint.old_velocity) / instant.average();
    constraint.reaction = inertia(analysis)[constraint.node] * acceleration -
                          component_of(force + 4 * static_cast<std::ptrdiff_t>(constraint.node), constraint.direction);
  }
}

void NodalConstraints::add_to_reactions(std::int32_t node, const Point& force) {
  for (auto& constraint : on_node(constraints_, node))
    constraint.reaction -= component_of(force.data(), constraint.direction);
}

void NodalConstraints::enforce(Analysis& analysis, const Instant& instant) const {
  for (const auto& constraint : constraints_) {
    double* const entry = &velocity(analysis)[4 * constraint.node];
    add_to(entry, constraint.new_velocity - component_of(entry, constraint.direction), constraint.direction);
    // Trapezoidal: half the work of the increment before, half of the one that follows.
    analysis.current.nodal_work[constraint.node].external +=
        0.5 * constraint.reaction *
        (instant.previous * constraint.old_velocity + instant.next * constraint.new_velocity);
  }
}

void NodalConstraints::move_again(Analysis& analysis, const Instant& instant) const {
  for (const auto& constraint : constraints_)
    for (int c = 0; c < 3; ++c)
      analysis.current.position[4 * constraint.node + c] =
          constraint.position[c] + instant.next * analysis.current.velocity[4 * constraint.node + c];
}

void NodalConstraints::add_to_output(Analysis& analysis, const Instant& instant) const {
  const bool rotations = freedom_ == NodalFreedom::rotation;
  auto& reaction = rotations ? analysis.reaction_moment : analysis.reaction;
  auto& acceleration = rotations ? analysis.angular_acceleration : analysis.acceleration;
  for (const auto& constraint : constraints_) {
    add_to(&reaction[4 * constraint.node], constraint.reaction, constraint.direction);
    analysis.work_ahead[constraint.node].external += 0.5 * instant.next * constraint.reaction * constraint.new_velocity;
    const double mass = inertia(analysis)[constraint.node];
    if (mass > 0.0) add_to(&acceleration[4 * constraint.node], constraint.reaction / mass, constraint.direction);
  }
}

void NodalConstraints::remove_constrained(double* vector) const {
  for (const auto& constraint : constraints_) {
    double* entry = vector + 4 * static_cast<std::ptrdiff_t>(constraint.node);
    add_to(entry, -component_of(entry, constraint.direction), constraint.direction);
  }
}

double NodalConstraints::squared_constrained(const Domain& domain, const double* vector,
                                             const std::function<double(std::size_t)>& factor) const {
  double sum = 0.0;
  for (const auto& constraint : constraints_) {
    const double value = factor(static_cast<std::size_t>(constraint.node)) *
                         component_of(vector + 4 * static_cast<std::ptrdiff_t>(constraint.node), constraint.direction);
    if (domain.owned[constraint.node]) sum += value * value;
  }
  return sum;
}

}  // namespace balocco
