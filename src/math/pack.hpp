// SIMD packs of doubles, the scalar type of the explicit loop. With strict IEEE flags a lane computes exactly what the
// scalar code computes, so a pack kernel equals its scalar instantiation bit for bit.
#pragma once

#include <experimental/simd>

#include "math/scalar.hpp"

namespace balocco {

/// One register where the processor has registers of that size: GCC then inlines every operation.
using Pack = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, pack_size>>;
using PackMask = Pack::mask_type;

/// `address` is aligned to 64 bytes and holds pack_size doubles.
inline Pack load(const double* address) { return Pack(address, std::experimental::vector_aligned); }
inline void store(const Pack& value, double* address) { value.copy_to(address, std::experimental::vector_aligned); }

}  // namespace balocco
