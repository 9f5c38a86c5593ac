#include "total_force.hpp"

#include <algorithm>
#include <vector>

#include "elements/element_type.hpp"

namespace balocco {

namespace {

/// By node of the model, whether it belongs to an element with forces: what holds another one has no forces of elements to be told by.
std::vector<bool> nodes_of_elements(const Model& model) {
  std::vector<bool> held(static_cast<std::size_t>(model.nodes.size()), false);
  for (const auto& table : model.elements)
    for (std::size_t i = 0; table.type->make_group != nullptr && i < table.connectivity.size(); ++i) held[table.connectivity[i]] = true;
  return held;
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
  domain.halo->begin_sum(sums.data());
  domain.halo->finish_sum(sums.data());
  const auto of_elements = nodes_of_elements(analysis.model);
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    const bool by_reaction = analysis.current.dynamic || !of_elements[domain.node_row[node]];
    const auto body = analysis.reference_of(node);
    const double* const held = by_reaction ? &analysis.reaction[4 * node] : &sums[4 * node];
    std::copy_n(body >= 0 ? analysis.body_reaction[body].data() : held, 3, &values[3 * node]);
  }
}

}  // namespace balocco
