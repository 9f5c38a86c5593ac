// Which state of another job *IMPORT and *RESTART, READ speak of.
#pragma once

#include <fmt/format.h>

#include "deck/builder.hpp"

namespace balocco::deck {

/// STEP, INTERVAL and what counts increments.
inline StateChoice read_state_choice(Builder& builder, const Block& block, const char* increment) {
  const auto number = [&](const char* parameter) -> std::optional<std::int32_t> {
    if (!block.has(parameter)) return std::nullopt;
    const auto value = static_cast<std::int32_t>(block.integer(parameter, 0));
    if (value < 1) builder.error(block, block.location, fmt::format("{}={} must be a number from 1; correct it", parameter, value));
    return value;
  };
  const StateChoice choice{.step = number("STEP"), .increment = number(increment), .interval = number("INTERVAL")};
  if (choice.increment && choice.interval) builder.error(block, block.location, fmt::format("give {} or INTERVAL, not both", increment));
  return choice;
}

}  // namespace balocco::deck
