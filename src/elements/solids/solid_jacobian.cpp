#include "elements/solids/solid_jacobian.hpp"

#include "elements/solids/nodal_shapes.hpp"

namespace balocco {

namespace {

template <class Geometry>
SmallestJacobian smallest(std::span<const Point> nodes) {
  std::array<Vector3<double>, Geometry::nodes> x;
  for (int node = 0; node < Geometry::nodes; ++node) {
    for (int i = 0; i < 3; ++i) x[node][i] = nodes[node][i] - nodes[0][i];
  }
  const auto coefficients = Geometry::coefficients(x);
  static constexpr auto quadrature = Geometry::quadrature();
  SmallestJacobian result;
  for (int point = 0; point < Geometry::points; ++point) {
    Matrix3<double> jacobian{};
    for (int mode = 0; mode < Geometry::modes; ++mode) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) jacobian(i, j) += coefficients[mode][i] * quadrature[point].derivative[mode][j];
      }
    }
    const double value = determinant(jacobian, cofactor(jacobian));
    if (point == 0 || value < result.determinant) result = {value, point};
  }
  return result;
}

}  // namespace

SmallestJacobian smallest_jacobian(Shape shape, std::span<const Point> nodes) {
  switch (shape) {
    case Shape::tetrahedron:
      return smallest<TetrahedronShape>(nodes);
    case Shape::wedge:
      return smallest<WedgeShape>(nodes);
    case Shape::quadratic_tetrahedron:
      return smallest<QuadraticTetrahedronShape>(nodes);
    case Shape::quadratic_wedge:
      return smallest<QuadraticWedgeShape>(nodes);
    case Shape::quadratic_hexahedron:
      return smallest<SerendipityShape<3>>(nodes);
    default:
      return smallest<HexahedronShape>(nodes);
  }
}

}  // namespace balocco
