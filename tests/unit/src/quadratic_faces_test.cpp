// Pressure on faces of quadratic elements: consistent forces, closed surfaces, the exact tangent; integrals of N_I N_J.
#include <gtest/gtest.h>

#include <numeric>

#include "loads/pressure_faces.hpp"
#include "solid_fixture.hpp"

namespace balocco::test {

namespace {

/// A surface of all faces of the elements that lie on the skin of the unit block.
PressureFaces skin(const SolidCase& c, const std::function<bool(const Point&)>& on) {
  Surface surface;
  const ElementTable& table = c.model.elements[0];
  for (std::int32_t row = 0; row < table.size(); ++row)
    for (std::size_t face = 0; face < table.type->faces.size(); ++face) {
      bool all = true;
      for (const int local : table.type->faces[face])
        all = all && on(c.model.nodes.coordinates[table.connectivity[row * table.type->nodes + local]]);
      if (all) surface.faces.push_back({{0, row}, static_cast<std::int32_t>(face)});
    }
  std::vector<std::int32_t> local(c.model.nodes.coordinates.size());
  std::iota(local.begin(), local.end(), 0);
  return {c.model, surface, local, {std::vector<bool>(table.id.size(), true)}, static_cast<std::int32_t>(local.size())};
}

SolidCase block(const std::string& type, int cells) {
  SolidOptions options;
  options.type = type;
  return make_block(options, {{cells, cells, cells}});
}

std::vector<double> forces(const PressureFaces& faces, const SolidCase& c) {
  std::vector<double> force(c.position.size(), 0.0);
  for (std::size_t i = 3; i < force.size(); i += 4) force[i] = rounding_constant(1e3);
  faces.add_forces(6.0, c.position.data(), force.data());
  return force;
}

class QuadraticFaces : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, QuadraticFaces, ::testing::Values("C3D10", "C3D15", "C3D20", "C3D20R"));

/// Of a unit pressure on a flat face: -1/12 of it at corners and 1/3 at the middles of eight nodes, 0 and 1/3 of six.
TEST_P(QuadraticFaces, FlatFacesHaveConsistentForces) {
  SolidCase c = block(GetParam(), 1);
  const bool triangles = GetParam() == "C3D10" || GetParam() == "C3D15";
  const auto faces = skin(c, [](const Point& x) { return x[2] < 1e-9; });
  ASSERT_EQ(faces.size(), triangles ? 2 : 1);
  const auto force = forces(faces, c);
  double sum = 0.0;
  for (int node = 0; node < c.nodes(); ++node) {
    const Point& x = c.model.nodes.coordinates[node];
    if (x[2] > 1e-9) continue;
    sum += force[4 * node + 2];
    const int middles = (x[0] == 0.5) + (x[1] == 0.5);
    const double expected = triangles ? (middles == 0 ? 0.0 : middles == 1 ? 1.0 : 2.0) : middles == 0 ? -0.5 : 2.0;
    EXPECT_NEAR(force[4 * node + 2], expected, 1e-11) << x[0] << " " << x[1];
  }
  EXPECT_NEAR(sum, 6.0, 1e-11);
}

/// Nothing pushes a closed surface, however its faces are curved; the work for a growing body is -p dV.
TEST_P(QuadraticFaces, ClosedSurfacesAreInBalance) {
  SolidCase c = block(GetParam(), 2);
  const auto faces = skin(c, [](const Point& x) {
    return std::abs(x[0] - 0.5) > 0.49 || std::abs(x[1] - 0.5) > 0.49 || std::abs(x[2] - 0.5) > 0.49;
  });
  const auto flat = forces(faces, c);
  double work = 0.0;
  for (int node = 0; node < c.nodes(); ++node)
    for (int d = 0; d < 3; ++d) work += flat[4 * node + d] * c.position[4 * node + d];
  EXPECT_NEAR(work, -6.0 * 3.0, 1e-10);
  shake(c, 0.05);
  const auto force = forces(faces, c);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int node = 0; node < c.nodes(); ++node) sum += Eigen::Map<const Eigen::Vector3d>(&force[4 * node]);
  EXPECT_LT(sum.norm(), 1e-9);
  EXPECT_GT(std::abs(force[0]) + std::abs(force[1]), 1e-4);
}

TEST_P(QuadraticFaces, TangentIsTheDerivativeOfTheForce) {
  SolidCase c = block(GetParam(), 1);
  shake(c, 0.1);
  const auto faces = skin(c, [](const Point& x) { return x[0] > 1.0 - 1e-9; });
  const auto node = faces.nodes(0);
  const int dofs = 3 * static_cast<int>(node.size());
  std::vector<double> force(dofs), up(dofs), down(dofs), stiffness(dofs * dofs), unused(dofs * dofs);
  faces.linearize(0, 5.0, c.position.data(), force, stiffness);
  const double step = 1e-4;  // the force is quadratic in each coordinate: central differences are exact
  for (int j = 0; j < dofs; ++j) {
    double& x = c.position[4 * node[j / 3] + j % 3];
    const double at = x;
    x = at + step;
    faces.linearize(0, 5.0, c.position.data(), up, unused);
    x = at - step;
    faces.linearize(0, 5.0, c.position.data(), down, unused);
    x = at;
    for (int i = 0; i < dofs; ++i) EXPECT_NEAR((up[i] - down[i]) / (2.0 * step), stiffness[dofs * i + j], 1e-9);
  }
}

/// Consistent masses add up to the volume, turn a linear field into its second moment, and their diagonal gives the lumped ones.
TEST_P(QuadraticFaces, ShapeProductsAreExact) {
  SolidCase c = block(GetParam(), 1);
  const ElementType& type = *c.model.elements[0].type;
  double volume = 0.0, moment = 0.0;
  for (int element = 0; element < c.group->size(); ++element) {
    std::vector<Point> nodes;
    for (const auto node : c.group->nodes(element)) nodes.push_back(c.model.nodes.coordinates[node]);
    std::vector<double> products(type.nodes * type.nodes), lumped(type.nodes);
    type.shape_products(nodes, products);
    c.group->lumped_volume(element, lumped);
    double trace = 0.0;
    for (int i = 0; i < type.nodes; ++i) trace += products[type.nodes * i + i];
    const double whole = std::accumulate(lumped.begin(), lumped.end(), 0.0);
    for (int i = 0; i < type.nodes; ++i) {
      EXPECT_NEAR(lumped[i], whole * products[type.nodes * i + i] / trace, 1e-14);
      for (int j = 0; j < type.nodes; ++j) {
        volume += products[type.nodes * i + j];
        moment += products[type.nodes * i + j] * nodes[i][0] * nodes[j][0];
      }
    }
  }
  EXPECT_NEAR(volume, 1.0, 1e-13);
  EXPECT_NEAR(moment, 1.0 / 3.0, 1e-13);
}

}  // namespace

}  // namespace balocco::test
