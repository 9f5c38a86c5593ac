// C3D8: the fully integrated brick, with the mean dilatation unless its section says otherwise.
#include "elements/solids/full_solid_explicit.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  if (input.model.sections.at(input.section).pointwise_dilatation)
    return std::make_unique<FullSolid<PlainHexahedronShape>>(input);
  return std::make_unique<FullSolid<HexahedronShape>>(input);
}

const RegisterElement registered({.name = "C3D8",
                                  .shape = Shape::hexahedron,
                                  .nodes = HexahedronShape::nodes,
                                  .integration_points = HexahedronShape::points,
                                  .section = Section::Kind::solid,
                                  .faces = hexahedron_faces(),
                                  .cycle_cost = 290,
                                  .make_group = make_group,
                                  .point_shapes = point_shapes<TrilinearValues>});

}  // namespace

}  // namespace balocco
