// Every law with memory, by one table of tests at a single point, and metals against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "materials/initial_stress.hpp"
#include "materials/material_option.hpp"
#include "materials/rubber_stability.hpp"
#include "model/diagnostics.hpp"
#include "steel.hpp"
#include "symmetric_eigenvalues.hpp"

namespace balocco::test {

namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Tangent = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

struct Subject {
  std::string name;
  Material material;
  double size;       // of the strains it is driven to
  double duration;   // of the path; quasi_static: no rates
  std::vector<double> initial_stress{};
};
std::ostream& operator<<(std::ostream& out, const Subject& s) { return out << s.name; }
MaterialOption chaboche() { return {"plastic-combined", {2.0}, {{0.3, 20.0, 100.0, 2.0, 5.0}}}; }

Material rubber(const std::string& law, std::vector<double> parameters, std::vector<MaterialOption> options = {}) {
  return {.name = "RUBBER", .law = law, .parameters = std::move(parameters), .options = std::move(options), .location = {}};
}
MaterialOption prony() { return {"prony", {}, {{0.3, 0.0, 1e-3}, {0.2, 0.0, 1e-2}}}; }

std::vector<Subject> subjects() {
  const std::vector<double> initial_stress{0.15, -0.05, 0.05, 0.05, -0.05, 0.04};
  return {
      {"isotropic", steel({table()}), 0.05, quasi_static},
      {"perfect", steel({{"plastic", {0.0}, {{0.4, 0.0}}}}), 0.05, quasi_static},
      {"kinematic", steel({{"plastic-kinematic", {}, {{0.4, 0.0}, {0.6, 0.1}}}}), 0.05, quasi_static},
      {"combined", steel({chaboche(), {"cyclic-hardening", {}, {{0.3, 0.1, 20.0}}}}), 0.05, quasi_static},
      {"power-law", steel({table(), {"rate-power-law", {}, {{40.0, 5.0}}}}), 0.05, 1e-3},
      {"johnson-cook", steel({{"plastic-johnson-cook", {}, {{0.4, 0.3, 0.3}}}, {"rate-johnson-cook", {}, {{0.02, 1.0}}}}),
       0.05, 1e-3},
      {"yeoh", rubber("yeoh", {0.5, -0.05, 0.01, 0.05, 0.0, 0.0}), 0.5, quasi_static},
      {"polynomial", rubber("polynomial-2", {0.4, 0.1, 0.02, 0.01, -0.005, 0.05, 0.3}), 0.4, quasi_static},
      {"ogden", rubber("ogden-2", {0.8, 2.5, -0.1, -1.5, 0.05, 0.0}), 0.5, quasi_static},
      {"hyperfoam", rubber("hyperfoam-2", {0.8, 4.5, 0.2, -2.5, 0.1, 0.0}), 0.5, quasi_static},
      {"relaxing-elastic", rubber("elastic", {3.0, 0.45}, {prony()}), 0.3, 5e-3},
      {"relaxing-neo-hooke", rubber("neo-hooke", {0.5, 0.05}, {prony()}), 0.3, 5e-3},
      {"relaxing-ogden", rubber("ogden-1", {1.0, 3.0, 0.05}, {prony()}), 0.3, 5e-3},
      {"rate-table", steel({table(), {"plastic", {100.0}, {{0.6, 0.0}, {0.9, 0.5}}}}), 0.05, 1e-3},
      {"stressed-isotropic", steel({table()}), 0.05, quasi_static, initial_stress},
      {"stressed-combined", steel({chaboche()}), 0.05, quasi_static, initial_stress},
      {"stressed-ogden", rubber("ogden-2", {0.8, 2.5, -0.1, -1.5, 0.05, 0.0}), 0.5, quasi_static, initial_stress},
  };
}

/// A point of a law that is driven along a path.
template <PointKind kind>
struct Driven {
  static constexpr int n = strain_size(kind);
  std::unique_ptr<Law<kind>> law;
  std::vector<double> history;

  explicit Driven(const Material& material) : law(make_law<kind>(material)), history(law->history_size(), 0.0) {}
  explicit Driven(const Subject& subject) : Driven(subject.material) {
    if (subject.initial_stress.empty()) return;
    law = initially_stressed(std::move(law));
    history.assign(law->history_size(), 0.0);
    std::ranges::copy(subject.initial_stress, history.begin() + field_row(*law, "S0"));
  }

  using Stress = Eigen::Matrix<double, n, 1>;
  Stress move(const double* strain, double increment, double* stiffness = nullptr) {
    Stress stress;
    law->tangent(std::span<const double, n>(strain, n), increment, history, std::span<double, n>(stress.data(), n),
                 stiffness == nullptr ? std::span<double>() : std::span<double>(stiffness, n * n));
    return stress;
  }
  Stress trial(const double* strain, double increment, double* stiffness = nullptr) {
    const std::vector<double> saved = history;
    const Stress stress = move(strain, increment, stiffness);
    history = saved;
    return stress;
  }
};

Matrix random_direction(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Matrix h;
  for (int i = 0; i < 9; ++i) h.data()[i] = normal(random);
  return h / h.norm();
}

/// Two legs that do not commute: I -> I + size A -> I + size (A + B).
Matrix path(const Subject& s, double t) {
  const Matrix a = random_direction(3), b = random_direction(5);
  return Matrix::Identity() + s.size * (std::min(t, 0.5) * 2.0 * a + std::max(t - 0.5, 0.0) * 2.0 * b);
}

class LawTable : public ::testing::TestWithParam<Subject> {};

TEST_P(LawTable, TangentIsTheDerivativeAndScalarEqualsPack) {
  const Subject& s = GetParam();
  const Matrix undeformed = Matrix::Identity();
  Driven<PointKind::solid> point(s), still(s);
  PointBatch<PointKind::solid> batch;
  batch.count = pack_size;
  std::vector<double> histories(point.history.size() * pack_size);
  for (std::size_t i = 0; i < histories.size(); ++i) histories[i] = point.history[i / pack_size];
  batch.history = histories.data();
  batch.history_stride = pack_size;
  constexpr int steps = 10;
  batch.increment = s.duration / steps;
  for (int i = 1; i <= steps; ++i) {
    const Matrix f = path(s, static_cast<double>(i) / steps), direction = random_direction(7);
    Tangent tangent;
    const auto with = point.trial(f.data(), s.duration / steps, tangent.data());
    const Vector9 exact = tangent * Eigen::Map<const Vector9>(direction.data());
    const auto error = [&](double h) {
      const Matrix plus = f + h * direction, minus = f - h * direction;
      const Vector9 difference = (point.trial(plus.data(), s.duration / steps) -
                                  point.trial(minus.data(), s.duration / steps)) / (2.0 * h);
      return (difference - exact).norm() / tangent.norm();
    };
    EXPECT_LT(error(1e-6), 1e-6) << i;

    for (int lane = 0; lane < pack_size; ++lane) {  // only half of the lanes follow the path
      for (int k = 0; k < 9; ++k) batch.strain[k][lane] = lane % 2 == 0 ? f.data()[k] : (k % 4 == 0 ? 1.0 : 0.0);
    }
    point.law->stress(batch);
    still.move(undeformed.data(), s.duration / steps);
    const auto stress = point.move(f.data(), s.duration / steps);
    EXPECT_EQ(std::memcmp(stress.data(), with.data(), sizeof stress), 0);
    for (int k = 0; k < 9; ++k) EXPECT_EQ(batch.stress[k][2], stress[k]) << "step " << i;
    for (std::size_t k = 0; k < point.history.size(); ++k) {
      EXPECT_EQ(histories[k * pack_size + 2], point.history[k]) << "row " << k;
      EXPECT_EQ(histories[k * pack_size + 1], still.history[k]);
    }
    const auto again = point.trial(f.data(), 0.0);
    EXPECT_LT((again - stress).norm(), 1e-11 * tangent.norm()) << "zero increment";

    const Matrix inverse = f.inverse().transpose();  // the bound covers the tangent
    const Eigen::Map<const Vector9> t(inverse.data());
    const Tangent slack = batch.volumetric_modulus[2] * t * t.transpose() +
                          2.0 * batch.shear_modulus[2] * Tangent::Identity() - 0.5 * (tangent + tangent.transpose());
    EXPECT_GE(symmetric_eigenvalues(slack)(0), -1e-9 * tangent.norm()) << i;
  }
}

TEST_P(LawTable, IsObjectiveAndWorkIsStoredOrDissipated) {
  const Subject& s = GetParam();
  const Matrix q = Eigen::AngleAxisd(1.3, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const auto gap = [&](int steps) {
    Driven<PointKind::solid> point(s), turned(s);
    double work = 0.0, largest = 0.0;
    Matrix last = Matrix::Identity();
    Vector9 last_stress = point.trial(last.data(), 0.0);
    const double at_first = point.law->energy_density(std::span<const double, 9>(last.data(), 9), point.history).recoverable;
    for (int i = 1; i <= steps; ++i) {
      const Matrix f = path(s, static_cast<double>(i) / steps), qf = q * f;
      const Vector9 stress = point.move(f.data(), s.duration / steps);
      const Vector9 other = turned.move(qf.data(), s.duration / steps);
      const Matrix rotated = q * Eigen::Map<const Matrix>(stress.data());
      largest = std::max(largest, stress.norm());
      EXPECT_LT((Eigen::Map<const Matrix>(other.data()) - rotated).norm(), 1e-9 * largest);
      const Matrix step = f - last;
      work += 0.5 * (stress + last_stress).dot(Eigen::Map<const Vector9>(step.data()));
      last = f;
      last_stress = stress;
    }
    const EnergyDensity e = point.law->energy_density(std::span<const double, 9>(last.data(), 9), point.history);
    EXPECT_GE(e.plastic + e.viscous, 0.0);
    return std::fabs(work + at_first - e.recoverable - e.plastic - e.viscous) / work;
  };
  const double coarse = gap(100), fine = gap(400);
  EXPECT_LT(fine, 2e-3);
  EXPECT_LT(fine, 0.5 * coarse + 1e-6);
}

TEST_P(LawTable, BeginsWithItsInitialStress) {
  const Subject& s = GetParam();
  if (s.initial_stress.empty()) return;
  const auto& stress = s.initial_stress;
  const Matrix q = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  Matrix expected;
  expected << stress[0], stress[3], stress[4], stress[3], stress[1], stress[5], stress[4], stress[5], stress[2];
  const auto at_rest = Driven<PointKind::solid>(s).move(q.data(), s.duration);  // as of other material axes
  EXPECT_LT((Eigen::Map<const Matrix>(at_rest.data()) - q * expected).norm(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(All, LawTable, ::testing::ValuesIn(subjects()));

double yield_of_table(double p) {
  const double rows[4][2] = {{0.4, 0.0}, {0.5, 0.02}, {0.6, 0.1}, {0.7, 0.5}};
  for (int i = 1; i < 4; ++i)
    if (p < rows[i][1])
      return rows[i - 1][0] + (rows[i][0] - rows[i - 1][0]) * (p - rows[i - 1][1]) / (rows[i][1] - rows[i - 1][1]);
  return 0.7;
}

/// Kirchhoff stress tau of uniaxial stress at logarithmic strain e: tau = yield(e - tau / E).
double uniaxial(double strain) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high), p = strain - middle / 200.0;
    (p > 0.0 && middle > yield_of_table(p) ? high : low) = middle;
  }
  return low;
}

/// Pulled to 100 % true strain in one increment or in hundred: the closed form, in each form of the law.
TEST(Metal, PulledToTheDoubleIsTheClosedForm) {
  for (const int steps : {1, 100}) {
    Driven<PointKind::line> line(steel({table()}));
    Driven<PointKind::fibre> fibre(steel({table()}));
    Driven<PointKind::plane> plane(steel({table()}));
    Driven<PointKind::solid> solid(steel({table()}));
    for (int i = 1; i <= steps; ++i) {
      const double e = static_cast<double>(i) / steps, tau = uniaxial(e), across = -0.5 * (e - tau / 200.0) - 0.3 * tau / 200.0;
      const double c = std::exp(2.0 * e), lateral = std::exp(2.0 * across);
      const double strain[3] = {0.5 * (c - 1.0), 0.5 * (lateral - 1.0), 0.0}, fibre_strain[2] = {strain[0], 0.0};
      EXPECT_NEAR(line.move(strain, quasi_static)[0] * c, tau, 1e-10);
      const auto of_fibre = fibre.move(fibre_strain, quasi_static);
      EXPECT_NEAR(of_fibre[0] * c, tau, 1e-10);
      EXPECT_NEAR(of_fibre[1], 0.0, 1e-12);
      const auto of_plane = plane.move(strain, quasi_static);
      EXPECT_NEAR(of_plane[0] * c, tau, 1e-10);
      EXPECT_NEAR(of_plane[1] * lateral, 0.0, 1e-10);
      const Matrix f = Eigen::Vector3d(std::sqrt(c), std::sqrt(lateral), std::sqrt(lateral)).asDiagonal();
      const auto of_solid = solid.move(f.data(), quasi_static);
      EXPECT_NEAR(of_solid[0] * std::sqrt(c), tau, 1e-10);
      EXPECT_NEAR(of_solid[4], 0.0, 1e-10);
      EXPECT_NEAR(line.law->transverse_stretch(std::span<const double, 1>(strain, 1), line.history), lateral, 1e-10);
    }
    EXPECT_NEAR(solid.history[history_scalar(*solid.law, "PEEQ")], 1.0 - uniaxial(1.0) / 200.0, 1e-12);
  }
}

/// Chaboche: tension, then compression; at plastic strain p sigma = yield + sum C/gamma (1 - exp(-gamma p)), exact for
/// any increment.
TEST(Metal, BackStressesSaturateExactly) {
  Driven<PointKind::line> line(steel({chaboche()}));
  const double p = 0.03, back = 0.2 * (1.0 - std::exp(-100.0 * p)) + 0.4 * (1.0 - std::exp(-5.0 * p));
  const double tau = 0.3 + back, e = p + tau / 200.0, strain = 0.5 * (std::exp(2.0 * e) - 1.0);
  EXPECT_NEAR(line.move(&strain, quasi_static)[0] * std::exp(2.0 * e), tau, 1e-10);
  const double after = 0.2 * (1.0 - std::exp(-100.0 * p)) * std::exp(-100.0 * p) - 0.2 * (1.0 - std::exp(-100.0 * p)) +
                       0.4 * (1.0 - std::exp(-5.0 * p)) * std::exp(-5.0 * p) - 0.4 * (1.0 - std::exp(-5.0 * p));
  const double reversed = after - 0.3, back_strain = 0.5 * (std::exp(2.0 * (reversed / 200.0)) - 1.0);
  EXPECT_NEAR(line.move(&back_strain, quasi_static)[0] * std::exp(2.0 * reversed / 200.0), reversed, 1e-10);
}

/// At a steady plastic rate r the stress is the table's times 1 + (r / D)^(1/n).
TEST(Metal, PowerLawRaisesTheYieldStress) {
  Driven<PointKind::line> line(steel({{"plastic", {0.0}, {{0.4, 0.0}}}, {"rate-power-law", {}, {{40.0, 5.0}}}}));
  const double rate = 100.0, increment = 1e-6;
  double tau = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double e = rate * increment * i, strain = 0.5 * (std::exp(2.0 * e) - 1.0);
    tau = line.move(&strain, increment)[0] * std::exp(2.0 * e);
  }
  EXPECT_NEAR(tau, 0.4 * (1.0 + std::pow(rate / 40.0, 0.2)), 1e-6);
}

/// VERIFY UNIAX, bulk modulus 1e5 shear moduli: nominal stress 2 (l - l^-2) W'(I1); Ogden with alpha = 2 is neo-Hooke.
TEST(Rubber, UniaxialIsTheClosedForm) {
  struct Row {
    Material material;
    double stretch, nominal;
  };
  for (const Row& row : {Row{rubber("yeoh", {0.5, -0.05, 0.01, 2e-5, 0.0, 0.0}), 1.5, 0.95396},
                         Row{rubber("yeoh", {0.5, -0.05, 0.01, 2e-5, 0.0, 0.0}), 0.7, -1.25742},
                         Row{rubber("ogden-1", {1.0, 2.0, 2e-5}), 1.5, 1.05556},
                         Row{rubber("polynomial-1", {0.4, 0.1, 2e-5}), 0.7, -1.45574},
                         Row{rubber("reduced-polynomial-2", {0.5, -0.05, 2e-5, 0.0}), 1.0, 0.0}}) {
    Driven<PointKind::line> line(row.material);
    const double strain = 0.5 * (row.stretch * row.stretch - 1.0);
    EXPECT_NEAR(line.move(&strain, quasi_static)[0] * row.stretch, row.nominal, 1e-4) << row.material.law << row.stretch;
  }
}

/// A sudden shear held: stress over the first is 1 - sum g (1 - exp(-t / tau)); the first one is that of the
/// instantaneous modulus, which MODULI chooses; statics give the long term at once.
TEST(Rubber, RelaxationIsTheClosedForm) {
  for (const bool instantaneous : {false, true}) {
    Material material = rubber("neo-hooke", {0.5, 0.05}, {prony()});
    material.instantaneous = instantaneous;
    Driven<PointKind::solid> point(material), slow(material);
    Matrix f = Matrix::Identity();
    f(0, 1) = 0.1;
    const double first = point.move(f.data(), 1e-12)[1];
    EXPECT_NEAR(first, (instantaneous ? 1.0 : 2.0) * 0.1, 1e-8);
    double now = 0.0;
    for (int i = 0; i < 10; ++i) now = point.move(f.data(), 5e-4)[1];
    const double t = 5e-3;
    EXPECT_NEAR(now / first, 1.0 - 0.3 * (1.0 - std::exp(-t / 1e-3)) - 0.2 * (1.0 - std::exp(-t / 1e-2)), 1e-8);
    EXPECT_NEAR(slow.move(f.data(), quasi_static)[1] / first, 0.5, 1e-8);
    const EnergyDensity e = point.law->energy_density(std::span<const double, 9>(f.data(), 9), point.history);
    EXPECT_NEAR(e.recoverable + e.viscous, 0.5 * first * 0.1, 1e-3 * first);
  }
}

/// Round a square of two strains, in each sense: where nothing relaxes, or all at once, the work is nil; what is dissipated only grows,
/// and no more is stored than was put in.
TEST(Rubber, RelaxationTakesEnergyAlone) {
  const std::array<std::pair<const char*, std::vector<double>>, 3> laws{
      {{"elastic", {3.0, 0.3}}, {"neo-hooke", {0.5, 0.2}}, {"ogden-1", {1.0, 3.0, 0.2}}}};
  for (const auto& [law, parameters] : laws)
    for (const double time : {1e5, 1e-6, 0.3})
      for (const bool turned : {false, true}) {
        Driven<PointKind::solid> point(rubber(law, parameters, {{"prony", {}, {{0.4, 0.0, time}, {0.2, 0.0, 2.0 * time}}}}));
        Matrix last = Matrix::Identity();
        Vector9 before = Vector9::Zero();
        double work = 0.0, viscous = 0.0, most = 0.0;
        constexpr int steps = 4000;
        for (int i = 1; i <= steps; ++i) {
          const double t = 4.0 * i / steps, first = std::clamp(std::min(t, 3.0 - t), 0.0, 1.0), second = std::clamp(std::min(t - 1.0, 4.0 - t), 0.0, 1.0);
          Matrix f = Matrix::Identity();
          f(0, 2) = 0.4 * (turned ? second : first);
          f(2, 2) -= 0.3 * (turned ? first : second);
          const Vector9 stress = point.move(f.data(), 4.0 / steps);
          const Matrix step = f - last;
          work += 0.5 * (stress + before).dot(Eigen::Map<const Vector9>(step.data()));
          const EnergyDensity e = point.law->energy_density(std::span<const double, 9>(f.data(), 9), point.history);
          EXPECT_GE(e.viscous, viscous);
          most = std::max(most, e.recoverable);
          EXPECT_LT(e.recoverable, work + 1e-4 * most);
          viscous = e.viscous;
          last = f;
          before = stress;
        }
        const EnergyDensity e = point.law->energy_density(std::span<const double, 9>(last.data(), 9), point.history);
        EXPECT_NEAR(work, e.recoverable + viscous, 1e-3 * most) << law << " " << time << " " << turned;
        if (time == 0.3) EXPECT_GT(work, 0.1 * most);
        else EXPECT_NEAR(work, 0.0, 1e-3 * most) << law << " " << time << " " << turned;
        EXPECT_TRUE(time < 1e5 || viscous < 1e-4 * most) << law;
      }
}

TEST(Rubber, UnstableCoefficientsAreTold) {
  const auto warn = [](const Material& m) { return unstable_range(*make_law<PointKind::solid>(m)); };
  EXPECT_EQ(warn(rubber("yeoh", {0.5, 0.0, 0.0, 0.05, 0.0, 0.0})), "");
  EXPECT_EQ(warn(rubber("ogden-1", {1.0, 2.0, 0.05})), "");
  EXPECT_NE(warn(rubber("yeoh", {0.5, -0.1, 0.0, 0.05, 0.0, 0.0})).find("uniaxial tension beyond"), std::string::npos);
}

/// Condensed thin forms equal those written by hand.
TEST(Rubber, CondensedFormsAreTheHandWritten) {
  const double strain[3] = {0.3, -0.1, 0.2};
  Driven<PointKind::plane> hand(rubber("mooney-rivlin", {0.4, 0.1, 0.05})), condensed(rubber("polynomial-1", {0.4, 0.1, 0.05}));
  std::array<double, 9> a, b;
  const auto of_hand = hand.move(strain, 0.0, a.data()), of_condensed = condensed.move(strain, 0.0, b.data());
  EXPECT_LT((of_hand - of_condensed).norm(), 1e-12);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(a[i], b[i], 1e-11);
}

TEST(Metal, TablesThatMakeNoSenseAreRefused) {
  EXPECT_THROW(make_law<PointKind::solid>(steel({{"plastic", {0.0}, {{0.4, 0.1}}}})), InputError);
  EXPECT_THROW(make_law<PointKind::solid>(steel({{"plastic", {0.0}, {{0.4, 0.0}, {0.5, 0.0}}}})), InputError);
  EXPECT_THROW(make_law<PointKind::solid>(steel({{"plastic", {5.0}, {{0.4, 0.0}}}})), InputError);
  EXPECT_THROW(make_law<PointKind::solid>(steel({{"plastic-kinematic", {}, {{0.4, 0.0}}}})), InputError);
}

}  // namespace

}  // namespace balocco::test
