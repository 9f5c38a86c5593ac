// SIMD packs of doubles, the scalar type of the explicit loop. With strict IEEE flags a lane computes exactly what the
// scalar code computes, so a pack kernel equals its scalar instantiation bit for bit.
#pragma once

#include <cmath>
#include <experimental/simd>

namespace balocco {

inline constexpr int pack_size = 8;
using Pack = std::experimental::fixed_size_simd<double, pack_size>;
using PackMask = Pack::mask_type;

/// `address` is aligned to 64 bytes and holds pack_size doubles.
inline Pack load(const double* address) { return Pack(address, std::experimental::vector_aligned); }
inline void store(const Pack& value, double* address) { value.copy_to(address, std::experimental::vector_aligned); }

/// Lane-wise `condition ? yes : no`, for packs and for plain doubles alike.
inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline Pack select(const PackMask& condition, const Pack& yes, Pack no) {
  where(condition, no) = yes;
  return no;
}

inline bool any(bool condition) { return condition; }
inline bool any(const PackMask& condition) { return std::experimental::any_of(condition); }

inline double square_root(double x) { return std::sqrt(x); }
inline Pack square_root(const Pack& x) { return std::experimental::sqrt(x); }

// These three are the C library's, lane by lane: tens of nanoseconds a value. Hot kernels do without.
inline double exponential(double x) { return std::exp(x); }
inline Pack exponential(const Pack& x) { return std::experimental::exp(x); }
inline double logarithm(double x) { return std::log(x); }
inline Pack logarithm(const Pack& x) { return std::experimental::log(x); }
inline double power(double x, double exponent) { return std::pow(x, exponent); }
inline Pack power(const Pack& x, double exponent) { return std::experimental::pow(x, Pack(exponent)); }

inline double maximum(double a, double b) { return a > b ? a : b; }
inline Pack maximum(const Pack& a, const Pack& b) { return std::experimental::max(a, b); }

}  // namespace balocco
