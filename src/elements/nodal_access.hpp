// How element kernels read nodes and add to them: one pack of elements at a time, from and to the nodal arrays of 4 doubles.
#pragma once

#include <cstdint>
#include <cstring>

#include "math/exact_sum.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// A pack in memory: std::vector<PackBlock> is aligned as `load` and `store` demand.
struct alignas(64) PackBlock {
  double lane[pack_size] = {};
};

/// For memory of any alignment (element history).
inline Pack load_unaligned(const double* address) { return Pack(address, std::experimental::element_aligned); }
inline void store_unaligned(const Pack& value, double* address) {
  value.copy_to(address, std::experimental::element_aligned);
}

namespace detail {

// The compiler's own vectors: one row of a nodal array, and one component of a pack of nodes.
using Row = double __attribute__((vector_size(4 * sizeof(double))));
using Lanes = double __attribute__((vector_size(pack_size * sizeof(double))));

inline Row load_row(const double* address) {
  Row row;
  std::memcpy(&row, address, sizeof(Row));
  return row;
}

inline Pack to_pack(const Lanes& lanes) {
  PackBlock block;
  std::memcpy(block.lane, &lanes, sizeof(Lanes));
  return load(block.lane);
}

inline Lanes to_lanes(const Pack& pack) {
  PackBlock block;
  store(pack, block.lane);
  Lanes lanes;
  std::memcpy(&lanes, block.lane, sizeof(Lanes));
  return lanes;
}

/// Rows x y z w of four nodes become x, y and z of four nodes.
struct Columns {
  Row component[3];
};

inline Columns transpose_rows(const Row& a, const Row& b, const Row& c, const Row& d) {
  const Row ab_xy = __builtin_shufflevector(a, b, 0, 4, 1, 5);  // ax bx ay by
  const Row cd_xy = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Row ab_zw = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Row cd_zw = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {{__builtin_shufflevector(ab_xy, cd_xy, 0, 1, 4, 5), __builtin_shufflevector(ab_xy, cd_xy, 2, 3, 6, 7),
           __builtin_shufflevector(ab_zw, cd_zw, 0, 1, 4, 5)}};
}

}  // namespace detail

/// x, y, z of one node of each of pack_size elements. `connectivity` points to that node of the first of them; the same node
/// of the next element lies `stride` (nodes per element) further on.
inline Vector3<Pack> gather_node(const double* nodal, const std::int32_t* connectivity, int stride) {
  using namespace detail;
  static_assert(pack_size == 8);
  Row row[pack_size];
  for (int lane = 0; lane < pack_size; ++lane) row[lane] = load_row(nodal + 4 * std::ptrdiff_t{connectivity[lane * stride]});
  const Columns low = transpose_rows(row[0], row[1], row[2], row[3]);
  const Columns high = transpose_rows(row[4], row[5], row[6], row[7]);
  Vector3<Pack> result;
  for (int i = 0; i < 3; ++i)
    result[i] = to_pack(__builtin_shufflevector(low.component[i], high.component[i], 0, 1, 2, 3, 4, 5, 6, 7));
  return result;
}

/// x, y, z of one node for the scalar instantiation of a kernel.
inline Vector3<double> gather_node(const double* nodal, std::int32_t node) {
  const double* row = nodal + 4 * std::ptrdiff_t{node};
  return {{row[0], row[1], row[2]}};
}

/// Adds `addend` of each lane, rounded with its node's constant, lane after lane (two lanes may share a node). The fourth
/// double of a row is the rounding constant M and stays: (0 + M) - M = 0 is added to it.
inline void scatter_node(const Vector3<Pack>& addend, const std::int32_t* connectivity, int stride, double* nodal) {
  using namespace detail;
  static_assert(pack_size == 8);
  const Lanes zero{};
  const Lanes x = to_lanes(addend[0]), y = to_lanes(addend[1]), z = to_lanes(addend[2]);
  const Lanes xy_even = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes xy_odd = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes zw_even = __builtin_shufflevector(z, zero, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes zw_odd = __builtin_shufflevector(z, zero, 1, 9, 3, 11, 5, 13, 7, 15);
  const Row rows[pack_size] = {
      __builtin_shufflevector(xy_even, zw_even, 0, 1, 8, 9),   __builtin_shufflevector(xy_odd, zw_odd, 0, 1, 8, 9),
      __builtin_shufflevector(xy_even, zw_even, 2, 3, 10, 11), __builtin_shufflevector(xy_odd, zw_odd, 2, 3, 10, 11),
      __builtin_shufflevector(xy_even, zw_even, 4, 5, 12, 13), __builtin_shufflevector(xy_odd, zw_odd, 4, 5, 12, 13),
      __builtin_shufflevector(xy_even, zw_even, 6, 7, 14, 15), __builtin_shufflevector(xy_odd, zw_odd, 6, 7, 14, 15)};
  for (int lane = 0; lane < pack_size; ++lane) {
    double* address = nodal + 4 * std::ptrdiff_t{connectivity[lane * stride]};
    Row row = load_row(address);
    const Row constant = __builtin_shufflevector(row, row, 3, 3, 3, 3);
    row += (rows[lane] + constant) - constant;
    std::memcpy(address, &row, sizeof(Row));
  }
}

/// The same for one node of the scalar instantiation.
inline void scatter_node(const Vector3<double>& addend, std::int32_t node, double* nodal) {
  double* row = nodal + 4 * std::ptrdiff_t{node};
  for (int i = 0; i < 3; ++i) row[i] += rounded(addend[i], row[3]);
}

}  // namespace balocco
