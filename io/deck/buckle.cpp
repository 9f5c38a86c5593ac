// *BUCKLE.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/step_draft.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// Stresses of the step's loads are initial stresses to the stiffness: only elements that can have these count them.
void give_initial_stresses(Builder& builder, const Block& block) {
  for (auto& section : builder.model.sections) {
    using Kind = Section::Kind;
    const bool stressed = section.kind == Kind::solid || section.kind == Kind::membrane || section.kind == Kind::truss ||
                          (section.kind == Kind::shell && !section.shell.general);
    if (!stressed && section.kind != Kind::shell && section.kind != Kind::beam) continue;
    const auto& material = section.material;
    const bool yields = material >= 0 && std::ranges::any_of(builder.model.materials[material].options,
                                                             [](const auto& option) { return option.name.starts_with("plastic"); });
    if (!stressed || yields || section.orientation >= 0) {
      builder.error(block, block.location,
                    fmt::format("the section of {} {}; load factors are those of solids, shells with points in their thickness, membranes and trusses that "
                                "neither yield nor have an ORIENTATION",
                                section.element_set, !stressed ? "is a general one, or of beams" : yields ? "yields" : "has an ORIENTATION"));
      return;
    }
    section.initially_stressed = true;
  }
}

/// The number of factors; how another code should find them comes behind.
void read_buckle(Builder& builder, const Block& block) {
  if (!begin_procedure(builder, block)) return;
  auto& procedure = builder.model.steps.back().procedure.emplace<BuckleProcedure>();
  if (block.lines.empty()) return builder.error(block, block.location, "how many load factors is not said; add a line with their number");
  Row row(builder, block, block.lines[0]);
  procedure.number = static_cast<std::int32_t>(row.integer(0, "number of load factors"));
  row.at_most(4);
  if (row.ok() && procedure.number < 1) row.error(fmt::format("{} load factors are asked for; ask for one or more", procedure.number));
  give_initial_stresses(builder, block);
}

const RegisterKeyword buckle{{"BUCKLE", Phase::history, Place::step, {foreign("SOLVER")}, read_buckle}};

}  // namespace

}  // namespace balocco::deck
