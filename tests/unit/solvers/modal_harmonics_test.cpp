#include "modal_harmonics.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "excitation_frequencies.hpp"

namespace balocco {
namespace {

using Complex = std::complex<double>;

ModalEquations two_modes() {
  return {Eigen::Vector2d(4.0, 9.0), Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
}

TEST(ModalHarmonics, CoupledModesObeyTheirEquations) {
  auto equations = two_modes();
  equations.damping << 0.1, 0.05, 0.05, 0.2;
  equations.structural << 0.02, 0.03;
  const Eigen::Vector2cd force(Complex(1.0, 2.0), Complex(-1.0, 0.5));
  const double omega = 2.5;
  const auto found = modal_harmonics(equations, omega, force);
  EXPECT_EQ(found.unbounded, -1);
  const Complex i(0.0, 1.0);
  for (int row = 0; row < 2; ++row) {
    Complex sum = (equations.stiffness[row] * (1.0 + i * equations.structural[row]) - omega * omega) * found.amplitude[row];
    for (int column = 0; column < 2; ++column) sum += i * omega * equations.damping(row, column) * found.amplitude[column];
    EXPECT_LT(std::abs(sum - force[row]), 1e-14);
  }
}

TEST(ModalHarmonics, AnUndampedModeAtItsOwnFrequencyHasNoBoundWhereSomethingExcitesIt) {
  auto equations = two_modes();
  EXPECT_EQ(modal_harmonics(equations, 2.0, Eigen::Vector2cd(1.0, 1.0)).unbounded, 0);
  const auto idle = modal_harmonics(equations, 2.0, Eigen::Vector2cd(0.0, 1.0));
  EXPECT_EQ(idle.unbounded, -1);
  EXPECT_EQ(idle.amplitude[0], 0.0);
  EXPECT_NEAR(idle.amplitude[1].real(), 0.2, 1e-15);
  // The same where a damper couples modes, of three the first two.
  ModalEquations three{Eigen::Vector3d(4.0, 9.0, 25.0), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  three.damping.topLeftCorner(2, 2) << 0.1, 0.05, 0.05, 0.2;
  EXPECT_EQ(modal_harmonics(three, 5.0, Eigen::Vector3cd(1.0, 1.0, 1.0)).unbounded, 2);
  const auto beside = modal_harmonics(three, 5.0, Eigen::Vector3cd(1.0, 1.0, 0.0));
  EXPECT_EQ(beside.unbounded, -1);
  EXPECT_LT(std::abs(beside.amplitude[2]), 1e-12);
}

TEST(ExcitationFrequencies, TouchingRangesAndClustersCountOnce) {
  SteadyStateProcedure procedure;
  procedure.logarithmic = false;
  procedure.ranges = {{1.0, 2.0, 3, 1.0}, {2.0, 4.0, 3, 1.0}, {4.0, 4.0}};
  const std::vector<double> eigenfrequencies{3.0, 3.0 + 1e-9, 0.5, 2.0};
  const auto found = excitation_frequencies(procedure, eigenfrequencies);
  const std::vector<double> wanted{1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0};
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-8);
}

}  // namespace
}  // namespace balocco
