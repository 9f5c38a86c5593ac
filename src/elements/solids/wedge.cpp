// C3D6: the linear wedge.
#include "elements/solids/full_solid_explicit.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  return std::make_unique<FullSolid<WedgeShape>>(input);
}

const RegisterElement registered({.name = "C3D6",
                                  .shape = Shape::wedge,
                                  .nodes = WedgeShape::nodes,
                                  .integration_points = WedgeShape::points,
                                  .section = Section::Kind::solid,
                                  .faces = wedge_faces(),
                                  .cycle_cost = 190,
                                  .make_group = make_group,
                                  .point_shapes = point_shapes<WedgeValues>});

}  // namespace

}  // namespace balocco
