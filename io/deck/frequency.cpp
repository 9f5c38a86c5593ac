// *FREQUENCY.
#include <fmt/format.h>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/step_draft.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// Field `index` of the line as a frequency that must not be negative.
std::optional<double> bound(Row& row, int index, const char* what) {
  if (!row.has(index)) return std::nullopt;
  const double value = row.real(index, what);
  if (row.ok() && value < 0.0) row.error(fmt::format("the {} {} is negative; correct it", what, value));
  return value;
}

/// Lanczos: number, lower and upper frequency, shift, then how another code should compute. Subspace: number, upper, shift.
void read_frequency(Builder& builder, const Block& block) {
  if (!begin_procedure(builder, block)) return;
  auto& procedure = builder.model.steps.back().procedure.emplace<FrequencyProcedure>();
  if (block.value("NORMALIZATION", "DISPLACEMENT") == "MASS")
    procedure.normalization = FrequencyProcedure::Normalization::mass;
  const bool subspace = block.value("EIGENSOLVER", "LANCZOS") == "SUBSPACE";
  if (block.lines.empty())
    return builder.error(block, block.location, "how many modes is not said; add a line: number, lowest, highest frequency");
  Row row(builder, block, block.lines[0]);
  if (row.has(0)) procedure.number = static_cast<std::int32_t>(row.integer_or(0, 0, "number of modes"));
  if (!subspace) procedure.lower = bound(row, 1, "lowest frequency");
  procedure.upper = bound(row, subspace ? 1 : 2, "highest frequency");
  procedure.shift = row.real_or(subspace ? 2 : 3, 0.0, "shift");
  row.at_most(7);
  if (!row.ok()) return;
  if (procedure.number && *procedure.number < 1)
    row.error(fmt::format("{} modes are asked for; ask for one or more", *procedure.number));
  else if (!procedure.number && !procedure.upper)
    row.error("neither the number of modes nor the highest frequency is given; fill field 1 or 3");
  else if (procedure.upper && *procedure.upper <= procedure.lower.value_or(0.0))
    row.error(fmt::format("the highest frequency {} does not exceed the lowest; correct it", *procedure.upper));
}

const RegisterKeyword frequency{{"FREQUENCY",
                                 Phase::history,
                                 Place::step,
                                 {choice("EIGENSOLVER", {"LANCZOS", "SUBSPACE"}),
                                  choice("NORMALIZATION", {"DISPLACEMENT", "MASS"}), flag("SIM"),
                                  choice("ACOUSTIC COUPLING", {"ON", "OFF", "PROJECTION"}), foreign("STORAGE"), foreign("SOLVER")},
                                 read_frequency}};

}  // namespace

}  // namespace balocco::deck
