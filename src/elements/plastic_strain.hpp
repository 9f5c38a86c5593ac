// The plastic strain tensor PE of metals, for output.
#pragma once

#include <array>

namespace balocco {

/// PE = LE - elastic logarithmic strain of isotropic Hencky elasticity, (1 + nu) / E tau - nu / E tr(tau) 1, with Kirchhoff's stress
/// tau = exp(tr LE) sigma: what elastic unloading without rotation would leave. `logarithmic` is LE, 11 22 33 12 13 23 with
/// engineering shears, as the result; `cauchy` has the tensor's own shears; both in the same directions.
std::array<double, 6> plastic_strain(const std::array<double, 6>& logarithmic, const std::array<double, 6>& cauchy, double young,
                                     double poisson);

}  // namespace balocco
