// Laws at one point: closed forms, exact tangents, objectivity, thin forms against the solid, bounds of the tangent.
#include "materials/material_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <random>

#include "elements/element_type.hpp"
#include "materials/material_option.hpp"
#include "math/inverse_cube_root.hpp"
#include "math/pack.hpp"
#include "model/diagnostics.hpp"
#include "model/model.hpp"
#include "symmetric_eigenvalues.hpp"

namespace balocco::test {

namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Solid = Law<PointKind::solid>;

struct Case {
  std::string law;
  std::vector<double> parameters;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.law;
}

std::vector<Case> solid_cases() {
  return {{"elastic", {1000.0, 0.3}},
          {"engineering-constants", {100.0, 20.0, 10.0, 0.3, 0.25, 0.4, 8.0, 7.0, 5.0}},
          {"orthotropic", {120.0, 30.0, 100.0, 25.0, 20.0, 90.0, 30.0, 35.0, 40.0}},
          {"anisotropic", {120.0, 30.0, 100.0, 25.0, 20.0, 90.0, 5.0, -4.0, 3.0,  30.0, 2.0,
                           6.0,   -3.0, 4.0,   35.0, -2.0, 3.0,  5.0, 2.0,  -4.0, 40.0}},
          {"neo-hooke", {0.5, 0.05}},
          {"neo-hooke", {0.5, 0.0}},
          {"mooney-rivlin", {0.4, 0.1, 0.05}}};
}

struct Response {
  Matrix stress;
  Eigen::Matrix<double, 9, 9, Eigen::RowMajor> tangent;
};

Response respond(const Solid& law, const Matrix& f) {
  Response r;
  law.tangent(std::span<const double, 9>(f.data(), 9), 0.0, {}, std::span<double, 9>(r.stress.data(), 9),
              std::span<double, 81>(r.tangent.data(), 81));
  return r;
}
double energy(const Solid& law, const Matrix& f) {
  return law.energy_density(std::span<const double, 9>(f.data(), 9), {}).recoverable;
}

template <PointKind kind>
std::unique_ptr<Law<kind>> law_of(const std::string& name, std::vector<double> parameters) {
  return make_law<kind>({.name = "M", .law = name, .parameters = std::move(parameters), .location = {}});
}

Matrix random_gradient(std::mt19937& random, double size) {
  std::normal_distribution<double> normal;
  Matrix f;
  do {
    f = Matrix::Identity();
    for (int i = 0; i < 9; ++i) f(i / 3, i % 3) += size * normal(random);
  } while (f.determinant() < 0.4 || f.determinant() > 2.0);
  return f;
}

class SolidLaw : public ::testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<Solid> law() const { return law_of<PointKind::solid>(GetParam().law, GetParam().parameters); }
};

TEST_P(SolidLaw, UndeformedIsFreeOfStressAndEnergy) {
  const Response r = respond(*law(), Matrix::Identity());
  EXPECT_LT(r.stress.cwiseAbs().maxCoeff(), 1e-15 * r.tangent.cwiseAbs().maxCoeff());
  EXPECT_NEAR(energy(*law(), Matrix::Identity()), 0.0, 1e-15 * r.tangent.cwiseAbs().maxCoeff());
}

/// Small strains keep their digits: |P - D : E| of a strain 1e-8 is of second order plus round-off of F, no worse.
TEST_P(SolidLaw, SmallStrainsKeepTheirDigits) {
  const Response at_rest = respond(*law(), Matrix::Identity());
  std::mt19937 random(2);
  Matrix h = random_gradient(random, 1.0) - Matrix::Identity();
  const Matrix f = Matrix::Identity() + 1e-8 * h;
  h = f - Matrix::Identity();
  const Eigen::Matrix<double, 9, 1> linear = at_rest.tangent * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(h.data());
  const Matrix stress = respond(*law(), f).stress;
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(stress.data()[i], linear(i), 4e-15 * at_rest.tangent.cwiseAbs().maxCoeff());
}

TEST_P(SolidLaw, StressIsTheGradientOfTheEnergy) {
  std::mt19937 random(4);
  const auto law = this->law();
  for (int trial = 0; trial < 10; ++trial) {
    Matrix f = random_gradient(random, 0.2);
    const Response r = respond(*law, f);
    for (int i = 0; i < 9; ++i) {
      const double step = 1e-5, start = f.data()[i];
      f.data()[i] = start + step;
      const double plus = energy(*law, f);
      f.data()[i] = start - step;
      const double minus = energy(*law, f);
      f.data()[i] = start;
      EXPECT_NEAR((plus - minus) / (2 * step), r.stress.data()[i], 1e-7 * r.tangent.cwiseAbs().maxCoeff());
    }
  }
}

/// The error of a central difference falls with the square of its step; the tangent is symmetric.
TEST_P(SolidLaw, TangentIsTheDerivativeOfTheStress) {
  std::mt19937 random(6);
  const auto law = this->law();
  const Matrix f = random_gradient(random, 0.2), direction = random_gradient(random, 0.5);
  const Response r = respond(*law, f);
  const Eigen::Matrix<double, 9, 1> exact = r.tangent * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(direction.data());
  const auto error = [&](double step) {
    const Matrix difference =
        (respond(*law, f + step * direction).stress - respond(*law, f - step * direction).stress) / (2 * step);
    return (Eigen::Map<const Eigen::Matrix<double, 9, 1>>(difference.data()) - exact).norm();
  };
  EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 2.0, 0.1);
  EXPECT_LT((r.tangent - r.tangent.transpose()).cwiseAbs().maxCoeff(), 1e-13 * r.tangent.cwiseAbs().maxCoeff());
}

TEST_P(SolidLaw, IsObjective) {
  std::mt19937 random(8);
  const auto law = this->law();
  const Matrix f = random_gradient(random, 0.3);
  const Matrix q = Eigen::AngleAxisd(1.3, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Response r = respond(*law, f);
  EXPECT_LT((respond(*law, q * f).stress - q * r.stress).norm(), 1e-13 * r.tangent.norm());
}

/// Packs, scalars and duals give the same bits; the bounds cover the second variation for every direction.
TEST_P(SolidLaw, BatchEqualsScalarAndBoundsHold) {
  std::mt19937 random(9);
  const auto law = this->law();
  PointBatch<PointKind::solid> points;
  points.count = 64;
  std::vector<Matrix> gradients;
  for (int p = 0; p < points.count; ++p) {
    gradients.push_back(random_gradient(random, 0.05 * (p % 8)));
    for (int i = 0; i < 9; ++i) points.strain[i][p] = gradients[p].data()[i];
  }
  law->stress(points);
  for (int p = 0; p < points.count; ++p) {
    const Response r = respond(*law, gradients[p]);
    for (int i = 0; i < 9; ++i) EXPECT_EQ(std::memcmp(&points.stress[i][p], &r.stress.data()[i], sizeof(double)), 0);
    const Matrix inverse_transposed = gradients[p].inverse().transpose();
    const Eigen::Map<const Eigen::Matrix<double, 9, 1>> t(inverse_transposed.data());
    const Eigen::Matrix<double, 9, 9> slack = points.volumetric_modulus[p] * t * t.transpose() +
                                              2.0 * points.shear_modulus[p] * Eigen::Matrix<double, 9, 9>::Identity() -
                                              r.tangent;
    const double least = symmetric_eigenvalues(slack)(0);
    EXPECT_GE(least, -1e-9 * r.tangent.norm()) << "point " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SolidLaw, ::testing::ValuesIn(solid_cases()));

/// Uniaxial stretch with free sides: nominal stress 2 (l - l^-2)(C10 + C01 / l), VERIFY UNIAX (bulk modulus 1e5 shear
/// moduli).
TEST(MaterialLaw, UniaxialRubber) {
  struct Row {
    std::string law;
    std::vector<double> parameters;
    double stretch, nominal;
  };
  for (const Row& row :
       {Row{"neo-hooke", {0.5, 2e-5}, 1.5, 1.05556}, Row{"neo-hooke", {0.5, 2e-5}, 0.7, -1.34082},
        Row{"mooney-rivlin", {0.4, 0.1, 2e-5}, 1.5, 0.98519}, Row{"mooney-rivlin", {0.4, 0.1, 2e-5}, 0.7, -1.45574}}) {
    const auto line = law_of<PointKind::line>(row.law, row.parameters);
    const double strain[1] = {0.5 * (row.stretch * row.stretch - 1.0)};
    double stress[1], tangent[1];
    line->tangent(strain, 0.0, {}, stress, tangent);
    EXPECT_NEAR(stress[0] * row.stretch, row.nominal, 1e-4 * std::abs(row.nominal)) << row.law << row.stretch;

    // The same by the solid form: the transverse stretch that frees the sides, by bisection.
    const auto solid = law_of<PointKind::solid>(row.law, row.parameters);
    double low = 0.5, high = 1.5;
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      const Matrix f = Eigen::Vector3d(row.stretch, middle, middle).asDiagonal();
      (respond(*solid, f).stress(1, 1) > 0.0 ? high : low) = middle;
    }
    const Matrix f = Eigen::Vector3d(row.stretch, low, low).asDiagonal();
    EXPECT_NEAR(respond(*solid, f).stress(0, 0), stress[0] * row.stretch, 1e-9 * std::abs(row.nominal));
    EXPECT_NEAR(line->transverse_stretch(strain, {}), low * low, 1e-9);  // of the area
  }
}

/// Plane forms: energy, tangent and bound; the stress is that of the solid whose thickness frees it.
TEST(MaterialLaw, PlaneFormsAreConsistent) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const std::vector<Case> cases = {{"elastic", {1000.0, 0.3}},
                                   {"lamina", {100.0, 5.0, 0.3, 4.0, 4.0, 3.0}},
                                   {"neo-hooke", {0.5, 0.05}},
                                   {"neo-hooke", {0.5, 1.0}},
                                   {"mooney-rivlin", {0.4, 0.1, 0.0}},
                                   {"engineering-constants", {100.0, 20.0, 10.0, 0.3, 0.25, 0.4, 8.0, 7.0, 5.0}}};
  for (const Case& c : cases) {
    const MaterialLaw* entry = find_material_law(c.law);
    const auto law = law_of<PointKind::plane>(c.law, c.parameters);
    const bool rubber = entry->keyword == "HYPERELASTIC";
    PointBatch<PointKind::plane> points;
    points.count = 64;
    for (int p = 0; p < 64; ++p) {
      const double size = (rubber ? 0.06 : 0.01) * (p % 8);
      for (int i = 0; i < 3; ++i)
        points.strain[i][p] = size * uniform(random) + (rubber && p > 40 && i < 2 ? 1.5 : 0.0);
    }
    law->stress(points);
    for (int p = 0; p < 64; ++p) {
      std::array<double, 3> strain{points.strain[0][p], points.strain[1][p], points.strain[2][p]}, stress;
      Eigen::Matrix<double, 3, 3, Eigen::RowMajor> tangent;
      const std::span<double, 9> tangent_span(tangent.data(), 9);
      law->tangent(strain, 0.0, {}, stress, tangent_span);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(std::memcmp(&stress[i], &points.stress[i][p], sizeof(double)), 0) << c.law;
      EXPECT_LT((tangent - tangent.transpose()).norm(), 1e-12 * tangent.norm()) << c.law;
      for (int i = 0; i < 3; ++i) {
        const double step = 1e-5, start = strain[i];
        std::array<double, 3> plus, minus, ignored;
        strain[i] = start + step;
        const double more = law->energy_density(strain, {}).recoverable;
        law->tangent(strain, 0.0, {}, plus, tangent_span);
        strain[i] = start - step;
        const double less = law->energy_density(strain, {}).recoverable;
        law->tangent(strain, 0.0, {}, minus, tangent_span);
        strain[i] = start;
        law->tangent(strain, 0.0, {}, ignored, tangent_span);
        EXPECT_NEAR((more - less) / (2 * step), stress[i], 1e-7 * tangent.norm()) << c.law;
        for (int j = 0; j < 3; ++j)
          EXPECT_NEAR((plus[j] - minus[j]) / (2 * step), tangent(j, i), 1e-6 * tangent.norm()) << c.law;
      }
      // dE : dE counts E12 twice: in Mandel's components the bound is an eigenvalue.
      const Eigen::Vector3d scale(1.0, 1.0, std::sqrt(2.0));
      const Eigen::Matrix3d mandel = scale.asDiagonal() * tangent * scale.asDiagonal();
      const double largest =
          symmetric_eigenvalues(0.5 * (mandel + mandel.transpose()))(2);
      EXPECT_LE(largest, 2.0 * points.shear_modulus[p] * (1 + 1e-12)) << c.law << " " << p;
      if (!rubber) {
        EXPECT_NEAR(largest, 2.0 * points.shear_modulus[p], 1e-12 * largest) << c.law;
      }
      if (!rubber) continue;
      const double thickness = law->transverse_stretch(strain, {});
      Eigen::Matrix2d right;
      right << 1 + 2 * strain[0], strain[2], strain[2], 1 + 2 * strain[1];
      Matrix f = Matrix::Zero();
      f.topLeftCorner<2, 2>() = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(right).operatorSqrt();
      f(2, 2) = thickness;
      const Response solid = respond(*law_of<PointKind::solid>(c.law, c.parameters), f);
      EXPECT_NEAR(solid.stress(2, 2), 0.0, 1e-12 * solid.tangent.norm()) << c.law;
      const Matrix second = f.inverse() * solid.stress;
      EXPECT_NEAR(second(0, 0), stress[0], 1e-12 * solid.tangent.norm()) << c.law;
      EXPECT_NEAR(second(0, 1), stress[2], 1e-12 * solid.tangent.norm()) << c.law;
    }
  }
}

/// At rest the plane bound of rubber is sharp: E / (1 - nu), by biaxial strain; that of a line is E / 2 per half.
TEST(MaterialLaw, ThinBoundsAreSharpAtRest) {
  const auto plane = law_of<PointKind::plane>("neo-hooke", {0.5, 2e-6});
  PointBatch<PointKind::plane> points{};
  points.count = 8;
  plane->stress(points);
  EXPECT_NEAR(2.0 * points.shear_modulus[0], 6.0, 1e-4);  // E / (1 - nu) = 3 mu / 0.5, mu = 1
  const auto line = law_of<PointKind::line>("mooney-rivlin", {0.4, 0.1, 2e-6});
  PointBatch<PointKind::line> fibre{};
  fibre.count = 8;
  line->stress(fibre);
  EXPECT_NEAR(2.0 * fibre.shear_modulus[0], 3.0, 1e-4);
}

TEST(MaterialLaw, LaminaStiffness) {
  std::array<double, 9> q;
  find_material_law("lamina")->lamina_stiffness(std::vector<double>{100.0, 5.0, 0.3, 4.0, 0.0, 0.0}, q);
  const double reduced = 1.0 - 0.3 * 0.3 * 5.0 / 100.0;  // Jones, Mechanics of Composite Materials, eq. 2.61
  EXPECT_NEAR(q[0], 100.0 / reduced, 1e-12);
  EXPECT_NEAR(q[1], 0.3 * 5.0 / reduced, 1e-13);
  EXPECT_NEAR(q[4], 5.0 / reduced, 1e-13);
  EXPECT_EQ(q[8], 4.0);
  EXPECT_EQ(q[2], 0.0);
}

TEST(MaterialLaw, IndefiniteStiffnessIsRefused) {
  EXPECT_THROW(law_of<PointKind::plane>("lamina", {1.0, 100.0, 0.3, 1.0, 1.0, 1.0}), InputError);
  EXPECT_THROW(law_of<PointKind::solid>("engineering-constants", {1, 1, 1, 0.9, 0.9, 0.9, 1, 1, 1}),
               InputError);
}

TEST(MaterialLaw, RegisterListsEveryLawByName) {
  const auto laws = material_laws();
  EXPECT_GE(laws.size(), 6u);
  for (std::size_t i = 1; i < laws.size(); ++i) EXPECT_LT(laws[i - 1]->name, laws[i]->name);
  EXPECT_EQ(find_material_law("granite"), nullptr);
  EXPECT_EQ(find_material_law("lamina")->solid, nullptr);
}

TEST(Registers, TakeANameOnce) {
  EXPECT_THROW(RegisterLaw({.name = "lamina"}), std::logic_error);
  EXPECT_THROW(RegisterOption({.name = "plastic"}), std::logic_error);
  EXPECT_THROW(RegisterElement({.name = "C3D8R"}), std::logic_error);
}

TEST(InverseCubeRoot, AccurateToRoundOffAndEqualInPacks) {
  alignas(64) double x[pack_size], y[pack_size];
  for (double value = 0.05; value < 20.0; value *= 1.01) {
    const double root = inverse_cube_root(value);
    EXPECT_NEAR(root * std::cbrt(value), 1.0, 6e-16) << value;
    std::fill(x, x + pack_size, value);
    store(inverse_cube_root(load(x)), y);
    EXPECT_EQ(std::memcmp(&y[3], &root, sizeof(double)), 0);
  }
  EXPECT_EQ(inverse_cube_root(1.0), 1.0);
}

}  // namespace

}  // namespace balocco::test
