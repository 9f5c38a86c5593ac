// C3D4: the linear tetrahedron, of constant strain.
#include "elements/solids/full_solid_explicit.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  return std::make_unique<FullSolid<TetrahedronShape>>(input);
}

const RegisterElement registered({.name = "C3D4",
                                  .shape = Shape::tetrahedron,
                                  .nodes = TetrahedronShape::nodes,
                                  .integration_points = TetrahedronShape::points,
                                  .section = Section::Kind::solid,
                                  .faces = tetrahedron_faces(),
                                  .cycle_cost = 50,
                                  .make_group = make_group,
                                  .point_shapes = point_shapes<TetrahedronShape>});

}  // namespace

}  // namespace balocco
