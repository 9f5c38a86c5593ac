// *FIXED MASS SCALING, *VARIABLE MASS SCALING.
#include "deck/mass_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

bool scales(const ElementType& type) {
  using Kind = Section::Kind;
  return std::ranges::count(std::array{Kind::solid, Kind::membrane, Kind::shell, Kind::truss, Kind::beam}, type.section) > 0;
}

/// The set that the block names, or -1; empty: an error was told.
std::optional<std::int32_t> scaled_set(Builder& builder, const Block& block) {
  if (!block.has("ELSET")) return -1;
  const auto set = builder.require(builder.element_sets, block.value("ELSET"), block, block.location);
  if (!set) return std::nullopt;
  const auto is_scaled = [&](const ElementRef& element) { return scales(*builder.model.elements[element.table].type); };
  if (std::ranges::any_of(builder.elements_in(*set), is_scaled)) return set;
  builder.error(
      block, block.location,
      fmt::format("{} has no solids, membranes, shells, trusses or beams, whose masses alone are scaled; give its elements "
                  "another mass, or name another set",
                  block.value("ELSET")));
  return std::nullopt;
}

/// DT and TYPE. @return false if an error was told.
bool read_target(Builder& builder, const Block& block, MassScaling& definition) {
  using Target = MassScaling::Target;
  if (!block.has("DT")) {
    if (!block.has("TYPE")) return true;
    builder.error(block, block.location, "TYPE says how to reach a stable increment; add DT=");
    return false;
  }
  definition.increment = block.real("DT", 0.0);
  const std::string type = block.value("TYPE", "BELOW MIN");
  definition.target = type == "UNIFORM" ? Target::uniform : type == "BELOW MIN" ? Target::below_minimum : Target::equal;
  if (definition.increment > 0.0) return true;
  builder.error(block, block.location, fmt::format("DT={} must be positive; correct it", definition.increment));
  return false;
}

std::vector<MassScaling>& definitions(Builder& builder, const Block& block,
                                      std::optional<std::vector<MassScaling>> StepDraft::*kind) {
  auto& draft = builder.draft;
  if (!draft.fixed_mass_scaling && !draft.variable_mass_scaling) draft.mass_scaling_location = block.location;
  auto& said = draft.*kind;
  if (!said) said.emplace();
  return *said;
}

void read_fixed(Builder& builder, const Block& block) {
  auto& said = definitions(builder, block, &StepDraft::fixed_mass_scaling);
  MassScaling definition;
  definition.factor = block.real("FACTOR", 1.0);
  if (!(definition.factor > 0.0))
    return builder.error(block, block.location, fmt::format("FACTOR={} must be positive; correct it", definition.factor));
  const auto set = scaled_set(builder, block);
  if (!set || !read_target(builder, block, definition)) return;
  definition.element_set = *set;
  said.push_back(definition);
}

void read_variable(Builder& builder, const Block& block) {
  auto& said = definitions(builder, block, &StepDraft::variable_mass_scaling);
  if (!block.has("DT")) {
    for (const char* parameter : {"TYPE", "FREQUENCY", "NUMBER INTERVAL", "ELSET"})
      if (block.has(parameter))
        return builder.error(
            block, block.location,
            fmt::format("{} has a meaning only with DT; add DT=, or leave both out to end the scaling of the steps before",
                        parameter));
    return said.clear();
  }
  MassScaling definition;
  const auto set = scaled_set(builder, block);
  if (!set || !read_target(builder, block, definition)) return;
  definition.element_set = *set;
  const bool by_increments = block.has("FREQUENCY"), by_intervals = block.has("NUMBER INTERVAL");
  if (by_increments == by_intervals)
    return builder.error(block, block.location,
                         "it does not say when to scale; add either FREQUENCY=increments or NUMBER INTERVAL=intervals");
  const char* const when = by_increments ? "FREQUENCY" : "NUMBER INTERVAL";
  const auto number = block.integer(when, 1);
  if (number < 1) return builder.error(block, block.location, fmt::format("{}={} must be positive; correct it", when, number));
  (by_increments ? definition.frequency : definition.number_interval) = number;
  said.push_back(definition);
}

/// Of the last explicit step before the current one.
const ExplicitProcedure* explicit_before(const Model& model) {
  for (std::size_t row = model.steps.size() - 1; row-- > 0;)
    if (const auto* procedure = std::get_if<ExplicitProcedure>(&model.steps[row].procedure)) return procedure;
  return nullptr;
}

const RegisterKeyword fixed{
    {.keyword = "FIXED MASS SCALING",
     .phase = Phase::history,
     .place = Place::step,
     .parameters = {real("FACTOR"), real("DT"), choice("TYPE", {"UNIFORM", "BELOW MIN", "SET EQUAL DT"}), name("ELSET")},
     .handler = read_fixed}};
const RegisterKeyword variable_mass_scaling{{.keyword = "VARIABLE MASS SCALING",
                                             .phase = Phase::history,
                                             .place = Place::step,
                                             .parameters = {real("DT"), choice("TYPE", {"UNIFORM", "BELOW MIN", "SET EQUAL DT"}),
                                                            integer("FREQUENCY"), integer("NUMBER INTERVAL"), name("ELSET")},
                                             .handler = read_variable}};

}  // namespace

void end_mass_scaling(Builder& builder) {
  const auto& draft = builder.draft;
  auto* procedure = std::get_if<ExplicitProcedure>(&builder.model.steps.back().procedure);
  if (procedure == nullptr) {
    if (draft.has_procedure && (draft.fixed_mass_scaling || draft.variable_mass_scaling))
      builder.diagnostics.error(draft.mass_scaling_location, "MASS SCALING",
                                "only *DYNAMIC, EXPLICIT has an increment that depends on masses; remove it from this step");
    return;
  }
  if (draft.fixed_mass_scaling) procedure->fixed_mass_scaling = *draft.fixed_mass_scaling;
  if (draft.variable_mass_scaling)
    procedure->variable_mass_scaling = *draft.variable_mass_scaling;
  else if (const auto* before = explicit_before(builder.model))
    procedure->variable_mass_scaling = before->variable_mass_scaling;
}

}  // namespace balocco::deck
