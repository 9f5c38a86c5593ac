#include "model/check_constraints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/turning_nodes.hpp"

namespace balocco {

namespace {

template <class Procedure>
bool has_step(const Model& model) {
  return std::ranges::any_of(model.steps, [](const Step& step) { return std::holds_alternative<Procedure>(step.procedure); });
}

}  // namespace

bool is_acting_guide(const Model& model, std::size_t index) {
  const auto* guide = std::get_if<Guide>(&model.constraints[index].kind);
  const auto is_own = [&](const auto& actuation) { return actuation.guide == static_cast<std::int32_t>(index); };
  return guide != nullptr && (std::ranges::any_of(guide->rows,
                                                  [](const Guide::Row& row) {
                                                    return row.angle_node < 0 || row.stop != Guide::everywhere ||
                                                           row.lock != Guide::everywhere || row.friction;
                                                  }) ||
                              std::ranges::any_of(model.steps, [&](const Step& step) {
                                return std::ranges::any_of(step.connector_motions, is_own) ||
                                       std::ranges::any_of(step.connector_loads, is_own);
                              }));
}

std::vector<std::pair<Location, std::string>> check_constraints(const Model& model) {
  std::vector<std::pair<Location, std::string>> errors;
  if (model.constraints.empty()) return errors;
  std::map<std::int32_t, std::size_t> body_of;  // by node, from the start
  for (std::size_t index = 0; index < model.rigid_bodies.size(); ++index) {
    const auto& body = model.rigid_bodies[index];
    body_of[body.reference_node] = index;
    for (const auto* nodes : {&body.tie_nodes, &body.pin_nodes})
      for (const auto node : *nodes) body_of[node] = index;
  }
  for (const auto& step : model.steps) {
    if (step.removed_constraints.empty() || !std::holds_alternative<ExplicitProcedure>(step.procedure)) continue;
    const auto& definition = model.constraints[step.removed_constraints.front()];
    errors.emplace_back(
        Location{definition.file, definition.line},
        fmt::format(
            "*EQUATION: step '{}' is explicit and goes without it, which implicit steps alone can; keep it, or make the step "
            "implicit",
            step.name));
  }
  const bool is_explicit = has_step<ExplicitProcedure>(model), is_implicit_dynamic = has_step<DynamicProcedure>(model);
  const auto turns = turning_nodes(model);
  for (std::size_t index = 0; index < model.constraints.size(); ++index) {
    const auto& definition = model.constraints[index];
    if (is_explicit && std::holds_alternative<GreatestDistance>(definition.kind))
      errors.emplace_back(Location{definition.file, definition.line},
                          fmt::format("{}: DIST pulls in implicit steps alone; replace it by a spring with a table (*SPRING, NONLINEAR)", definition.keyword));
    if (is_explicit && std::holds_alternative<MeanRotation>(definition.kind))
      errors.emplace_back(Location{definition.file, definition.line},
                          fmt::format("{}: MEANROT turns nodes in implicit steps alone; replace it by *COUPLING with *DISTRIBUTING",
                                      definition.keyword));
    if (is_implicit_dynamic && is_acting_guide(model, index))
      errors.emplace_back(Location{definition.file, definition.line},
                          fmt::format("{}: stops, locks, friction, motions and loads of connectors have no place in implicit *DYNAMIC steps; give the "
                                      "step EXPLICIT, or remove them",
                                      definition.keyword));
    if (const auto* guide = std::get_if<Guide>(&definition.kind))
      for (const auto& row : guide->rows)
        if (row.angle_node >= 0 && turns[row.angle_node])
          errors.emplace_back(Location{definition.file, definition.line},
                              fmt::format("{}: degree of freedom 6 of node {} is the joint's angle, but another constraint turns that node; take a "
                                          "node that nothing else names",
                                          definition.keyword, model.node_name(row.angle_node)));
    const auto* joint = std::get_if<Joint>(&definition.kind);
    if (joint == nullptr || definition.element.table < 0) continue;
    const auto first = body_of.find(joint->nodes[0]), second = body_of.find(joint->nodes[1]);
    if (first == body_of.end() || second == body_of.end() || first->second != second->second) continue;
    errors.emplace_back(Location{definition.file, definition.line},
                        fmt::format("{}: nodes {} and {} belong to one rigid body, of reference node {}, so that nothing is left to join; join nodes "
                                    "of two bodies, or remove it",
                                    definition.keyword, model.node_name(joint->nodes[0]), model.node_name(joint->nodes[1]),
                                    model.node_name(model.rigid_bodies[first->second].reference_node)));
  }
  return errors;
}

}  // namespace balocco
