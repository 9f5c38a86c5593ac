#include "master_surface.hpp"

#include <map>

#include "elements/element_type.hpp"

namespace balocco {

namespace {

RigidMesh mesh_of(const Model& model, const Surface& surface, const Point& reference) {
  std::vector<Vector3<double>> vertices;
  std::vector<std::vector<std::int32_t>> facets;
  std::map<std::int32_t, std::int32_t> vertex_of_row;
  for (const auto& [element, face] : surface.faces) {
    const ElementTable& table = model.elements[element.table];
    auto& facet = facets.emplace_back();
    for (const int corner : table.type->faces[face]) {
      const std::int32_t row = table.connectivity[element.row * table.type->nodes + corner];
      const auto [place, fresh] = vertex_of_row.try_emplace(row, static_cast<std::int32_t>(vertices.size()));
      if (fresh) vertices.push_back(Vector3<double>{model.nodes.coordinates[row]} - Vector3<double>{reference});
      facet.push_back(place->second);
    }
  }
  return RigidMesh(std::move(vertices), facets);
}

}  // namespace

MasterSurface::MasterSurface(const Model& model, const Surface& surface, const Point& reference) {
  if (surface.analytical) {
    shape_ = RigidSurface(*surface.analytical, reference);
  } else {
    shape_ = mesh_of(model, surface, reference);
  }
}

}  // namespace balocco
