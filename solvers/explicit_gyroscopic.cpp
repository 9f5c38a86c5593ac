#include "explicit_gyroscopic.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "math/rotation.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

Vector3<double> vector(const double* p) {
  return {{p[0], p[1], p[2]}};
}

}  // namespace

GyroscopicNodes::GyroscopicNodes(const Analysis& analysis, const Step& step) {
  for (const auto& given : analysis.rotary_tensors) {
    if (analysis.reference_of(given.node) >= 0) continue;
    const auto row = analysis.domain.node_row[given.node];
    if (analysis.turning_body(given.node) >= 0)
      throw InputError(fmt::format(
          "{}: error: *ROTARY INERTIA: node {} turns with a rigid body; give the inertia to the body's reference node",
          analysis.model.where(analysis.model.sections[given.section].location), analysis.model.nodes.id[row]));
    if (!contains(given.node)) {
      nodes_.push_back({.node = given.node,
                        .section = given.section,
                        .tensor = analysis.rotary_inertia[given.node] * Matrix3<double>::identity()});
      if (const auto* axes = analysis.directions.find(row)) nodes_.back().axes = *axes;
    }
    auto& node = *std::ranges::find(nodes_, given.node, &Node::node);
    node.tensor = node.tensor + given.tensor;
  }
  for (const auto& condition : step.boundary) {
    if (condition.dof < 3) continue;
    const auto local = analysis.domain.local_node[condition.node];
    const auto node = std::ranges::find(nodes_, local, &Node::node);
    if (local >= 0 && node != nodes_.end()) node->condition[condition.dof - 3] = &condition;
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
  return std::ranges::find(nodes_, node, &Node::node) != nodes_.end();
}

void GyroscopicNodes::solve(Node& node, const Analysis& analysis, const Vector3<double>& torque,
                            const Vector3<double>& old_spin, const std::array<double, 3>& wanted,
                            const Instant& instant) const {
  // Everything along the degrees of freedom.
  const double* const q = &analysis.current.orientation[4 * node.node];
  const auto turn = node.axes * rotation_matrix(Quaternion<double>{q[0], q[1], q[2], q[3]});
  const auto inertia = turn * node.tensor * transpose(turn);
  Eigen::Matrix3d reduced;
  Vector3<double> known{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) reduced(i, j) = inertia(i, j);
  for (int dof = 0; dof < 3; ++dof) {
    if (node.condition[dof] == nullptr) continue;
    known[dof] = (wanted[dof] - old_spin[dof]) / instant.average();
    reduced.row(dof).setZero();
    reduced.col(dof).setZero();
    reduced(dof, dof) = 1.0;
  }
  const Eigen::PartialPivLU<Eigen::Matrix3d> factors(reduced);
  // The gyroscopic moment belongs to the spin at the instant, which depends on the acceleration sought: three corrections
  // take the error to (spin x increment)^4, as for rigid bodies.
  Vector3<double> spin = old_spin, load{};
  for (int correction = 0; correction < 3; ++correction) {
    load = torque - cross(spin, inertia * spin);
    const auto rest = load - inertia * known;
    Eigen::Vector3d right;
    for (int dof = 0; dof < 3; ++dof) right[dof] = node.condition[dof] != nullptr ? known[dof] : rest[dof];
    const Eigen::Vector3d solution = factors.solve(right);
    node.acceleration = {{solution[0], solution[1], solution[2]}};
    spin = old_spin + 0.5 * instant.previous * node.acceleration;
  }
  node.reaction = inertia * node.acceleration - load;
  for (int dof = 0; dof < 3; ++dof)
    if (node.condition[dof] == nullptr) node.reaction[dof] = 0.0;
}

void GyroscopicNodes::accelerate(Analysis& analysis, const Step& step, const Instant& instant, const double* moment) {
  auto& state = analysis.current;
  for (auto& node : nodes_) {
    double* const spin = &state.angular_velocity[4 * node.node];
    const auto old_spin = node.axes * vector(spin), rotation = node.axes * vector(&state.rotation[4 * node.node]);
    std::array<double, 3> wanted{};
    for (int dof = 0; dof < 3; ++dof)
      if (const auto* condition = node.condition[dof])
        wanted[dof] = prescribed_velocity(analysis.model, step, *condition, instant, {rotation[dof], old_spin[dof]});
    solve(node, analysis, node.axes * vector(moment + 4 * static_cast<std::ptrdiff_t>(node.node)), old_spin, wanted,
          instant);
    auto new_spin = old_spin + instant.average() * node.acceleration;
    for (int dof = 0; dof < 3; ++dof)
      if (node.condition[dof] != nullptr) new_spin[dof] = wanted[dof];
    state.nodal_work[node.node].external +=
        0.5 * dot(node.reaction, instant.previous * old_spin + instant.next * new_spin);
    std::ranges::copy((transpose(node.axes) * new_spin).component, spin);
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
        0.5 * instant.next * dot(reaction, vector(&analysis.current.angular_velocity[4 * node.node]));
  }
}

}  // namespace balocco
