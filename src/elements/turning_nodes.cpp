#include "elements/turning_nodes.hpp"

#include "constraints/constraint.hpp"
#include "elements/connectors/connector.hpp"
#include "elements/element_type.hpp"

namespace balocco {

namespace {

/// What rigid bodies carry turns with them. That matters where a node belongs to no face or volume, as reference nodes of couplings,
/// which tell their rotation, and where a moment acts, which needs a place to be added up.
void add_carried(const Model& model, const std::vector<bool>& reference, std::vector<bool>& turns) {
  std::vector<bool> carried(turns.size(), false), idle(turns.size(), true);
  for (const auto& body : model.rigid_bodies)
    for (const auto node : body.tie_nodes) carried[node] = !reference[node];
  for (const auto& table : model.elements)
    for (std::size_t i = 0; i < table.connectivity.size() && table.type->nodes > 2; ++i) idle[table.connectivity[i]] = false;
  for (const auto& step : model.steps)
    for (const auto& load : step.concentrated_loads)
      if (load.dof >= 3 || load.follower) idle[load.node] = true;
  for (std::size_t node = 0; node < turns.size(); ++node)
    if (carried[node] && idle[node]) turns[node] = true;
}

}  // namespace

std::vector<bool> turning_nodes(const Model& model) {
  std::vector<bool> reference(static_cast<std::size_t>(model.nodes.size())), turns = reference;
  for (const auto& body : model.rigid_bodies) reference[body.reference_node] = true;
  for (const auto& table : model.elements) {
    const bool rotary = table.type->section == Section::Kind::rotary_inertia;
    if (!table.type->turns && !rotary) continue;
    for (const auto node : table.connectivity)
      if (!rotary || !reference[node]) turns[node] = true;
  }
  for (const auto& table : model.elements)
    for (std::size_t i = 0; i < table.connectivity.size(); ++i) {
      const auto section = table.section[i / static_cast<std::size_t>(table.type->nodes)];
      // Springs and dashpots of degrees of freedom 4 to 6; also on reference nodes, which turn with their bodies.
      if (section >= 0 && model.sections[section].spring.freedom[0] >= 3) turns[table.connectivity[i]] = true;
      if (section >= 0 && model.sections[section].connector >= 0 && turns_nodes(model.connectors[model.sections[section].connector]))
        turns[table.connectivity[i]] = true;
    }
  for (const auto& constraint : make_constraints(model))
    for (std::size_t i = 0; i < constraint->nodes().size(); ++i)
      if (constraint->turns(static_cast<int>(i))) turns[constraint->nodes()[i]] = true;
  add_carried(model, reference, turns);
  return turns;
}

}  // namespace balocco
