// Pairs of vectors, translation before rotation: motions, forces and inertia of bodies. Plain loops of fixed length, which round alike
// on every processor.
#pragma once

#include <array>

#include "math/tensor.hpp"

namespace balocco {

struct Vector6 {
  std::array<double, 6> component{};

  double& operator[](std::size_t i) { return component[i]; }
  double operator[](std::size_t i) const { return component[i]; }
  Vector3<double> translation() const { return {component[0], component[1], component[2]}; }
  Vector3<double> rotation() const { return {component[3], component[4], component[5]}; }
  bool operator==(const Vector6&) const = default;

  Vector6& operator+=(const Vector6& b) {
    for (std::size_t i = 0; i < 6; ++i) component[i] += b.component[i];
    return *this;
  }
  friend Vector6 operator+(Vector6 a, const Vector6& b) { return a += b; }
  friend Vector6 operator-(const Vector6& a, const Vector6& b) { return a + -1.0 * b; }
  friend Vector6 operator*(double s, Vector6 a) {
    for (double& value : a.component) value *= s;
    return a;
  }
};

inline Vector6 pair_of(const Vector3<double>& translation, const Vector3<double>& rotation) {
  return {translation[0], translation[1], translation[2], rotation[0], rotation[1], rotation[2]};
}

inline double dot(const Vector6& a, const Vector6& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

/// Row-major.
struct Matrix6 {
  std::array<double, 36> component{};

  double& operator()(std::size_t i, std::size_t j) { return component[6 * i + j]; }
  double operator()(std::size_t i, std::size_t j) const { return component[6 * i + j]; }

  friend Vector6 operator*(const Matrix6& a, const Vector6& v) {
    Vector6 product;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) product[i] += a(i, j) * v[j];
    return product;
  }
};

/// L D L^T of a symmetric matrix without negative eigenvalues: L with a unit diagonal, where D is zero a column of zeros.
struct FactoredMatrix6 {
  Matrix6 lower;
  Vector6 diagonal;
};
inline FactoredMatrix6 factored(const Matrix6& a) {
  constexpr double next_to_nothing = 1e-12;  // of what was there
  FactoredMatrix6 result;
  auto& [lower, diagonal] = result;
  for (std::size_t j = 0; j < 6; ++j) {
    for (std::size_t i = j; i < 6; ++i) {
      lower(i, j) = a(i, j);
      for (std::size_t k = 0; k < j; ++k) lower(i, j) -= lower(i, k) * diagonal[k] * lower(j, k);
    }
    diagonal[j] = lower(j, j) > next_to_nothing * a(j, j) ? lower(j, j) : 0.0;
    for (std::size_t i = j; i < 6; ++i) lower(i, j) = diagonal[j] > 0.0 ? lower(i, j) / diagonal[j] : 0.0;
  }
  return result;
}

/// Q block Q^T of each of the four blocks of a symmetric matrix.
inline Matrix6 turned(const Matrix3<double>& q, const Matrix6& a) {
  Matrix6 result;
  const auto turn = [&](std::size_t first_row, std::size_t first_column) {
    Matrix3<double> block;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) block(i, j) = a(first_row + i, first_column + j);
    block = q * block * transpose(q);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result(first_row + i, first_column + j) = result(first_column + j, first_row + i) = block(i, j);
  };
  turn(0, 0);
  turn(3, 0);
  turn(3, 3);
  return result;
}

}  // namespace balocco
