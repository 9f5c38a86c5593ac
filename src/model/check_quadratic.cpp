#include "model/check_quadratic.hpp"

#include <fmt/format.h>

#include "elements/element_type.hpp"

namespace balocco {

namespace {

using Errors = std::vector<std::pair<Location, std::string>>;

void check_explicit(const Model& model, const Step& step, Errors& errors) {
  for (const auto& table : model.elements)
    if (table.type->implicit_only && table.size() > 0)
      errors.emplace_back(
          table.location[0],
          fmt::format("*ELEMENT: {} is computed in implicit steps only, and step {} is explicit; use C3D8R, C3D8 or "
                      "C3D10",
                      table.type->name, step.name));
}

/// The areas that stand for the corners of a quadratic face are negative or zero.
void check_slaves(const Model& model, const ContactPair& pair, Errors& errors) {
  for (const auto& face : model.surfaces[pair.slave].faces) {
    const ElementType& type = *model.elements[face.element.table].type;
    if (type.face_midsides.empty()) continue;
    errors.emplace_back(
        pair.location, fmt::format("*CONTACT PAIR: element {} of the slave surface {} is a {}: contact of the nodes of "
                                   "quadratic faces is not supported; use linear elements there",
                                   model.element_name(face.element), model.surfaces[pair.slave].name, type.name));
    return;
  }
}

}  // namespace

Errors check_quadratic(const Model& model) {
  Errors errors;
  for (const auto& step : model.steps)
    if (std::holds_alternative<ExplicitProcedure>(step.procedure)) check_explicit(model, step, errors);
  for (const auto& pair : model.contact_pairs) check_slaves(model, pair, errors);
  return errors;
}

}  // namespace balocco
