#include "deck/updated_stresses.hpp"

#include <fmt/format.h>

#include "elements/element_type.hpp"
#include "materials/elastic_by_temperature.hpp"

namespace balocco::deck {

namespace {

/// Why elements of a type and section cannot go on with their stress in another reference configuration; empty: they can, or have none.
std::string reason_against(const Model& model, const ElementType& type, const Section& section) {
  switch (section.kind) {
    case Section::Kind::mass:
    case Section::Kind::rotary_inertia:
    case Section::Kind::rigid:
      return {};
    case Section::Kind::solid:
      break;
    case Section::Kind::spring:
    case Section::Kind::dashpot:
    case Section::Kind::connector:
      return "its force is counted from the lengths and angles that it had at first";
    default:
      return "its directions, thickness or area are those of the sheet or bar that it was at first";
  }
  if (section.orientation >= 0) return "its section has an ORIENTATION, which has turned with it";
  if (section.material < 0) return {};  // told
  const auto& material = model.materials[section.material];
  if (material.law != "elastic")
    return fmt::format("the law of its material {} is not *ELASTIC of an isotropic solid: the stress is that of the whole deformation "
                       "since it was free of stress, which UPDATE=YES would forget",
                       material.name);
  if (ElasticTable::is_in(material))
    return fmt::format("the constants of its material {} follow the temperature, which the imported state does not tell", material.name);
  if (!material.options.empty())
    return fmt::format("its material {} yields or relaxes: what it remembers is of the shape before, which UPDATE=YES would forget",
                       material.name);
  if (type.nodes == 8 && type.integration_points == 1)
    return "its hourglass stiffness, which carries bending, counts from the shape that it had at first (C3D8 and C3D8I can)";
  return {};
}

}  // namespace

void keep_updated_stresses(Builder& builder) {
  auto& model = builder.model;
  if (!model.state_import || !model.state_import->state || !model.state_import->update) return;
  for (const auto& element : model.state_import->elements) {
    const auto& table = model.elements[element.table];
    const auto row = table.section[element.row];
    if (row < 0) continue;  // told
    auto& section = model.sections[row];
    if (const auto reason = reason_against(model, *table.type, section); !reason.empty())
      return builder.diagnostics.error(
          model.state_import->location, "IMPORT",
          fmt::format("UPDATE=YES with STATE=YES: {} element {} cannot go on with its stress, since {}; import it with UPDATE=NO",
                      table.type->name, model.element_name(element), reason));
    section.initially_stressed = section.initially_stressed || section.kind == Section::Kind::solid;
  }
}

}  // namespace balocco::deck
