#include "model/check_density.hpp"

#include <fmt/format.h>

#include <set>

#include "loads/body_load.hpp"

namespace balocco {

namespace {

/// Sections of the elements that the step's loads on mass act on.
std::set<std::int32_t> sections_loaded_by_mass(const Model& model, const Step& step) {
  std::set<std::int32_t> sections;
  for (const auto& load : step.body_loads) {
    if (!acts_on_mass(load)) continue;
    if (load.element_set < 0)
      for (const auto& table : model.elements) sections.insert(table.section.begin(), table.section.end());
    else
      for (const auto element : model.element_sets[load.element_set].elements)
        sections.insert(model.elements[element.table].section[element.row]);
  }
  return sections;
}

}  // namespace

std::vector<std::pair<Location, std::string>> check_density(const Model& model) {
  std::vector<std::pair<Location, std::string>> errors;
  for (const auto& step : model.steps) {
    const auto loaded = sections_loaded_by_mass(model, step);
    const auto why = step.needs_mass() ? fmt::format("step {} ({})", step.name, step.procedure_name())
                                       : "a load on mass (GRAV, CENTRIF)";
    const auto need = [&](std::int32_t material) {
      if (material < 0 || model.materials[material].density > 0.0) return;
      errors.emplace_back(model.materials[material].location,
                          fmt::format("*MATERIAL: material {} has no density, which {} needs; add *DENSITY",
                                      model.materials[material].name, why));
    };
    for (std::size_t row = 0; row < model.sections.size(); ++row) {
      if (!step.needs_mass() && !loaded.contains(static_cast<std::int32_t>(row))) continue;
      need(model.sections[row].material);
      for (const auto& ply : model.sections[row].plies) need(ply.material);
    }
  }
  return errors;
}

}  // namespace balocco
