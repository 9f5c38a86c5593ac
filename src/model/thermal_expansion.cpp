#include "model/thermal_expansion.hpp"

#include <algorithm>

namespace balocco {

double ThermalExpansion::coefficient(double temperature) const {
  const auto above = std::ranges::find_if(rows, [&](const auto& row) { return row[1] > temperature; });
  if (above == rows.begin()) return rows.front()[0];
  if (above == rows.end()) return rows.back()[0];
  const auto &low = *(above - 1), &high = *above;
  return low[0] + (high[0] - low[0]) * (temperature - low[1]) / (high[1] - low[1]);
}

double ThermalExpansion::strain(double temperature, double initial) const {
  return coefficient(temperature) * (temperature - reference) - coefficient(initial) * (initial - reference);
}

}  // namespace balocco
