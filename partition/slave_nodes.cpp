#include "slave_nodes.hpp"

#include "elements/surface_nodes.hpp"

namespace balocco {

std::vector<std::int32_t> local_slave_nodes(const Model& model, std::int32_t pair, const Domain& domain) {
  std::vector<std::int32_t> nodes;
  for (std::int32_t row : surface_nodes(model, model.surfaces[model.contact_pairs[pair].slave])) {
    if (domain.local_node[row] >= 0) nodes.push_back(domain.local_node[row]);
  }
  return nodes;
}

}  // namespace balocco
