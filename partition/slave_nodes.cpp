#include "slave_nodes.hpp"

#include <algorithm>

#include "elements/element_type.hpp"

namespace balocco {

std::vector<std::int32_t> surface_rows(const Model& model, const Surface& surface) {
  std::vector<std::int32_t> rows = surface.nodes;
  for (const FaceRef& face : surface.faces) {
    const ElementTable& table = model.elements[face.element.table];
    const std::int32_t* corners = table.connectivity.data() + static_cast<std::size_t>(face.element.row) * table.type->nodes;
    for (int corner : table.type->faces[face.face]) rows.push_back(corners[corner]);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

std::vector<std::int32_t> local_slave_nodes(const Model& model, std::int32_t pair, const Domain& domain) {
  std::vector<std::int32_t> nodes;
  for (std::int32_t row : surface_rows(model, model.surfaces[model.contact_pairs[pair].slave])) {
    if (domain.local_node[row] >= 0) nodes.push_back(domain.local_node[row]);
  }
  return nodes;
}

}  // namespace balocco
