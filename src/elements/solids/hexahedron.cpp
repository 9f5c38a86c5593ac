#include "elements/solids/hexahedron.hpp"

#include <algorithm>
#include <cmath>

namespace balocco {

namespace {

using Vector = Vector3<double>;

/// Derivatives of h_1 .. h_7 with respect to xi, eta, zeta.
std::array<Vector, 7> derivatives(double x, double y, double z) {
  return {{{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{0, z, y}}, {{z, 0, x}}, {{y, x, 0}}, {{y * z, x * z, x * y}}}};
}

/// dX/dxi: column j is the derivative with respect to the j-th natural coordinate.
Matrix3<double> jacobian_matrix(const HexahedronCoefficients<double>& c, const std::array<Vector, 7>& dh) {
  Matrix3<double> j{};
  for (int k = 0; k < 7; ++k)
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) j(row, column) += c[k][row] * dh[k][column];
  return j;
}

}  // namespace

HexahedronGeometry::HexahedronGeometry(std::span<const Vector3<double>, 8> nodes) {
  std::array<Vector, 8> corner;
  std::copy(nodes.begin(), nodes.end(), corner.begin());
  coefficients = balocco::coefficients(corner);
  smallest_jacobian = 1e300;
  const double gauss = 1.0 / std::sqrt(3.0);  // 2 x 2 x 2 points integrate cof(dX/dxi) grad h exactly
  for (const auto& sign : hexahedron_signs) {
    const auto at_node = jacobian_matrix(coefficients, derivatives(sign[0], sign[1], sign[2]));
    smallest_jacobian = std::min(smallest_jacobian, determinant(at_node, cofactor(at_node)));
    const auto dh = derivatives(gauss * sign[0], gauss * sign[1], gauss * sign[2]);
    const auto j = jacobian_matrix(coefficients, dh);
    const auto c = cofactor(j);
    const double weight = determinant(j, c);
    smallest_jacobian = std::min(smallest_jacobian, weight);
    volume += weight;
    for (int k = 0; k < 7; ++k) mean_gradient[k] = mean_gradient[k] + c * dh[k];
  }
  for (auto& gradient : mean_gradient) gradient = (1.0 / volume) * gradient;
}

}  // namespace balocco
