#include "constraints/rigid_clouds.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "constraints/rigid_body.hpp"
#include "math/tensor.hpp"

namespace balocco {

namespace {

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

std::int32_t join_rigid_clouds(Model& model) {
  if (model.rigid_bodies.empty()) return 0;
  const auto bodies = initial_rigid_bodies(model);
  std::map<std::int32_t, std::size_t> body_of;  // by node
  for (std::size_t index = 0; index < bodies.size(); ++index) {
    const auto changes = [&](const Step& step) {
      return std::ranges::any_of(step.attachments, [&](const auto& change) { return change.rigid_body == static_cast<std::int32_t>(index); });
    };
    if (std::ranges::any_of(model.steps, changes)) continue;
    for (const auto& carried : bodies[index].nodes) body_of[carried.node] = index;
  }
  std::int32_t joined = 0;
  for (auto& definition : model.constraints) {
    const auto* coupling = std::get_if<DistributingCoupling>(&definition.kind);
    if (coupling == nullptr || std::ranges::count(coupling->freedoms, false) > 0) continue;
    const auto body = body_of.find(coupling->nodes.front());
    const auto in_body = [&](std::int32_t node) {
      const auto found = body_of.find(node);
      return found != body_of.end() && found->second == body->second;
    };
    if (body == body_of.end() || body_of.contains(coupling->reference) || !std::ranges::all_of(coupling->nodes, in_body)) continue;
    const auto first = model.rigid_bodies[body->second].reference_node;
    if (first == coupling->reference || !spreads(model, coupling->nodes)) continue;
    definition.kind = Joint{.nodes = {first, coupling->reference}, .pieces = {{Joint::Part::offset}, {Joint::Part::align}}};
    ++joined;
  }
  return joined;
}

}  // namespace balocco
