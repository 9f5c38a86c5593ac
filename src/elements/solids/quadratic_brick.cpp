// C3D20 and C3D20R: the serendipity bricks of 20 nodes, of implicit steps.
#include "elements/solids/full_solid_explicit.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

template <int n>
std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  return std::make_unique<FullSolid<SerendipityShape<n>>>(input);
}

template <int n>
ElementType brick(const char* name) {
  return {.name = name,
          .shape = Shape::quadratic_hexahedron,
          .nodes = 20,
          .integration_points = n * n * n,
          .section = Section::Kind::solid,
          .faces = hexahedron_faces(),
          .face_midsides = midsides(hexahedron_faces(), hexahedron_edges, 8),
          .implicit_only = true,
          .make_group = make_group<n>,
          .shape_products = shape_products<SerendipityShape<n>>,
          .point_shapes = point_shapes<SerendipityShape<n>>};
}

const RegisterElement full(brick<3>("C3D20")), reduced(brick<2>("C3D20R"));

}  // namespace

}  // namespace balocco
