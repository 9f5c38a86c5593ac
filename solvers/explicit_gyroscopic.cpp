#include "explicit_gyroscopic.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "math/definite_solver.hpp"
#include "math/rotation.hpp"
#include "model/diagnostics.hpp"
#include "vectors.hpp"

namespace balocco {

namespace {

/// What turned before its body took it has another inertia in the body's frame than at the start.
bool turns_as_its_body(const Analysis& analysis, std::int32_t node) {
  constexpr double alike = 1e-12;
  const auto& body = analysis.current.rigid_bodies[static_cast<std::size_t>(analysis.turning_body(node))].orientation;
  const double* const own = &analysis.current.orientation[4 * static_cast<std::size_t>(node)];
  return std::equal(body.begin(), body.end(), own, [](double a, double b) { return std::abs(a - b) < alike; });
}

}  // namespace

GyroscopicNodes::GyroscopicNodes(const Analysis& analysis, const Step& step)
    : index_(static_cast<std::size_t>(analysis.domain.turning), -1) {
  for (const auto& given : analysis.rotary_tensors) {
    if (analysis.reference_of(given.node) >= 0) continue;
    const auto row = analysis.domain.node_row[given.node];
    if (analysis.turning_body(given.node) >= 0) {
      if (turns_as_its_body(analysis, given.node)) continue;  // its inertia is the body's
      throw InputError(fmt::format(
          "{}: error: *ROTARY INERTIA: node {} had turned otherwise when a rigid body took it; give the inertia to the body's reference node",
          analysis.model.where(analysis.model.sections[given.section].location), analysis.model.nodes.id[row]));
    }
    if (!contains(given.node)) {
      index_[given.node] = static_cast<std::int32_t>(nodes_.size());
      nodes_.push_back({.node = given.node,
                        .section = given.section,
                        .tensor = analysis.scaled_inertia().rotary[given.node] * Matrix3<double>::identity()});
      if (const auto* axes = analysis.directions.find(row)) nodes_.back().axes = *axes;
    }
    auto& node = nodes_[index_[given.node]];
    node.tensor = node.tensor + given.tensor;
  }
  for (const auto& condition : step.boundary) {
    if (condition.dof < 3) continue;
    const auto local = analysis.domain.local_node[condition.node];
    if (local >= 0 && contains(local)) nodes_[index_[local]].condition[condition.dof - 3] = &condition;
  }
  for (const auto& node : nodes_) {
    const auto inertia = node.axes * node.tensor * transpose(node.axes);
    for (int dof = 0; dof < 3; ++dof)
      if (node.condition[dof] == nullptr && !(inertia(dof, dof) > 0.0))
        throw InputError(fmt::format(
            "{}: error: *ROTARY INERTIA: degree of freedom {} of node {} is free in step {} but has no inertia; constrain "
            "it or give it some",
            analysis.model.where(analysis.model.sections[node.section].location), dof + 4,
            analysis.model.nodes.id[analysis.domain.node_row[node.node]], step.name));
  }
}

bool GyroscopicNodes::contains(std::int32_t node) const {
  return node < static_cast<std::int32_t>(index_.size()) && index_[node] >= 0;
}

void GyroscopicNodes::renew_inertia(const Analysis& analysis) {
  for (auto& node : nodes_) {
    node.tensor = analysis.scaled_inertia().rotary[node.node] * Matrix3<double>::identity();
    node.inertia_now = {};
  }
  for (const auto& given : analysis.rotary_tensors)
    if (contains(given.node)) nodes_[index_[given.node]].tensor = nodes_[index_[given.node]].tensor + given.tensor;
}

const GyroscopicNodes::Inertia& GyroscopicNodes::inertia(const Node& node, const Analysis& analysis) {
  Quaternion<double> orientation;
  std::copy_n(&analysis.current.orientation[4 * static_cast<std::size_t>(node.node)], 4, orientation.begin());
  auto& now = node.inertia_now;
  if (now.orientation == orientation) return now;
  now.orientation = orientation;
  const auto turn = node.axes * rotation_matrix(orientation);
  now.tensor = turn * node.tensor * transpose(turn);
  auto reduced = now.tensor;  // rows of prescribed degrees of freedom become identities
  for (int dof = 0; dof < 3; ++dof) {
    if (node.condition[dof] == nullptr) continue;
    for (int i = 0; i < 3; ++i) reduced(dof, i) = reduced(i, dof) = 0.0;
    reduced(dof, dof) = 1.0;
  }
  const DefiniteSolver<3> factors(reduced);
  for (int j = 0; j < 3; ++j) {
    Vector3<double> unit;
    unit[j] = 1.0;
    const auto column = factors.solve(unit);
    for (int i = 0; i < 3; ++i) now.inverse(i, j) = node.condition[i] == nullptr && node.condition[j] == nullptr ? column[i] : 0.0;
  }
  return now;
}

GyroscopicNodes::Motion GyroscopicNodes::solve(const Node& node, const Analysis& analysis, const Step& step, const Vector3<double>& moment,
                                               const Instant& instant) const {
  Motion motion;
  const auto& state = analysis.current;
  motion.old_spin = node.axes * vector_of(&state.angular_velocity[4 * node.node]);
  const auto torque = node.axes * moment, rotation = node.axes * vector_of(&state.rotation[4 * node.node]);
  const auto& [orientation, mass, inverse] = inertia(node, analysis);
  Vector3<double> known{}, wanted{};
  for (int dof = 0; dof < 3; ++dof) {
    if (node.condition[dof] == nullptr) continue;
    wanted[dof] = prescribed_velocity(analysis.model, step, *node.condition[dof], instant, {rotation[dof], motion.old_spin[dof]});
    known[dof] = (wanted[dof] - motion.old_spin[dof]) / instant.average();
  }
  // The gyroscopic moment belongs to the spin at the instant, which depends on the acceleration sought: three corrections
  // take the error to (spin x increment)^4, as for rigid bodies.
  Vector3<double> spin = motion.old_spin, load{};
  for (int correction = 0; correction < 3; ++correction) {
    load = torque - cross(spin, mass * spin);
    motion.acceleration = inverse * (load - mass * known) + known;
    spin = motion.old_spin + 0.5 * instant.previous * motion.acceleration;
  }
  motion.reaction = mass * motion.acceleration - load;
  motion.new_spin = motion.old_spin + instant.average() * motion.acceleration;
  for (int dof = 0; dof < 3; ++dof) {
    if (node.condition[dof] != nullptr) motion.new_spin[dof] = wanted[dof];
    if (node.condition[dof] == nullptr) motion.reaction[dof] = 0.0;
  }
  return motion;
}

Matrix3<double> GyroscopicNodes::response(const Analysis& analysis, std::int32_t node) const {
  const auto& of = at(node);
  return transpose(of.axes) * inertia(of, analysis).inverse * of.axes;
}

Vector3<double> GyroscopicNodes::predicted_spin(const Analysis& analysis, const Step& step, const Instant& instant, std::int32_t node,
                                                const Vector3<double>& moment) const {
  return transpose(at(node).axes) * solve(at(node), analysis, step, moment, instant).new_spin;
}

void GyroscopicNodes::accelerate(Analysis& analysis, const Step& step, const Instant& instant, const double* moment) {
  for (auto& node : nodes_) {
    const auto motion = solve(node, analysis, step, vector_of(moment + 4 * static_cast<std::ptrdiff_t>(node.node)), instant);
    node.acceleration = motion.acceleration;
    node.reaction = motion.reaction;
    analysis.current.nodal_work[node.node].external +=
        0.5 * dot(node.reaction, instant.previous * motion.old_spin + instant.next * motion.new_spin);
    std::ranges::copy((transpose(node.axes) * motion.new_spin).component, &analysis.current.angular_velocity[4 * node.node]);
  }
}

void GyroscopicNodes::add_to_output(Analysis& analysis, const Instant& instant) const {
  for (const auto& node : nodes_) {
    const auto back = transpose(node.axes);
    const auto reaction = back * node.reaction, acceleration = back * node.acceleration;
    for (int i = 0; i < 3; ++i) {
      analysis.reaction_moment[4 * node.node + i] += reaction[i];
      analysis.angular_acceleration[4 * node.node + i] = acceleration[i];
    }
    analysis.work_ahead[node.node].external +=
        0.5 * instant.next * dot(reaction, vector_of(&analysis.current.angular_velocity[4 * node.node]));
  }
}

}  // namespace balocco
