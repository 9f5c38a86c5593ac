// The scalar equation of J2 return mappings.
#pragma once

#include "materials/flow_stress.hpp"
#include "materials/material_law.hpp"

namespace balocco {

/// Increment dp of equivalent plastic strain at which `residual(dp)`, a falling Sloped<V> in units of stress, is zero, for lanes
/// that yield (`yields`); the others' values mean nothing. `stiffness`: at least residual's slope in size where the flow stress is
/// constant, so that dp <= trial_mises / stiffness. Newton's method within a bracket; lanes that have arrived stay where they are,
/// so that a lane equals the scalar.
template <class V>
V plastic_increment(const FlowStress& flow, const V& equivalent_plastic_strain, double increment, const V& trial_mises,
                    double stiffness, const auto& yields, const auto& residual) {
  const double exponent = increment < quasi_static ? flow.search_exponent() : 1.0;
  const bool curved = exponent != 1.0;
  V scale = V(1.0);
  if (curved) {  // the overstress law and elasticity both bound the increment from above
    const V still = flow.static_curve(equivalent_plastic_strain).value;
    const V rate_bound = (increment * flow.rate_parameter) * power(maximum(trial_mises / still - 1.0, V(0.0)), exponent);
    const V elastic_bound = (1.0 / stiffness) * trial_mises;
    scale = -maximum(-rate_bound, -elastic_bound);
  }
  V low = V(0.0), high = curved ? V(1.0) : (1.0 / stiffness) * trial_mises, y = curved ? high : low;
  const V tolerance = 1e-14 * trial_mises;
  constexpr int most_iterations = 60;
  for (int i = 0; i < most_iterations; ++i) {
    const V dp = curved ? scale * power(y, exponent) : y;
    const Sloped<V> r = residual(dp);
    const auto open = yields && maximum(r.value, -r.value) > tolerance;
    if (!any(open)) break;
    const V slope = curved ? r.slope * (exponent * dp / y) : r.slope;
    low = select(r.value > 0.0, y, low);
    high = select(r.value > 0.0, high, y);
    const V newton = y - r.value / slope;
    const V next = select(newton >= low && newton <= high, newton, 0.5 * (low + high));
    y = select(open, next, y);
  }
  return curved ? scale * power(y, exponent) : y;
}

}  // namespace balocco
