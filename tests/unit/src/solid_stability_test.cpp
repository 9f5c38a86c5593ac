// The stable increment of solids against the largest eigenvalue of M^-1 K: never unsafe, sharp near the reference
// state.
#include <gtest/gtest.h>

#include "solid_fixture.hpp"
#include "symmetric_eigenvalues.hpp"

namespace balocco::test {

namespace {

/// 2 / omega_max of one free element at its current positions.
double exact_increment(const SolidCase& c, int element = 0) {
  Eigen::VectorXd f;
  Eigen::MatrixXd k;
  c.linearize(element, f, k);
  std::vector<double> mass(c.group->nodes_per_element());
  c.group->lumped_mass(element, mass);
  for (int i = 0; i < k.rows(); ++i)
    for (int j = 0; j < k.cols(); ++j) k(i, j) /= std::sqrt(mass[i / 3] * mass[j / 3]);
  return 2.0 / std::sqrt(symmetric_eigenvalues(0.5 * (k + k.transpose()))(k.rows() - 1));
}

SolidOptions options(const std::string& type, const std::string& law, std::vector<double> parameters) {
  SolidOptions o;
  o.type = type;
  o.law = law;
  o.parameters = std::move(parameters);
  o.density = 2.0;
  return o;
}

std::vector<std::pair<std::string, std::vector<double>>> laws() {
  return {{"elastic", {1000.0, 0.3}},
          {"elastic", {1000.0, 0.0}},
          {"elastic", {1000.0, 0.49}},
          {"neo-hooke", {0.5, 0.01}},
          {"mooney-rivlin", {0.4, 0.1, 0.0}}};
}

/// A free cube vibrates fastest in uniform dilatation: omega^2 = 4 (3 lambda + 2 mu) / (rho L^2), by hand.
TEST(SolidStability, CubeIsGovernedByDilatation) {
  const double young = 1000.0, poisson = 0.3, rho = 2.0;
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = young / (2 * (1 + poisson));
  const double expected = 2.0 / std::sqrt(4.0 * (3.0 * lambda + 2.0 * mu) / rho);
  for (const std::string type : {"C3D8R", "C3D8"}) {
    SolidCase c = make_block(options(type, "elastic", {young, poisson}), {});
    EXPECT_NEAR(exact_increment(c), expected, 1e-12 * expected) << type;
    EXPECT_NEAR(c.explicit_cycle().increment, expected, 1e-7 * expected) << type;
    EXPECT_LT(expected, 1.0 / std::sqrt((lambda + 2.0 * mu) / rho)) << "L / c_d would be unsafe";
  }
}

TEST(SolidStability, SharpForBoxes) {
  for (const std::string type : {"C3D8R", "C3D8"}) {
    for (const auto& [law, parameters] : laws()) {
      for (const Point size : {Point{1, 1, 1}, Point{2, 1, 1}, Point{1, 3, 2}, Point{1, 1, 0.1}, Point{0.05, 0.2, 1}}) {
        SolidCase c = make_block(options(type, law, parameters), {{1, 1, 1}, size});
        const double ratio = c.explicit_cycle().increment / exact_increment(c);
        EXPECT_LE(ratio, 1.0 + 1e-9) << type << " " << law << " " << size[0] << size[1] << size[2];
        EXPECT_GE(ratio, 0.90) << type << " " << law << " " << size[0] << " " << size[1] << " " << size[2];
      }
    }
  }
}

/// Distorted, strained, sheared, compressed, rotated: the estimate may lose, but must not exceed the exact limit.
TEST(SolidStability, NeverUnsafe) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (const std::string name : {"C3D8R", "C3D8", "C3D6", "C3D4", "C3D10", "C3D8 pointwise", "C3D8I"}) {
    const std::string type = name.substr(0, name.find(' '));
    const auto options = [&](const std::string& of_type, const std::string& law, const std::vector<double>& parameters) {
      SolidOptions o = test::options(of_type, law, parameters);
      o.pointwise_dilatation = name != type;
      return o;
    };
    double worst = 0.0, least = 1.0, sum = 0.0;
    int count = 0;
    for (const auto& [law, parameters] : laws()) {
      for (int trial = 0; trial < 60; ++trial) {
        Block block;
        block.skew = 0.02 * (trial % 10);
        block.skew_boundary = true;
        block.size = {1.0, 1.0 + 0.2 * (trial % 4), 1.0 + 0.5 * (trial % 3)};
        SolidCase c = make_block(options(type, law, parameters), block);
        Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
        const double strain = law == "elastic" ? 0.04 * (trial % 3) : 0.15 * (trial % 4);
        for (int i = 0; i < 9; ++i) a(i / 3, i % 3) += strain * normal(random);
        if (a.determinant() < 0.3 || a.determinant() > 2.0) continue;
        if (parameters.back() != 0.3 && law != "elastic") a /= std::cbrt(a.determinant());
        c.move(affine(rotation(trial, {1, 2, 3}) * a));
        shake(c, 0.03 * (trial % 2), trial);
        Eigen::VectorXd f;
        Eigen::MatrixXd k;
        for (int e = 0; e < c.group->size(); ++e) {
          if (!c.linearize(e, f, k)) continue;
          SolidCase one = make_case(options(type, law, parameters), c.model.nodes.coordinates,
                                    {c.group->nodes(e).begin(), c.group->nodes(e).end()});
          one.position = c.position;
          const double ratio = one.explicit_cycle().increment / exact_increment(one);
          worst = std::max(worst, ratio);
          least = std::min(least, ratio);
          sum += ratio;
          ++count;
        }
      }
    }
    EXPECT_GT(count, 200) << name;
    EXPECT_LE(worst, 1.0 + 1e-9) << name;
    EXPECT_GE(sum / count, 0.7) << name;
    RecordProperty(type + "_mean_ratio", std::to_string(sum / count));
    RecordProperty(type + "_least_ratio", std::to_string(least));
    std::printf("%s: estimate / exact: least %.3f, mean %.3f, largest %.6f\n", name.c_str(), least, sum / count, worst);
  }
}

/// Bulk viscosity and stiffness-proportional damping shorten the increment by sqrt(1 + xi^2) - xi.
TEST(SolidStability, DampingShortensTheIncrement) {
  SolidOptions o = options("C3D8R", "elastic", {1000.0, 0.3});
  SolidCase plain = make_block(o, {});
  const double free_increment = plain.explicit_cycle(1e-3).increment, omega = 2.0 / free_increment;
  const double lambda = 1000.0 * 0.3 / (1.3 * 0.4), mu = 1000.0 / 2.6;
  const double linear =
      0.06 * std::sqrt((lambda + 2 * mu) / 2.0) * 12.0 / (2.0 * omega);  // xi = b1 c_d L (12 / L^2) / (2 omega), L = 1
  SolidCase viscous = make_block(o, {});
  EXPECT_NEAR(viscous.explicit_cycle(1e-3, 0.06, 1.2).increment,
              free_increment * (std::sqrt(1 + linear * linear) - linear), 1e-6 * free_increment);
  o.damping_beta = 0.02;
  SolidCase damped = make_block(o, {});
  const double xi = 0.5 * o.damping_beta * omega;
  EXPECT_NEAR(damped.explicit_cycle(1e-3).increment, free_increment * (std::sqrt(1 + xi * xi) - xi),
              1e-6 * free_increment);
}

TEST(SolidStability, InvertedElementsAreNamed) {
  for (const std::string type : {"C3D8R", "C3D8", "C3D6", "C3D4", "C3D10"}) {
    SolidOptions o = options(type, "neo-hooke", {0.5, 0.05});
    SolidCase c = make_block(o, {{4, 3, 1}, {4, 3, 1}});
    const int bad = 7;
    const auto nodes = c.group->nodes(bad);
    for (const auto node : nodes) c.position[4 * node + 2] *= -3.0;
    Eigen::VectorXd f;
    Eigen::MatrixXd k;
    EXPECT_FALSE(c.linearize(bad, f, k));
    EXPECT_LE(c.explicit_cycle().increment, 0.0);
    SolidCase nan = make_block(o, {{4, 3, 1}, {4, 3, 1}});
    nan.position[4 * nan.group->nodes(bad)[0]] = std::nan("");
    const StableIncrement stop = nan.explicit_cycle();
    EXPECT_LE(stop.increment, 0.0) << type;
    const auto named = nan.group->nodes(stop.element);
    EXPECT_NE(std::find(named.begin(), named.end(), nan.group->nodes(bad)[0]), named.end()) << type;
  }
}

}  // namespace

}  // namespace balocco::test
