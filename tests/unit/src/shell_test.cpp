// Shells: rigid motions, modes without energy, the gradient of the energy, patch tests, SIMD against scalars, stable
// increments.
#include <gtest/gtest.h>

#include <cmath>

#include "elements/shells/shell_kernel.hpp"
#include "elements/shells/shell_normals.hpp"
#include "elements/shells/shell_reference.hpp"
#include "shell_fixture.hpp"
#include "symmetric_eigenvalues.hpp"

namespace balocco::test {

namespace {

const std::vector<std::string> shell_types{"S4", "S4R", "S3R"};

/// A rigid motion: every node moves with x -> R x + t and turns by R.
void move_rigidly(Shell& shell, const Vector3<double>& spin, const Vector3<double>& shift) {
  const Quaternion<double> q = exponential(spin);
  const Matrix3<double> r = rotation_matrix(q);
  for (std::int32_t n = 0; n < shell.model.nodes.size(); ++n) {
    const Vector3<double> x{{shell.position[4 * n], shell.position[4 * n + 1], shell.position[4 * n + 2]}};
    const Vector3<double> moved = r * x + shift;
    for (int c = 0; c < 3; ++c) shell.position[4 * n + c] = moved[c];
    const Quaternion<double> old{shell.orientation[4 * n], shell.orientation[4 * n + 1], shell.orientation[4 * n + 2],
                                 shell.orientation[4 * n + 3]};
    std::ranges::copy(product(q, old), shell.orientation.begin() + 4 * n);
  }
}

TEST(Shell, RigidMotionStrainsNothing) {
  for (const auto& type : shell_types) {
    Shell shell = crooked(type);
    shell.build();
    move_rigidly(shell, {{1.3, -0.7, 2.1}}, {{3.0, -5.0, 7.0}});
    EXPECT_LT(shell.forces().lpNorm<Eigen::Infinity>(), 1e-13 * 100.0) << type;
    EXPECT_LT(shell.energy(), 1e-25) << type;
    EXPECT_LT(shell.explicit_forces().lpNorm<Eigen::Infinity>(), 1e-9) << type;  // the quantum of the sums
  }
}

TEST(Shell, HasExactlySixModesWithoutEnergy) {
  for (const auto& type : shell_types) {
    Shell shell = crooked(type);
    shell.build();
    Eigen::MatrixXd stiffness;
    shell.forces(&stiffness);
    EXPECT_LT((stiffness - stiffness.transpose()).norm(), 1e-12 * stiffness.norm()) << type;
    const Eigen::VectorXd value = symmetric_eigenvalues(stiffness);
    EXPECT_LT(std::abs(value[5]), 1e-12 * value.maxCoeff()) << type;
    EXPECT_GT(value[6], 1e-7 * value.maxCoeff()) << type;
  }
}

TEST(Shell, ForceIsTheGradientOfTheEnergy) {
  for (const auto& type : shell_types)
    for (const bool stack : {false, true}) {
      Shell shell = crooked(type);
      shell.model.sections[0].shell.offset = 0.3;
      if (stack) shell.model.sections[0].plies = {{0.03, 0, 0.4, 3}, {0.05, 0, -0.9, 5}};
      if (stack)
        shell.model.materials[0].law = "lamina",
        shell.model.materials[0].parameters = {100.0, 10.0, 0.3, 4.0, 3.0, 2.0};
      if (stack) shell.model.sections[0].thickness = 0.08;
      shell.build();
      shell.move(scatter(shell.freedoms(), 0.1));
      const Eigen::VectorXd force = shell.forces();
      const auto position = shell.position, orientation = shell.orientation;
      const auto energy_at = [&](const Eigen::VectorXd& step) {
        shell.position = position;
        shell.orientation = orientation;
        shell.move(step);
        return shell.energy();
      };
      const Eigen::VectorXd direction = scatter(shell.freedoms(), 1.0, 7);
      double error[2];
      for (int i = 0; i < 2; ++i) {
        const double size = i == 0 ? 2e-3 : 1e-3;
        error[i] = std::abs((energy_at(size * direction) - energy_at(-size * direction)) / (2.0 * size) -
                            force.dot(direction));
      }
      EXPECT_LT(error[1], 1e-3 * std::abs(force.dot(direction))) << type;
      EXPECT_NEAR(error[0] / error[1], 4.0, 0.2) << type;  // central differences are of second order
    }
}

TEST(Shell, TangentIsTheDerivativeOfTheForce) {
  for (const auto& type : shell_types) {
    Shell shell = crooked(type);
    shell.model.materials[0].law = "neo-hooke";
    shell.model.materials[0].parameters = {20.0, 0.01};
    shell.build();
    shell.move(scatter(shell.freedoms(), 0.1));
    Eigen::MatrixXd stiffness;
    shell.forces(&stiffness);
    const auto position = shell.position, orientation = shell.orientation;
    const Eigen::VectorXd direction = scatter(shell.freedoms(), 1.0, 7);
    const auto force_at = [&](double size) {
      shell.position = position;
      shell.orientation = orientation;
      shell.move(size * direction);
      return shell.forces();
    };
    double error[2];
    for (int i = 0; i < 2; ++i) {
      const double size = i == 0 ? 2e-3 : 1e-3;
      error[i] = ((force_at(size) - force_at(-size)) / (2.0 * size) - stiffness * direction).norm();
    }
    EXPECT_LT(error[1], 1e-3 * (stiffness * direction).norm()) << type;
    EXPECT_NEAR(error[0] / error[1], 4.0, 0.2) << type;
  }
}

/// MacNeal & Harder's patch: a crooked inner quadrilateral in a rectangle; triangles split each element in two.
Shell patch(const std::string& type) {
  const std::vector<Point> nodes{{0, 0, 0},       {0.24, 0, 0},    {0.24, 0.12, 0}, {0, 0.12, 0},
                                 {0.04, 0.02, 0}, {0.18, 0.03, 0}, {0.16, 0.08, 0}, {0.08, 0.08, 0}};
  const std::vector<std::array<int, 4>> quadrilaterals{
      {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
  std::vector<std::int32_t> connectivity;
  for (const auto& q : quadrilaterals) {
    if (type == "S3R")
      connectivity.insert(connectivity.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    else
      connectivity.insert(connectivity.end(), q.begin(), q.end());
  }
  Shell shell(type, nodes, connectivity);
  shell.model.sections[0].thickness = 0.001;
  shell.model.materials[0].parameters = {1e6, 0.25};
  shell.build();
  return shell;
}

/// Prescribes a linear field on the outer nodes, solves for the inner ones, and returns the greatest difference to the
/// field there.
double patch_error(Shell& shell, const Eigen::VectorXd& field, bool hold_inner_rotation_about_normal = false) {
  Eigen::MatrixXd stiffness;
  shell.forces(&stiffness);
  std::vector<int> inner, outer;
  for (int i = 0; i < shell.freedoms(); ++i)
    (i / 6 >= 4 && !(hold_inner_rotation_about_normal && i % 6 == 5) ? inner : outer).push_back(i);
  const Eigen::VectorXd load = -stiffness(inner, outer) * field(outer);
  const Eigen::VectorXd solution = stiffness(inner, inner).ldlt().solve(load);
  return (solution - field(inner)).lpNorm<Eigen::Infinity>() / field.lpNorm<Eigen::Infinity>();
}

TEST(Shell, PassesThePatchTests) {
  for (const auto& type : shell_types) {
    Shell shell = patch(type);
    Eigen::VectorXd membrane = Eigen::VectorXd::Zero(shell.freedoms()), bending = membrane, shear = membrane;
    for (std::int32_t n = 0; n < shell.model.nodes.size(); ++n) {
      const auto [x, y, z] = shell.model.nodes.coordinates[n];
      membrane.segment<3>(6 * n) << 1e-3 * (x + 0.5 * y), 1e-3 * (y + 0.5 * x), 0.0;
      bending.segment<3>(6 * n) << 0.0, 0.0, 1e-3 * 0.5 * (x * x + x * y + y * y);
      bending.segment<3>(6 * n + 3) << 1e-3 * (0.5 * x + y), -1e-3 * (x + 0.5 * y), 0.0;
      shear.segment<3>(6 * n) << 0.0, 0.0, 1e-3 * (x + 2.0 * y);  // normals stay upright: uniform transverse shear
    }
    EXPECT_LT(patch_error(shell, membrane), 1e-10) << type;
    EXPECT_LT(patch_error(shell, bending), 1e-10) << type;
    if (type == "S3R") continue;  // each triangle has a flexibility of its own in transverse shear, lest it lock
    // Uniform transverse shear without bending is not in equilibrium with moments; hold the inner rotations.
    Eigen::MatrixXd stiffness;
    const Eigen::VectorXd nothing = shell.forces(&stiffness);
    const Eigen::VectorXd force = stiffness * shear;
    for (std::int32_t n = 4; n < 8; ++n) EXPECT_LT(force.segment<3>(6 * n).norm(), 1e-10 * force.norm()) << type;
  }
}

/// Rolled into an arc, nodes on it and directors along its radii, an element has the energy EI (turn / length)^2 / 2, not that of the
/// chord between the directors' tips, which a turn of 0.4 shortens by 0.7 %.
TEST(Shell, RolledElementBendsByItsTurn) {
  for (const auto& type : shell_types) {
    Shell shell(type, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                type == "S3R" ? std::vector<std::int32_t>{0, 1, 2, 0, 2, 3} : std::vector<std::int32_t>{0, 1, 2, 3});
    shell.model.materials[0].parameters[1] = 0.0;
    shell.build();
    const auto energy_of = [&](double turn) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(shell.freedoms());
      for (int node = 0; node < 4; ++node) step[6 * node + 4] = (node == 0 || node == 3 ? -0.5 : 0.5) * turn;
      shell.move(step);
      const double energy = shell.energy();
      shell.move(-step);
      return energy;
    };
    EXPECT_NEAR(energy_of(0.4) / energy_of(0.01), 1600.0, 1.0) << type;
  }
}

TEST(Shell, PackEqualsScalarBitForBit) {
  Shell shell = crooked("S4R");
  const ShellGeometry geometry = shell_geometry(shell.model, {0, 0}, shell.model.sections[0]);
  const ShellSection section = shell_section(shell.model, shell.model.sections[0]);
  using Record = ShellRecord<4, 1>;
  alignas(64) double record[Record::size * pack_size];
  const std::array<double, 4> thickness{0.1, 0.1, 0.1, 0.1};
  for (int lane = 0; lane < pack_size; ++lane)
    fill_shell_reference<4, 1>(geometry, section, thickness, {}, record + lane);

  ShellKernel<double, 4>::Edges edge;
  ShellKernel<Pack, 4>::Edges edges;
  std::array<Matrix3<double>, 4> rotation;
  std::array<Matrix3<Pack>, 4> rotations;
  const Eigen::VectorXd noise = scatter(48, 0.1);
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 3 && i > 0; ++c) edges[i - 1][c] = edge[i - 1][c] = geometry.edge[i][c] + noise[3 * i + c];
    rotation[i] = rotation_matrix(exponential({{noise[12 + i], noise[16 + i], noise[20 + i]}}));
    for (int k = 0; k < 9; ++k) rotations[i].component[k] = rotation[i].component[k];
  }
  ShellKernel<double, 4> scalar;
  ShellKernel<Pack, 4> pack;
  scalar.set(record, edge, rotation);
  pack.set(record, edges, rotations);
  const ShellModes<double, 4> strain = scalar.strains();
  const ShellModes<Pack, 4> strains = pack.strains();
  ShellModes<double, 4> stress = strain;
  ShellModes<Pack, 4> stresses = strains;
  scalar.add_elastic(strain, stress);
  pack.add_elastic(strains, stresses);
  ShellForces<double, 4> nodal;
  ShellForces<Pack, 4> nodals;
  scalar.add_forces(stress, nodal);
  pack.add_forces(stresses, nodals);
  for (int lane = 0; lane < pack_size; ++lane)
    for (int i = 0; i < 4; ++i)
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(nodal.moment[i][c], nodals.moment[i][c][lane]);
        if (i > 0) {
          EXPECT_EQ(nodal.force[i - 1][c], nodals.force[i - 1][c][lane]);
        }
      }
}

TEST(Shell, ExplicitForcesAreThoseOfStatics) {
  for (const auto& type : shell_types)
    for (const std::string law : {"elastic", "neo-hooke"}) {
      Shell shell = crooked(type);
      shell.model.materials[0].law = law;
      if (law == "neo-hooke") shell.model.materials[0].parameters = {20.0, 0.01};
      shell.build();
      shell.move(scatter(shell.freedoms(), 0.1));
      const Eigen::VectorXd statics = shell.forces();
      EXPECT_LT((shell.explicit_forces() + statics).lpNorm<Eigen::Infinity>(), 1e-9)
          << type;  // the quantum of the sums
    }
}

/// 2 / omega of the only element, free, with its lumped inertia, from its exact tangent.
double exact_increment(const Shell& shell) {
  Eigen::MatrixXd stiffness;
  shell.forces(&stiffness);
  const int nodes = shell.group->nodes_per_element();
  std::vector<double> mass(nodes), inertia(nodes);
  shell.group->lumped_mass(0, mass);
  shell.group->lumped_rotary_inertia(0, inertia);
  Eigen::VectorXd root(6 * nodes);
  for (int i = 0; i < 6 * nodes; ++i) root[i] = 1.0 / std::sqrt(i % 6 < 3 ? mass[i / 6] : inertia[i / 6]);
  const Eigen::MatrixXd scaled = root.asDiagonal() * (0.5 * (stiffness + stiffness.transpose())) * root.asDiagonal();
  return 2.0 / std::sqrt(symmetric_eigenvalues(scaled).maxCoeff());
}

TEST(Shell, StableIncrementIsExactAtRestAndSafeWhenDeformed) {
  for (const auto& type : shell_types)
    for (const double thickness : {0.001, 0.1, 1.0}) {
      Shell shell = crooked(type);
      shell.model.sections[0].thickness = thickness;
      shell.build();
      StableIncrement stable;
      shell.explicit_forces({}, &stable);
      EXPECT_NEAR(stable.increment, exact_increment(shell), 1e-9 * stable.increment) << type;
      for (unsigned seed = 1; seed < 20; ++seed) {
        shell.build();
        shell.move(scatter(shell.freedoms(), 0.15, seed));
        shell.explicit_forces({}, &stable);
        EXPECT_LT(stable.increment, 1.0001 * exact_increment(shell)) << type << " " << thickness;
      }
    }
}

TEST(Shell, OffsetAddsTheMomentOfTheMembraneForce) {
  Shell shell("S4R", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 3});
  shell.model.sections[0].shell.offset = 0.5;  // nodes on SPOS
  shell.model.materials[0].parameters = {100.0, 0.0};
  shell.build();
  Eigen::VectorXd stretch = Eigen::VectorXd::Zero(24);
  stretch[6] = stretch[12] = 1e-6;
  shell.move(stretch);
  const Eigen::VectorXd force = shell.forces();
  EXPECT_NEAR(force[6], 0.5 * 100.0 * 0.1 * 1e-6, 1e-11);
  EXPECT_NEAR(force[6 + 4], -0.05 * force[6], 1e-12);  // the force acts half a thickness below the node
}

TEST(Shell, NeighboursShareNormalsWithinTwentyDegrees) {
  for (const double degrees : {15.0, 25.0}) {
    const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
    Shell bent("S4R", {{-1, 0, 0}, {0, 0, 0}, {c, 0, s}, {-1, 1, 0}, {0, 1, 0}, {c, 1, s}}, {0, 1, 4, 3, 1, 2, 5, 4});
    EXPECT_TRUE(set_corner_normals(bent.model, {}).empty());
    const Point left = bent.model.elements[0].corner_normal[1], right = bent.model.elements[0].corner_normal[4];
    const double half = degrees < 20.0 ? 0.5 * degrees * M_PI / 180.0 : 0.0;
    EXPECT_NEAR(left[0], -std::sin(half), 1e-15);
    EXPECT_NEAR(right[0], degrees < 20.0 ? -std::sin(half) : -s, 1e-15);
  }
}

TEST(Shell, NormalsThatFlipAreFoundAndGivenNormalsRule) {
  Shell flat("S4R", {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 4, 3, 1, 4, 5, 2});
  GivenNormals given;
  given.at_node[1] = {0.6, 0.0, 0.8};
  given.at_corner[{{0, 0}, 1}] = {0.0, 0.6, 0.8};
  const auto opposed = set_corner_normals(flat.model, given);
  ASSERT_EQ(opposed.size(), 1u);
  EXPECT_EQ(opposed[0].second.row, 1);
  EXPECT_EQ(flat.model.elements[0].corner_normal[1][1], 0.6);
  EXPECT_EQ(flat.model.elements[0].corner_normal[4][0], 0.6);
}

TEST(Shell, SectionRulesIntegrateExactly) {
  for (const int points : {3, 5, 7, 9}) {
    double weight = 0.0, second = 0.0;
    for (const auto& point : thickness_rule(points, false))
      weight += point.weight, second += point.weight * point.position * point.position;
    EXPECT_NEAR(weight, 1.0, 1e-15);
    EXPECT_NEAR(second, 1.0 / 12.0, 1e-15);
  }
  double fourth = 0.0;
  for (const auto& point : thickness_rule(3, true)) fourth += point.weight * std::pow(point.position, 4);
  EXPECT_NEAR(fourth, 1.0 / 80.0, 1e-16);
}

TEST(Shell, ShearStiffnessIsFiveSixthsOfAHomogeneousPlate) {
  Shell shell = crooked("S4");
  const ShellSection whole = shell_section(shell.model, shell.model.sections[0]);
  EXPECT_NEAR(whole.shear[0], 5.0 / 6.0 * 100.0 / 2.6, 1e-12);
  shell.model.sections[0].plies = {{0.02, 0, 0.0, 3}, {0.05, 0, 0.5, 3}, {0.03, 0, 1.0, 3}};
  const ShellSection plies = shell_section(shell.model, shell.model.sections[0]);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(plies.shear[i], whole.shear[i], 1e-12);
}

}  // namespace

}  // namespace balocco::test
