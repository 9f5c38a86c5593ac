// *EXPANSION *TEMPERATURE.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/load_magnitude.hpp"
#include "deck/register.hpp"

namespace balocco::deck {

namespace {

void read_expansion(Builder& builder, const Block& block) {
  Material& material = builder.model.materials.back();
  if (material.expansion) return builder.error(block, block.location, fmt::format("material {} has it already; keep one", material.name));
  ThermalExpansion expansion{.reference = block.real("ZERO", 0.0), .rows = {}};
  if (block.lines.empty()) return builder.error(block, block.location, "the coefficient is missing; add a data line");
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const double coefficient = row.real(0, "coefficient of thermal expansion");
    const double temperature = row.real_or(1, 0.0, "temperature");
    row.at_most(2);
    if (!row.ok()) return;
    if (!expansion.rows.empty() && temperature <= expansion.rows.back()[1])
      return row.error(fmt::format("temperature {} does not exceed that of the line before; list them rising", temperature));
    expansion.rows.push_back({coefficient, temperature});
  }
  material.expansion = std::move(expansion);
}

double initial_temperature(const Model& model, std::int32_t node) {
  return model.initial_temperature.empty() ? 0.0 : model.initial_temperature[node];
}

/// OP=NEW: nodes go back to their initial temperature, in a static step gradually (once a step).
void renew_temperatures(Builder& builder) {
  if (builder.draft.temperature_renewed) return;
  builder.draft.temperature_renewed = true;
  for (auto& old : current_step(builder).temperatures) {
    if (builder.draft.said_here(old)) continue;
    old.magnitude = initial_temperature(builder.model, old.node);
    old.amplitude = -1;
  }
}

void read_temperature(Builder& builder, const Block& block) {
  auto& temperatures = current_step(builder).temperatures;
  if (block.value("OP") == "NEW") renew_temperatures(builder);
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  if (block.lines.empty() && block.value("OP") != "NEW")
    return builder.error(block, block.location, "no temperatures are given; add lines: node or node set, temperature");
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    std::vector<std::int32_t> nodes;
    const double magnitude = row.real(1, "temperature");
    row.at_most(2);
    if (!row.ok() || !builder.nodes_of(row.text(0), block, line.location, nodes)) continue;
    for (const auto node : nodes) {
      const auto [place, added] = builder.draft.temperature_of.emplace(node, temperatures.size());
      if (added) temperatures.push_back({.node = node, .previous = initial_temperature(builder.model, node)});
      auto& said = temperatures[place->second];
      said.magnitude = scaled(builder, *amplitude, magnitude);
      said.amplitude = *amplitude;
      said.file = line.location.file;
      said.line = line.location.line;
    }
    builder.draft.said.insert({line.location.file, line.location.line});
  }
}

const RegisterKeyword expansion{
    {"EXPANSION", Phase::definitions, Place::model, {choice("TYPE", {"ISO"}), real("ZERO")}, read_expansion, "MATERIAL"}};
const RegisterKeyword temperature{{"TEMPERATURE",
                                   Phase::history,
                                   Place::step,
                                   {choice("OP", {"MOD", "NEW"}), name("AMPLITUDE"), real("TIME DELAY")},
                                   read_temperature}};

}  // namespace

}  // namespace balocco::deck
