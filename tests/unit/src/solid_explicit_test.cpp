// The explicit side of solids: order-free sums, portions, padding, dissipation, material directions, faces, masses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "elements/solids/solid_reference.hpp"
#include "solid_fixture.hpp"

namespace balocco::test {

namespace {

SolidOptions of_rubber(const std::string& type) {
  SolidOptions o;
  o.type = type;
  o.law = "neo-hooke";
  o.parameters = {0.5, 0.05};
  return o;
}

class ExplicitSolid : public ::testing::TestWithParam<std::string> {};

/// Incompatible modes are a few cycles behind nodes that have moved.
void settle(SolidCase& c) {
  for (int cycle = 0; cycle < 300; ++cycle) c.explicit_cycle();
}

/// Elements in any order, split between interface and interior in any way, give the same nodal forces bit for bit.
TEST_P(ExplicitSolid, SumsAreFreeOfOrder) {
  const double constant = rounding_constant(1e4);
  Block block;
  block.cells = {4, 3, 3};
  block.skew = 0.2;
  SolidCase c = make_block(of_rubber(GetParam()), block);
  shake(c, 0.05);
  c.explicit_cycle(0.0, 0.06, 1.2, constant);
  const int count = c.group->size(), nodes = c.group->nodes_per_element();
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  std::vector<std::int32_t> connectivity;
  for (const int e : order)
    for (int i = 0; i < nodes; ++i) connectivity.push_back(c.group->nodes(e)[i]);
  SolidCase shuffled = make_case(of_rubber(GetParam()), c.model.nodes.coordinates, connectivity, 11);
  shuffled.position = c.position;
  shuffled.explicit_cycle(0.0, 0.06, 1.2, constant);
  const std::size_t bytes = sizeof(double) * 4 * c.nodes();  // without the scratch node
  EXPECT_EQ(std::memcmp(c.force.data(), shuffled.force.data(), bytes), 0);
  for (int i = 0; i < c.nodes(); ++i) EXPECT_EQ(c.force[4 * i + 3], constant);
}

/// The rounded sums are the assembled forces of the scalar kernel to the quantum.
TEST_P(ExplicitSolid, ForcesAreTheAssembledOnes) {
  Block block;
  block.cells = {3, 2, 2};
  SolidCase c = make_block(of_rubber(GetParam()), block);
  shake(c, 0.05);
  settle(c);
  c.explicit_cycle(0.0, 0.0, 0.0, rounding_constant(10.0));
  Eigen::VectorXd f;
  Eigen::MatrixXd k;
  c.assemble(f, k);
  for (int i = 0; i < c.dofs(); ++i) EXPECT_NEAR(c.force[4 * (i / 3) + i % 3], -f(i), 1e-13);
}

/// Bulk viscosity and Rayleigh damping take from the motion what they report as dissipated: power = - viscous force .
/// velocity.
TEST_P(ExplicitSolid, DissipationIsTheWorkOfTheViscousForces) {
  const double increment = 1e-4;
  SolidOptions o = of_rubber(GetParam());
  for (const double beta : {0.0, 0.03}) {
    o.damping_beta = beta;
    SolidCase c = make_block(o, {{2, 2, 2}, {1, 1, 1}, 0.1});
    shake(c, 0.03);
    settle(c);  // remembers the volume
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < c.dofs(); ++i) {
      c.velocity[4 * (i / 3) + i % 3] = uniform(random);
      c.position[4 * (i / 3) + i % 3] += increment * c.velocity[4 * (i / 3) + i % 3];
    }
    const bool bulk = beta == 0.0;
    c.explicit_cycle(increment, bulk ? 0.06 : 0.0, bulk ? 1.2 : 0.0);
    Eigen::VectorXd f;
    Eigen::MatrixXd k;
    c.assemble(f, k);
    double work = 0.0, dissipated = 0.0;
    for (int i = 0; i < c.dofs(); ++i)
      work -= (c.force[4 * (i / 3) + i % 3] + f(i)) * c.velocity[4 * (i / 3) + i % 3] * increment;
    for (int e = 0; e < c.group->size(); ++e)
      dissipated += c.group->energies(e, {c.position.data()}, c.element_history(e)).viscous;
    if (bulk) work *= 0.5;  // the trapezoid, from no viscous stress at the start
    EXPECT_GT(work, 0.0);
    // Incompatible modes take part in the change of volume, but not in this sum of works.
    EXPECT_NEAR(dissipated, work, (GetParam() == "C3D8I" ? 0.03 : 2e-4) * work)
        << "beta = " << beta;  // rate from the volumes at both ends: error of order dt |grad v|
  }
}

TEST_P(ExplicitSolid, RigidRotationDissipatesNothing) {
  SolidOptions o = of_rubber(GetParam());
  o.damping_beta = 0.03;
  SolidCase c = make_block(o, {});
  c.explicit_cycle();
  const Eigen::Vector3d spin(1.0, -2.0, 0.5);
  c.move(affine(rotation(0.7, spin)));
  for (int i = 0; i < c.nodes(); ++i) {
    const Eigen::Vector3d v = spin.cross(Eigen::Map<Eigen::Vector3d>(&c.position[4 * i]));
    std::copy(v.data(), v.data() + 3, &c.velocity[4 * i]);
  }
  c.explicit_cycle(1e-3, 0.06, 1.2);
  EXPECT_NEAR(c.group->energies(0, {c.position.data()}, c.element_history(0)).viscous, 0.0, 1e-15);
  for (int i = 0; i < c.dofs(); ++i) EXPECT_NEAR(c.force[4 * (i / 3) + i % 3], 0.0, 1e-13);
}

TEST_P(ExplicitSolid, MassIsDensityTimesVolume) {
  SolidOptions o = of_rubber(GetParam());
  o.density = 3.0;
  SolidCase c = make_block(o, {{2, 3, 1}, {2, 3, 0.5}, 0.2});
  double total = 0.0;
  std::vector<double> mass(c.group->nodes_per_element());
  for (int e = 0; e < c.group->size(); ++e) {
    c.group->lumped_mass(e, mass);
    total = std::accumulate(mass.begin(), mass.end(), total);
  }
  EXPECT_NEAR(total, 9.0, 1e-13);
}

/// Faces: the area vector of each, nodes in the stored order, points away from the element's centre.
TEST_P(ExplicitSolid, FacesLookOutwards) {
  const ElementType* type = find_element_type(GetParam());
  SolidCase c = make_block(of_rubber(GetParam()), {});
  ASSERT_EQ(type->faces.size(), type->nodes == 8 ? 6u : type->shape == Shape::wedge ? 5u : 4u);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), sum = Eigen::Vector3d::Zero();
  const auto at = [&](int local) {
    return Eigen::Map<const Eigen::Vector3d>(c.model.nodes.coordinates[c.group->nodes(0)[local]].data());
  };
  for (int i = 0; i < type->nodes; ++i) centre += at(i) / type->nodes;
  for (const auto& face : type->faces) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < face.size(); ++i) {
      area += 0.5 * at(face[i]).cross(at(face[(i + 1) % face.size()]));
      middle += at(face[i]) / static_cast<double>(face.size());
    }
    EXPECT_GT(area.dot(middle - centre), 0.0);
    sum += area;
  }
  EXPECT_LT(sum.norm(), 1e-14);
}

TEST_P(ExplicitSolid, CarriesFewBytes) {
  SolidCase c = make_block(of_rubber(GetParam()), {});
  if (GetParam() == "C3D8R") {
    EXPECT_LT(c.group->bytes_per_element(), 600u);
  }
  EXPECT_GT(c.group->bytes_per_element(), 100u);
}

INSTANTIATE_TEST_SUITE_P(All, ExplicitSolid, ::testing::Values("C3D8R", "C3D8", "C3D6", "C3D4", "C3D10", "C3D8I"));

/// A cylindrical orientation: direction 1 is radial. Radial stretch of an element at 90 degrees meets E1, not E2.
TEST(SolidOrientation, MaterialDirectionsFollowTheOrientation) {
  Model model;
  Orientation orientation;
  orientation.system = Orientation::System::cylindrical;
  model.orientations.push_back(orientation);
  Section section;
  section.orientation = 0;
  const Matrix3<double> q = material_directions(model, section, {0.0, 2.0, 5.0});
  EXPECT_NEAR(q(1, 0), 1.0, 1e-15);   // column 1: radial = global y
  EXPECT_NEAR(q(0, 1), -1.0, 1e-15);  // column 2: tangential = -x
  EXPECT_NEAR(q(2, 2), 1.0, 1e-15);
  model.orientations[0].rotation_axis = 2;
  model.orientations[0].additional_rotation = std::acos(0.0);
  const Matrix3<double> turned = material_directions(model, section, {0.0, 2.0, 5.0});
  EXPECT_NEAR(turned(0, 0), -1.0, 1e-15);  // a quarter turn about the axis: direction 1 becomes tangential
}

/// Uniaxial stress of a cube along global y whose direction 1 lies there: stiffness E1.
TEST(SolidOrientation, StiffnessTurnsWithIt) {
  SolidOptions o;
  o.law = "engineering-constants";
  o.parameters = {100.0, 20.0, 10.0, 0.3, 0.25, 0.4, 8.0, 7.0, 5.0};
  SolidCase plain = make_block(o, {});
  Model model = plain.model;
  Orientation orientation;
  orientation.axes = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
  model.orientations.push_back(orientation);
  model.sections[0].orientation = 0;
  const GroupInput input{model, 0, 0, {0}, 0, model.elements[0].connectivity, 8};
  const auto group = model.elements[0].type->make_group(input);
  const double strain = 1e-6;  // in global y and its lateral contractions
  std::vector<double> position = plain.position, stress(6), history(group->history_size(), 1.0);
  const double contraction_x = -0.3 * strain, contraction_z = -0.25 * strain;
  for (int i = 0; i < 8; ++i) {
    position[4 * i] *= 1.0 + contraction_x;
    position[4 * i + 1] *= 1.0 + strain;
    position[4 * i + 2] *= 1.0 + contraction_z;
  }
  group->output("S", 0, 0, {position.data()}, history, stress);
  EXPECT_NEAR(stress[1], 100.0 * strain, 1e-5 * 100.0 * strain);
  EXPECT_NEAR(stress[0], 0.0, 1e-5 * 100.0 * strain);
  EXPECT_NEAR(stress[2], 0.0, 1e-5 * 100.0 * strain);
}

/// LE of a rotated uniaxial stretch, spatial directions; MISES and PRESS of the same stress.
TEST(SolidOutput, TensorsAndInvariants) {
  SolidCase c = make_block(of_rubber("C3D8R"), {});
  const Eigen::Matrix3d q = rotation(0.4, {0, 0, 1}), stretch = Eigen::Vector3d(1.5, 0.9, 0.8).asDiagonal();
  c.move(affine(q * stretch));
  const Eigen::Matrix3d expected =
      q * Eigen::Vector3d(std::log(1.5), std::log(0.9), std::log(0.8)).asDiagonal() * q.transpose();
  std::vector<double> le(6), s(6), mises(1), press(1), sener(1);
  c.group->output("LE", 0, 0, {c.position.data()}, c.element_history(0), le);
  const double components[6] = {expected(0, 0),     expected(1, 1),     expected(2, 2),
                                2 * expected(0, 1), 2 * expected(0, 2), 2 * expected(1, 2)};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(le[i], components[i], 1e-14);
  c.group->output("S", 0, 0, {c.position.data()}, c.element_history(0), s);
  c.group->output("MISES", 0, 0, {c.position.data()}, c.element_history(0), mises);
  c.group->output("PRESS", 0, 0, {c.position.data()}, c.element_history(0), press);
  c.group->output("SENER", 0, 0, {c.position.data()}, c.element_history(0), sener);
  EXPECT_NEAR(press[0], -(s[0] + s[1] + s[2]) / 3.0, 1e-13);
  const double by_hand =
      std::sqrt(0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)) +
                3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
  EXPECT_NEAR(mises[0], by_hand, 1e-12);
  EXPECT_NEAR(sener[0], c.group->energies(0, {c.position.data()}, c.element_history(0)).strain, 1e-13);
  EXPECT_EQ(c.group->output_components("PEEQ"), 0);
}

}  // namespace

}  // namespace balocco::test
