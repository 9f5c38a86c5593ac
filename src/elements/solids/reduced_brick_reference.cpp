#include "elements/solids/reduced_brick_reference.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace balocco {

namespace {

using Matrix33 = Eigen::Matrix3d;
using Matrix66 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Gradients = Eigen::Matrix<double, 3, 7>;

constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

/// The strains of a class: two normal ones and the shear between them. Class 0 varies with zeta, 1 with eta, 2 with xi.
constexpr int class_strains[3][3] = {{0, 1, 3}, {0, 2, 4}, {1, 2, 5}};

/// Moduli in natural axes: S^ab = (A^a . e_i)(A^b . e_j) S_ij with the duals A^a of the columns of `axes`.
Matrix66 natural_compliance(const SolidMaterial& material, const Matrix33& axes) {
  const Matrix33 dual = axes.inverse();
  Matrix66 transform;
  for (int a = 0; a < 6; ++a) {
    const auto first = dual.row(voigt[a][0]), second = dual.row(voigt[a][1]);
    for (int b = 0; b < 6; ++b) {
      const int i = voigt[b][0], j = voigt[b][1];
      transform(a, b) = i == j ? first(i) * second(j) : first(i) * second(j) + first(j) * second(i);
    }
  }
  const Matrix66 stiffness = Eigen::Map<const Matrix66>(material.stiffness.data());
  return (transform * stiffness * transform.transpose()).inverse();
}

/// Largest eigenvalue of the stiffness on q, bounded by row sums in the orthonormal axes nearest the element's (exact
/// for boxes).
double hourglass_bound(const std::array<Matrix33, 3>& classes, const Eigen::Vector3d& last, const Matrix33& axes) {
  const Matrix33 local = Matrix33(Eigen::HouseholderQR<Matrix33>(axes).householderQ()).transpose() * axes;
  // Rows of a class's strains on (q1, q2, q3), in local components: c_i . q_a.
  static constexpr int mode[3][2] = {{1, 0}, {2, 0}, {2, 1}};  // modes of the two normal strains
  Eigen::Matrix<double, 9, 9> stiffness = Eigen::Matrix<double, 9, 9>::Zero();
  for (int c = 0; c < 3; ++c) {
    const int i = voigt[class_strains[c][2]][0], j = voigt[class_strains[c][2]][1];
    const int mode_i = mode[c][0], mode_j = mode[c][1];
    Eigen::Matrix<double, 3, 9> strain = Eigen::Matrix<double, 3, 9>::Zero();
    strain.block<1, 3>(0, 3 * mode_i) = local.col(i).transpose();
    strain.block<1, 3>(1, 3 * mode_j) = local.col(j).transpose();
    strain.block<1, 3>(2, 3 * mode_j) = local.col(i).transpose();
    strain.block<1, 3>(2, 3 * mode_i) = local.col(j).transpose();
    stiffness += strain.transpose() * classes[c] * strain;
  }
  const Matrix33 fourth = local * last.asDiagonal() * local.transpose();
  return std::max(stiffness.cwiseAbs().rowwise().sum().maxCoeff(), fourth.cwiseAbs().rowwise().sum().maxCoeff());
}

/// Bound of cos^2 of the angle between the uniform strain operator and the hourglass operator, both acting on c_1 ..
/// c_7.
double overlap(const Gradients& gradients, const Gradients& coefficients) {
  Eigen::Matrix<double, 4, 7> hourglass = Eigen::Matrix<double, 4, 7>::Zero();
  for (int a = 0; a < 4; ++a) {
    hourglass(a, 3 + a) = 1.0;
    for (int k = 0; k < 7; ++k) hourglass(a, k) -= gradients.col(k).dot(coefficients.col(3 + a));
  }
  const Eigen::Matrix<double, 3, 4> cross = gradients * hourglass.transpose();
  const Matrix33 uniform = gradients * gradients.transpose();
  const Eigen::Matrix4d gram = hourglass * hourglass.transpose();
  return std::min(1.0, (uniform.inverse() * cross * gram.inverse() * cross.transpose()).trace());
}

/// HOURGLASS=STIFFNESS: energy k |q|^2 / 2 with 0.5 % of the dilatational stiffness of the uniform strain.
constexpr double stiffness_control_factor = 0.005;

}  // namespace

std::array<double, brick_record::size> reduced_brick_record(const HexahedronGeometry& geometry, const SolidMaterial& material,
                                                            const Section& section, bool flows) {
  std::array<double, brick_record::size> record{};
  Gradients gradients, coefficients;
  for (int k = 0; k < 7; ++k) {
    for (int i = 0; i < 3; ++i) {
      gradients(i, k) = geometry.mean_gradient[k][i];
      coefficients(i, k) = geometry.coefficients[k][i];
      record[brick_record::mean_gradient + 3 * k + i] = gradients(i, k);
      if (k >= 3) record[brick_record::hourglass_map + 3 * (k - 3) + i] = coefficients(i, k);
    }
  }
  const Matrix33 metric = gradients * gradients.transpose();
  const double largest = Eigen::SelfAdjointEigenSolver<Matrix33>(metric, Eigen::EigenvaluesOnly).eigenvalues()(2);
  record[brick_record::volume] = geometry.volume;
  record[brick_record::length] = 2.0 / std::sqrt(largest);
  record[brick_record::gradient_bound] = largest;
  record[brick_record::overlap] = overlap(gradients, coefficients);

  double* stiffness = &record[brick_record::stiffness];
  if (section.hourglass == HourglassControl::stiffness) {
    const double modulus = material.volumetric_modulus + 2.0 * material.shear_modulus;
    const double density = section.hourglass_scale * stiffness_control_factor * modulus * metric.trace();
    stiffness[0] = density * geometry.volume;
    record[brick_record::hourglass_bound] = density;
    return record;
  }
  const Matrix33 axes = coefficients.leftCols<3>();
  if (flows) {  // each vector is in two classes, of which plane stress of both normal strains is the stiffest: 2/3 E / (1 - nu)
    Eigen::Map<Matrix33> sides(stiffness);
    sides = axes;
    const double lame = material.stiffness[1], shear = material.stiffness[21];
    const double biaxial = 2.0 * shear * (3.0 * lame + 2.0 * shear) / (lame + 2.0 * shear);
    record[brick_record::hourglass_bound] = section.hourglass_scale * (2.0 / 3.0) * biaxial;
    return record;
  }
  const Matrix66 compliance = natural_compliance(material, axes);
  std::array<Matrix33, 3> classes;
  for (int c = 0; c < 3; ++c) {
    Matrix33 block;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) block(i, j) = compliance(class_strains[c][i], class_strains[c][j]);
    classes[c] = section.hourglass_scale / 3.0 * block.inverse();
    int entry = 6 * c;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) stiffness[entry++] = geometry.volume * classes[c](i, j);
  }
  Eigen::Vector3d last;
  for (int i = 0; i < 3; ++i) {
    last(i) = section.hourglass_scale / 9.0 / compliance(i, i);
    stiffness[18 + i] = geometry.volume * last(i);
  }
  record[brick_record::hourglass_bound] = hourglass_bound(classes, last, axes);
  return record;
}

}  // namespace balocco
