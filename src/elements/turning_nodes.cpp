#include "elements/turning_nodes.hpp"

#include "constraints/constraint.hpp"
#include "elements/connectors/connector.hpp"
#include "elements/element_type.hpp"

namespace balocco {

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
  return turns;
}

}  // namespace balocco
