#include "model/rigid_constraints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "math/tensor.hpp"

namespace balocco {

namespace {

/// Body of each node that is its reference node, or tied to it from the start to the end.
std::unordered_map<std::int32_t, std::size_t> lasting_bodies(const Model& model) {
  std::unordered_map<std::int32_t, std::size_t> body_of;
  for (std::size_t index = 0; index < model.rigid_bodies.size(); ++index) {
    const auto& body = model.rigid_bodies[index];
    body_of[body.reference_node] = index;
    for (const auto node : body.tie_nodes) body_of[node] = index;
    for (const auto node : body.pin_nodes) body_of.erase(node);
  }
  for (const auto& step : model.steps)
    for (const auto& change : step.attachments)
      for (const auto node : change.nodes) body_of.erase(node);
  return body_of;
}

/// What follows others by their rows goes on doing so. `row` has the new rows.
void renumber(Model& model, const std::vector<std::int32_t>& row) {
  for (auto& definition : model.constraints)
    if (auto* guide = std::get_if<Guide>(&definition.kind); guide != nullptr && guide->joint >= 0) guide->joint = row[guide->joint];
  for (auto& step : model.steps) {
    for (auto& motion : step.connector_motions) motion.guide = row[motion.guide];
    for (auto& load : step.connector_loads) load.guide = row[load.guide];
  }
}

/// Whether the nodes are not all on one line, about which their mean would not turn.
bool spreads(const Model& model, const std::vector<std::int32_t>& nodes) {
  const auto arm = [&](std::int32_t node) {
    return Vector3<double>{model.nodes.coordinates[node]} - Vector3<double>{model.nodes.coordinates[nodes.front()]};
  };
  Vector3<double> longest{};
  for (const auto node : nodes)
    if (dot(arm(node), arm(node)) > dot(longest, longest)) longest = arm(node);
  constexpr double beside = 1e-6;  // square of the sine
  return std::ranges::any_of(nodes, [&](std::int32_t node) {
    const auto across = cross(longest, arm(node));
    return dot(across, across) > beside * dot(longest, longest) * dot(longest, longest);
  });
}

}  // namespace

std::optional<std::string> drop_implied_joints(Model& model) {
  const auto body_of = lasting_bodies(model);
  const auto implied = [&](const ConstraintDefinition& definition) {
    const auto* joint = std::get_if<Joint>(&definition.kind);
    if (joint == nullptr || definition.element.table >= 0) return false;
    const auto first = body_of.find(joint->nodes[0]), second = body_of.find(joint->nodes[1]);
    return first != body_of.end() && second != body_of.end() && first->second == second->second;
  };
  std::vector<ConstraintDefinition> kept, dropped;
  std::vector<std::int32_t> row;
  for (auto& definition : model.constraints) {
    row.push_back(static_cast<std::int32_t>(kept.size()));
    (implied(definition) ? dropped : kept).push_back(std::move(definition));
  }
  model.constraints = std::move(kept);
  if (dropped.empty()) return std::nullopt;
  renumber(model, row);
  const auto& first = dropped.front();
  const auto& nodes = std::get<Joint>(first.kind).nodes;
  return fmt::format("{}: note: {}: nodes {} and {} move as one with the rigid body of reference node {}; this joint is left out{}",
                     model.where({first.file, first.line}), first.keyword, model.node_name(nodes[0]), model.node_name(nodes[1]),
                     model.node_name(model.rigid_bodies[body_of.at(nodes[0])].reference_node),
                     dropped.size() > 1 ? fmt::format(", and {} others for the same reason", dropped.size() - 1) : "");
}

void join_rigid_clouds(Model& model) {
  const auto body_of = lasting_bodies(model);
  const auto body = [&](std::int32_t node) {
    const auto found = body_of.find(node);
    return found == body_of.end() ? -1 : static_cast<std::int64_t>(found->second);
  };
  for (auto& definition : model.constraints) {
    const auto* coupling = std::get_if<DistributingCoupling>(&definition.kind);
    if (coupling == nullptr || std::ranges::count(coupling->freedoms, false) > 0) continue;
    const auto carrier = body(coupling->nodes.front());
    if (carrier < 0 || body(coupling->reference) == carrier) continue;
    if (std::ranges::any_of(coupling->nodes, [&](std::int32_t node) { return body(node) != carrier; }) || !spreads(model, coupling->nodes)) continue;
    const auto first = model.rigid_bodies[static_cast<std::size_t>(carrier)].reference_node;
    definition.kind = Joint{.nodes = {first, coupling->reference}, .pieces = {{Joint::Part::offset}, {Joint::Part::align}}};
  }
}

}  // namespace balocco
