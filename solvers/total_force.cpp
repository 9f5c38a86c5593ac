#include "total_force.hpp"

#include <algorithm>
#include <vector>

namespace balocco {

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
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    const auto body = analysis.reference_of(node);
    const double* const held = analysis.current.dynamic ? &analysis.reaction[4 * node] : &sums[4 * node];
    std::copy_n(body >= 0 ? analysis.body_reaction[body].data() : held, 3, &values[3 * node]);
  }
}

}  // namespace balocco
