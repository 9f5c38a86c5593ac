// Solids of metal: hourglass stresses that flow with the centre of C3D8R, and stable increments of what has flowed far.
#include <gtest/gtest.h>


#include "solid_fixture.hpp"

namespace balocco::test {

namespace {

constexpr double young = 200.0, poisson = 0.3, yield = 0.4, shear = young / 2.6;

SolidOptions metal(const std::string& type, double scale = 1.0) {
  SolidOptions o;
  o.type = type;
  o.parameters = {young, poisson};
  o.material_options = {{"plastic", {0.0}, {{yield, 0.0}, {yield + 0.2, 1.0}}}};
  o.density = 2.0;
  o.hourglass_scale = scale;
  return o;
}

/// Positions `from` + `share` of the way to `to`.
void place(SolidCase& c, const std::vector<double>& from, const std::vector<double>& to, double share) {
  for (std::size_t i = 0; i < from.size(); ++i)
    if (i % 4 != 3) c.position[i] = from[i] + share * (to[i] - from[i]);
}

/// One distorted element, led in `count` explicit cycles to where `a` and a random displacement of `size` put it.
SolidCase flowed(const SolidOptions& o, const Block& block, const Eigen::Matrix3d& a, double size, int count, unsigned seed = 3) {
  SolidCase c = make_block(o, block);
  const std::vector<double> from = c.position;
  c.move(affine(a));
  shake(c, size, seed);
  const std::vector<double> to = c.position;
  for (int k = 1; k <= count; ++k) {
    place(c, from, to, static_cast<double>(k) / count);
    c.explicit_cycle(1e-3);
  }
  return c;
}

Block skewed(double skew) {
  Block block;
  block.skew = skew;
  block.skew_boundary = true;
  block.size = {1.0, 1.3, 0.7};
  return block;
}

const Eigen::Matrix3d squeeze = Eigen::Vector3d(1.5, 1.5, 0.45).asDiagonal();

}  // namespace

/// While nothing yields the hourglass is that of elasticity, though its stiffness comes from the metric of the sides. Hourglass
/// motion alone: no affine part, no mean strain.
TEST(SolidMetal, HourglassIsElasticBelowYield) {
  for (const double skew : {0.0, 0.2}) {
    SolidOptions elastic = metal("C3D8R", 0.7);
    elastic.material_options.clear();
    SolidCase c = make_block(metal("C3D8R", 0.7), skewed(0.0)), e = make_block(elastic, skewed(0.0));
    for (SolidCase* one : {&c, &e}) {
      for (auto& x : one->model.nodes.coordinates) x[0] += skew * x[1];  // a parallelepiped: skew axes
      Model& model = one->model;
      one->group = model.elements[0].type->make_group({model, 0, 0, {0}, 0, model.elements[0].connectivity, 8});
      one->move([](const Point& x) { return x; });
    }
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    for (int a = 0; a < 4; ++a) {
      const double d[3] = {1e-4 * normal(random), 1e-4 * normal(random), 1e-4 * normal(random)};
      const auto nodes = c.group->nodes(0);
      static constexpr int corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
      for (int i = 0; i < 8; ++i) {
        const int x = corner[i][0], y = corner[i][1], z = corner[i][2];
        const int mode[4] = {y * z, x * z, x * y, x * y * z};
        for (int k = 0; k < 3; ++k) {
          c.position[4 * nodes[i] + k] += mode[a] * d[k];
          e.position[4 * nodes[i] + k] += mode[a] * d[k];
        }
      }
    }
    Eigen::VectorXd force, expected;
    Eigen::MatrixXd k;
    ASSERT_TRUE(c.linearize(0, force, k));
    ASSERT_TRUE(e.linearize(0, expected, k));
    EXPECT_GT(expected.norm(), 1e-5);
    EXPECT_LT((force - expected).norm(), 1e-12 * expected.norm());
    EXPECT_NEAR(c.group->energies(0, {c.position.data()}, c.element_history(0)).hourglass,
                e.group->energies(0, {e.position.data()}, e.element_history(0)).hourglass, 1e-15);
  }
}

/// Moment of an element of side 1 whose centre is at rest, bent in `count` explicit cycles to `curvature` by forces at its corners.
double bending_moment(SolidCase& c, const std::vector<double>& start, double curvature, int count) {
  const auto nodes = c.group->nodes(0);
  for (int k = 1; k <= count; ++k) {
    for (int i = 0; i < 8; ++i) {
      const double* const x = &start[4 * nodes[i]];
      c.position[4 * nodes[i]] = x[0] - curvature * k / count * (x[0] - 0.5) * (x[1] - 0.5);
      // Free of stress across: what flows has the proportions of the trial strain.
      c.position[4 * nodes[i] + 2] = x[2] + poisson * curvature * k / count * (x[1] - 0.5) * (x[2] - 0.5);
    }
    c.explicit_cycle(1e-3);
  }
  double moment = 0.0;
  for (int i = 0; i < 8; ++i)
    if (start[4 * nodes[i]] > 0.5) moment += c.force[4 * nodes[i]] * (start[4 * nodes[i] + 1] - 0.5);
  return moment;
}

/// An element bent while its centre is at rest gives the plastic moment of its thickness and no more: sigma h^2 / 4 a width, here of a
/// curve without hardening.
TEST(SolidMetal, HourglassYieldsInBending) {
  SolidOptions o = metal("C3D8R");
  o.material_options = {{"plastic", {0.0}, {{yield, 0.0}, {yield, 1.0}}}};
  SolidCase c = make_block(o, {});
  const std::vector<double> start = c.position;
  const double plastic = 0.25 * yield, first = yield / young * 2.0;  // curvature at first yield of an edge
  EXPECT_NEAR(bending_moment(c, start, first, 50) / plastic, 2.0 / 3.0, 0.02);
  EXPECT_NEAR(bending_moment(c, start, 6.0 * first, 500) / plastic, 1.0, 0.05);
  EXPECT_EQ(c.element_history(0)[c.group->law_field_row("PEEQ", 0)], 0.0);
}

/// With linear hardening the moment goes on: sigma h^2 / 4 (1 - (e / kappa h)^2 4 / 3) of the yield stress, and that of the tangent
/// modulus for the strain beyond yield.
TEST(SolidMetal, HourglassHardensInBending) {
  constexpr double hardening = 40.0, tangent = young * hardening / (young + hardening), first = yield / young;
  SolidOptions o = metal("C3D8R");
  o.material_options = {{"plastic", {0.0}, {{yield, 0.0}, {yield + hardening, 1.0}}}};
  for (const double curvature : {10.0 * first, 30.0 * first}) {
    SolidCase c = make_block(o, {});
    const std::vector<double> start = c.position;
    const double depth = first / curvature;  // up to which it is elastic, of the half height 0.5
    const double perfect = yield * (0.25 - depth * depth / 3.0);
    const double beyond = tangent * curvature * 2.0 * ((0.125 - depth * depth * depth) / 3.0 - depth * (0.25 - depth * depth) / 2.0);
    EXPECT_NEAR(bending_moment(c, start, curvature, 2000) / (perfect + beyond), 1.0, 0.03) << curvature;
  }
}

/// A stress of the centre takes from the moment: 1 - 0.9 n^2 of it is left beside a normal force n of what yields, and a repeated
/// increment changes nothing.
TEST(SolidMetal, CentreTakesFromTheMoment) {
  SolidOptions o = metal("C3D8R");
  o.material_options = {{"plastic", {0.0}, {{yield, 0.0}, {yield, 1.0}}}};
  const double plastic = 0.25 * yield;
  for (const double share : {0.5, 0.9}) {
    SolidCase c = make_block(o, {});
    const std::vector<double> unloaded = c.position;
    const double strain = share * yield / young;
    c.move(affine(Eigen::Vector3d(1.0 + strain, 1.0 - poisson * strain, 1.0 - poisson * strain).asDiagonal()));
    const std::vector<double> start = c.position;
    const double moment = bending_moment(c, start, 8.0 * yield / young, 500);
    EXPECT_NEAR(moment / plastic, 1.0 - 0.9 * share * share, 0.03) << share;
    const std::vector<double> force = c.force;
    c.explicit_cycle(1e-3);
    for (std::size_t i = 0; i < force.size(); ++i) EXPECT_NEAR(c.force[i], force[i], 1e-12);
  }
}

/// Affine flow, however large, leaves hourglass stresses what they were per side; the shape does not creep under it.
TEST(SolidMetal, AffineFlowStrainsNoHourglass) {
  SolidCase c = flowed(metal("C3D8R"), skewed(0.0), squeeze, 0.0, 400);
  EXPECT_GT(c.element_history(0)[c.group->law_field_row("PEEQ", 0)], 0.5);
  const ElementEnergies energies = c.group->energies(0, {c.position.data()}, c.element_history(0));
  EXPECT_LT(energies.hourglass, 1e-20 * energies.plastic);
}

/// Plastic strain keeps the volume, and on a path of one direction its size is the equivalent plastic strain; a turn turns it.
TEST(SolidMetal, PlasticStrainIsATensorWithoutTrace) {
  const Eigen::Matrix3d turn = rotation(0.7, {1, 2, 3});
  for (const std::string type : {"C3D8R", "C3D8"}) {
    SolidCase c = flowed(metal(type), {}, squeeze, 0.0, 200);
    std::array<double, 6> still, turned, strain;
    std::array<double, 1> equivalent;
    const auto ask = [&](const char* variable, std::span<double> values) {
      ASSERT_EQ(c.group->output_components(variable), static_cast<int>(values.size()));
      c.group->output(variable, 0, 0, {c.position.data()}, c.element_history(0), values);
    };
    ask("PE", still);
    ask("PEEQ", equivalent);
    ask("LE", strain);
    EXPECT_NEAR(still[0] + still[1] + still[2], 0.0, 1e-12);
    EXPECT_NEAR(std::sqrt((2.0 / 3.0) * (still[0] * still[0] + still[1] * still[1] + still[2] * still[2])), equivalent[0], 0.01 * equivalent[0]);
    EXPECT_NEAR(still[2], strain[2], 0.01);
    c.move(affine(turn * squeeze));
    ask("PE", turned);
    Eigen::Matrix3d expected = turn * Eigen::Vector3d(still[0], still[1], still[2]).asDiagonal() * turn.transpose();
    EXPECT_NEAR(turned[0], expected(0, 0), 1e-12);
    EXPECT_NEAR(turned[3], 2.0 * expected(0, 1), 1e-12);
    EXPECT_NEAR(turned[5], 2.0 * expected(1, 2), 1e-12);
  }
}

/// The tangent holds for increments in which the centre flows: the error of a central difference falls with the square of its step.
TEST(SolidMetal, TangentIsTheDerivativeOfTheForce) {
  SolidCase c = flowed(metal("C3D8R"), skewed(0.1), squeeze, 0.05, 50);
  const std::vector<double> start = c.position;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> direction(start.size());
  for (auto& d : direction) d = normal(random);
  const std::vector<double> history = c.history;
  const auto at = [&](double step) {
    for (std::size_t i = 0; i < start.size(); ++i)
      if (i % 4 != 3) c.position[i] = start[i] * (1.0 + 0.01 * (i % 4)) + step * direction[i];
    Eigen::VectorXd f;
    Eigen::MatrixXd k;
    c.assemble(f, k);
    return std::pair(f, k);
  };
  Eigen::VectorXd along(c.dofs());
  for (int i = 0; i < c.dofs(); ++i) along(i) = direction[4 * (i / 3) + i % 3];
  const Eigen::VectorXd exact = at(0.0).second * along;
  const auto error = [&](double step) {
    return ((at(step).first - at(-step).first) / (2.0 * step) - exact).norm() / exact.norm();
  };
  const double coarse = error(2e-6), fine = error(1e-6);  // no point begins or ceases to yield so near
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);
}

/// A lane equals the scalar: forces and history, bit for bit, where the law is quasi-static and nothing is viscous.
TEST(SolidMetal, PacksEqualScalars) {
  SolidCase c = flowed(metal("C3D8R"), skewed(0.1), squeeze, 0.1, 20);
  for (std::size_t i = 0; i < c.position.size(); ++i)
    if (i % 4 != 3) c.position[i] *= 1.0 + 0.01 * (i % 4);
  const std::vector<double> old_history = c.element_history(0);
  std::vector<double> history(old_history), force(24);
  ASSERT_TRUE(c.group->linearize(0, {c.position.data()}, old_history, history, force, {}));
  const double before = c.element_history(0)[c.group->law_field_row("PEEQ", 0)];
  c.explicit_cycle();
  const std::vector<double> packed = c.element_history(0);
  EXPECT_GT(packed[c.group->law_field_row("PEEQ", 0)], before);
  EXPECT_EQ(packed, history);
  for (int i = 0; i < 24; ++i) EXPECT_EQ(c.force[4 * c.group->nodes(0)[i / 3] + i % 3], 0.0 - force[i]);
}

/// Work of the forces on a path that bends and squeezes an element, against its energies. What is missed, next to the hourglass
/// energy, falls with the increment to the order of the elastic strain: moduli follow the shape that flow has given.
TEST(SolidMetal, EnergyBalances) {
  const auto miss = [](int count) {
    SolidCase c = make_block(metal("C3D8R"), skewed(0.1));
    const std::vector<double> from = c.position;
    c.move(affine(squeeze));
    shake(c, 0.25);
    const std::vector<double> to = c.position;
    double work = 0.0;
    c.position = from;
    std::vector<double> old_force = c.force, old_position = from;
    for (int k = 1; k <= count; ++k) {
      place(c, from, to, static_cast<double>(k) / count);
      c.explicit_cycle(1e-3);
      for (std::size_t i = 0; i < c.position.size(); ++i)
        if (i % 4 != 3) work -= 0.5 * (c.force[i] + old_force[i]) * (c.position[i] - old_position[i]);
      old_force = c.force;
      old_position = c.position;
    }
    const ElementEnergies e = c.group->energies(0, {c.position.data()}, c.element_history(0));
    EXPECT_GT(e.hourglass, 2e-4 * work);
    return std::fabs(work - e.strain - e.plastic - e.viscous - e.hourglass) / e.hourglass;
  };
  EXPECT_LT(miss(500), 0.015);
  EXPECT_LT(miss(2000), 0.008);
}

/// Squeezed, bent, flowed far: the estimate never exceeds 2 / omega_max of the element that unloads, and does not fall far below.
TEST(SolidMetal, StableIncrementIsSafeAndSharp) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (const std::string type : {"C3D8R", "C3D8", "C3D6"}) {
    double worst = 0.0, least = 1.0, sum = 0.0;
    int count = 0;
    for (int trial = 0; trial < 60; ++trial) {
      Block block = skewed(0.03 * (trial % 5));
      Eigen::Matrix3d a = trial % 3 == 0 ? squeeze : Eigen::Matrix3d::Identity().eval();
      for (int i = 0; i < 9; ++i) a(i / 3, i % 3) += 0.1 * (trial % 4) * normal(random);
      if (a.determinant() < 0.3) continue;
      a /= std::cbrt(a.determinant());
      SolidCase c = flowed(metal(type), block, rotation(0.2 * trial, {1, 2, 3}) * a, 0.02 * (trial % 3), 200, trial);
      for (std::size_t i = 0; i < c.position.size(); ++i)
        if (i % 4 != 3) c.position[i] *= 1.0 - 2e-5;  // off the yield surface
      const double estimate = c.explicit_cycle().increment;
      double largest = 0.0;
      for (int e = 0; e < c.group->size(); ++e) {
        Eigen::VectorXd f;
        Eigen::MatrixXd k;
        if (!c.linearize(e, f, k)) continue;
        std::vector<double> mass(c.group->nodes_per_element());
        c.group->lumped_mass(e, mass);
        const double omega = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (k + k.transpose())).eigenvalues()(k.rows() - 1);
        largest = std::max(largest, omega / mass[0]);
      }
      if (!(estimate > 0.0)) continue;
      const double ratio = estimate / (2.0 / std::sqrt(largest));
      worst = std::max(worst, ratio);
      least = std::min(least, ratio);
      sum += ratio;
      ++count;
    }
    std::printf("%s: estimate / exact: least %.3f, mean %.3f, largest %.6f, %d cases\n", type.c_str(), least, sum / count, worst, count);
    EXPECT_GT(count, 40) << type;
    EXPECT_LE(worst, 1.0 + 1e-9) << type;
    EXPECT_GE(sum / count, 0.6) << type;
    EXPECT_GE(least, 0.3) << type;
  }
}

}  // namespace balocco::test
