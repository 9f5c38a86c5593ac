// What the core itself can do, measured in the same run as the kernels.
#pragma once

namespace balocco::bench {

/// Fused multiply-adds of independent packs: floating-point operations per nanosecond, two for each.
double peak_flops_per_ns();

/// Stream triad a = b + s c on arrays far beyond the last cache: bytes per nanosecond, three moved for each entry.
double triad_bytes_per_ns();

}  // namespace balocco::bench
