// *MODAL DYNAMIC *MODAL DAMPING.
#include <fmt/format.h>

#include <limits>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/step_draft.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

void read_modal_dynamic(Builder& builder, const Block& block) {
  if (!begin_procedure(builder, block)) return;
  auto& procedure = builder.model.steps.back().procedure.emplace<ModalDynamicProcedure>();
  procedure.maximum_increments = builder.draft.maximum_increments;
  const bool automatic = block.value("DIRECT", "YES") == "NO";
  if (automatic != block.has("DELTMX"))
    builder.error(
        block, block.location,
        "increments that grow (DIRECT=NO) and the greatest change of a load in one (DELTMX) belong together; give both, or none");
  if (automatic) procedure.largest_load_change = block.real("DELTMX", 0.0);
  if (procedure.largest_load_change.value_or(1.0) <= 0.0)
    builder.error(block, block.location, "DELTMX must be positive; correct it");
  if (block.lines.empty()) return builder.error(block, block.location, "increment and period are missing; add a line: increment, period");
  Row row(builder, block, block.lines[0]);
  procedure.increment = row.real(0, "time increment");
  procedure.duration = row.real(1, "time period");
  row.at_most(2);
  if (row.ok() && !(procedure.increment > 0.0 && procedure.duration >= procedure.increment))
    row.error(fmt::format("increment {} and period {} must be positive, and the increment not the greater; correct them", procedure.increment,
                          procedure.duration));
}

/// Where the damping of modes in the present step goes; null where its procedure superposes none.
std::vector<ModalDamping>* damping_of_modes(Step& step) {
  if (auto* transient = std::get_if<ModalDynamicProcedure>(&step.procedure)) return &transient->damping;
  if (auto* harmonic = std::get_if<SteadyStateProcedure>(&step.procedure)) return &harmonic->damping;
  return nullptr;
}

/// Lines "first mode, last mode, fraction of critical damping", with STRUCTURAL the structural damping factor, with RAYLEIGH "first mode, last
/// mode, alpha, beta". Without a first mode a line speaks of all.
void read_modal_damping(Builder& builder, const Block& block) {
  auto* dampings = damping_of_modes(current_step(builder));
  if (dampings == nullptr)
    return builder.error(block, block.location, "only *MODAL DYNAMIC and *STEADY STATE DYNAMICS have it; put it behind one of these");
  const bool rayleigh = block.has("RAYLEIGH") || block.value("VISCOUS") == "RAYLEIGH", structural = block.has("STRUCTURAL");
  if (structural && !current_step(builder).is_harmonic())
    return builder.error(block, block.location, "STRUCTURAL damping has a meaning in *STEADY STATE DYNAMICS alone; give a fraction of critical damping");
  if (structural && (rayleigh || block.has("VISCOUS") || block.has("MODAL")))
    return builder.error(block, block.location, "give STRUCTURAL a *MODAL DAMPING of its own, beside that of viscous damping");
  const char* what = rayleigh ? "alpha" : structural ? "structural damping factor" : "fraction of critical damping";
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    ModalDamping damping;
    damping.first = static_cast<std::int32_t>(row.integer_or(0, 1, "first mode"));
    const auto otherwise = row.has(0) ? damping.first : std::numeric_limits<std::int32_t>::max();
    damping.last = static_cast<std::int32_t>(row.integer_or(1, otherwise, "last mode"));
    (rayleigh ? damping.alpha : structural ? damping.structural : damping.fraction) = row.real_or(2, 0.0, what);
    if (rayleigh) damping.beta = row.real_or(3, 0.0, "beta");
    row.at_most(rayleigh ? 4 : 3);
    if (row.ok() && (damping.first < 1 || damping.last < damping.first))
      row.error(fmt::format("there are no modes {} to {}; correct fields 1 and 2", damping.first, damping.last));
    if (row.ok() && (damping.fraction < 0.0 || damping.alpha < 0.0 || damping.beta < 0.0 || damping.structural < 0.0))
      row.error("damping must not be negative; correct it");
    if (row.ok()) dampings->push_back(damping);
  }
}

const RegisterKeyword modal_dynamic{{"MODAL DYNAMIC",
                                     Phase::history,
                                     Place::step,
                                     {foreign("SOLVER"), choice("DIRECT", {"YES", "NO"}), real("DELTMX")},
                                     read_modal_dynamic}};
const RegisterKeyword modal_damping{{"MODAL DAMPING",
                                     Phase::history,
                                     Place::step,
                                     {flag("RAYLEIGH"), flag("STRUCTURAL"), optional_choice("MODAL", {"DIRECT"}),
                                      choice("VISCOUS", {"FRACTION OF CRITICAL DAMPING", "RAYLEIGH"})},
                                     read_modal_damping}};

}  // namespace

}  // namespace balocco::deck
