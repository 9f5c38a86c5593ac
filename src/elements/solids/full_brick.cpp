// C3D8: the fully integrated brick.
#include "elements/solids/full_solid_explicit.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  return std::make_unique<FullSolid<HexahedronShape>>(input);
}

const RegisterElement registered({.name = "C3D8",
                                  .shape = Shape::hexahedron,
                                  .nodes = HexahedronShape::nodes,
                                  .integration_points = HexahedronShape::points,
                                  .section = Section::Kind::solid,
                                  .faces = hexahedron_faces(),
                                  .cycle_cost = 470,
                                  .make_group = make_group});

}  // namespace

}  // namespace balocco
