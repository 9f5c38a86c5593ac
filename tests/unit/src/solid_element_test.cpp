// What every solid element must do, for each type and law: patch test, rigid motion, zero eigenvalues, exact tangent,
// one kernel.
#include <gtest/gtest.h>

#include <cstring>

#include "solid_fixture.hpp"
#include "symmetric_eigenvalues.hpp"

namespace balocco::test {

namespace {

struct Parameter {
  std::string type, law;
  std::vector<double> parameters;
  HourglassControl hourglass = HourglassControl::enhanced;
  bool pointwise_dilatation = false;
};

std::ostream& operator<<(std::ostream& out, const Parameter& p) {
  return out << p.type << " " << p.law << (p.hourglass == HourglassControl::stiffness ? " stiffness" : "")
             << (p.pointwise_dilatation ? " pointwise" : "");
}

const std::vector<double> soft_rubber{0.5, 0.05};  // C10, D1: bulk / shear = 40
const std::vector<double> moduli{120.0, 30.0, 100.0, 25.0, 20.0, 90.0, 30.0, 35.0, 40.0};

const std::vector<double> all_moduli{120.0, 30.0, 100.0, 25.0, 20.0, 90.0, 5.0, -4.0, 3.0, 30.0, 2.0,
                                     6.0,   -3.0, 4.0,   35.0, -2.0, 3.0,  5.0, 2.0,  -4.0, 40.0};

std::vector<Parameter> all_parameters() {
  std::vector<Parameter> all;
  for (const std::string type : {"C3D8R", "C3D8", "C3D6", "C3D4", "C3D10", "C3D20", "C3D20R", "C3D8I", "C3D15"}) {
    if (find_element_type(type) == nullptr) continue;
    all.push_back({type, "elastic", {1000.0, 0.3}});
    all.push_back({type, "neo-hooke", soft_rubber});
    all.push_back({type, "mooney-rivlin", {0.4, 0.1, 0.05}});
    all.push_back({type, "orthotropic", moduli});
  }
  all.push_back({"C3D8R", "neo-hooke", soft_rubber, HourglassControl::stiffness});
  all.push_back({"C3D8", "elastic", {1000.0, 0.3}, HourglassControl::enhanced, true});
  all.push_back({"C3D8", "neo-hooke", soft_rubber, HourglassControl::enhanced, true});
  all.push_back({"C3D8", "anisotropic", all_moduli});
  return all;
}

class SolidElement : public ::testing::TestWithParam<Parameter> {
 protected:
  SolidOptions options() const {
    SolidOptions o;
    o.type = GetParam().type;
    o.law = GetParam().law;
    o.parameters = GetParam().parameters;
    o.hourglass = GetParam().hourglass;
    o.pointwise_dilatation = GetParam().pointwise_dilatation;
    return o;
  }
  /// Random displacement beside a large strain. Incompatible modes of large amplitude have several states of equilibrium.
  double shaken() const { return GetParam().type == "C3D8I" ? 0.01 : 0.05; }
  SolidCase distorted() const {
    Block block;
    block.skew = 0.15;
    block.skew_boundary = true;
    return make_block(options(), block);
  }
};

const Eigen::Matrix3d large_strain = (Eigen::Matrix3d() << 1.2, 0.1, 0.0, -0.05, 0.9, 0.15, 0.1, 0.0, 1.05).finished();

/// Affine motion: interior nodes of a skewed mesh carry no force, and the stress is that of the law, 1e-13 of the
/// modulus.
TEST_P(SolidElement, PassesThePatchTest) {
  Block block;
  block.cells = {3, 3, 3};
  block.skew = 0.25;
  SolidCase c = make_block(options(), block);
  c.move(affine(large_strain));
  Eigen::VectorXd f;
  Eigen::MatrixXd k;
  c.assemble(f, k);
  const double scale = f.cwiseAbs().maxCoeff();
  ASSERT_GT(scale, 0.0);
  int inside = 0;
  for (int i = 0; i < c.nodes(); ++i) {
    bool interior = true;
    for (double x : c.model.nodes.coordinates[i]) interior = interior && x > 1e-9 && x < 1.0 - 1e-9;
    if (!interior) continue;
    ++inside;
    for (int d = 0; d < 3; ++d) EXPECT_LT(std::abs(f(3 * i + d)), 1e-13 * k.cwiseAbs().maxCoeff());
  }
  EXPECT_GE(inside, 8);
  std::vector<double> first(6), other(6);
  c.group->output("S", 0, 0, {c.position.data()}, c.element_history(0), first);
  for (int e = 1; e < c.group->size(); ++e) {
    c.group->output("S", e, 0, {c.position.data()}, c.element_history(e), other);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(other[i], first[i], 1e-11 * std::abs(first[0]));
  }
}

TEST_P(SolidElement, RigidRotationIsFreeOfForce) {
  SolidCase c = distorted();
  Eigen::VectorXd reference_force, f;
  Eigen::MatrixXd k;
  c.linearize(0, reference_force, k);
  c.move(affine(rotation(2.0, {1.0, -2.0, 0.5}), {3.0, -1.0, 2.0}));
  c.linearize(0, f, k);
  EXPECT_LT(f.cwiseAbs().maxCoeff(), 1e-14 * k.cwiseAbs().maxCoeff());
  EXPECT_NEAR(c.group->energies(0, {c.position.data()}, c.element_history(0)).hourglass, 0.0,
              1e-14 * k.cwiseAbs().maxCoeff());
}

/// A superposed rotation turns forces with the body: also with hourglass deformation.
TEST_P(SolidElement, ForcesTurnWithTheBody) {
  SolidCase c = distorted();
  c.move(affine(large_strain));
  shake(c, 0.05);
  const Eigen::Matrix3d q = rotation(1.1, {0.3, 1.0, -0.4});
  Eigen::VectorXd f, turned;
  Eigen::MatrixXd k;
  c.assemble(f, k);
  for (int i = 0; i < c.nodes(); ++i) {
    Eigen::Map<Eigen::Vector3d> x(&c.position[4 * i]);
    x = (q * x).eval();
  }
  c.assemble(turned, k);
  for (int i = 0; i < c.nodes(); ++i)
    EXPECT_LT((turned.segment<3>(3 * i) - q * f.segment<3>(3 * i)).norm(), 1e-13 * k.cwiseAbs().maxCoeff());
}

/// Six of them, and of C3D20R the six of reduced integration, which two elements side by side do not share.
TEST_P(SolidElement, HasItsZeroEigenvaluesAndASymmetricTangent) {
  SolidCase c = distorted();
  Eigen::VectorXd f;
  Eigen::MatrixXd k;
  ASSERT_TRUE(c.linearize(0, f, k));
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-13 * k.cwiseAbs().maxCoeff());
  const Eigen::VectorXd values = symmetric_eigenvalues(k);
  const int zeros = GetParam().type == "C3D20R" ? 12 : 6;
  EXPECT_LT(std::abs(values(zeros - 1)), 1e-12 * values(values.size() - 1));
  EXPECT_LT(std::abs(values(0)), 1e-12 * values(values.size() - 1));
  EXPECT_GT(values(zeros), 1e-5 * values(values.size() - 1));

  c.move(affine(large_strain));
  shake(c, 0.05);
  ASSERT_TRUE(c.linearize(0, f, k));
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff());
}

/// The tangent is the derivative of the force: the error of a central difference falls with the square of its step.
TEST_P(SolidElement, TangentIsTheDerivativeOfTheForce) {
  SolidCase c = distorted();
  c.move(affine(large_strain));
  shake(c, shaken());
  Eigen::VectorXd f, plus, minus;
  Eigen::MatrixXd k, ignored;
  c.assemble(f, k);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Eigen::VectorXd direction(c.dofs());
  for (int i = 0; i < c.dofs(); ++i) direction(i) = normal(random);
  const std::vector<double> start = c.position;
  const auto error = [&](double step) {
    for (int i = 0; i < c.dofs(); ++i)
      c.position[4 * (i / 3) + i % 3] = start[4 * (i / 3) + i % 3] + step * direction(i);
    c.assemble(plus, ignored);
    for (int i = 0; i < c.dofs(); ++i)
      c.position[4 * (i / 3) + i % 3] = start[4 * (i / 3) + i % 3] - step * direction(i);
    c.assemble(minus, ignored);
    return ((plus - minus) / (2.0 * step) - k * direction).norm() / (k * direction).norm();
  };
  const double coarse = error(4e-3), fine = error(2e-3);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);
}

/// The force is the gradient of strain and hourglass energy.
TEST_P(SolidElement, ForceIsTheGradientOfTheEnergy) {
  SolidCase c = distorted();
  c.move(affine(large_strain));
  shake(c, 0.05);
  Eigen::VectorXd f;
  Eigen::MatrixXd k;
  c.assemble(f, k);
  const auto energy = [&] {
    double sum = 0.0;
    for (int e = 0; e < c.group->size(); ++e) {
      const std::vector<double> before = c.element_history(e);
      std::vector<double> history(before), force(3 * c.group->nodes_per_element());
      c.group->linearize(e, {c.position.data()}, before, history, force, {});  // incompatible modes find their least energy
      const ElementEnergies energies = c.group->energies(e, {c.position.data()}, history);
      sum += energies.strain + energies.hourglass;
    }
    return sum;
  };
  const double step = 1e-5;
  for (int i = 0; i < c.dofs(); ++i) {
    double& x = c.position[4 * (i / 3) + i % 3];
    const double start = x;
    x = start + step;
    const double plus = energy();
    x = start - step;
    const double minus = energy();
    x = start;
    EXPECT_NEAR((plus - minus) / (2.0 * step), f(i), 1e-6 * f.cwiseAbs().maxCoeff());
  }
}

/// Energies of packs are those of single elements bit for bit; the last pack has padded lanes.
TEST_P(SolidElement, PackEnergiesEqualSingleOnes) {
  Block block;
  block.cells = {3, 3, 1};
  block.skew = 0.1;
  block.skew_boundary = true;
  SolidCase c = make_block(options(), block);
  c.move(affine(large_strain));
  shake(c, 0.04);
  c.explicit_cycle(1e-3, 0.06, 1.2);
  std::vector<ElementEnergies> energies(static_cast<std::size_t>(c.group->padded_size()));
  c.group->energies(0, {c.position.data()}, c.history, energies);
  for (int e = 0; e < c.group->size(); ++e) {
    const ElementEnergies one = c.group->energies(e, {c.position.data()}, c.element_history(e));
    for (const auto member : {&ElementEnergies::strain, &ElementEnergies::hourglass, &ElementEnergies::viscous, &ElementEnergies::plastic})
      EXPECT_EQ(energies[e].*member, one.*member);
    EXPECT_GT(one.strain, 0.0);
  }
}

/// One kernel: the explicit loop's packs give the very forces of the scalar kernel. Eight different elements fill the
/// lanes.
TEST_P(SolidElement, PackForcesEqualScalarForces) {
  if (find_element_type(GetParam().type)->implicit_only) GTEST_SKIP() << "has no explicit kernel";
  if (GetParam().type == "C3D8I") GTEST_SKIP() << "its incompatible modes are a few cycles behind: IncompatibleModes";
  Block block;
  block.cells = {3, 1, 1};
  block.skew = 0.1;
  block.skew_boundary = true;
  SolidCase c = make_block(options(), block);
  c.move(affine(large_strain));
  shake(c, 0.04);
  for (int e = 0; e < c.group->size(); ++e) {  // one at a time so that the sums at the nodes hold one addend
    SolidCase one =
        make_case(options(), c.model.nodes.coordinates, {c.group->nodes(e).begin(), c.group->nodes(e).end()});
    one.position = c.position;
    const std::vector<double> history = one.element_history(0);
    std::vector<double> updated(history), force(3 * one.group->nodes_per_element());
    ASSERT_TRUE(one.group->linearize(0, {one.position.data()}, history, updated, force, {}));
    one.explicit_cycle();
    for (int i = 0; i < one.group->nodes_per_element(); ++i) {
      for (int d = 0; d < 3; ++d) {
        const double subtracted = 0.0 - force[3 * i + d];
        EXPECT_EQ(std::memcmp(&one.force[4 * one.group->nodes(0)[i] + d], &subtracted, sizeof(double)), 0);
      }
    }
  }
}

/// Where the nodes rest, the amplitudes that explicit cycles follow become those that statics finds.
TEST(IncompatibleModes, SettleInExplicitCycles) {
  SolidOptions options;
  options.type = "C3D8I";
  options.law = "neo-hooke";
  options.parameters = soft_rubber;
  SolidCase c = make_block(options, {{1, 1, 1}, {1, 1, 1}, 0.1, true});
  c.move(affine(Eigen::Matrix3d::Identity() + 0.2 * (large_strain - Eigen::Matrix3d::Identity())));
  shake(c, 0.02);
  const std::vector<double> before = c.element_history(0);
  std::vector<double> after(before), force(24);
  ASSERT_TRUE(c.group->linearize(0, {c.position.data()}, before, after, force, {}));
  double scale = 0.0;
  for (const double f : force) scale = std::max(scale, std::abs(f));
  const auto error = [&] {
    double worst = 0.0;
    for (int i = 0; i < 24; ++i)
      worst = std::max(worst, std::abs(c.force[4 * c.group->nodes(0)[i / 3] + i % 3] + force[i]));
    return worst / scale;
  };
  c.explicit_cycle();
  const double first = error();
  for (int cycle = 0; cycle < 500; ++cycle) c.explicit_cycle();
  EXPECT_LT(first, 0.5);
  EXPECT_LT(error(), 1e-12);
}

/// The hourglass moduli of an isotropic C3D8R are kept in fewer numbers than those of one that is so but for 1e-9.
TEST(ReducedBrick, IsotropicHourglassModuliAreTheAnisotropicOnes) {
  const double shear = 1000.0 / 2.6;
  SolidOptions isotropic, other;
  other.law = "engineering-constants";
  other.parameters = {1000.0, 1000.0 + 1e-6, 1000.0, 0.3, 0.3, 0.3, shear, shear, shear};
  std::array<Eigen::VectorXd, 2> force;
  for (const int i : {0, 1}) {
    SolidCase c = make_block(i == 0 ? isotropic : other, {{1, 1, 1}, {1.0, 1.5, 0.7}, 0.2, true});
    shake(c, 0.1);
    Eigen::MatrixXd stiffness;
    ASSERT_TRUE(c.linearize(0, force[i], stiffness));
  }
  EXPECT_LT((force[0] - force[1]).norm(), 1e-8 * force[0].norm());
}

INSTANTIATE_TEST_SUITE_P(All, SolidElement, ::testing::ValuesIn(all_parameters()));

}  // namespace

}  // namespace balocco::test
