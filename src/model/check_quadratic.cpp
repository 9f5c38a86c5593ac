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

}  // namespace

Errors check_quadratic(const Model& model) {
  Errors errors;
  for (const auto& step : model.steps)
    if (std::holds_alternative<ExplicitProcedure>(step.procedure)) check_explicit(model, step, errors);
  return errors;
}

}  // namespace balocco
