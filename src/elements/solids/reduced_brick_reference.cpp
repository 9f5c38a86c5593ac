#include "elements/solids/reduced_brick_reference.hpp"

#include <algorithm>
#include <cmath>

#include "math/dense.hpp"

namespace balocco {

namespace {

using Matrix33 = Dense<3, 3>;
using Matrix66 = Dense<6, 6>;
using Gradients = Dense<3, 7>;

constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

/// The strains of a class: two normal ones and the shear between them. Class 0 varies with zeta, 1 with eta, 2 with xi.
constexpr int class_strains[3][3] = {{0, 1, 3}, {0, 2, 4}, {1, 2, 5}};

/// Moduli in natural axes: S^ab = (A^a . e_i)(A^b . e_j) S_ij with the duals A^a of the columns of `axes`.
Matrix66 natural_compliance(const SolidMaterial& material, const Matrix33& axes) {
  const Matrix33 dual = inverse(axes);
  Matrix66 transform;
  for (int a = 0; a < 6; ++a) {
    const auto first = [&](int i) { return dual(voigt[a][0], i); };
    const auto second = [&](int i) { return dual(voigt[a][1], i); };
    for (int b = 0; b < 6; ++b) {
      const int i = voigt[b][0], j = voigt[b][1];
      transform(a, b) = i == j ? first(i) * second(j) : first(i) * second(j) + first(j) * second(i);
    }
  }
  return inverse(transform * Matrix66{material.stiffness} * transpose(transform));
}

/// The columns of `axes` in orthonormal axes that lie along the first, in the plane of the first two, and normal to it.
Matrix33 in_orthonormal_axes(const Matrix33& axes) {
  Matrix33 local, q = axes;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < j; ++i) {
      for (int c = 0; c < 3; ++c) local(i, j) += q(c, i) * q(c, j);
      for (int c = 0; c < 3; ++c) q(c, j) -= local(i, j) * q(c, i);
    }
    for (int c = 0; c < 3; ++c) local(j, j) += q(c, j) * q(c, j);
    local(j, j) = std::sqrt(local(j, j));
    for (int c = 0; c < 3; ++c) q(c, j) /= local(j, j);
  }
  return local;
}

template <int size>
double largest_row_sum(const Dense<size, size>& matrix) {
  double largest = 0.0;
  for (int i = 0; i < size; ++i) {
    double sum = 0.0;
    for (int j = 0; j < size; ++j) sum += std::abs(matrix(i, j));
    largest = std::max(largest, sum);
  }
  return largest;
}

/// Largest eigenvalue of the stiffness on q, bounded by row sums in the orthonormal axes nearest the element's (exact
/// for boxes).
double hourglass_bound(const std::array<Matrix33, 3>& classes, const Vector3<double>& last, const Matrix33& axes) {
  const auto local = in_orthonormal_axes(axes);
  // Rows of a class's strains on (q1, q2, q3), in local components: c_i . q_a.
  static constexpr int mode[3][2] = {{1, 0}, {2, 0}, {2, 1}};  // modes of the two normal strains
  Dense<9, 9> stiffness;
  for (int c = 0; c < 3; ++c) {
    const int i = voigt[class_strains[c][2]][0], j = voigt[class_strains[c][2]][1];
    const int mode_i = mode[c][0], mode_j = mode[c][1];
    Dense<3, 9> strain;
    for (int k = 0; k < 3; ++k) {
      strain(0, 3 * mode_i + k) = local(k, i);
      strain(1, 3 * mode_j + k) = local(k, j);
      strain(2, 3 * mode_j + k) = local(k, i);
      strain(2, 3 * mode_i + k) = local(k, j);
    }
    stiffness += transpose(strain) * classes[c] * strain;
  }
  Matrix33 fourth;
  for (int i = 0; i < 3; ++i) fourth(i, i) = last[i];
  return std::max(largest_row_sum(stiffness), largest_row_sum(local * fourth * transpose(local)));
}

/// Bound of cos^2 of the angle between the uniform strain operator and the hourglass operator, both acting on c_1 ..
/// c_7.
double overlap(const Gradients& gradients, const Gradients& coefficients) {
  Dense<4, 7> hourglass;
  for (int a = 0; a < 4; ++a) {
    hourglass(a, 3 + a) = 1.0;
    for (int k = 0; k < 7; ++k)
      for (int i = 0; i < 3; ++i) hourglass(a, k) -= gradients(i, k) * coefficients(i, 3 + a);
  }
  const auto cross = gradients * transpose(hourglass);
  const auto shared = inverse(gradients * transpose(gradients)) * cross * inverse(hourglass * transpose(hourglass)) * transpose(cross);
  return std::min(1.0, shared(0, 0) + shared(1, 1) + shared(2, 2));
}

/// h11, h12, h22 of IsotropicShape: k11 = h11^2, k13 = h11 h12, k22 = h22^2.
std::array<double, 3> roots_of_class(const Matrix33& moduli) {
  const double first = std::sqrt(moduli(0, 0));
  return {first, moduli(0, 2) / first, std::sqrt(moduli(1, 1))};
}

/// HOURGLASS=STIFFNESS: energy k |q|^2 / 2 with 0.5 % of the dilatational stiffness of the uniform strain.
constexpr double stiffness_control_factor = 0.005;

}  // namespace

std::optional<double> isotropic_poisson_ratio(const SolidMaterial& material) {
  constexpr double round_off = 1e-12;
  const double lame = material.stiffness[1], shear = material.stiffness[21];
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double normal = (i < 3 && j < 3 ? lame : 0.0) + (i == j && i < 3 ? 2.0 * shear : 0.0), expected = i == j && i >= 3 ? shear : normal;
      if (!(std::abs(material.stiffness[6 * i + j] - expected) <= round_off * (lame + 2.0 * shear))) return std::nullopt;
    }
  return 0.5 * lame / (lame + shear);
}

std::array<double, brick_record::most> reduced_brick_record(const HexahedronGeometry& geometry, const SolidMaterial& material,
                                                            const Section& section, BrickHourglass kind) {
  std::array<double, brick_record::most> record{};
  Gradients gradients, coefficients;
  for (int k = 0; k < 7; ++k) {
    for (int i = 0; i < 3; ++i) {
      gradients(i, k) = geometry.mean_gradient[k][i];
      coefficients(i, k) = geometry.coefficients[k][i];
      record[brick_record::mean_gradient + 3 * k + i] = gradients(i, k);
      if (k >= 3) record[brick_record::hourglass_map + 3 * (k - 3) + i] = coefficients(i, k);
    }
  }
  const Matrix33 metric = gradients * transpose(gradients);
  const double largest = largest_eigenvalue(metric);
  record[brick_record::volume] = geometry.volume;
  record[brick_record::length] = 2.0 / std::sqrt(largest);
  record[brick_record::gradient_bound] = largest;
  record[brick_record::overlap] = overlap(gradients, coefficients);

  double* stiffness = &record[brick_record::stiffness];
  if (kind == BrickHourglass::scalar) {
    const double modulus = material.volumetric_modulus + 2.0 * material.shear_modulus;
    const double density = section.hourglass_scale * stiffness_control_factor * modulus * (metric(0, 0) + metric(1, 1) + metric(2, 2));
    stiffness[0] = density * geometry.volume;
    record[brick_record::hourglass_bound] = density;
    return record;
  }
  Matrix33 axes;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) axes(i, k) = coefficients(i, k);
  if (kind == BrickHourglass::flowing) {  // each vector is in two classes, of which plane stress of both normal strains is the stiffest: 2/3 E / (1 - nu)
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) stiffness[3 * k + i] = axes(i, k);
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
    classes[c] = section.hourglass_scale / 3.0 * inverse(block);
    if (kind == BrickHourglass::anisotropic)
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) *stiffness++ = geometry.volume * classes[c](i, j);
    else
      for (const double root : roots_of_class(geometry.volume * classes[c])) *stiffness++ = root;
  }
  Vector3<double> last;
  for (int i = 0; i < 3; ++i) {
    last[i] = section.hourglass_scale / 9.0 / compliance(i, i);
    *stiffness++ = geometry.volume * last[i];
  }
  record[brick_record::hourglass_bound] = hourglass_bound(classes, last, axes);
  return record;
}

}  // namespace balocco
