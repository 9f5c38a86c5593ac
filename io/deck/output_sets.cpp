// *NODE OUTPUT *ELEMENT OUTPUT.
#include <fmt/format.h>

#include "deck/output_words.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// NT11, the temperature of a node, is NT; everything else is what it says.
std::string temperature_or(const std::string& variable) { return variable == "NT11" ? "NT" : variable; }

/// A vector of nodes; in harmonic steps also one that counts the base's motion.
bool is_vector(const Step& step, const std::string& variable) {
  static const Words total_vectors{"TU", "TV", "TA"};
  return contains(node_vectors, variable) || (step.is_harmonic() && contains(total_vectors, variable));
}

/// U or U1..U3 of a vector variable, or NT.
bool is_node_history(const Step& step, const std::string& variable) {
  if (is_vector(step, variable) || variable == "NT") return true;
  return variable.size() > 1 && variable.back() >= '1' && variable.back() <= '3' &&
         is_vector(step, variable.substr(0, variable.size() - 1));
}

/// Row of the node set that NSET names, a node id made one; nothing if it is undefined (told).
std::optional<std::int32_t> node_set(Builder& builder, const Block& block) {
  std::vector<std::int32_t> nodes;
  const std::string name = block.value("NSET");
  if (!builder.nodes_of(name, block, block.location, nodes)) return std::nullopt;
  if (const auto set = builder.find(builder.node_sets, name)) return set;
  const std::int32_t row = builder.node_set_row("_OUTPUT-" + name);
  builder.model.node_sets[row].nodes = nodes;
  return row;
}

/// The same for ELSET.
std::optional<std::int32_t> element_set(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  const std::string name = block.value("ELSET");
  if (!builder.elements_of(name, block, block.location, elements)) return std::nullopt;
  if (const auto set = builder.find(builder.element_sets, name)) return set;
  const std::int32_t row = builder.element_set_row("_OUTPUT-" + name);
  builder.model.element_sets[row].elements = elements;
  return row;
}

/// The entry of the latest *OUTPUT, FIELD whose variables are written for `set`: one of another set is left alone.
FieldOutput& field_for(Builder& builder, std::int32_t FieldOutput::*member, std::int32_t set) {
  auto& outputs = builder.model.steps.back().field_outputs;
  const bool of_nodes = member == &FieldOutput::node_set;
  const auto unused = [&](const FieldOutput& output) {
    return of_nodes ? output.node_variables.empty()
                    : output.element_variables.empty() && output.integration_point_variables.empty();
  };
  for (std::size_t row = builder.draft.first_field; row < outputs.size(); ++row) {
    if (unused(outputs[row])) outputs[row].*member = set;
    if (outputs[row].*member == set) return outputs[row];
  }
  FieldOutput another = outputs[builder.draft.first_field];  // its marks and precision
  for (auto* variables : {&another.node_variables, &another.element_variables, &another.integration_point_variables,
                          &another.contact_variables}) {
    variables->clear();
  }
  another.node_set = another.element_set = -1;
  another.*member = set;
  return outputs.emplace_back(std::move(another));
}

void read_node_field(Builder& builder, const Block& block) {
  const auto set = block.has("NSET") ? node_set(builder, block) : -1;
  if (!set) return;
  auto& output = field_for(builder, &FieldOutput::node_set, *set);
  for (const auto& variable : asked_by_variable(block, preselected_node, node_vectors))
    add(output.node_variables, variable);
  each_variable(builder, block, [&](const std::string& said, Row& row) {
    const std::string variable = temperature_or(said);
    if (variable != "NT" && !is_vector(current_step(builder), variable)) return unknown_variable(builder, block, row, variable, node_vectors);
    add(output.node_variables, variable);
  });
}

void read_node_history(Builder& builder, const Block& block) {
  if (!block.has("NSET")) return builder.error(block, block.location, "the nodes are not named; add NSET=...");
  const auto set = node_set(builder, block);
  if (!set) return;
  HistoryOutput::Nodes request;
  request.set = *set;
  request.variables = asked_by_variable(block, preselected_node, node_vectors);
  each_variable(builder, block, [&](const std::string& said, Row& row) {
    const std::string variable = temperature_or(said);
    if (!is_node_history(current_step(builder), variable)) return unknown_variable(builder, block, row, variable, node_vectors);
    add(request.variables, variable);
  });
  if (!request.variables.empty()) builder.model.steps.back().history_outputs.back().nodes.push_back(std::move(request));
}

void read_node_output(Builder& builder, const Block& block) {
  if (builder.draft.output == StepDraft::Output::field) read_node_field(builder, block);
  if (builder.draft.output == StepDraft::Output::history) read_node_history(builder, block);
}

void read_element_field(Builder& builder, const Block& block) {
  const auto set = block.has("ELSET") ? element_set(builder, block) : -1;
  if (!set) return;
  auto& output = field_for(builder, &FieldOutput::element_set, *set);
  const auto position = squeeze(block.value("POSITION"));
  const bool at_nodes = position.ends_with("NODES"), at_points = at_nodes || position == "INTEGRATIONPOINTS";
  if (at_nodes) builder.warning(block, block.location, fmt::format("POSITION={} is not supported: written at the integration points", block.value("POSITION")));
  auto& target = at_points ? output.integration_point_variables : output.element_variables;
  for (const auto& variable : asked_by_variable(block, preselected_element, all_element)) add(target, variable);
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    add(target, whole_variable(variable));
    builder.asked_element_variables.push_back({whole_variable(variable), row.location()});
  });
}

void read_element_history(Builder& builder, const Block& block) {
  if (!block.has("ELSET")) return builder.error(block, block.location, "the elements are not named; add ELSET=...");
  const auto set = element_set(builder, block);
  if (!set) return;
  HistoryOutput::Elements request;
  request.set = *set;
  request.variables = asked_by_variable(block, preselected_element, all_element);
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    add(request.variables, whole_variable(variable));
    builder.asked_element_variables.push_back({whole_variable(variable), row.location()});
  });
  if (!request.variables.empty()) builder.model.steps.back().history_outputs.back().elements.push_back(std::move(request));
}

void read_element_output(Builder& builder, const Block& block) {
  if (builder.draft.output == StepDraft::Output::field) read_element_field(builder, block);
  if (builder.draft.output == StepDraft::Output::history) read_element_history(builder, block);
}

const RegisterKeyword node_output{
    {"NODE OUTPUT", Phase::history, Place::step, {name("NSET"), variable_rule()}, read_node_output, "OUTPUT"}};
const RegisterKeyword element_output{
    {"ELEMENT OUTPUT",
     Phase::history,
     Place::step,
     {name("ELSET"), variable_rule(), choice("POSITION", {"INTEGRATION POINTS", "CENTROIDAL", "NODES", "AVERAGED AT NODES"}),
      choice("DIRECTIONS", {"YES", "NO"})},
     read_element_output,
     "OUTPUT"}};

}  // namespace

}  // namespace balocco::deck
