// AMPLITUDE= and TIME DELAY= of loads and conditions.
#include <fmt/format.h>

#include "deck/load_magnitude.hpp"
#include "deck/steady_state.hpp"

namespace balocco::deck {

namespace {

/// The amplitude that is `delay` later than another: A(t - delay).
std::int32_t delayed(Builder& builder, std::int32_t row, double delay) {
  Amplitude later = builder.model.amplitudes[row];
  later.name = fmt::format("{}-DELAYED-BY-{}", later.name, delay);
  if (const auto known = builder.amplitudes.rows.find(later.name); known != builder.amplitudes.rows.end())
    return known->second;
  for (auto& point : later.points) point[0] += delay;
  later.start += delay;
  const auto added = static_cast<std::int32_t>(builder.model.amplitudes.size());
  builder.amplitudes.rows.emplace(later.name, added);
  if (builder.absolute_amplitudes.contains(row)) builder.absolute_amplitudes.insert(added);
  builder.model.amplitudes.push_back(std::move(later));
  return added;
}

}  // namespace

std::optional<std::int32_t> amplitude_of(Builder& builder, const Block& block) {
  if (!block.has("AMPLITUDE")) {
    if (!block.has("TIME DELAY")) return -1;
    builder.error(block, block.location, "TIME DELAY shifts an amplitude; add AMPLITUDE=...");
    return std::nullopt;
  }
  const auto row = builder.require(builder.amplitudes, block.value("AMPLITUDE"), block, block.location);
  const double delay = block.real("TIME DELAY", 0.0);
  if (delay < 0.0) {
    builder.error(block, block.location, "TIME DELAY must not be negative; correct it");
    return std::nullopt;
  }
  if (delay > 0.0) refuse_in_harmonics(builder, block, without_times("TIME DELAY"));
  return row && delay > 0.0 ? std::optional(delayed(builder, *row, delay)) : row;
}

}  // namespace balocco::deck
