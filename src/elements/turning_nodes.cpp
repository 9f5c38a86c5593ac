#include "elements/turning_nodes.hpp"

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
  return turns;
}

}  // namespace balocco
