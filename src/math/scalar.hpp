// What kernels ask of their scalar type, for plain doubles and for packs (pack.hpp) alike; duals (dual.hpp) answer the same. Packs are
// known by their type alone, so that files which compute with doubles need not read the standard library's SIMD header.
#pragma once

#include <cmath>
#include <type_traits>

namespace balocco {

/// Lanes of a pack.
inline constexpr int pack_size = 8;

template <class T>
concept PackOfLanes = requires { typename T::mask_type::simd_type; };
template <class T>
concept MaskOfLanes = requires { typename T::simd_type; };

/// Lane-wise `condition ? yes : no`.
inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
template <MaskOfLanes Mask>
typename Mask::simd_type select(const Mask& condition, const typename Mask::simd_type& yes, typename Mask::simd_type no) {
  where(condition, no) = yes;
  return no;
}

inline bool any(bool condition) { return condition; }
template <MaskOfLanes Mask>
bool any(const Mask& condition) {
  return any_of(condition);
}

inline double square_root(double x) { return std::sqrt(x); }
template <PackOfLanes T>
T square_root(const T& x) {
  return sqrt(x);
}

// These three are the C library's, lane by lane: tens of nanoseconds a value. Hot kernels do without.
inline double exponential(double x) { return std::exp(x); }
template <PackOfLanes T>
T exponential(const T& x) {
  return exp(x);
}
inline double logarithm(double x) { return std::log(x); }
template <PackOfLanes T>
T logarithm(const T& x) {
  return log(x);
}
inline double power(double x, double exponent) { return std::pow(x, exponent); }
template <PackOfLanes T>
T power(const T& x, double exponent) {
  return pow(x, T(exponent));
}

inline double maximum(double a, double b) { return a > b ? a : b; }
template <PackOfLanes T>
T maximum(const T& a, const std::type_identity_t<T>& b) {
  return select(a > b, a, T(b));
}

}  // namespace balocco
