// Where the history of elements keeps the stress that they have in the undeformed state (materials/initial_stress.hpp).
#pragma once

#include <span>
#include <vector>

#include "elements/element_group.hpp"

namespace balocco {

/// The components of an initial stress of such elements among those of a stress as it is shown, 11 22 33 12 13 23.
std::span<const int> initial_stress_components(const Model& model, const ElementGroup& group);

/// Components of an element's history that are its points' initial stress; empty: it has none.
std::vector<int> initial_stress_rows(const Model& model, const ElementGroup& group);

/// Components of an element's history that are its points' thermal strain (materials/expanding.hpp); empty: it has none.
inline std::vector<int> thermal_strain_rows(const ElementGroup& group) {
  std::vector<int> rows;
  for (int point = 0; point < group.integration_points(); ++point)
    if (const int row = group.law_field_row("THE", point); row >= 0) rows.push_back(row);
  return rows;
}

}  // namespace balocco
