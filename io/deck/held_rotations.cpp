#include "deck/held_rotations.hpp"

#include <set>

#include "elements/turning_nodes.hpp"
#include "model/rigid_constraints.hpp"

namespace balocco::deck {

namespace {

bool is_beam(const Builder& builder, const Builder::HeldRotation& held) { return builder.model.constraints[held.joint].keyword == "*MPC"; }

/// Nodes that an *MPC BEAM holds though no element turns them: those that a rigid body carries with their rotation, and those where two
/// such arms end, which are rigid to each other.
std::vector<bool> turned_by_arms(const Builder& builder) {
  std::vector<bool> turned;
  for (const auto body : lasting_bodies(builder.model)) turned.push_back(body >= 0);
  std::set<std::int32_t> ends;
  for (const auto& held : builder.held_rotations) {
    const auto end = std::get<Joint>(builder.model.constraints[held.joint].kind).nodes[1];
    if (is_beam(builder, held) && !ends.insert(end).second) turned[end] = true;
  }
  return turned;
}

void take_out_empty(Builder& builder) {
  auto& constraints = builder.model.constraints;
  std::vector<std::int32_t> row;  // new ones
  std::vector<ConstraintDefinition> kept;
  for (auto& definition : constraints) {
    row.push_back(static_cast<std::int32_t>(kept.size()));
    const auto* joint = std::get_if<Joint>(&definition.kind);
    if (joint == nullptr || !joint->pieces.empty()) kept.push_back(std::move(definition));
  }
  if (kept.size() == row.size()) {
    constraints = std::move(kept);
    return;
  }
  for (auto& definition : kept)
    if (auto* guide = std::get_if<Guide>(&definition.kind); guide != nullptr && guide->joint >= 0) guide->joint = row[guide->joint];
  for (auto& [node, angle] : builder.joint_angles) angle.guide = row[angle.guide];
  constraints = std::move(kept);
}

}  // namespace

void hold_rotations(Builder& builder) {
  if (builder.held_rotations.empty()) return;
  const auto turns = turning_nodes(builder.model);
  const auto turned = turned_by_arms(builder);
  for (const auto& held : builder.held_rotations) {
    auto& joint = std::get<Joint>(builder.model.constraints[held.joint].kind);
    const auto end = joint.nodes[1];
    if (turns[end] || builder.body_of_reference.contains(end) || (is_beam(builder, held) && turned[end]))
      joint.pieces.push_back({Joint::Part::align, held.along});
  }
  builder.held_rotations.clear();
  take_out_empty(builder);
}

}  // namespace balocco::deck
