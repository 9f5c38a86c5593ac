// *RESTART: checkpoints to write, and the one to go on from.
#include <fmt/format.h>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/state_choice.hpp"

namespace balocco::deck {

namespace {

/// What a checkpoint of another job is read for is said by the model.
void read_restart_of_another_job(Builder& builder, const Block& block) {
  if (builder.in_step) return builder.error(block, block.location, "READ stands before or behind a *STEP, not in one; move it");
  if (builder.model.nodes.size() == 0)
    return builder.error(
        block, block.location,
        "the model and the steps before are missing; say them as the first deck did: *INCLUDE, INPUT=FIRST.inp before this line");
  if (builder.model.restart_read) return builder.error(block, block.location, "READ is said twice; remove one");
  const auto choice = read_state_choice(builder, block, "INC");
  builder.model.restart_read =
      RestartRead{.step = choice.step.value_or(0), .end_step = block.has("END STEP"), .choice = choice, .location = block.location};
}

void read_restart(Builder& builder, const Block& block) {
  if (block.has("READ")) read_restart_of_another_job(builder, block);
  if (!block.has("READ") && !block.has("WRITE"))
    return builder.error(block, block.location,
                         "say READ, to go on from the checkpoint of another job, or WRITE, to write checkpoints");
  if (!block.has("WRITE")) return;
  if (block.has("FREQUENCY") && block.has("NUMBER INTERVAL")) {
    return builder.error(block, block.location, "give FREQUENCY or NUMBER INTERVAL, not both");
  }
  const std::int32_t frequency = block.integer("FREQUENCY", 1), intervals = block.integer("NUMBER INTERVAL", 1);
  if (frequency < 0 || intervals < 0)
    return builder.error(block, block.location, "FREQUENCY and NUMBER INTERVAL must not be negative; correct it");
  const auto unless_zero = [](std::int32_t value) { return value > 0 ? std::optional(value) : std::nullopt; };
  const bool by_intervals = block.has("NUMBER INTERVAL");
  auto& every = builder.in_step ? builder.model.steps.back().checkpoint_frequency : builder.checkpoint_frequency;
  auto& number = builder.in_step ? builder.model.steps.back().checkpoint_number_interval : builder.checkpoint_number_interval;
  (builder.in_step ? builder.model.steps.back().keeps_checkpoints : builder.keeps_checkpoints) = !block.has("OVERLAY");
  builder.checkpoints_by_procedure = !by_intervals && !block.has("FREQUENCY");
  every = by_intervals ? std::nullopt : unless_zero(frequency);
  number = by_intervals ? unless_zero(intervals) : std::nullopt;
}

const RegisterKeyword restart{{"RESTART",
                               Phase::history,
                               Place::anywhere,
                               {flag("READ"), integer("STEP"), integer("INC"), integer("INTERVAL"), flag("END STEP"), flag("WRITE"),
                                integer("FREQUENCY"), integer("NUMBER INTERVAL"), flag("OVERLAY"), choice("TIME MARKS", {"NO"})},
                               read_restart}};

}  // namespace

}  // namespace balocco::deck
