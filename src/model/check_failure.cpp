#include "model/check_failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "elements/element_type.hpp"
#include "materials/material_option.hpp"

namespace balocco {

namespace {

using Errors = std::vector<std::pair<Location, std::string>>;

/// The material of a section that can fail, or nullptr.
const Material* failing_material(const Model& model, const Section& section) {
  const auto fails = [&](std::int32_t material) {
    return material >= 0 && find_option(model.materials[material], "shear-failure") != nullptr;
  };
  if (fails(section.material)) return &model.materials[section.material];
  for (const auto& ply : section.plies)
    if (fails(ply.material)) return &model.materials[ply.material];
  return nullptr;
}

const Material* failing_material(const Model& model, const ElementTable& table, std::int32_t row) {
  return table.section[row] < 0 ? nullptr : failing_material(model, model.sections[table.section[row]]);
}

/// An element goes as a whole; one of whose points some are gone would turn inside out at that corner.
bool can_be_deleted(const ElementType& type) {
  const bool family = type.section == Section::Kind::solid || type.section == Section::Kind::shell || type.section == Section::Kind::truss;
  return family && type.integration_points == 1;
}

void check_elements(const Model& model, Errors& errors) {
  for (const auto& table : model.elements) {
    if (can_be_deleted(*table.type)) continue;
    for (std::int32_t row = 0; row < table.size(); ++row) {
      const Material* material = failing_material(model, table, row);
      if (material == nullptr) continue;
      errors.emplace_back(material->location,
                          fmt::format("*SHEAR FAILURE: material {} belongs to element {}, a {}; only elements of one point (C3D8R, "
                                      "S4R, S3R, T3D2) are deleted, so use one of those or remove *SHEAR FAILURE",
                                      material->name, table.id[row], table.type->name));
      break;
    }
  }
}

void check_surface_loads(const Model& model, const Step& step, Errors& errors) {
  for (const auto& load : step.surface_loads)
    for (const auto& face : acts_on_edges(load.kind) ? model.surfaces[load.surface].edges : model.surfaces[load.surface].faces) {
      const auto& table = model.elements[face.element.table];
      const Material* material = failing_material(model, table, face.element.row);
      if (material == nullptr) continue;
      errors.emplace_back(Location{load.file, load.line},
                          fmt::format("the load on surface {} would go on after element {} is deleted (*SHEAR FAILURE of material "
                                      "{}); take such elements out of the surface",
                                      model.surfaces[load.surface].name, table.id[face.element.row], material->name));
      break;
    }
}

}  // namespace

Errors check_failure(const Model& model) {
  Errors errors;
  const bool any = std::ranges::any_of(model.sections, [&](const auto& section) { return failing_material(model, section) != nullptr; });
  if (!any) return errors;
  check_elements(model, errors);
  for (const auto& step : model.steps)
    if (std::holds_alternative<ExplicitProcedure>(step.procedure)) check_surface_loads(model, step, errors);
  return errors;
}

}  // namespace balocco
