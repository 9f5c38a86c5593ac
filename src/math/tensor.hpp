// Vectors and second-order tensors of three dimensions over any scalar: double, Pack or Dual.
#pragma once

#include <array>

namespace balocco {

template <class T>
struct Vector3 {
  std::array<T, 3> component{};

  T& operator[](int i) { return component[i]; }
  const T& operator[](int i) const { return component[i]; }

  friend Vector3 operator+(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
  friend Vector3 operator-(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  friend Vector3 operator*(const T& s, const Vector3& a) { return {s * a[0], s * a[1], s * a[2]}; }
};

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Row-major 3 x 3 tensor.
template <class T>
struct Matrix3 {
  std::array<T, 9> component{};

  T& operator()(int i, int j) { return component[3 * i + j]; }
  const T& operator()(int i, int j) const { return component[3 * i + j]; }

  static Matrix3 identity() { return {{T(1.0), T(0.0), T(0.0), T(0.0), T(1.0), T(0.0), T(0.0), T(0.0), T(1.0)}}; }

  friend Matrix3 operator+(const Matrix3& a, const Matrix3& b) {
    Matrix3 r;
    for (int i = 0; i < 9; ++i) r.component[i] = a.component[i] + b.component[i];
    return r;
  }
  friend Matrix3 operator-(const Matrix3& a, const Matrix3& b) {
    Matrix3 r;
    for (int i = 0; i < 9; ++i) r.component[i] = a.component[i] - b.component[i];
    return r;
  }
  friend Matrix3 operator*(const T& s, const Matrix3& a) {
    Matrix3 r;
    for (int i = 0; i < 9; ++i) r.component[i] = s * a.component[i];
    return r;
  }
  friend Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
    Matrix3 r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
    return r;
  }
  friend Vector3<T> operator*(const Matrix3& a, const Vector3<T>& v) {
    return {a(0, 0) * v[0] + a(0, 1) * v[1] + a(0, 2) * v[2], a(1, 0) * v[0] + a(1, 1) * v[1] + a(1, 2) * v[2],
            a(2, 0) * v[0] + a(2, 1) * v[1] + a(2, 2) * v[2]};
  }
};

template <class T>
Matrix3<T> transpose(const Matrix3<T>& a) {
  return {{a(0, 0), a(1, 0), a(2, 0), a(0, 1), a(1, 1), a(2, 1), a(0, 2), a(1, 2), a(2, 2)}};
}

template <class T>
Vector3<T> row_of(const Matrix3<T>& matrix, int i) {
  return {matrix(i, 0), matrix(i, 1), matrix(i, 2)};
}

/// A matrix of constants over another scalar.
template <class T>
Matrix3<T> constant(const Matrix3<double>& matrix) {
  Matrix3<T> result;
  for (int i = 0; i < 9; ++i) result.component[i] = T(matrix.component[i]);
  return result;
}

/// cof(A) = det(A) A^-T; its rows are cross products of the rows of A.
template <class T>
Matrix3<T> cofactor(const Matrix3<T>& a) {
  return {{a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1), a(1, 2) * a(2, 0) - a(1, 0) * a(2, 2),
           a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0), a(2, 1) * a(0, 2) - a(2, 2) * a(0, 1),
           a(2, 2) * a(0, 0) - a(2, 0) * a(0, 2), a(2, 0) * a(0, 1) - a(2, 1) * a(0, 0),
           a(0, 1) * a(1, 2) - a(0, 2) * a(1, 1), a(0, 2) * a(1, 0) - a(0, 0) * a(1, 2),
           a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0)}};
}

/// det(A), given its cofactor so that nothing is computed twice.
template <class T>
T determinant(const Matrix3<T>& a, const Matrix3<T>& cofactor_of_a) {
  return a(0, 0) * cofactor_of_a(0, 0) + a(0, 1) * cofactor_of_a(0, 1) + a(0, 2) * cofactor_of_a(0, 2);
}

/// A : B, the sum of the products of all components.
template <class T>
T double_contraction(const Matrix3<T>& a, const Matrix3<T>& b) {
  T sum = a.component[0] * b.component[0];
  for (int i = 1; i < 9; ++i) sum = sum + a.component[i] * b.component[i];
  return sum;
}

}  // namespace balocco
