#include "total_force.hpp"

#include <algorithm>
#include <vector>

#include "constraints/linkages.hpp"
#include "elements/element_type.hpp"

namespace balocco {

namespace {

/// By node of the model, whether what its elements resist tells its force: CalculiX adds to the others what constraints exert on them,
/// but for that of equations. A node that equations alone know is so told nothing, and a body in equilibrium sums to zero.
std::vector<bool> told_by_elements(const Model& model) {
  std::vector<bool> told(static_cast<std::size_t>(model.nodes.size()), false);
  for (const auto& constraint : model.constraints)
    if (const auto* equation = std::get_if<LinearEquation>(&constraint.kind))
      for (const auto& term : equation->terms) told[term.node] = true;
  for (const auto& constraint : model.constraints)
    if (!std::holds_alternative<LinearEquation>(constraint.kind))
      for (const auto node : constrained_nodes(constraint.kind)) told[node] = false;
  for (const auto& table : model.elements)
    for (std::size_t i = 0; table.type->make_group != nullptr && i < table.connectivity.size(); ++i) told[table.connectivity[i]] = true;
  return told;
}

}  // namespace

void total_force(const Analysis& analysis, std::span<double> values) {
  const auto& domain = analysis.domain;
  std::vector<double> sums(4 * (static_cast<std::size_t>(domain.size()) + 1), 0.0), force;
  for (std::size_t index = 0; index < analysis.element_groups.size() && !analysis.current.dynamic; ++index) {
    const auto& group = *analysis.element_groups[index];
    const int freedoms = group.freedoms_per_node();
    force.resize(static_cast<std::size_t>(freedoms) * group.nodes_per_element());
    for (std::int32_t element = 0; element < group.size(); ++element) {
      if (!analysis.takes_part(group, element)) continue;
      analysis.internal_force(index, element, force);
      const auto nodes = group.nodes(element);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) sums[4 * nodes[i] + axis] += force[freedoms * i + axis];
    }
  }
  for (std::size_t pair = 0; pair < analysis.mesh_contacts.size() && !analysis.current.dynamic; ++pair) {
    const auto& contact = analysis.mesh_contacts[pair];
    for (std::int32_t place = 0; place < contact.size(); ++place)
      if (contact.owned(place))
        contact.take_forces(place, analysis.current.position.data(), analysis.current.contact[pair][place], sums);
  }
  domain.halo->begin_sum(sums.data());
  domain.halo->finish_sum(sums.data());
  const auto told = told_by_elements(analysis.model);
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    const bool by_reaction = analysis.current.dynamic || !told[domain.node_row[node]];
    const auto body = analysis.reference_of(node);
    const double* const held = by_reaction ? &analysis.reaction[4 * node] : &sums[4 * node];
    std::copy_n(body >= 0 ? analysis.body_reaction[body].data() : held, 3, &values[3 * node]);
  }
}

}  // namespace balocco
