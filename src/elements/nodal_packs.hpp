// Between nodal arrays (4 doubles a node) and packs of elements: transposes in registers instead of strided loads.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

static_assert(pack_size == 8, "the transposes below are written for packs of eight");

namespace nodal_packs_detail {

using Row = double __attribute__((vector_size(32)));   // one node: x y z w
using Wide = double __attribute__((vector_size(64)));  // one component of eight elements, or two nodes

inline Row load_row(const double* address) {
  Row row;
  std::memcpy(&row, address, sizeof row);
  return row;
}
inline Wide join(const Row& low, const Row& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
// Through memory, because a std::simd is not trivially copyable; compilers keep both in one register.
inline Pack as_pack(const Wide& a) {
  alignas(64) double values[pack_size];
  std::memcpy(values, &a, sizeof a);
  return load(values);
}
inline Wide as_wide(const Pack& a) {
  alignas(64) double values[pack_size];
  store(a, values);
  Wide wide;
  std::memcpy(&wide, values, sizeof wide);
  return wide;
}
inline Row low_half(const Wide& a) {
  return __builtin_shufflevector(a, a, 0, 1, 2, 3);
}
inline Row high_half(const Wide& a) {
  return __builtin_shufflevector(a, a, 4, 5, 6, 7);
}

}  // namespace nodal_packs_detail

/// Asks for the rows of `count` nodes, those of the next pack, while this one is computed: their positions, and the sums that their
/// forces go to. Every other node is enough: most of the rest lie beside them or are other elements' even ones.
inline void prefetch_nodes(const std::int32_t* nodes, int count, const double* position, const double* force) {
  for (int k = 0; k < count; k += 2) {
    const auto row = 4 * static_cast<std::ptrdiff_t>(nodes[k]);
    __builtin_prefetch(position + row);
    __builtin_prefetch(force + row, 1);
  }
}

/// All four values of one node of eight elements, a quaternion say; `nodes` and `stride` as in gather.
inline std::array<Pack, 4> gather_four(const double* nodal, const std::int32_t* nodes, int stride) {
  using namespace nodal_packs_detail;
  const auto row = [&](int lane) { return load_row(nodal + 4 * static_cast<std::ptrdiff_t>(nodes[lane * stride])); };
  const Wide a0 = join(row(0), row(4)), a1 = join(row(1), row(5)), a2 = join(row(2), row(6)), a3 = join(row(3), row(7));
  const Wide xz01 = __builtin_shufflevector(a0, a1, 0, 8, 2, 10, 4, 12, 6, 14);
  const Wide xz23 = __builtin_shufflevector(a2, a3, 0, 8, 2, 10, 4, 12, 6, 14);
  const Wide yw01 = __builtin_shufflevector(a0, a1, 1, 9, 3, 11, 5, 13, 7, 15);
  const Wide yw23 = __builtin_shufflevector(a2, a3, 1, 9, 3, 11, 5, 13, 7, 15);
  return {as_pack(__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13)),
          as_pack(__builtin_shufflevector(yw01, yw23, 0, 1, 8, 9, 4, 5, 12, 13)),
          as_pack(__builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15)),
          as_pack(__builtin_shufflevector(yw01, yw23, 2, 3, 10, 11, 6, 7, 14, 15))};
}

/// The vectors (x, y, z) of one node of eight elements; `nodes` holds the local node of the first element, that of the
/// next element follows `stride` further on.
inline Vector3<Pack> gather(const double* nodal, const std::int32_t* nodes, int stride) {
  const auto [x, y, z, w] = gather_four(nodal, nodes, stride);
  return {{x, y, z}};
}

/// Subtracts `vector` of eight elements from `force`, each addend rounded by its node's constant (the fourth component,
/// which stays). One element after the other: two lanes may share a node.
inline void scatter_subtract(const Vector3<Pack>& vector, const std::int32_t* nodes, int stride, double* force) {
  using namespace nodal_packs_detail;
  const Wide x = as_wide(vector[0]), y = as_wide(vector[1]), z = as_wide(vector[2]);
  const Wide zero{};
  const Wide xy_even = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
  const Wide xy_odd = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
  const Wide z_even = __builtin_shufflevector(z, zero, 0, 8, 2, 10, 4, 12, 6, 14);
  const Wide z_odd = __builtin_shufflevector(z, zero, 1, 9, 3, 11, 5, 13, 7, 15);
  const Wide lanes04 = __builtin_shufflevector(xy_even, z_even, 0, 1, 8, 9, 4, 5, 12, 13);
  const Wide lanes26 = __builtin_shufflevector(xy_even, z_even, 2, 3, 10, 11, 6, 7, 14, 15);
  const Wide lanes15 = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 8, 9, 4, 5, 12, 13);
  const Wide lanes37 = __builtin_shufflevector(xy_odd, z_odd, 2, 3, 10, 11, 6, 7, 14, 15);
  const auto subtract = [&](int lane, const Row& addend) {
    double* address = force + 4 * static_cast<std::ptrdiff_t>(nodes[lane * stride]);
    Row sum = load_row(address);
    const Row constant = __builtin_shufflevector(sum, sum, 3, 3, 3, 3);
    sum -= (addend + constant) - constant;
    std::memcpy(address, &sum, sizeof sum);
  };
  subtract(0, low_half(lanes04));
  subtract(1, low_half(lanes15));
  subtract(2, low_half(lanes26));
  subtract(3, low_half(lanes37));
  subtract(4, high_half(lanes04));
  subtract(5, high_half(lanes15));
  subtract(6, high_half(lanes26));
  subtract(7, high_half(lanes37));
}

}  // namespace balocco
