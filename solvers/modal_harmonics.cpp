#include "modal_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace balocco {

namespace {

constexpr double nothing = 1e-12;   // of a mode's stiffness or inertia: what rounding leaves of their difference
constexpr double rigid = 1e-10;     // of the stiffest mode: what rounding leaves of a stiffness that a free motion has not
constexpr double excitation = 1e-6;  // of all forces: what rounding may leave of a force on a mode

/// Modes that nothing couples: one equation each.
ModalHarmonics solve_alone(const Eigen::VectorXcd& dynamic, const Eigen::VectorXcd& force) {
  ModalHarmonics found{Eigen::VectorXcd::Zero(force.size())};
  for (Eigen::Index mode = 0; mode < force.size(); ++mode) {
    if (std::abs(dynamic[mode]) > nothing)
      found.amplitude[mode] = force[mode] / dynamic[mode];
    else if (std::abs(force[mode]) > excitation * force.norm())
      found.unbounded = mode;
  }
  return found;
}

/// The real equations of real and imaginary parts: of complex products compilers make such as are rounded once. Where they are singular the
/// solution that leaves idle modes at rest, if there is one.
ModalHarmonics solve_coupled(const Eigen::MatrixXcd& dynamic, const Eigen::VectorXcd& force) {
  const Eigen::Index n = force.size();
  Eigen::MatrixXd matrix(2 * n, 2 * n);
  matrix << dynamic.real(), -dynamic.imag(), dynamic.imag(), dynamic.real();
  Eigen::VectorXd right(2 * n), solution;
  right << force.real(), force.imag();
  ModalHarmonics found;
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(matrix);
  if (factors.matrixLU().diagonal().cwiseAbs().minCoeff() > nothing) {
    solution = factors.solve(right);
  } else {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition(2 * n, 2 * n);
    decomposition.setThreshold(nothing);
    decomposition.compute(matrix);
    solution = decomposition.solve(right);
    Eigen::Index worst = 0;
    const double left = (right - matrix * solution).cwiseAbs().maxCoeff(&worst);
    if (left > excitation * right.norm()) found.unbounded = worst % n;
  }
  found.amplitude.resize(n);
  for (Eigen::Index mode = 0; mode < n; ++mode) found.amplitude[mode] = {solution[mode], solution[n + mode]};
  return found;
}

}  // namespace

ModalHarmonics modal_harmonics(const ModalEquations& equations, double omega, const Eigen::VectorXcd& force) {
  const std::complex<double> i(0.0, 1.0);
  Eigen::VectorXd k = equations.stiffness;
  const double least = rigid * k.cwiseAbs().maxCoeff();
  for (double& eigenvalue : k)
    if (std::abs(eigenvalue) < least) eigenvalue = 0.0;
  // Each mode is measured by what its stiffness or its inertia weighs, whichever is more.
  const double greatest = std::max(k.cwiseAbs().maxCoeff(), omega * omega);
  const Eigen::VectorXd scale = k.cwiseAbs().cwiseMax(omega * omega).cwiseMax(nothing * greatest).cwiseSqrt().cwiseInverse();
  const Eigen::VectorXcd diagonal = k.cast<std::complex<double>>() + i * k.cwiseProduct(equations.structural) -
                                    Eigen::VectorXcd::Constant(k.size(), omega * omega) + i * omega * equations.damping.diagonal();
  const Eigen::VectorXcd scaled_force = scale.cwiseProduct(force);
  ModalHarmonics found;
  if (equations.damping.isDiagonal(0.0)) {
    found = solve_alone(scale.cwiseAbs2().cwiseProduct(diagonal), scaled_force);
  } else {
    Eigen::MatrixXcd dynamic = i * omega * equations.damping;
    dynamic.diagonal() = diagonal;
    found = solve_coupled(scale.asDiagonal() * dynamic * scale.asDiagonal(), scaled_force);
  }
  found.amplitude = scale.cwiseProduct(found.amplitude);
  return found;
}

}  // namespace balocco
