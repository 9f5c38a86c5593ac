#include "machine.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "elements/aligned_vector.hpp"
#include "math/pack.hpp"

namespace balocco::bench {

namespace {

/// Best of several timings, in nanoseconds: the machine may be shared.
template <class Work>
double best_nanoseconds(const Work& work, int repetitions) {
  double best = 1e300;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - start;
    best = std::min(best, passed.count());
  }
  return best;
}

}  // namespace

double peak_flops_per_ns() {
  constexpr int chains = 12, rounds = 100000;  // enough independent chains to hide the latency
  std::array<Pack, chains> sum;
  for (int i = 0; i < chains; ++i) sum[i] = 1.0 + i;
  const Pack factor = 0.999999, addend = 1e-6;
  const double time = best_nanoseconds(
      [&] {
        std::array<Pack, chains> local = sum;
        for (int round = 0; round < rounds; ++round)
          for (auto& s : local) s = std::experimental::fma(s, factor, addend);
        sum = local;
        benchmark::DoNotOptimize(sum);
      },
      10);
  return 2.0 * pack_size * chains * rounds / time;
}

double triad_bytes_per_ns() {
  constexpr std::size_t size = 16 << 20;  // 128 MiB each
  AlignedVector<double> a(size, 0.0), b(size, 1.0), c(size, 2.0);
  const double time = best_nanoseconds(
      [&] {
        for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + 3.0 * c[i];
        benchmark::DoNotOptimize(a.data());
        benchmark::ClobberMemory();
      },
      10);
  return 24.0 * size / time;
}

}  // namespace balocco::bench
