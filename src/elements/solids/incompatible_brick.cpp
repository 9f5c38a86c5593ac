// C3D8I: the brick with incompatible modes, which bends without locking.
#include "elements/solids/full_solid_explicit.hpp"
#include "elements/solids/full_solid_static.hpp"
#include "elements/solids/full_solid_bubbles.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  return std::make_unique<FullSolid<IncompatibleBrickShape>>(input);
}

const RegisterElement registered({.name = "C3D8I",
                                  .shape = Shape::hexahedron,
                                  .nodes = IncompatibleBrickShape::nodes,
                                  .integration_points = IncompatibleBrickShape::points,
                                  .section = Section::Kind::solid,
                                  .faces = hexahedron_faces(),
                                  .cycle_cost = 1300,
                                  .make_group = make_group,
                                  .point_shapes = point_shapes<TrilinearValues>});

}  // namespace

}  // namespace balocco
