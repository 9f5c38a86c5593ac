#include "model/rigid_constraints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "elements/turning_nodes.hpp"
#include "math/tensor.hpp"

namespace balocco {

namespace {

/// `row` has the new rows of the constraints.
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

const Joint* joint_of(const ConstraintDefinition& definition) { return std::get_if<Joint>(&definition.kind); }
bool is_connector(const ConstraintDefinition& definition) { return definition.element.table >= 0; }

/// Whether an end of a joint moves as one with the other, which a body carries: it keeps its place in the other's frame, and its axes if it
/// turns. What a body carries turns with it: *MPC BEAM on such a node holds rotations, even where no element turns the node.
bool is_arm(const ConstraintDefinition& definition, int end, const std::vector<bool>& turns) {
  const auto& joint = *joint_of(definition);
  const auto holds_all = [&](Joint::Part part) {
    return std::ranges::any_of(joint.pieces, [&](const Joint::Piece& piece) {
      return piece.part == part && piece.along == std::array{true, true, true};
    });
  };
  if (!holds_all(Joint::Part::offset)) return false;
  return holds_all(Joint::Part::align) || (end == 1 ? !turns[joint.nodes[1]] : definition.keyword == "*MPC");
}

/// Nodes whose motion something beside constraints says: boundary conditions, bodies that carry them at some time.
std::vector<bool> moved_otherwise(const Model& model) {
  std::vector<bool> moved(static_cast<std::size_t>(model.nodes.size()), false);
  for (const auto& body : model.rigid_bodies) {
    moved[body.reference_node] = true;
    for (const auto* nodes : {&body.tie_nodes, &body.pin_nodes})
      for (const auto node : *nodes) moved[node] = true;
  }
  for (const auto& step : model.steps) {
    for (const auto& change : step.attachments)
      for (const auto node : change.nodes) moved[node] = true;
    for (const auto& condition : step.boundary) moved[condition.node] = true;
  }
  return moved;
}

/// Takes joints out, but those of connectors, between nodes of one body; what follows others by their rows goes on doing so.
std::vector<ConstraintDefinition> take_out_implied(Model& model, const std::vector<std::int32_t>& body_of) {
  std::vector<ConstraintDefinition> kept, dropped;
  std::vector<std::int32_t> row;
  for (auto& definition : model.constraints) {
    row.push_back(static_cast<std::int32_t>(kept.size()));
    const auto* joint = joint_of(definition);
    const bool implied = joint != nullptr && !is_connector(definition) && body_of[joint->nodes[0]] >= 0 &&
                         body_of[joint->nodes[0]] == body_of[joint->nodes[1]];
    (implied ? dropped : kept).push_back(std::move(definition));
  }
  model.constraints = std::move(kept);
  if (!dropped.empty()) renumber(model, row);
  return dropped;
}

/// Which initial velocities name each node.
using Starts = std::vector<std::vector<bool>>;

Starts starts_of(const Model& model) {
  Starts starts;
  for (const auto& initial : model.initial_velocities) {
    auto& named = starts.emplace_back(static_cast<std::size_t>(model.nodes.size()), false);
    for (const auto node : initial.nodes) named[node] = true;
  }
  return starts;
}

/// Where a node is given a velocity without its body its joint decides what becomes of both.
bool starts_alone(const Starts& starts, std::int32_t node, std::int32_t other, std::int32_t reference) {
  return std::ranges::any_of(starts, [&](const std::vector<bool>& named) { return named[node] && !named[other] && !named[reference]; });
}

/// What bodies carry when they carry nodes at the ends of rigid arms too; `kept` are left alone. Such nodes start as what they are joined to:
/// `starts` then names them likewise.
std::vector<std::int32_t> bodies_with_arms(const Model& model, const std::vector<bool>& kept, Starts& starts) {
  auto body_of = lasting_bodies(model);
  const auto turns = turning_nodes(model);
  starts = starts_of(model);
  for (bool more = true; more;) {
    more = false;
    for (const auto& definition : model.constraints) {
      const auto* joint = joint_of(definition);
      if (joint == nullptr || is_connector(definition)) continue;
      for (const int end : {0, 1}) {
        const auto node = joint->nodes[end], other = joint->nodes[1 - end];
        if (body_of[node] >= 0 || body_of[other] < 0 || kept[node] || !is_arm(definition, end, turns)) continue;
        const auto reference = model.rigid_bodies[static_cast<std::size_t>(body_of[other])].reference_node;
        if (starts_alone(starts, node, other, reference)) continue;
        body_of[node] = body_of[other];
        for (auto& named : starts) named[node] = named[node] || named[other];
        more = true;
      }
    }
  }
  return body_of;
}

}  // namespace

std::vector<std::int32_t> lasting_bodies(const Model& model) {
  std::vector<std::int32_t> body_of(static_cast<std::size_t>(model.nodes.size()), -1);
  for (std::size_t index = 0; index < model.rigid_bodies.size(); ++index) {
    const auto& body = model.rigid_bodies[index];
    body_of[body.reference_node] = static_cast<std::int32_t>(index);
    for (const auto node : body.tie_nodes) body_of[node] = static_cast<std::int32_t>(index);
    for (const auto node : body.pin_nodes) body_of[node] = -1;
  }
  for (const auto& step : model.steps)
    for (const auto& change : step.attachments)
      for (const auto node : change.nodes) body_of[node] = -1;
  return body_of;
}

bool strains_in_bodies(const Section& section) {
  return (section.kind == Section::Kind::spring || section.kind == Section::Kind::dashpot) && section.spring.freedom[0] >= 0;
}

bool rests_for_good(std::span<const std::int32_t> nodes, const std::vector<std::int32_t>& body_of) {
  const auto body = body_of[nodes.front()];
  return body >= 0 && nodes.size() > 1 && std::ranges::all_of(nodes, [&](std::int32_t node) { return body_of[node] == body; });
}

std::optional<std::string> drop_implied_joints(Model& model) {
  const auto body_of = lasting_bodies(model);
  const auto dropped = take_out_implied(model, body_of);
  if (dropped.empty()) return std::nullopt;
  const auto& first = dropped.front();
  const auto& nodes = joint_of(first)->nodes;
  return fmt::format("{}: note: {}: nodes {} and {} move as one with the rigid body of reference node {}; this joint is left out{}",
                     model.where({first.file, first.line}), first.keyword, model.node_name(nodes[0]), model.node_name(nodes[1]),
                     model.node_name(model.rigid_bodies[body_of[nodes[0]]].reference_node),
                     dropped.size() > 1 ? fmt::format(", and {} others for the same reason", dropped.size() - 1) : "");
}

void join_rigid_clouds(Model& model) {
  const auto body_of = lasting_bodies(model);
  for (auto& definition : model.constraints) {
    const auto* coupling = std::get_if<DistributingCoupling>(&definition.kind);
    if (coupling == nullptr || std::ranges::count(coupling->freedoms, false) > 0) continue;
    const auto carrier = body_of[coupling->nodes.front()];
    if (carrier < 0 || body_of[coupling->reference] == carrier) continue;
    if (std::ranges::any_of(coupling->nodes, [&](std::int32_t node) { return body_of[node] != carrier; }) || !spreads(model, coupling->nodes)) continue;
    const auto first = model.rigid_bodies[static_cast<std::size_t>(carrier)].reference_node;
    definition.kind = Joint{.nodes = {first, coupling->reference}, .pieces = {{Joint::Part::offset}, {Joint::Part::align}}};
  }
}

void carry_joined_nodes(Model& model) {
  auto kept = moved_otherwise(model);
  Starts starts;
  auto body_of = bodies_with_arms(model, kept, starts);
  const auto holds_nothing = [&](const ConstraintDefinition& definition) {  // a connector that would lie within a body
    const auto* joint = joint_of(definition);
    if (joint == nullptr || !is_connector(definition)) return false;
    const auto [first, second] = joint->nodes;
    return body_of[first] >= 0 && body_of[first] == body_of[second] && !(kept[first] && kept[second]);
  };
  const auto find = [&] { return std::ranges::find_if(model.constraints, holds_nothing); };
  for (auto found = find(); found != model.constraints.end(); found = find()) {
    for (const auto node : joint_of(*found)->nodes) kept[node] = true;
    body_of = bodies_with_arms(model, kept, starts);
  }
  const auto before = lasting_bodies(model);
  bool carries_more = false;
  for (std::int32_t node = 0; node < model.nodes.size(); ++node) {
    if (body_of[node] == before[node]) continue;
    model.rigid_bodies[static_cast<std::size_t>(body_of[node])].tie_nodes.push_back(node);
    for (std::size_t i = 0; i < starts.size(); ++i)
      if (auto& named = model.initial_velocities[i].nodes; starts[i][node] && std::ranges::count(named, node) == 0) named.push_back(node);
    carries_more = true;
  }
  if (!carries_more) return;
  for (auto& body : model.rigid_bodies) std::ranges::sort(body.tie_nodes);
  take_out_implied(model, body_of);
}

}  // namespace balocco
