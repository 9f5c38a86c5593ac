// C3D15: wedge of 15 nodes, in implicit steps only.
#include "elements/solids/full_solid_explicit.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  return std::make_unique<FullSolid<QuadraticWedgeShape>>(input);
}

const RegisterElement registered({.name = "C3D15",
                                  .shape = Shape::quadratic_wedge,
                                  .nodes = QuadraticWedgeShape::nodes,
                                  .integration_points = QuadraticWedgeShape::points,
                                  .section = Section::Kind::solid,
                                  .faces = wedge_faces(),
                                  .face_midsides = midsides(wedge_faces(), wedge_edges, 6),
                                  .implicit_only = true,
                                  .make_group = make_group,
                                  .shape_products = shape_products<QuadraticWedgeShape>,
                                  .point_shapes = point_shapes<QuadraticWedgeShape>});

}  // namespace

}  // namespace balocco
