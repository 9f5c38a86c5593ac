#include "elements/initial_stress_rows.hpp"

#include <array>

#include "elements/element_type.hpp"

namespace balocco {

std::span<const int> initial_stress_components(const Model& model, const ElementGroup& group) {
  static constexpr std::array solid{0, 1, 2, 3, 4, 5};
  static constexpr std::array plane{0, 1, 3};
  static constexpr std::array line{0};
  switch (model.elements[group.table()].type->section) {
    case Section::Kind::solid:
      return solid;
    case Section::Kind::membrane:
    case Section::Kind::shell:
      return plane;
    case Section::Kind::beam:
    case Section::Kind::truss:
      return line;
    default:
      return {};
  }
}

std::vector<int> initial_stress_rows(const Model& model, const ElementGroup& group) {
  std::vector<int> rows;
  const auto count = static_cast<int>(initial_stress_components(model, group).size());
  for (int point = 0; point < group.integration_points(); ++point) {
    const int first = group.law_field_row("S0", point);
    for (int k = 0; k < count && first >= 0; ++k) rows.push_back(first + k);
  }
  return rows;
}

}  // namespace balocco
