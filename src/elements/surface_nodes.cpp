#include "elements/surface_nodes.hpp"

#include <algorithm>

#include "elements/element_type.hpp"

namespace balocco {

std::vector<std::int32_t> face_nodes(const Model& model, const FaceRef& face) {
  const ElementTable& table = model.elements[face.element.table];
  const std::int32_t* const of_element = table.connectivity.data() + static_cast<std::size_t>(face.element.row) * table.type->nodes;
  std::vector<std::int32_t> nodes;
  for (const int local : nodes_of_face(*table.type, face.face)) nodes.push_back(of_element[local]);
  return nodes;
}

std::vector<std::int32_t> surface_nodes(const Model& model, const Surface& surface) {
  std::vector<std::int32_t> nodes = surface.nodes;
  for (const FaceRef& face : surface.faces)
    for (const auto node : face_nodes(model, face)) nodes.push_back(node);
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace balocco
