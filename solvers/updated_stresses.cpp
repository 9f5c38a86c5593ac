#include "updated_stresses.hpp"

#include <algorithm>

#include "elements/element_type.hpp"
#include "materials/initial_stress.hpp"

namespace balocco {

namespace {

constexpr int components = initial_stress_size(PointKind::solid);

std::size_t place_of(const ElementGroup& group, std::int32_t element) {
  return static_cast<std::size_t>(group.row(element)) * group.integration_points() * components;
}

bool is_imported(const Model& model, const ElementGroup& group, std::int32_t element) {
  return std::ranges::binary_search(model.state_import->elements, ElementRef{group.table(), group.row(element)});
}

}  // namespace

PointStresses stresses_of_imported_solids(const Analysis& analysis) {
  PointStresses stresses;
  for (const auto& table : analysis.model.elements) {
    const bool solids = table.type->section == Section::Kind::solid;
    stresses.emplace_back(solids ? static_cast<std::size_t>(table.size()) * table.type->integration_points * components : 0, 0.0);
  }
  for (std::size_t g = 0; g < analysis.element_groups.size(); ++g) {
    const auto& group = *analysis.element_groups[g];
    auto& of_table = stresses[group.table()];
    for (std::int32_t element = 0; element < group.size() && !of_table.empty(); ++element) {
      if (!is_imported(analysis.model, group, element)) continue;
      for (int point = 0; point < group.integration_points(); ++point)
        analysis.element(g, "S", element, point, std::span(of_table).subspan(place_of(group, element) + point * components, components));
    }
  }
  for (auto& of_table : stresses) analysis.communicator.sum(std::span<double>(of_table));
  return stresses;
}

void start_from_stresses(const PointStresses& stresses, Analysis& analysis) {
  for (std::size_t g = 0; g < analysis.element_groups.size(); ++g) {
    const auto& group = *analysis.element_groups[g];
    const auto& of_table = stresses[group.table()];
    auto& history = analysis.current.element_history[g];
    for (std::int32_t lane = 0; lane < group.padded_size() && !of_table.empty(); ++lane) {
      if (!is_imported(analysis.model, group, lane)) continue;
      for (int point = 0; point < group.integration_points(); ++point)
        for (int k = 0; k < components; ++k)
          history[static_cast<std::size_t>(group.law_field_row("S0", point) + k) * group.padded_size() + lane] =
              of_table[place_of(group, lane) + point * components + k];
    }
  }
}

}  // namespace balocco
