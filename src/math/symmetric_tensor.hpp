// Symmetric second-order tensors over any scalar, and isotropic functions of them.
#pragma once

#include <array>

#include "math/dual.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Components 11 22 33 12 13 23.
template <class T>
struct SymmetricTensor {
  std::array<T, 6> component{};

  static SymmetricTensor identity() { return {{T(1.0), T(1.0), T(1.0), T(0.0), T(0.0), T(0.0)}}; }
  friend SymmetricTensor operator+(const SymmetricTensor& a, const SymmetricTensor& b) {
    SymmetricTensor r;
    for (int i = 0; i < 6; ++i) r.component[i] = a.component[i] + b.component[i];
    return r;
  }
  friend SymmetricTensor operator-(const SymmetricTensor& a, const SymmetricTensor& b) {
    SymmetricTensor r;
    for (int i = 0; i < 6; ++i) r.component[i] = a.component[i] - b.component[i];
    return r;
  }
  friend SymmetricTensor operator*(const T& s, const SymmetricTensor& a) {
    SymmetricTensor r;
    for (int i = 0; i < 6; ++i) r.component[i] = s * a.component[i];
    return r;
  }
  SymmetricTensor plus_identity(const T& s) const {
    SymmetricTensor r = *this;
    for (int i = 0; i < 3; ++i) r.component[i] = r.component[i] + s;
    return r;
  }
};

template <class T>
T trace(const SymmetricTensor<T>& a) {
  return a.component[0] + a.component[1] + a.component[2];
}

template <class T>
T double_contraction(const SymmetricTensor<T>& a, const SymmetricTensor<T>& b) {
  const auto &x = a.component, &y = b.component;
  return (x[0] * y[0] + x[1] * y[1] + x[2] * y[2]) + 2.0 * (x[3] * y[3] + x[4] * y[4] + x[5] * y[5]);
}

template <class T>
Matrix3<T> full(const SymmetricTensor<T>& a) {
  const auto& x = a.component;
  return {{x[0], x[3], x[4], x[3], x[1], x[5], x[4], x[5], x[2]}};
}

/// sym(A).
template <class T>
SymmetricTensor<T> symmetric_part(const Matrix3<T>& a) {
  return {{a(0, 0), a(1, 1), a(2, 2), 0.5 * (a(0, 1) + a(1, 0)), 0.5 * (a(0, 2) + a(2, 0)), 0.5 * (a(1, 2) + a(2, 1))}};
}

/// A B of two tensors that commute: symmetric too.
template <class T>
SymmetricTensor<T> commuting_product(const SymmetricTensor<T>& a, const SymmetricTensor<T>& b) {
  const auto &x = a.component, &y = b.component;
  return {{x[0] * y[0] + x[3] * y[3] + x[4] * y[4], x[3] * y[3] + x[1] * y[1] + x[5] * y[5],
           x[4] * y[4] + x[5] * y[5] + x[2] * y[2], x[0] * y[3] + x[3] * y[1] + x[4] * y[5],
           x[0] * y[4] + x[3] * y[5] + x[4] * y[2], x[3] * y[4] + x[1] * y[5] + x[5] * y[2]}};
}

template <class T>
SymmetricTensor<T> inverse(const SymmetricTensor<T>& a) {
  const auto& x = a.component;
  const T c11 = x[1] * x[2] - x[5] * x[5], c12 = x[4] * x[5] - x[3] * x[2], c13 = x[3] * x[5] - x[1] * x[4];
  const T scale = 1.0 / (x[0] * c11 + x[3] * c12 + x[4] * c13);
  return {{scale * c11, scale * (x[0] * x[2] - x[4] * x[4]), scale * (x[0] * x[1] - x[3] * x[3]), scale * c12,
           scale * c13, scale * (x[3] * x[4] - x[0] * x[5])}};
}

/// (F^T F - I) / 2 from H = F - I: exact to round-off of the displacement gradient, however small the strain.
template <class T>
SymmetricTensor<T> green_strain(const Matrix3<T>& h) {
  const auto component = [&](int i, int j) {
    return 0.5 * (h(i, j) + h(j, i) + (h(0, i) * h(0, j) + h(1, i) * h(1, j) + h(2, i) * h(2, j)));
  };
  return {{component(0, 0), component(1, 1), component(2, 2), component(0, 1), component(0, 2), component(1, 2)}};
}

/// A function f of a symmetric tensor: sum f(a) n (x) n over its eigenpairs. Value and slope of f at an eigenvalue.
struct IsotropicFunction {
  double (*value)(double a, const void* data);
  double (*slope)(double a, const void* data);
  const void* data = nullptr;
};

SymmetricTensor<double> apply(const IsotropicFunction& function, const SymmetricTensor<double>& a);
/// Derivatives by divided differences over the eigenvalues (Daleckii & Krein 1965): dA row-major, `count` x 6 components
/// each; f' likewise.
void apply_derivative(const IsotropicFunction& function, const SymmetricTensor<double>& a, int count,
                      const double* da, double* df);

template <int N>
SymmetricTensor<Dual<N>> apply(const IsotropicFunction& function, const SymmetricTensor<Dual<N>>& a) {
  SymmetricTensor<double> value;
  std::array<double, 6 * N> da, df;
  for (int i = 0; i < 6; ++i) {
    value.component[i] = a.component[i].value;
    for (int k = 0; k < N; ++k) da[6 * k + i] = a.component[i].derivative[k];
  }
  const SymmetricTensor<double> f = apply(function, value);
  apply_derivative(function, value, N, da.data(), df.data());
  SymmetricTensor<Dual<N>> result;
  for (int i = 0; i < 6; ++i) {
    result.component[i] = Dual<N>(f.component[i]);
    for (int k = 0; k < N; ++k) result.component[i].derivative[k] = df[6 * k + i];
  }
  return result;
}

namespace symmetric_tensor_detail {

/// One lane of a pack, or of a dual of packs.
inline double lane(const Pack& x, int i) { return x[i]; }
inline void set_lane(Pack& x, int i, double value) { x[i] = value; }
template <int N>
Dual<N> lane(const Dual<N, Pack>& x, int i) {
  Dual<N> result(static_cast<double>(x.value[i]));
  for (int k = 0; k < N; ++k) result.derivative[k] = x.derivative[k][i];
  return result;
}
template <int N>
void set_lane(Dual<N, Pack>& x, int i, const Dual<N>& value) {
  x.value[i] = value.value;
  for (int k = 0; k < N; ++k) x.derivative[k][i] = value.derivative[k];
}

}  // namespace symmetric_tensor_detail

/// `where_needed` lanes of `result` by the function, one after the other.
template <class T>
void apply_to_lanes(const IsotropicFunction& function, const SymmetricTensor<T>& a, const PackMask& where_needed,
                    SymmetricTensor<T>& result) {
  using namespace symmetric_tensor_detail;
  for (int i = 0; i < pack_size; ++i) {
    if (!where_needed[i]) continue;
    SymmetricTensor<std::decay_t<decltype(lane(a.component[0], 0))>> one;
    for (int k = 0; k < 6; ++k) one.component[k] = lane(a.component[k], i);
    const auto f = apply(function, one);
    for (int k = 0; k < 6; ++k) set_lane(result.component[k], i, f.component[k]);
  }
}
template <class T>
void apply_to_lanes(const IsotropicFunction& function, const SymmetricTensor<T>& a, bool needed,
                    SymmetricTensor<T>& result) {
  if (needed) result = apply(function, a);
}

/// The function itself over any scalar, lane by lane.
template <class T>
SymmetricTensor<T> isotropic_function(const IsotropicFunction& function, const SymmetricTensor<T>& a) {
  SymmetricTensor<T> result;
  apply_to_lanes(function, a, value_of(a.component[0]) == value_of(a.component[0]), result);
  return result;
}

/// Below this size (Frobenius) of a strain the series below hold to round-off.
inline constexpr double series_limit = 0.02;

template <class T>
auto beyond_series(const SymmetricTensor<T>& a) {
  return !(value_of(double_contraction(a, a)) <= series_limit * series_limit);
}

/// Logarithmic strain ln(I + 2E) / 2 of a Green strain E: artanh X = X + X^3/3 + X^5/5 + X^7/7, X = E (I + E)^-1.
template <class T>
SymmetricTensor<T> logarithmic_strain(const SymmetricTensor<T>& green) {
  static constexpr IsotropicFunction logarithm{
      [](double e, const void*) { return 0.5 * std::log1p(2.0 * e); },
      [](double e, const void*) { return 1.0 / (1.0 + 2.0 * e); }};
  const SymmetricTensor<T> x = commuting_product(green, inverse(green.plus_identity(T(1.0))));
  const SymmetricTensor<T> y = commuting_product(x, x);
  SymmetricTensor<T> series = (T(1.0 / 7.0) * y).plus_identity(T(1.0 / 5.0));
  series = commuting_product(y, series).plus_identity(T(1.0 / 3.0));
  series = x + commuting_product(x, commuting_product(y, series));
  apply_to_lanes(logarithm, green, beyond_series(green), series);
  return series;
}

/// exp(A) - I.
template <class T>
SymmetricTensor<T> exponential_less_identity(const SymmetricTensor<T>& a) {
  static constexpr IsotropicFunction exponential{[](double e, const void*) { return std::expm1(e); },
                                                 [](double e, const void*) { return std::exp(e); }};
  SymmetricTensor<T> series = (T(1.0 / 7.0) * a).plus_identity(T(1.0));
  for (const double n : {6.0, 5.0, 4.0, 3.0, 2.0})
    series = (T(1.0 / n) * commuting_product(a, series)).plus_identity(T(1.0));
  series = commuting_product(a, series);
  apply_to_lanes(exponential, a, beyond_series(a), series);
  return series;
}

}  // namespace balocco
