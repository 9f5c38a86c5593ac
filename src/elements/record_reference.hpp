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

}  // namespace balocco
