// *OUTPUT, and what is written when nothing is asked for.
#include <fmt/format.h>

#include <algorithm>

#include "deck/groups.hpp"
#include "deck/output_words.hpp"
#include "deck/register.hpp"
#include "deck/steady_state.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

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
    const auto* points = builder.require_time_points(block);
    if (points == nullptr) return false;
    output.time_points = *points;
  }
  for (const char* mark : {"NUMBER INTERVAL", "TIME INTERVAL", "TIME POINTS"})
    if (block.has(mark)) refuse_in_harmonics(builder, block, without_times(mark));
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
  Step& step = current_step(builder);
  if (!builder.draft.field_replaced && block.value("OP", "NEW") == "NEW") step.field_outputs.clear();
  builder.draft.field_replaced = true;
  // Without FIELD it only says when frames are written, as CalculiX has it.
  FieldOutput output = block.has("VARIABLE") || !block.has("FIELD") ? preselected_field() : FieldOutput{};
  if (block.value("VARIABLE") == "ALL") {
    output.node_variables = node_vectors;
    output.element_variables = all_element;
    output.contact_variables = contact_fields;
  }
  output.single_precision = block.value("PRECISION", "SINGLE") == "SINGLE";
  if (!set_times(builder, block, output)) return;
  const std::size_t row = builder.model.steps.size() - 1;
  builder.without_field.erase(row);
  if (output.frequency == 0 && step.field_outputs.empty()) builder.without_field.insert(row);
  if (output.frequency == 0) return;  // none
  builder.draft.first_field = step.field_outputs.size();
  step.field_outputs.push_back(std::move(output));
  builder.draft.output = StepDraft::Output::field;
}

void begin_history(Builder& builder, const Block& block) {
  Step& step = current_step(builder);
  if (!builder.draft.history_replaced && block.value("OP", "NEW") == "NEW") step.history_outputs.clear();
  builder.draft.history_replaced = true;
  for (const char* parameter : {"TIME POINTS", "PRECISION"}) {
    if (block.has(parameter)) {
      return builder.error(block, block.location,
                           fmt::format("{} is not supported for history; use FREQUENCY, NUMBER INTERVAL or TIME INTERVAL",
                                       parameter));
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
  if (times.number_interval) output.time_interval = step.duration() / *times.number_interval;
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
  if (block.has("FIELD") && block.has("HISTORY"))
    return builder.error(block, block.location, "give either FIELD or HISTORY");
  block.has("HISTORY") ? begin_history(builder, block) : begin_field(builder, block);
}

// Of kinds of elements that a model may be without, while a block of requests serves many models.
const Words of_some_elements{"S",   "LE",  "MISES", "SENER", "ELSE", "ELASE", "SM",  "SK", "STH",
                             "CTF", "CEF", "CVF",   "CRF",   "CSF",  "CCF",   "CU",  "CV", "CP"};

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
  for (auto& output : step.field_outputs) {
    if (output.frequency || output.number_interval || output.time_interval || !output.time_points.empty()) continue;
    step.has_few_increments() ? output.frequency = 1 : output.number_interval = 20;
  }
  for (auto& output : step.history_outputs) {
    if (output.frequency || output.time_interval) continue;
    if (step.has_few_increments()) {
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
      choice("PRECISION", {"SINGLE", "DOUBLE"}), choice("TIME MARKS", {"NO"}), text("NAME"), foreign("SENSOR")},
     read_output}};

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
    if (is_abaqus_only(variable) || contains(of_some_elements, variable)) {
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
    default_times(step);
    // Explicit frames and histories that nobody asked for have no times: they are written at leisure (results_schedule.hpp).
    if (step.field_outputs.empty() && !builder.without_field.contains(row)) {
      step.field_outputs.push_back(preselected_field());
      if (step.has_few_increments()) step.field_outputs.back().frequency = 1;
    }
    if (step.history_outputs.empty() && !builder.without_history.contains(row)) {
      step.history_outputs.emplace_back();
      step.history_outputs.back().energies = energies;
    }
    for (auto& output : step.field_outputs) {
      for (auto* variables : {&output.element_variables, &output.integration_point_variables}) {
        std::erase_if(*variables, [&](const std::string& name) { return !exists(name) || (step.is_harmonic() && has_no_parts(name)); });
      }
      if (model.contact_pairs.empty() || step.is_harmonic()) output.contact_variables.clear();
    }
    for (auto& output : step.history_outputs) {
      for (auto& elements : output.elements)
        std::erase_if(elements.variables, [&](const std::string& name) { return !exists(name); });
    }
  }
}

}  // namespace balocco::deck
