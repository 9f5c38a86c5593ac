// How kernels read an element's reference data: component k as reference[k], a pack or one lane of it.
#pragma once

#include <type_traits>

#include "math/pack.hpp"
#include "math/tensor.hpp"

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

/// Reference data stay plain doubles beside duals: they have no derivative.
template <class T>
using Coefficient = std::conditional_t<std::is_same_v<T, Pack>, Pack, double>;

template <class T>
Coefficient<T> reference_value(const double* base, int component) {
  if constexpr (std::is_same_v<T, Pack>)
    return load(base + component * pack_size);
  else
    return base[component * pack_size];
}

template <class C, class T>
Vector3<T> scaled(const C& factor, const Vector3<T>& v) {
  return {{factor * v[0], factor * v[1], factor * v[2]}};
}

/// Asks for the record of the next pack (`components` packs long) while this one is computed; past the last it is a
/// hint without effect.
inline void prefetch_record(const double* record, int components) {
  for (int k = 0; k < components; ++k) __builtin_prefetch(record + pack_size * k);
}

}  // namespace balocco
