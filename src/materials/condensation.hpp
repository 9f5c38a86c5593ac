// Thin forms of any solid law by one condensation: the stretches that no strain prescribes make their stresses vanish.
// E -> C -> F by Cholesky, whose rotation an objective law does not see; Newton's method with duals finds the free C.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "materials/law_of.hpp"
#include "materials/stretch.hpp"
#include "math/symmetric_tensor.hpp"

namespace balocco {

template <PointKind kind>
struct FreeStretches;
/// Which entries of C are free, and which stress components come back.
template <>
struct FreeStretches<PointKind::plane> {
  static constexpr int count = 1;
  static constexpr std::array<int, 1> entry{2};
  static constexpr std::array<int, 3> kept{0, 1, 3};  // 11 22 12
};
template <>
struct FreeStretches<PointKind::line> {
  static constexpr int count = 2;
  static constexpr std::array<int, 2> entry{1, 2};
  static constexpr std::array<int, 1> kept{0};
};
template <>
struct FreeStretches<PointKind::fibre> {
  static constexpr int count = 2;
  static constexpr std::array<int, 2> entry{1, 2};
  static constexpr std::array<int, 2> kept{0, 3};
};

namespace condensation_detail {

template <class T>
struct NoMemory {};
template <class Solid, class T>
struct SolidMemory {
  using type = NoMemory<T>;
};
template <Remembers Solid, class T>
struct SolidMemory<Solid, T> {
  using type = typename Solid::template State<T>;
};

}  // namespace condensation_detail

template <PointKind kind, class Solid>
struct Condensed {
  using Free = FreeStretches<kind>;
  static constexpr int n = strain_size(kind), m = Free::count;
  Solid solid;
  double modulus;  // of the undeformed solid: the scale of a stress that is as good as none

  template <class T>
  using SolidMemory = typename condensation_detail::SolidMemory<Solid, T>::type;

  template <class T>
  struct State {
    std::array<T, m> free{};  // C - 1 of the free stretches
    SolidMemory<T> solid{};
  };
  template <class S, class Visit>
  void fields(S& state, Visit&& visit) const {
    visit("FREE STRETCH", state.free);
    if constexpr (Remembers<Solid>) solid.fields(state.solid, visit);
  }

  template <class T>
  std::array<T, n> stress(const std::array<T, n>& strain, State<T>& state, double increment) const;

  /// From the solid's bound with the free stretches chosen to lower it (any choice bounds the condensed tangent):
  /// in-plane d2W <= 2 shear |dF|^2 + relief (F^-T : dF)^2, |dF| <= |F^-1| |dE|; exact for isotropic laws at rest.
  template <class T>
  T bound(const std::array<T, n>& strain, const std::array<T, n>& stress, const State<T>& state) const;

  EnergyDensity energy(const std::array<double, n>& strain, const State<double>& state) const {
    const Matrix3<double> f = gradient(strain, state.free);
    if constexpr (Remembers<Solid>)
      return solid.energy(f, state.solid);
    else
      return {solid.energy(f), 0.0, 0.0};
  }
  double transverse_stretch(const std::array<double, n>&, const State<double>& state) const {
    double square = 1.0;
    for (const double free : state.free) square *= 1.0 + free;
    return std::sqrt(square);
  }

 private:
  /// Upper triangular F with F^T F = 1 + 2 E. The first diagonal is 1 + small where the strain is small.
  template <class T>
  static Matrix3<T> gradient(const std::array<T, n>& strain, const std::array<T, m>& free) {
    T c22, c33, c12;
    if constexpr (kind == PointKind::plane) {
      c22 = 1.0 + 2.0 * strain[1];
      c12 = strain[2];
      c33 = 1.0 + free[0];
    } else {
      c22 = 1.0 + free[0];
      c33 = 1.0 + free[1];
      c12 = T(0.0);
      if constexpr (kind == PointKind::fibre) c12 = strain[1];
    }
    Matrix3<T> f = Matrix3<T>::identity();
    f(0, 0) = square_root(1.0 + 2.0 * strain[0]);
    f(0, 1) = c12 / f(0, 0);
    f(1, 1) = square_root(c22 - f(0, 1) * f(0, 1));
    f(2, 2) = square_root(c33);
    return f;
  }

  /// S = F^-1 P of the solid; updates the solid's state.
  template <class T>
  SymmetricTensor<T> second_piola(const std::array<T, n>& strain, const std::array<T, m>& free,
                                  SolidMemory<T>& state, double increment) const {
    const Matrix3<T> f = gradient(strain, free);
    Matrix3<T> p;
    if constexpr (Remembers<Solid>)
      p = solid.stress(f, state, increment);
    else
      p = solid.stress(f);
    SymmetricTensor<T> s;  // F is upper triangular and turns nothing into the third direction
    s.component[2] = p(2, 2) / f(2, 2);
    s.component[1] = p(1, 1) / f(1, 1);
    s.component[3] = p(1, 0) / f(1, 1);
    s.component[0] = (p(0, 0) - f(0, 1) * s.component[3]) / f(0, 0);
    return s;
  }

  template <class T, class From>
  SolidMemory<T> converted(const SolidMemory<From>& from) const {
    SolidMemory<T> to{};
    if constexpr (Remembers<Solid>) {
      std::vector<From> scalars;
      for_each_scalar(solid, from, [&](const char*, int, const From& x) { scalars.push_back(x); });
      std::size_t next = 0;
      for_each_scalar(solid, to, [&](const char*, int, T& x) { x = T(value_of(scalars[next++])); });
    }
    return to;
  }

  template <class V>
  struct Balance {
    std::array<V, m> stress;                 // that ought to vanish
    std::array<std::array<V, m>, m> slope;   // against the free stretches
  };
  template <class V>
  Balance<V> balance(const std::array<V, n>& strain, const std::array<V, m>& free, const SolidMemory<V>& old,
                     double increment) const {
    using Derivative = Dual<m, V>;
    std::array<Derivative, n> fixed;
    std::array<Derivative, m> variable;
    for (int i = 0; i < n; ++i) fixed[i] = Derivative(strain[i]);
    for (int i = 0; i < m; ++i) variable[i] = Derivative(free[i], i);
    auto memory = converted<Derivative, V>(old);
    const auto s = second_piola(fixed, variable, memory, increment);
    Balance<V> result;
    for (int i = 0; i < m; ++i) {
      result.stress[i] = s.component[Free::entry[i]].value;
      for (int j = 0; j < m; ++j) result.slope[i][j] = s.component[Free::entry[i]].derivative[j];
    }
    return result;
  }

  /// slope^-1 right; a point that has failed has no slope, and nothing to solve.
  template <class T, class V>
  static std::array<T, m> solve(const std::array<std::array<V, m>, m>& a, const std::array<T, m>& right) {
    const auto safe = [](const V& x) { return V(select(x == V(0.0), V(1.0), x)); };
    if constexpr (m == 1) return {right[0] / T(safe(a[0][0]))};
    if constexpr (m == 2) {
      const T inverse = T(1.0 / safe(a[0][0] * a[1][1] - a[0][1] * a[1][0]));
      return {inverse * (T(a[1][1]) * right[0] - T(a[0][1]) * right[1]),
              inverse * (T(a[0][0]) * right[1] - T(a[1][0]) * right[0])};
    }
  }

  template <class T>
  static T largest_of_plane(const T& a11, const T& a22, const T& a12) {
    const T mean = 0.5 * (a11 + a22), half = 0.5 * (a11 - a22);
    return mean + square_root(half * half + a12 * a12);
  }
};

template <PointKind kind, class Solid>
template <class T>
auto Condensed<kind, Solid>::stress(const std::array<T, n>& strain, State<T>& state, double increment) const
    -> std::array<T, n> {
  using V = std::decay_t<decltype(value_of(strain[0]))>;
  std::array<V, n> fixed;
  std::array<V, m> free;
  for (int i = 0; i < n; ++i) fixed[i] = value_of(strain[i]);
  for (int i = 0; i < m; ++i) free[i] = value_of(state.free[i]);
  const SolidMemory<V> old = converted<V, T>(state.solid);
  constexpr int most_iterations = 30;
  Balance<V> now = balance(fixed, free, old, increment);
  V before = V(std::numeric_limits<double>::max());
  for (int k = 0; k < most_iterations; ++k) {
    V size = V(0.0);
    for (int i = 0; i < m; ++i) size = maximum(size, absolute(now.stress[i]));
    // Until nothing is left, or round-off alone, which no further step makes smaller.
    const auto open = size > 1e-14 * modulus && (size > 1e-11 * modulus || size < 0.5 * before);
    if (!any(open)) break;
    before = size;
    const auto step = solve(now.slope, now.stress);
    for (int i = 0; i < m; ++i)  // a step never takes more than three quarters of C
      free[i] = select(open, maximum(free[i] - step[i], 0.25 * free[i] - 0.75), free[i]);
    now = balance(fixed, free, old, increment);
  }
  for (int i = 0; i < m; ++i) state.free[i] = T(free[i]);
  if constexpr (!std::is_same_v<T, V>) {  // the free stretches follow the strain
    auto memory = converted<T, V>(old);
    const auto s = second_piola(strain, state.free, memory, increment);
    std::array<T, m> follows;
    for (int i = 0; i < m; ++i) follows[i] = s.component[Free::entry[i]] - T(now.stress[i]);
    follows = solve(now.slope, follows);
    for (int i = 0; i < m; ++i) state.free[i] = T(free[i]) - (follows[i] - T(value_of(follows[i])));
  }
  const auto s = second_piola(strain, state.free, state.solid, increment);
  std::array<T, n> result;
  for (int i = 0; i < n; ++i) result[i] = s.component[Free::kept[i]];
  return result;
}

template <PointKind kind, class Solid>
template <class T>
T Condensed<kind, Solid>::bound(const std::array<T, n>& strain, const std::array<T, n>& stress,
                                const State<T>& state) const {
  const Matrix3<T> f = gradient(strain, state.free);
  SymmetricTensor<T> s;
  for (int i = 0; i < n; ++i) s.component[Free::kept[i]] = stress[i];
  TangentBound<T> tangent;
  if constexpr (requires { solid.bound(f, f); })
    tangent = solid.bound(f, f * full(s));
  else
    tangent = solid.bound(f);
  const T compression = maximum(largest_of_plane(-s.component[0], -s.component[1], s.component[3]), T(0.0));
  const T twice = 2.0 * tangent.shear + compression;

  const T c11 = f(0, 0) * f(0, 0), c12 = f(0, 0) * f(0, 1), c22 = f(0, 1) * f(0, 1) + f(1, 1) * f(1, 1);
  const T c33 = f(2, 2) * f(2, 2), inverse = 1.0 / (c11 * c22 - c12 * c12);
  const T i11 = inverse * c22, i22 = inverse * c11, i12 = -inverse * c12;
  T n2 = largest_of_plane(i11, i22, i12), spring = twice * c33, volumetric = 2.0 * (n2 * n2);
  if constexpr (kind != PointKind::plane) {
    const T other = kind == PointKind::line ? c22 : n2 / (i22 * i22);
    spring = spring * (other / (other + c33));
    volumetric = i11 * i11 + 2.0 * (i12 * i12);
    if constexpr (kind == PointKind::line) n2 = i11;
  }
  const T relief = tangent.volumetric * spring / (tangent.volumetric + spring);
  return 0.5 * (twice * n2 + relief * volumetric);
}

/// A thin form of a solid law.
template <PointKind kind, class Solid>
std::unique_ptr<Law<kind>> make_condensed_law(const Solid& solid) {
  const auto identity = Matrix3<double>::identity();
  TangentBound<double> rest;
  if constexpr (requires { solid.bound(identity, identity); })
    rest = solid.bound(identity, Matrix3<double>{});
  else
    rest = solid.bound(identity);
  return std::make_unique<LawOf<kind, Condensed<kind, Solid>>>(
      Condensed<kind, Solid>{solid, rest.volumetric + 2.0 * rest.shear});
}

}  // namespace balocco
