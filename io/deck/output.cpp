// *OUTPUT *NODE OUTPUT *ELEMENT OUTPUT *CONTACT OUTPUT *ENERGY OUTPUT, and what is written when nothing is asked for.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/groups.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

using Words = std::vector<std::string>;

// The nodal and contact variables of model/results.hpp.
const Words node_vectors{"U", "V", "A", "RF", "UR", "VR", "AR", "RM"};
const Words contact_fields{"CPRESS", "CSHEAR", "COPEN", "CSLIP", "CNORMF", "CSHEARF"};
const Words contact_histories{"CFN", "CFT", "CM", "CAREA", "XN"};
const Words energies{"ALLKE", "ALLIE", "ALLSE", "ALLPD", "ALLVD", "ALLAE", "ALLFD", "ALLCW", "ALLWK", "ETOTAL"};

// Variables of Abaqus that its own pre-processor asks for by default and that are not written here: told, but no reason
// to refuse.
const Words abaqus_only{
    "CF",      "COORD",    "TF",       "RT",      "UT",     "VT",    "AT",      "NT",     "CM1",     "E",
    "EE",      "NE",       "PE",       "PEEQ",    "PEMAG",  "PEEQT", "EVOL",    "IVOL",   "ELKE",
    "ELPD",    "PRESS",    "TRIAX",    "DENSITY", "STATUS", "SF",    "SE",      "ER",     "EVF",     "SVAVG",
    "PEVAVG",  "PEEQVAVG", "CNAREA",   "CSTATUS", "CFS",    "ALLCD", "ALLDMD",  "ALLEE",  "ALLJD",   "ALLKL",
    "ALLQB",   "ALLSD",    "ALLVE",    "ALLDC",   "ALLMW",  "ALLPW", "ALLCCDW", "ALLCCE", "ALLCCEN", "ALLCCET",
    "ALLCCSD", "ALLCCSDN", "ALLCCSDT", "ALLHF",   "ALLIHE", "DMASS", "EFABRIC"};

const Words preselected_node{"U", "V", "A", "RF"};
const Words preselected_element{"S", "LE", "MISES"};
const Words preselected_contact{"CPRESS", "CSHEAR", "COPEN"};

Step& current(Builder& builder) {
  return builder.model.steps.back();
}

bool contains(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void add(Words& words, const std::string& word) {
  if (!contains(words, word)) words.push_back(word);
}

FieldOutput preselected_field() {
  FieldOutput output;
  output.node_variables = preselected_node;
  output.element_variables = preselected_element;
  output.contact_variables = preselected_contact;
  return output;
}

/// The one mark that says when; none given: every increment of a static step, twenty frames of an explicit one.
bool set_times(Builder& builder, const Block& block, FieldOutput& output) {
  int marks = 0;
  if (block.has("FREQUENCY")) ++marks, output.frequency = block.integer("FREQUENCY", 1);
  if (block.has("NUMBER INTERVAL")) ++marks, output.number_interval = block.integer("NUMBER INTERVAL", 1);
  if (block.has("TIME INTERVAL")) ++marks, output.time_interval = block.real("TIME INTERVAL", 0.0);
  if (block.has("TIME POINTS")) {
    ++marks;
    const auto found = builder.time_points.find(block.value("TIME POINTS"));
    if (found == builder.time_points.end()) {
      if (!builder.is_poisoned(block.value("TIME POINTS"))) {
        builder.error(
            block, block.location,
            fmt::format("time points {} are not defined; define them under *TIME POINTS", block.value("TIME POINTS")));
      }
      return false;
    }
    output.time_points = found->second;
  }
  if (marks > 1) {
    builder.error(block, block.location, "give one of FREQUENCY, NUMBER INTERVAL, TIME INTERVAL and TIME POINTS");
    return false;
  }
  const bool negative = output.frequency.value_or(1) < 0 || output.number_interval.value_or(1) < 1 ||
                        output.time_interval.value_or(1.0) <= 0.0;
  if (negative) builder.error(block, block.location, "the interval must be positive; correct it");
  return !negative;
}

void begin_field(Builder& builder, const Block& block) {
  Step& step = current(builder);
  if (!builder.draft.field_replaced && block.value("OP", "NEW") == "NEW") step.field_outputs.clear();
  builder.draft.field_replaced = true;
  FieldOutput output = block.has("VARIABLE") ? preselected_field() : FieldOutput{};
  if (block.value("VARIABLE") == "ALL") {
    output.node_variables = node_vectors;
    output.element_variables = {"ALL"};
    output.contact_variables = contact_fields;
  }
  output.single_precision = block.value("PRECISION", "SINGLE") == "SINGLE";
  if (!set_times(builder, block, output)) return;
  const std::size_t row = builder.model.steps.size() - 1;
  builder.without_field.erase(row);
  if (output.frequency == 0 && step.field_outputs.empty()) builder.without_field.insert(row);
  if (output.frequency == 0) return;  // none
  step.field_outputs.push_back(std::move(output));
  builder.draft.output = StepDraft::Output::field;
}

void begin_history(Builder& builder, const Block& block) {
  Step& step = current(builder);
  if (!builder.draft.history_replaced && block.value("OP", "NEW") == "NEW") step.history_outputs.clear();
  builder.draft.history_replaced = true;
  for (const char* parameter : {"NUMBER INTERVAL", "TIME POINTS", "PRECISION"}) {
    if (block.has(parameter)) {
      return builder.error(block, block.location,
                           fmt::format("{} is not supported for history; use FREQUENCY or TIME INTERVAL", parameter));
    }
  }
  FieldOutput times;
  if (!set_times(builder, block, times)) return;
  const std::size_t row = builder.model.steps.size() - 1;
  builder.without_history.erase(row);
  if (times.frequency == 0 && step.history_outputs.empty()) builder.without_history.insert(row);
  if (times.frequency == 0) return;
  HistoryOutput output;
  output.frequency = times.frequency;
  output.time_interval = times.time_interval;
  if (block.has("VARIABLE")) {
    output.energies = energies;
    for (std::size_t pair = 0; block.value("VARIABLE") == "ALL" && pair < builder.model.contact_pairs.size(); ++pair) {
      output.contact_pairs.push_back(static_cast<std::int32_t>(pair));
    }
  }
  step.history_outputs.push_back(std::move(output));
  builder.draft.output = StepDraft::Output::history;
}

void read_output(Builder& builder, const Block& block) {
  builder.draft.output = StepDraft::Output::none;
  if (block.has("FIELD") == block.has("HISTORY"))
    return builder.error(block, block.location, "give either FIELD or HISTORY");
  block.has("FIELD") ? begin_field(builder, block) : begin_history(builder, block);
}

/// Calls use(name, row) for every variable on the data lines.
template <class Use>
void each_variable(Builder& builder, const Block& block, const Use& use) {
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size() && row.ok(); ++field) {
      if (row.has(field)) use(row.name(field), row);
    }
  }
}

void unknown_variable(Builder& builder, const Block& block, Row& row, const std::string& variable, const Words& known) {
  if (contains(abaqus_only, variable)) {
    return builder.warning(block, row.location(), fmt::format("variable {} is not written by Balocco", variable));
  }
  row.error(fmt::format("variable {} is unknown or not supported{}; supported: {}", variable,
                        did_you_mean(variable, known), join(known)));
}

bool is_preselect(const Block& block) {
  return block.value("VARIABLE") == "PRESELECT" || block.value("VARIABLE") == "ALL";
}

/// U or U1..U3 of a vector variable.
bool is_node_history(const std::string& variable) {
  if (contains(node_vectors, variable)) return true;
  return variable.size() > 1 && variable.back() >= '1' && variable.back() <= '3' &&
         contains(node_vectors, variable.substr(0, variable.size() - 1));
}

void note_whole_model(Builder& builder, const Block& block, const char* parameter) {
  if (block.has(parameter)) {
    builder.warning(
        block, block.location,
        fmt::format("{}={}: field output is always written for the whole model", parameter, block.value(parameter)));
  }
}

void read_node_field(Builder& builder, const Block& block) {
  auto& output = current(builder).field_outputs.back();
  note_whole_model(builder, block, "NSET");
  if (is_preselect(block)) {
    for (const auto& variable : block.value("VARIABLE") == "ALL" ? node_vectors : preselected_node)
      add(output.node_variables, variable);
  }
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    if (!contains(node_vectors, variable)) return unknown_variable(builder, block, row, variable, node_vectors);
    add(output.node_variables, variable);
  });
}

void read_node_history(Builder& builder, const Block& block) {
  if (!block.has("NSET")) return builder.error(block, block.location, "the nodes are not named; add NSET=...");
  std::vector<std::int32_t> nodes;
  if (!builder.nodes_of(block.value("NSET"), block, block.location, nodes)) return;
  HistoryOutput::Nodes request;
  if (const auto set = builder.find(builder.node_sets, block.value("NSET"))) {
    request.set = *set;
  } else {  // a node id in the place of a set
    request.set = builder.node_set_row("_HISTORY-" + block.value("NSET"));
    builder.model.node_sets[request.set].nodes = nodes;
  }
  if (is_preselect(block)) request.variables = preselected_node;
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    if (!is_node_history(variable)) return unknown_variable(builder, block, row, variable, node_vectors);
    add(request.variables, variable);
  });
  if (!request.variables.empty()) current(builder).history_outputs.back().nodes.push_back(std::move(request));
}

void read_node_output(Builder& builder, const Block& block) {
  if (builder.draft.output == StepDraft::Output::field) read_node_field(builder, block);
  if (builder.draft.output == StepDraft::Output::history) read_node_history(builder, block);
}

void read_element_field(Builder& builder, const Block& block) {
  auto& output = current(builder).field_outputs.back();
  note_whole_model(builder, block, "ELSET");
  const bool at_points = squeeze(block.value("POSITION")) == "INTEGRATIONPOINTS";
  auto& target = at_points ? output.integration_point_variables : output.element_variables;
  if (is_preselect(block)) {
    for (const auto& variable : preselected_element) add(target, variable);
  }
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    add(target, variable);
    builder.asked_element_variables.push_back({variable, row.location()});
  });
}

void read_element_history(Builder& builder, const Block& block) {
  if (!block.has("ELSET")) return builder.error(block, block.location, "the elements are not named; add ELSET=...");
  std::vector<ElementRef> elements;
  if (!builder.elements_of(block.value("ELSET"), block, block.location, elements)) return;
  HistoryOutput::Elements request;
  if (const auto set = builder.find(builder.element_sets, block.value("ELSET"))) {
    request.set = *set;
  } else {
    request.set = builder.element_set_row("_HISTORY-" + block.value("ELSET"));
    builder.model.element_sets[request.set].elements = elements;
  }
  if (is_preselect(block)) request.variables = preselected_element;
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    add(request.variables, variable);
    builder.asked_element_variables.push_back({variable, row.location()});
  });
  if (!request.variables.empty()) current(builder).history_outputs.back().elements.push_back(std::move(request));
}

void read_element_output(Builder& builder, const Block& block) {
  if (builder.draft.output == StepDraft::Output::field) read_element_field(builder, block);
  if (builder.draft.output == StepDraft::Output::history) read_element_history(builder, block);
}

void read_contact_history(Builder& builder, const Block& block) {
  auto& output = current(builder).history_outputs.back();
  std::int32_t slave = -1, master = -1;
  if (block.has("SLAVE"))
    slave = builder.require(builder.surfaces, block.value("SLAVE"), block, block.location).value_or(-2);
  if (block.has("MASTER"))
    master = builder.require(builder.surfaces, block.value("MASTER"), block, block.location).value_or(-2);
  if (slave == -2 || master == -2) return;
  const auto in_set = [&](std::int32_t pair) {
    const auto set = builder.contact_pair_sets.find(block.value("CPSET"));
    return !block.has("CPSET") || (set != builder.contact_pair_sets.end() && set->second.contains(pair));
  };
  bool any = false;
  for (std::size_t pair = 0; pair < builder.model.contact_pairs.size(); ++pair) {
    const auto& candidate = builder.model.contact_pairs[pair];
    const auto row = static_cast<std::int32_t>(pair);
    if ((slave >= 0 && candidate.slave != slave) || (master >= 0 && candidate.master != master) || !in_set(row))
      continue;
    any = true;
    if (std::find(output.contact_pairs.begin(), output.contact_pairs.end(), row) == output.contact_pairs.end()) {
      output.contact_pairs.push_back(row);
    }
  }
  if (!any && !builder.draft.faulty)
    builder.error(block, block.location,
                  "there is no such contact pair; declare it before the step or remove the request");
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    if (!contains(contact_histories, variable)) unknown_variable(builder, block, row, variable, contact_histories);
  });
}

void read_contact_output(Builder& builder, const Block& block) {
  if (builder.draft.output == StepDraft::Output::history) return read_contact_history(builder, block);
  if (builder.draft.output != StepDraft::Output::field) return;
  auto& output = current(builder).field_outputs.back();
  note_whole_model(builder, block, "SLAVE");
  note_whole_model(builder, block, "MASTER");
  if (is_preselect(block)) {
    for (const auto& variable : block.value("VARIABLE") == "ALL" ? contact_fields : preselected_contact)
      add(output.contact_variables, variable);
  }
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
  auto& output = current(builder).history_outputs.back();
  if (is_preselect(block) || block.lines.empty()) output.energies = energies;
  each_variable(builder, block, [&](const std::string& variable, Row& row) {
    if (!contains(energies, variable)) return unknown_variable(builder, block, row, variable, energies);
    add(output.energies, variable);
  });
}

/// A group of one element of each table and section, to ask which variables exist.
std::vector<std::unique_ptr<ElementGroup>> sample_groups(const Model& model) {
  std::vector<std::unique_ptr<ElementGroup>> groups;
  for (std::size_t t = 0; t < model.elements.size(); ++t) {
    const auto& table = model.elements[t];
    if (table.type->make_group == nullptr || table.id.empty() || table.section[0] < 0) continue;
    GroupInput input{model,
                     static_cast<std::int32_t>(t),
                     table.section[0],
                     {0},
                     0,
                     {},
                     static_cast<std::int32_t>(model.nodes.size())};
    input.connectivity.assign(table.connectivity.begin(), table.connectivity.begin() + table.type->nodes);
    groups.push_back(table.type->make_group(input));
  }
  return groups;
}

/// Times that were not said: the procedure's default.
void default_times(Step& step) {
  const bool is_static = step.procedure == Step::Procedure::static_analysis;
  for (auto& output : step.field_outputs) {
    if (output.frequency || output.number_interval || output.time_interval || !output.time_points.empty()) continue;
    is_static ? output.frequency = 1 : output.number_interval = 20;
  }
  for (auto& output : step.history_outputs) {
    if (output.frequency || output.time_interval) continue;
    if (is_static) {
      output.frequency = 1;
    } else {
      output.time_interval = step.duration() / 200.0;  // Abaqus/Explicit's number of history points
    }
  }
}

const RegisterKeyword output{
    {"OUTPUT",
     Phase::history,
     Place::step,
     {flag("FIELD"), flag("HISTORY"), integer("FREQUENCY"), integer("NUMBER INTERVAL"), real("TIME INTERVAL"),
      name("TIME POINTS"), choice("VARIABLE", {"PRESELECT", "ALL"}), choice("OP", {"NEW", "ADD"}),
      choice("PRECISION", {"SINGLE", "DOUBLE"}), choice("TIME MARKS", {"NO"})},
     read_output}};
const ParameterRule variable = choice("VARIABLE", {"PRESELECT", "ALL"});
const RegisterKeyword node_output{
    {"NODE OUTPUT", Phase::history, Place::step, {name("NSET"), variable}, read_node_output, "OUTPUT"}};
const RegisterKeyword element_output{
    {"ELEMENT OUTPUT",
     Phase::history,
     Place::step,
     {name("ELSET"), variable, choice("POSITION", {"INTEGRATION POINTS", "CENTROIDAL"}), choice("DIRECTIONS", {"YES"})},
     read_element_output,
     "OUTPUT"}};
const RegisterKeyword contact_output{{"CONTACT OUTPUT",
                                      Phase::history,
                                      Place::step,
                                      {name("SLAVE"), name("MASTER"), name("CPSET"), variable},
                                      read_contact_output,
                                      "OUTPUT"}};
const RegisterKeyword energy_output{
    {"ENERGY OUTPUT", Phase::history, Place::step, {variable}, read_energy_output, "OUTPUT"}};

}  // namespace

void finish_output(Builder& builder) {
  Model& model = builder.model;
  const auto groups = sample_groups(model);
  const auto exists = [&](const std::string& variable) {
    return std::any_of(groups.begin(), groups.end(),
                       [&](const auto& group) { return group->output_components(variable) > 0; });
  };
  for (const auto& [variable, location] : builder.asked_element_variables) {
    if (exists(variable)) continue;
    if (contains(abaqus_only, variable)) {
      builder.diagnostics.warning(location, "ELEMENT OUTPUT",
                                  fmt::format("variable {} does not exist in this model and is not written", variable));
    } else {
      builder.diagnostics.error(location, "ELEMENT OUTPUT",
                                fmt::format("no element of the model has the variable {}; remove it or "
                                            "correct the name (S, LE, MISES, SENER, ELSE, ELASE ...)",
                                            variable));
    }
  }
  for (std::size_t row = 0; row < model.steps.size(); ++row) {
    Step& step = model.steps[row];
    if (step.field_outputs.empty() && !builder.without_field.contains(row))
      step.field_outputs.push_back(preselected_field());
    if (step.history_outputs.empty() && !builder.without_history.contains(row)) {
      step.history_outputs.emplace_back();
      step.history_outputs.back().energies = energies;
    }
    default_times(step);
    for (auto& output : step.field_outputs) {
      for (auto* variables : {&output.element_variables, &output.integration_point_variables}) {
        if (*variables == Words{"ALL"}) *variables = {"S", "LE", "MISES", "SENER", "STH", "ELSE", "ELASE"};
        std::erase_if(*variables, [&](const std::string& name) { return !exists(name); });
      }
      if (model.contact_pairs.empty()) output.contact_variables.clear();
    }
  }
}

}  // namespace balocco::deck
