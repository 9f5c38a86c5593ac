// *CONTACT OUTPUT *ENERGY OUTPUT.
#include <algorithm>

#include "deck/output_words.hpp"
#include "deck/register.hpp"

namespace balocco::deck {

namespace {

/// Rows of the contact pairs that SLAVE, MASTER and CPSET leave; nothing if there is none (told).
std::vector<std::int32_t> pairs_of(Builder& builder, const Block& block) {
  std::vector<std::int32_t> pairs;
  std::int32_t slave = -1, master = -1;
  if (block.has("SLAVE"))
    slave = builder.require(builder.surfaces, block.value("SLAVE"), block, block.location).value_or(-2);
  if (block.has("MASTER"))
    master = builder.require(builder.surfaces, block.value("MASTER"), block, block.location).value_or(-2);
  if (slave == -2 || master == -2) return pairs;
  const auto in_set = [&](std::int32_t pair) {
    const auto set = builder.contact_pair_sets.find(block.value("CPSET"));
    return !block.has("CPSET") || (set != builder.contact_pair_sets.end() && set->second.contains(pair));
  };
  for (std::size_t pair = 0; pair < builder.model.contact_pairs.size(); ++pair) {
    const auto& candidate = builder.model.contact_pairs[pair];
    const auto row = static_cast<std::int32_t>(pair);
    if ((slave >= 0 && candidate.slave != slave) || (master >= 0 && candidate.master != master) || !in_set(row))
      continue;
    pairs.push_back(row);
  }
  if (pairs.empty() && !builder.draft.faulty)
    builder.error(block, block.location,
                  "there is no such contact pair; declare it before the step or remove the request");
  return pairs;
}

void read_contact_history(Builder& builder, const Block& block) {
  auto& wanted = builder.model.steps.back().history_outputs.back().contact_pairs;
  for (const auto pair : pairs_of(builder, block)) {
    if (std::ranges::find(wanted, pair) == wanted.end()) wanted.push_back(pair);
  }
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    if (!contains(contact_histories, variable)) unknown_variable(builder, block, row, variable, contact_histories);
  });
}

void read_contact_output(Builder& builder, const Block& block) {
  if (builder.draft.output == StepDraft::Output::history) return read_contact_history(builder, block);
  if (builder.draft.output != StepDraft::Output::field) return;
  const bool restricted = block.has("SLAVE") || block.has("MASTER") || block.has("CPSET");
  if (restricted && pairs_of(builder, block).size() < builder.model.contact_pairs.size() && !builder.draft.faulty) {
    return builder.error(block, block.location,
                         "contact fields are sums over all contact pairs at a node; leave out SLAVE, MASTER and CPSET, or ask "
                         "for the resultants of a pair under *OUTPUT, HISTORY");
  }
  auto& output = builder.model.steps.back().field_outputs[builder.draft.first_field];
  for (const auto& variable : asked_by_variable(block, preselected_contact, contact_fields))
    add(output.contact_variables, variable);
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    // CSTRESS and CDISP are Abaqus's names for the groups.
    if (variable == "CSTRESS") return add(output.contact_variables, "CPRESS"), add(output.contact_variables, "CSHEAR");
    if (variable == "CFORCE") return add(output.contact_variables, "CNORMF"), add(output.contact_variables, "CSHEARF");
    if (variable == "CDISP") return add(output.contact_variables, "COPEN"), add(output.contact_variables, "CSLIP");
    if (!contains(contact_fields, variable)) return unknown_variable(builder, block, row, variable, contact_fields);
    add(output.contact_variables, variable);
  });
}

void read_energy_output(Builder& builder, const Block& block) {
  if (builder.draft.output == StepDraft::Output::field)
    return builder.error(block, block.location, "it belongs under *OUTPUT, HISTORY; move it there");
  if (builder.draft.output != StepDraft::Output::history) return;
  auto& output = builder.model.steps.back().history_outputs.back();
  if (block.has("VARIABLE") || block.lines.empty()) output.energies = energies;
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    if (!contains(energies, variable)) return unknown_variable(builder, block, row, variable, energies);
    add(output.energies, variable);
  });
}

const RegisterKeyword contact_output{{"CONTACT OUTPUT",
                                      Phase::history,
                                      Place::step,
                                      {name("SLAVE"), name("MASTER"), name("CPSET"), variable_rule()},
                                      read_contact_output,
                                      "OUTPUT"}};
const RegisterKeyword energy_output{
    {"ENERGY OUTPUT", Phase::history, Place::step, {variable_rule()}, read_energy_output, "OUTPUT"}};

}  // namespace

}  // namespace balocco::deck
