// How kernels read an element's reference data: component k as reference[k], a pack or one lane of it.
#pragma once

#include "math/pack.hpp"

namespace balocco {

/// Records of whole packs: component k of lane l at data[pack_size * k + l].
struct PackReference {
  const double* data;
  Pack operator[](int k) const { return load(data + pack_size * k); }
};
struct LaneReference {
  const double* data;  // of the lane's pack, moved on by the lane
  double operator[](int k) const { return data[pack_size * k]; }
};

/// Asks for the record of the next pack (`components` packs long) while this one is computed; past the last it is a
/// hint without effect.
inline void prefetch_record(const double* record, int components) {
  for (int k = 0; k < components; ++k) __builtin_prefetch(record + pack_size * k);
}

}  // namespace balocco
