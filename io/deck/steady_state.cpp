// *STEADY STATE DYNAMICS *BASE MOTION.
#include "deck/steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "deck/load_magnitude.hpp"
#include "deck/output_words.hpp"
#include "deck/register.hpp"
#include "deck/step_draft.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// Row of the last step before the present one that finds natural modes, or -1.
std::int32_t step_of_modes(const Builder& builder) {
  auto row = static_cast<std::int32_t>(builder.model.steps.size()) - 2;
  while (row >= 0 && !std::holds_alternative<FrequencyProcedure>(builder.model.steps[row].procedure)) --row;
  return row;
}

/// Parameters of other ways to find the response. @return false, told, if there is one.
bool is_of_modes(Builder& builder, const Block& block) {
  const auto refuse = [&](const char* text) {
    builder.error(block, block.location, text);
    return false;
  };
  if (block.has("DIRECT") || block.has("SUBSPACE PROJECTION"))
    return refuse("DIRECT and SUBSPACE PROJECTION are not supported; without them the response is a sum of the modes of *FREQUENCY, of which "
                  "dashpots and materials may damp and couple any");
  if (block.value("HARMONIC", "YES") == "NO")
    return refuse("HARMONIC=NO is not supported: loads are harmonic here; give each of the load's frequencies a step, or use *MODAL DYNAMIC");
  if (block.value("INTERVAL") == "SPREAD")
    return refuse("INTERVAL=SPREAD is not supported; INTERVAL=EIGENFREQUENCY tells the response about eigenfrequencies too, the nearer the "
                  "greater the bias (field 4)");
  if (step_of_modes(builder) < 0) return refuse("there are no modes to superpose; put a *FREQUENCY step before this one");
  return true;
}

/// Lower and upper frequency, points of each interval, bias, factor of the points within.
void read_range(Builder& builder, const Block& block, const DataLine& line, SteadyStateProcedure& procedure) {
  Row row(builder, block, line);
  const bool by_range = procedure.interval == SteadyStateProcedure::Interval::range;
  SteadyStateProcedure::Range range;
  range.lower = row.real(0, "lower frequency");
  range.upper = row.real_or(1, 0.0, "upper frequency");
  constexpr std::int64_t most_points = 1'000'000;
  const auto points = row.integer_or(2, 0, "number of points");
  if (points > most_points) row.error(fmt::format("{} points between two frequencies are more than any response needs; ask for {} at most", points, most_points));
  if (points >= 2 && points <= most_points) range.points = static_cast<std::int32_t>(points);
  range.bias = row.real_or(3, by_range ? 1.0 : 3.0, "bias");
  range.scale = row.real_or(4, 1.0, "frequency scale factor");
  row.at_most(5);
  if (!row.ok()) return;
  const bool single = range.upper == 0.0;
  if (range.lower < 0.0 || range.upper < 0.0)
    return row.error(fmt::format("frequencies {} and {} must not be negative; correct them", range.lower, range.upper));
  if (!single && range.upper <= range.lower)
    return row.error(fmt::format("the upper frequency {} does not exceed the lower one {}; correct them, or leave it out for one frequency alone",
                                 range.upper, range.lower));
  if (!single && procedure.logarithmic && range.lower == 0.0)
    return row.error("a logarithmic scale has no frequency 0; give a lower frequency above 0, or FREQUENCY SCALE=LINEAR");
  if (!(range.bias > 0.0 && range.scale > 0.0)) return row.error("bias and frequency scale factor must be positive; correct fields 4 and 5");
  if (single) range.upper = range.lower;
  if (!procedure.ranges.empty() && range.lower < procedure.ranges.back().upper)
    return row.error(fmt::format("frequencies fall: the range begins at {}, below the end {} of the one before; put the ranges in order",
                                 range.lower, procedure.ranges.back().upper));
  procedure.ranges.push_back(range);
}

void read_steady_state(Builder& builder, const Block& block) {
  if (!begin_procedure(builder, block)) return;
  auto& procedure = current_step(builder).procedure.emplace<SteadyStateProcedure>();
  if (!is_of_modes(builder, block)) return;
  if (block.value("INTERVAL") == "RANGE") procedure.interval = SteadyStateProcedure::Interval::range;
  procedure.logarithmic = block.value("FREQUENCY SCALE", "LOGARITHMIC") == "LOGARITHMIC";
  if (block.lines.empty())
    return builder.error(block, block.location, "no frequencies are given; add a line: lower, upper frequency, points, bias");
  for (const auto& line : block.lines) read_range(builder, block, line, procedure);
}

void read_base_motion(Builder& builder, const Block& block) {
  auto* procedure = std::get_if<SteadyStateProcedure>(&current_step(builder).procedure);
  if (procedure == nullptr)
    return builder.error(block, block.location, "only *STEADY STATE DYNAMICS has it; put it behind that keyword, or move nodes by *BOUNDARY");
  if (block.has("BASE NAME"))
    return builder.error(block, block.location, "BASE NAME is not supported: all held freedoms move as one base; leave it out");
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  BaseMotion motion;
  motion.dof = block.integer("DOF", 1) - 1;
  if (motion.dof < 0 || motion.dof > 5)
    return builder.error(block, block.location, fmt::format("DOF={} does not exist; directions run from 1 to 6", motion.dof + 1));
  motion.kind = block.has("TYPE") ? kind_of_motion(block) : BoundaryCondition::Kind::acceleration;
  motion.scale = block.real("SCALE", 1.0);
  motion.imaginary = is_imaginary(builder, block);
  motion.amplitude = *amplitude;
  motion.file = block.location.file;
  motion.line = block.location.line;
  if (!block.lines.empty()) {
    Row row(builder, block, block.lines[0]);
    motion.centre = row.point(0, "centre of rotation");
    row.at_most(3);
    if (row.ok() && motion.dof < 3) row.error("a centre belongs to rotations, DOF=4 to 6; remove the line");
    if (!row.ok()) return;
  }
  procedure->base_motions.push_back(motion);
}

/// Held freedoms are those that the modes were found with.
void check_held_freedoms(Builder& builder, const Step& step) {
  const auto row = step_of_modes(builder);
  if (row < 0) return;  // told
  constexpr const char* cure = "the step moves in the modes of *FREQUENCY, which hold what that step held; put the condition there, and give the base a "
                               "*BASE MOTION";
  std::set<std::pair<std::int32_t, std::int32_t>> held;
  for (const auto& condition : builder.model.steps[row].boundary) held.emplace(condition.node, condition.dof);
  if (builder.draft.boundary_renewed) builder.diagnostics.error(builder.draft.location, "BOUNDARY", fmt::format("OP=NEW frees nothing here: {}", cure));
  for (const auto& condition : step.boundary)
    if (!condition.propagated && condition.magnitude == 0.0 && !held.contains({condition.node, condition.dof}))
      return builder.diagnostics.error({condition.file, condition.line}, "BOUNDARY",
                                       fmt::format("node {} is not held in direction {}: {}", builder.model.node_name(condition.node),
                                                   condition.dof + 1, cure));
}

void check_drives(Builder& builder, const Step& step) {
  constexpr const char* message = "connectors are not driven in *STEADY STATE DYNAMICS; load their nodes";
  for (const auto& load : step.connector_loads)
    if (load.magnitude != load.previous) builder.diagnostics.error({load.file, load.line}, "CONNECTOR LOAD", message);
  for (const auto& motion : step.connector_motions)
    if (!motion.course.propagated && motion.course.magnitude != 0.0)
      builder.diagnostics.error({motion.course.file, motion.course.line}, "CONNECTOR MOTION", message);
}

/// A base that is said to move with a velocity or an acceleration is displaced without bound at the frequency 0.
void check_base(Builder& builder, const SteadyStateProcedure& procedure) {
  if (procedure.ranges.empty() || procedure.ranges.front().lower > 0.0) return;
  for (const auto& motion : procedure.base_motions)
    if (motion.kind != BoundaryCondition::Kind::displacement)
      return builder.diagnostics.error({motion.file, motion.line}, "BASE MOTION",
                                       "at the frequency 0 a velocity or an acceleration moves the base without bound; give a lower frequency "
                                       "above 0, or TYPE=DISPLACEMENT");
}

void tell_of_rest(Builder& builder, const Step& step, const SteadyStateProcedure& procedure) {
  const bool is_loaded = !step.concentrated_loads.empty() || !step.surface_loads.empty() || !step.body_loads.empty();
  if (is_loaded || !procedure.base_motions.empty() || builder.draft.faulty) return;
  builder.diagnostics.warning(builder.draft.location, "STEADY STATE DYNAMICS",
                              fmt::format("step {} has no loads and no *BASE MOTION: nothing moves (loads of steps before do not go on in it)", step.name));
}

/// What is written is what the step itself asks for, and what has a real and an imaginary part.
void settle_outputs(Builder& builder, Step& step) {
  const auto& draft = builder.draft;
  const auto row = builder.model.steps.size() - 1;
  if (!draft.field_replaced) step.field_outputs.clear();
  if (!draft.history_replaced) {
    step.history_outputs.clear();
    builder.without_history.insert(row);
  }
  std::erase_if(step.print_outputs, [&](const PrintOutput& output) { return !draft.prints_replaced.contains(output.kind); });
  std::set<std::string> left_out;
  const auto leave_out = [&](Words& words, auto without_parts) {
    std::erase_if(words, [&](const std::string& word) { return without_parts(word) && (left_out.insert(word), true); });
  };
  const auto all = [](const std::string&) { return true; };
  for (auto& output : step.field_outputs) {
    leave_out(output.element_variables, has_no_parts);
    leave_out(output.integration_point_variables, has_no_parts);
    leave_out(output.contact_variables, all);
  }
  for (auto& output : step.history_outputs) {
    leave_out(output.energies, all);
    for (auto& elements : output.elements) leave_out(elements.variables, has_no_parts);
    output.contact_pairs.clear();
  }
  for (auto& output : step.print_outputs) leave_out(output.variables, has_no_parts);
  std::erase_if(step.print_outputs, [](const PrintOutput& output) { return output.variables.empty(); });
  if (left_out.empty()) return;
  builder.diagnostics.warning(draft.location, "OUTPUT",
                              fmt::format("step {}: {} have no real and imaginary part, and are not written", step.name,
                                          join(Words(left_out.begin(), left_out.end()))));
}

}  // namespace

bool is_imaginary(Builder& builder, const Block& block) {
  const int said = int{block.has("LOAD CASE")} + int{block.has("REAL")} + int{block.has("IMAGINARY")};
  if (said == 0) return false;
  auto& notes = builder.draft.harmonic;
  const auto is_told = [&](const auto& note) { return note.location.file == block.location.file && note.location.line == block.location.line; };
  if (std::ranges::any_of(notes, is_told)) return block.has("IMAGINARY") || block.integer("LOAD CASE", 1) == 2;
  const char* what = block.has("LOAD CASE") ? "LOAD CASE" : block.has("REAL") ? "REAL" : "IMAGINARY";
  notes.push_back({block.location, block.written, fmt::format("{} belongs to the harmonic loads of *STEADY STATE DYNAMICS; remove it", what)});
  const auto load_case = block.integer("LOAD CASE", 1);
  if (said > 1) builder.error(block, block.location, "give one of LOAD CASE, REAL and IMAGINARY");
  if (load_case != 1 && load_case != 2)
    builder.error(block, block.location, fmt::format("LOAD CASE={} does not exist; 1 is the real part of a harmonic load, 2 the imaginary one", load_case));
  return block.has("IMAGINARY") || load_case == 2;
}

void refuse_in_harmonics(Builder& builder, const Block& block, std::string text) {
  builder.draft.timed.push_back({block.location, block.written, std::move(text)});
}

std::string without_times(const char* parameter) {
  return fmt::format("{} means nothing in a step of *STEADY STATE DYNAMICS, which has frequencies and no times; remove it", parameter);
}

void settle_harmonics(Builder& builder) {
  Step& step = current_step(builder);
  const auto* procedure = std::get_if<SteadyStateProcedure>(&step.procedure);
  if (procedure == nullptr) {
    for (const auto& note : builder.draft.harmonic) builder.diagnostics.error(note.location, note.keyword, note.text);
    return;
  }
  for (const auto& note : builder.draft.timed) builder.diagnostics.error(note.location, note.keyword, note.text);
  check_held_freedoms(builder, step);
  check_drives(builder, step);
  check_base(builder, *procedure);
  tell_of_rest(builder, step, *procedure);
  settle_outputs(builder, step);
}

namespace {

const RegisterKeyword steady_state{{"STEADY STATE DYNAMICS",
                                    Phase::history,
                                    Place::step,
                                    {choice("INTERVAL", {"EIGENFREQUENCY", "RANGE", "SPREAD"}), choice("FREQUENCY SCALE", {"LOGARITHMIC", "LINEAR"}),
                                     flag("DIRECT"),
                                     optional_choice("SUBSPACE PROJECTION", {"ALL FREQUENCIES", "CONSTANT", "EIGENFREQUENCY", "PROPERTY CHANGE", "RANGE"}),
                                     choice("HARMONIC", {"YES", "NO"}), foreign("MODE BASED"), foreign("SOLVER")},
                                    read_steady_state}};
const RegisterKeyword base_motion{{"BASE MOTION",
                                   Phase::history,
                                   Place::step,
                                   {required(integer("DOF")), name("AMPLITUDE"), real("TIME DELAY"), real("SCALE"),
                                    choice("TYPE", {"DISPLACEMENT", "VELOCITY", "ACCELERATION"}), integer("LOAD CASE"), flag("REAL"),
                                    flag("IMAGINARY"), name("BASE NAME")},
                                   read_base_motion}};

}  // namespace

}  // namespace balocco::deck
