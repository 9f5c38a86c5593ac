#include "model/implied_joints.hpp"

#include <fmt/format.h>

#include <unordered_map>
#include <utility>
#include <vector>

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

}  // namespace balocco
