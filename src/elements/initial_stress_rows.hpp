// Where the history of elements keeps the stress that they have in the undeformed state (materials/initial_stress.hpp).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "elements/element_group.hpp"

namespace balocco {

/// The components of an initial stress of such elements among those of a stress as it is shown, 11 22 33 12 13 23: lines have two nodes,
/// and sheets a thickness to show.
inline std::span<const int> initial_stress_components(const ElementGroup& group) {
  static constexpr std::array solid{0, 1, 2, 3, 4, 5};
  static constexpr std::array plane{0, 1, 3};
  static constexpr std::array line{0};
  if (group.nodes_per_element() == 2) return line;
  return group.output_components("STH") > 0 ? std::span<const int>(plane) : std::span<const int>(solid);
}

/// Components of an element's history that are its points' initial stress; empty: it has none.
inline std::vector<int> initial_stress_rows(const ElementGroup& group) {
  std::vector<int> rows;
  const auto count = static_cast<int>(initial_stress_components(group).size());
  for (int point = 0; point < group.integration_points(); ++point) {
    const int first = group.law_field_row("S0", point);
    for (int k = 0; k < count && first >= 0; ++k) rows.push_back(first + k);
  }
  return rows;
}

}  // namespace balocco
