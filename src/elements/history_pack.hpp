// Element history as packs. A component of eight elements is contiguous, but State promises no alignment.
#pragma once

#include "math/pack.hpp"

namespace balocco {

inline Pack load_unaligned(const double* address) { return Pack(address, std::experimental::element_aligned); }
inline void store_unaligned(const Pack& value, double* address) { value.copy_to(address, std::experimental::element_aligned); }

}  // namespace balocco
