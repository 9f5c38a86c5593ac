// Floating-point operations of the explicit solid kernels, counted by running those very templates with a counting
// scalar.
#pragma once

#include <string>

namespace balocco::bench {

/// Operations per element-cycle of an undamped element with bulk viscosity; square roots, divisions and maxima count as
/// one. 0 where the kernel cannot be counted.
double flops_per_element(const std::string& type, const std::string& law);

}  // namespace balocco::bench
