#include "elements/solids/solid_output.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "elements/plastic_strain.hpp"

namespace balocco {

namespace {

constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

void copy_symmetric(const Eigen::Matrix3d& tensor, double shear_factor, std::span<double> values) {
  for (int a = 0; a < 6; ++a) values[a] = (a < 3 ? 1.0 : shear_factor) * tensor(voigt[a][0], voigt[a][1]);
}

Eigen::Matrix3d as_eigen(const Matrix3<double>& m) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.component.data());
}

/// ln V = sum ln(stretch) n (x) n over the eigenvectors of F F^T.
Eigen::Matrix3d logarithmic_strain(const Eigen::Matrix3d& f) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> left(f * f.transpose());
  const Eigen::Vector3d logarithms = 0.5 * left.eigenvalues().array().log();
  return left.eigenvectors() * logarithms.asDiagonal() * left.eigenvectors().transpose();
}

Eigen::Matrix3d cauchy_stress(const SolidMaterial& material, const Matrix3<double>& f,
                              std::span<const double> law_history) {
  Matrix3<double> piola;
  std::vector<double> history(law_history.begin(), law_history.end());
  material.law->tangent(f.component, 0.0, history, piola.component, {});
  return as_eigen(piola) * as_eigen(f).transpose() / as_eigen(f).determinant();
}

/// PE of a metal, in global directions.
std::array<double, 6> plastic_strain_of(const SolidMaterial& material, const Matrix3<double>& f, std::span<const double> law_history) {
  std::array<double, 6> strain, stress;
  copy_symmetric(logarithmic_strain(as_eigen(f)), 2.0, strain);
  if (const int row = history_scalar(*material.law, "THE"); row >= 0)
    for (int a = 0; a < 3; ++a) strain[a] -= std::log1p(law_history[row]);
  copy_symmetric(cauchy_stress(material, f, law_history), 1.0, stress);
  const double lame = material.stiffness[1], shear = material.stiffness[21];
  return plastic_strain(strain, stress, shear * (3.0 * lame + 2.0 * shear) / (lame + shear), 0.5 * lame / (lame + shear));
}

}  // namespace

int solid_output_components(const SolidMaterial& material, std::string_view variable) {
  if (variable == "S" || variable == "LE" || variable == "E") return 6;
  if (variable == "PE") return history_scalar(*material.law, "PEEQ") >= 0 ? 6 : 0;
  if (variable == "MISES" || variable == "PRESS" || variable == "SENER") return 1;
  return history_scalar(*material.law, variable) >= 0 ? 1 : 0;
}

void solid_output(std::string_view variable, const SolidMaterial& material, const Matrix3<double>& deformation_gradient,
                  std::span<const double> law_history, std::span<double> values) {
  if (variable == "SENER") {
    values[0] = material.law->energy_density(deformation_gradient.component, law_history).recoverable;
  } else if (const int row = history_scalar(*material.law, variable); row >= 0) {
    values[0] = law_history[row];
  } else if (variable == "E") {
    const Eigen::Matrix3d f = as_eigen(deformation_gradient);
    copy_symmetric(0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity()), 2.0, values);
  } else if (variable == "LE") {
    copy_symmetric(logarithmic_strain(as_eigen(deformation_gradient)), 2.0,
                   values);  // shear as 2 LE12, as Abaqus writes it
  } else if (variable == "PE") {
    std::ranges::copy(plastic_strain_of(material, deformation_gradient, law_history), values.begin());
  } else {
    const Eigen::Matrix3d stress = cauchy_stress(material, deformation_gradient, law_history);
    const double mean = stress.trace() / 3.0;
    if (variable == "S") copy_symmetric(stress, 1.0, values);
    if (variable == "PRESS") values[0] = -mean;
    if (variable == "MISES") values[0] = std::sqrt(1.5) * (stress - mean * Eigen::Matrix3d::Identity()).norm();
  }
}

}  // namespace balocco
