// Eight numbers side by side in memory: the rows of a small constraint, one a lane. Sums over lanes keep their order.
#pragma once

#include "math/pack.hpp"

namespace balocco {

struct alignas(64) Lanes {
  std::array<double, pack_size> lane{};

  double& operator[](int i) { return lane[i]; }
  double operator[](int i) const { return lane[i]; }
  Pack pack() const { return load(lane.data()); }
  void set(const Pack& pack) { store(pack, lane.data()); }
};

inline double sum_of(const Pack& pack) { return std::experimental::reduce(pack); }

}  // namespace balocco
