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

inline Pack with_lane(Pack pack, int lane, double value) {
  static const Pack number([](auto i) { return static_cast<double>(i); });
  where(number == static_cast<double>(lane), pack) = value;
  return pack;
}
inline double sum_of(const Pack& pack) { return std::experimental::reduce(pack); }

}  // namespace balocco
