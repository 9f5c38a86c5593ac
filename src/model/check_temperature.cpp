#include "model/check_temperature.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/element_type.hpp"
#include "materials/elastic_by_temperature.hpp"

namespace balocco {

namespace {

using Errors = std::vector<std::pair<Location, std::string>>;

/// Thermal strain is a matter of laws that are evaluated at points (materials/expanding.hpp).
void check_expansion(const Section& section, const Material& material, Errors& errors) {
  using Kind = Section::Kind;
  const bool is_sheet = section.kind == Kind::membrane || (section.kind == Kind::shell && !section.shell.general);
  const bool expands = section.kind == Kind::solid || section.kind == Kind::truss || section.kind == Kind::beam || (is_sheet && section.plies.empty());
  if (!material.expansion || expands) return;
  errors.emplace_back(section.location, fmt::format("*{}SECTION: its material {} has *EXPANSION, which is followed in solids, trusses, beams and sheets "
                                                    "of one material; take *EXPANSION out, or model the part with solids",
                                                    section.kind == Kind::membrane  ? "MEMBRANE "
                                                    : section.shell.general ? "SHELL GENERAL "
                                                                            : "SHELL ",
                                                    material.name));
}

/// Only the law of solids follows it (materials/elastic_by_temperature.hpp), and no hourglass stiffness does.
void check_elastic_table(const Model& model, const Section& section, const Material& material, Errors& errors) {
  if (!ElasticTable::is_in(material)) return;
  const auto row = static_cast<std::int32_t>(&section - model.sections.data());
  const bool is_reduced = std::ranges::any_of(model.elements, [&](const ElementTable& table) {
    return table.type->nodes == 8 && table.type->integration_points == 1 && std::ranges::count(table.section, row) > 0;
  });
  if (section.kind == Section::Kind::solid && !is_reduced) return;
  errors.emplace_back(section.location, fmt::format("*ELASTIC: the constants of material {} follow the temperature, which solids other than C3D8R "
                                                    "alone do; give one line of constants, or take C3D8 or C3D8I",
                                                    material.name));
}

/// Perturbations know no thermal loads.
void check_step(const Model& model, const Step& step, Errors& errors) {
  if (step.temperatures.empty() || std::ranges::none_of(model.materials, follows_temperature)) return;
  const auto moves = [](const NodalTemperature& said) { return said.magnitude != said.previous; };
  const bool superposes = std::holds_alternative<BuckleProcedure>(step.procedure) || std::holds_alternative<ModalDynamicProcedure>(step.procedure) ||
                          step.is_harmonic();
  if (superposes || (step.is_perturbation() && std::ranges::any_of(step.temperatures, moves)))
    errors.emplace_back(Location{step.temperatures.front().file, step.temperatures.front().line},
                        fmt::format("*TEMPERATURE: step {} of {} does not follow temperatures; use *STATIC or *DYNAMIC, or give the job no temperatures",
                                    step.name, step.procedure_name()));
}

}  // namespace

Errors check_temperature(const Model& model) {
  Errors errors;
  const auto check = [&](const Section& section, std::int32_t row) {
    if (row < 0 || model.materials[row].law.empty()) return;  // told
    check_expansion(section, model.materials[row], errors);
    check_elastic_table(model, section, model.materials[row], errors);
  };
  for (const auto& section : model.sections) {
    check(section, section.material);
    for (const auto& ply : section.plies) check(section, ply.material);
  }
  for (const auto& step : model.steps) check_step(model, step, errors);
  return errors;
}

}  // namespace balocco
