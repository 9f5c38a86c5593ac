// C3D10: the quadratic tetrahedron.
#include "elements/solids/full_solid_explicit.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  return std::make_unique<FullSolid<QuadraticTetrahedronShape>>(input);
}

const RegisterElement registered({.name = "C3D10",
                                  .shape = Shape::quadratic_tetrahedron,
                                  .nodes = QuadraticTetrahedronShape::nodes,
                                  .integration_points = QuadraticTetrahedronShape::points,
                                  .section = Section::Kind::solid,
                                  .faces = tetrahedron_faces(),
                                  .face_midsides = midsides(tetrahedron_faces(), tetrahedron_edges, 4),
                                  .cycle_cost = 600,
                                  .make_group = make_group,
                                  .shape_products = shape_products<QuadraticTetrahedronShape>,
                                  .point_shapes = point_shapes<QuadraticTetrahedronShape>});

}  // namespace

}  // namespace balocco
