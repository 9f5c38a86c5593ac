// R3D3 and R3D4: facets of a rigid body. They have no forces, hence no kernel, and no mass; contact masters are made of them.
#include "elements/element_type.hpp"

namespace balocco {

namespace {

ElementType facet_type(const char* name, Shape shape, std::vector<int> nodes) {
  ElementType type;
  type.name = name;
  type.shape = shape;
  type.nodes = static_cast<int>(nodes.size());
  type.integration_points = 0;
  type.section = Section::Kind::rigid;
  type.faces = {nodes, {nodes.rbegin(), nodes.rend()}};
  return type;
}

const RegisterElement r3d3(facet_type("R3D3", Shape::triangle, {0, 1, 2}));
const RegisterElement r3d4(facet_type("R3D4", Shape::quadrilateral, {0, 1, 2, 3}));

}  // namespace

}  // namespace balocco
