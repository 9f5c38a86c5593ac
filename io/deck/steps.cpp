// *STEP *END STEP *STATIC *DYNAMIC *BULK VISCOSITY.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "deck/builder.hpp"
#include "deck/mass_scaling.hpp"
#include "deck/register.hpp"
#include "deck/steady_state.hpp"
#include "deck/step_draft.hpp"
#include "deck/sudden_loads.hpp"
#include "deck/text.hpp"
#include "elements/turning_nodes.hpp"

namespace balocco::deck {

namespace {

/// Magnitude that a load or a motion has reached at the end of a step.
template <class Course>
double reached(const Model& model, const Course& course, double step_time, double total_time) {
  if (course.amplitude < 0) return course.magnitude;
  const Amplitude& amplitude = model.amplitudes[course.amplitude];
  return course.magnitude * amplitude.value(amplitude.total_time ? total_time : step_time);
}

/// A curve over the time of the step that has ended leaves what it reached there; one over total time goes on.
template <class Course>
void hold(const Model& model, Course& course, double step_time) {
  if (course.amplitude < 0 || model.amplitudes[course.amplitude].total_time) return;
  course.magnitude = reached(model, course, step_time, 0.0);
  course.amplitude = -1;
}

/// A propagated velocity or acceleration goes on as it was at the end; a displacement stays where it is (has_arrived).
void propagate(const Model& model, BoundaryCondition& condition, double step_time) {
  condition.propagated = true;
  if (condition.kind != BoundaryCondition::Kind::displacement) hold(model, condition, step_time);
}

void hold_ground_nodes(const Builder& builder, Step& step) {
  if (builder.ground_nodes.empty()) return;
  const auto turning = turning_nodes(builder.model);
  for (const auto node : builder.ground_nodes)
    for (int dof = 0; dof < (turning[node] ? 6 : 3); ++dof) step.boundary.push_back({.node = node, .dof = dof});
}

/// What a step takes over from the one before.
void inherit(Builder& builder, Step& step) {
  const Model& model = builder.model;
  const auto row = static_cast<std::int32_t>(model.steps.size());
  const auto general = model.general_step_before(row);
  if (general < 0) {
    step.boundary = builder.initial_boundary;
    step.connector_motions = builder.initial_angles;
    hold_ground_nodes(builder, step);
    step.checkpoint_frequency = builder.checkpoint_frequency;
    step.checkpoint_number_interval = builder.checkpoint_number_interval;
    step.keeps_checkpoints = builder.keeps_checkpoints;
    for (std::size_t pair = 0; pair < model.contact_pairs.size(); ++pair) {
      step.active_contact_pairs.push_back(static_cast<std::int32_t>(pair));
    }
    return;
  }
  const Step& before = model.steps[general];
  if (builder.without_field.contains(general)) builder.without_field.insert(row);
  if (builder.without_history.contains(general)) builder.without_history.insert(row);
  step.boundary = before.boundary;
  for (auto& condition : step.boundary) propagate(model, condition, before.duration());
  step.concentrated_loads = before.concentrated_loads;
  step.surface_loads = before.surface_loads;
  step.body_loads = before.body_loads;
  step.temperatures = before.temperatures;
  step.connector_motions = before.connector_motions;
  for (auto& motion : step.connector_motions) propagate(model, motion.course, before.duration());
  step.connector_loads = before.connector_loads;
  step.active_contact_pairs = before.active_contact_pairs;
  step.changed_interactions = before.changed_interactions;
  for (auto& change : step.changed_interactions) change.friction_before = change.properties.friction;
  step.removed_elements = before.removed_elements;
  step.removed_constraints = before.removed_constraints;
  step.field_outputs = before.field_outputs;
  step.history_outputs = before.history_outputs;
  step.print_outputs = before.print_outputs;
  step.checkpoint_frequency = before.checkpoint_frequency;
  step.checkpoint_number_interval = before.checkpoint_number_interval;
  step.keeps_checkpoints = before.keeps_checkpoints;
  double total = 0.0;
  for (const auto& done : model.steps) total += done.duration();
  const auto settle = [&](auto& loads) {
    for (auto& load : loads) {
      load.previous = reached(model, load, before.duration(), total);
      hold(model, load, before.duration());
    }
    std::erase_if(loads, [](const auto& load) { return load.magnitude == 0.0 && load.previous == 0.0; });
  };
  settle(step.concentrated_loads);
  settle(step.surface_loads);
  settle(step.body_loads);
  settle(step.connector_loads);
  for (auto& temperature : step.temperatures) {
    temperature.previous = reached(model, temperature, before.duration(), total);
    hold(model, temperature, before.duration());
  }
}

void index_nodes(Builder& builder) {
  const Step& step = current_step(builder);
  for (std::size_t row = 0; row < step.boundary.size(); ++row) {
    builder.draft.boundary_of[std::int64_t{step.boundary[row].node} * 6 + step.boundary[row].dof] = row;
  }
  for (std::size_t row = 0; row < step.concentrated_loads.size(); ++row) {
    const auto& load = step.concentrated_loads[row];
    builder.draft.concentrated_of[StepDraft::key_of(load.node, load.dof, load.follower, load.imaginary)] = row;
  }
  for (std::size_t row = 0; row < step.temperatures.size(); ++row) builder.draft.temperature_of[step.temperatures[row].node] = row;
}

void begin_step(Builder& builder, const Block& block) {
  auto& draft = builder.draft;
  const bool nonlinear_before = draft.nonlinear_geometry;
  const auto controls_before = draft.controls;
  draft = {};
  draft.location = block.location;
  draft.nonlinear_geometry = nonlinear_before;
  draft.controls = controls_before;
  draft.amplitude = block.value("AMPLITUDE");
  builder.draft.faulty = builder.refused_steps.contains(&block);
  Step step;
  inherit(builder, step);
  step.name = block.value("NAME", fmt::format("STEP-{}", builder.model.steps.size() + 1));
  for (const auto& other : builder.model.steps) {
    if (other.name == step.name)
      builder.error(block, block.location, fmt::format("two steps are named {}; rename one", step.name));
  }
  if (block.has("NLGEOM")) {
    const bool asked = block.value("NLGEOM", "YES") == "YES";
    if (!asked && nonlinear_before) {
      builder.error(block, block.location, "NLGEOM=NO cannot follow a step with large displacements; remove it");
    }
    draft.nonlinear_geometry = asked;
    draft.asks_linear_geometry = !asked;
  }
  draft.perturbation = block.has("PERTURBATION");
  draft.maximum_increments = block.integer("INC", 100);
  if (draft.maximum_increments < 1)
    builder.error(block, block.location, "INC must be positive; correct it");
  if (builder.model.heading.empty() && builder.model.steps.empty() && !block.lines.empty()) {
    builder.model.heading = block.lines[0].text;  // a subheading, as CalculiX decks have it
  }
  builder.model.steps.push_back(std::move(step));
  index_nodes(builder);
}

/// Loads that act on a perturbation are those that its own step says.
void drop_loads_of_the_state(Builder& builder, Step& step) {
  // Modes are about the state under its loads, and have none; a static perturbation counts its own from these.
  if (std::holds_alternative<FrequencyProcedure>(step.procedure) || std::holds_alternative<StaticPerturbationProcedure>(step.procedure)) return;
  const auto drop = [&](auto& loads) {
    std::erase_if(loads, [&](const auto& load) { return !builder.draft.said_here(load); });
    for (auto& load : loads) load.previous = 0.0;
  };
  drop(step.concentrated_loads);
  drop(step.surface_loads);
  drop(step.body_loads);
}

/// Modes are always written, and nothing else could be.
void end_search_for_modes(Builder& builder, Step& step) {
  if (builder.draft.field_replaced || builder.draft.history_replaced)
    builder.diagnostics.warning(builder.draft.location, "OUTPUT",
                                fmt::format("step {} writes the displacements and rotations of its modes, and nothing else",
                                            step.name));
  if (!builder.draft.said.empty() && std::holds_alternative<FrequencyProcedure>(step.procedure))
    builder.diagnostics.error(builder.draft.location, "STEP",
                              fmt::format("step {} seeks modes under the loads that stand when it begins; give loads in a "
                                          "*STATIC step before it",
                                          step.name));
  const auto row = builder.model.steps.size() - 1;
  builder.without_field.insert(row);
  builder.without_history.insert(row);
  step.field_outputs.clear();
  step.history_outputs.clear();
}

/// Those of the state stay.
void refuse_drives_of_connectors(Builder& builder, const Step& step) {
  constexpr const char* message = "connectors are not driven in a static PERTURBATION; load their nodes, or give a step with NLGEOM and small loads";
  for (const auto& load : step.connector_loads)
    if (load.magnitude != load.previous) builder.diagnostics.error({load.file, load.line}, "CONNECTOR LOAD", message);
  for (const auto& motion : step.connector_motions)
    if (!motion.course.propagated) builder.diagnostics.error({motion.course.file, motion.course.line}, "CONNECTOR MOTION", message);
}

/// The loads of a perturbation come on top of those that the state stands under.
void make_static_perturbation(Builder& builder, const Block& block) {
  Step& step = current_step(builder);
  const auto* procedure = std::get_if<StaticProcedure>(&step.procedure);
  const auto error = [&](const char* message) { builder.error(block, builder.draft.location, message); };
  if (procedure == nullptr) return error("PERTURBATION is supported with *STATIC and the procedures of modes; remove it");
  if (procedure->stabilize) return error("STABILIZE has nothing to stabilise in a step of PERTURBATION; remove one of them");
  step.procedure = StaticPerturbationProcedure{.duration = procedure->duration};
  const auto add = [&](auto& loads) {
    for (auto& load : loads) {
      const bool said = builder.draft.said_here(load);
      if (said && load.amplitude >= 0)
        builder.diagnostics.error({load.file, load.line}, "STATIC",
                                  "loads of a static PERTURBATION have no course in time; leave AMPLITUDE out and give the magnitude itself");
      load.magnitude = load.previous + (said ? load.magnitude : 0.0);
      load.amplitude = -1;
    }
  };
  add(step.concentrated_loads);
  add(step.surface_loads);
  add(step.body_loads);
  for (const auto& condition : step.boundary)
    if (!condition.propagated && condition.amplitude >= 0)
      builder.diagnostics.error({condition.file, condition.line}, "BOUNDARY",
                                "motions of a static PERTURBATION have no course in time; leave AMPLITUDE out and give the magnitude itself");
  refuse_drives_of_connectors(builder, step);
}

/// Checkpoints of which nobody says when: in each implicit increment, and at the end of an explicit step, as Abaqus has them.
void default_checkpoints(Step& step) {
  const bool is_explicit = std::holds_alternative<ExplicitProcedure>(step.procedure);
  step.checkpoint_frequency = is_explicit ? std::nullopt : std::optional(1);
  step.checkpoint_number_interval = is_explicit ? std::optional(1) : std::nullopt;
}

void end_step(Builder& builder, const Block& block) {
  if (!builder.draft.has_procedure && !builder.draft.faulty) {
    builder.error(block, builder.draft.location, "the step has no procedure; add *STATIC, *DYNAMIC or *FREQUENCY");
  }
  Step& step = current_step(builder);
  if (builder.draft.has_procedure && builder.draft.amplitude == "RAMP" && !step.ramps_loads())
    builder.diagnostics.error(builder.draft.location, "STEP",
                              "AMPLITUDE=RAMP: loads of a dynamic step act at once; leave it out and give the loads an *AMPLITUDE");
  if (builder.draft.perturbation && !step.is_perturbation()) make_static_perturbation(builder, block);
  if (builder.draft.amplitude == "STEP" && std::holds_alternative<StaticProcedure>(step.procedure)) act_at_once(builder);
  if (step.is_perturbation()) drop_loads_of_the_state(builder, step);
  settle_harmonics(builder);
  if (step.seeks_modes()) end_search_for_modes(builder, step);
  if (auto* statics = std::get_if<StaticProcedure>(&step.procedure)) statics->controls = builder.draft.controls;
  if (auto* dynamics = std::get_if<DynamicProcedure>(&step.procedure)) dynamics->controls = builder.draft.controls;
  if (builder.checkpoints_by_procedure) default_checkpoints(step);
  end_mass_scaling(builder);
  if (!builder.draft.bulk_viscosity) return;
  if (auto* procedure = std::get_if<ExplicitProcedure>(&step.procedure)) {
    procedure->linear_bulk_viscosity = (*builder.draft.bulk_viscosity)[0];
    procedure->quadratic_bulk_viscosity = (*builder.draft.bulk_viscosity)[1];
  } else {
    builder.diagnostics.error(builder.draft.bulk_viscosity_location, "BULK VISCOSITY",
                              "only *DYNAMIC, EXPLICIT has a bulk viscosity; remove it from this step");
  }
}

}  // namespace

bool begin_procedure(Builder& builder, const Block& block) {
  if (builder.draft.has_procedure) builder.error(block, block.location, "the step already has a procedure; remove one");
  const bool first = !builder.draft.has_procedure;
  builder.draft.has_procedure = true;
  return first;
}

namespace {

/// The data line of *STATIC and *DYNAMIC: first increment, period, smallest and largest increment.
void read_increments(Builder& builder, const Block& block, ImplicitIncrements& procedure) {
  procedure.nonlinear_geometry = builder.draft.nonlinear_geometry;
  procedure.maximum_increments = builder.draft.maximum_increments;
  procedure.direct = block.has("DIRECT");
  double initial = 0.0, duration = 0.0, minimum = 0.0, maximum = 0.0;
  if (!block.lines.empty()) {
    Row row(builder, block, block.lines[0]);
    initial = row.real_or(0, 0.0, "initial increment");
    duration = row.real_or(1, 0.0, "time period");
    minimum = row.real_or(2, 0.0, "smallest increment");
    maximum = row.real_or(3, 0.0, "largest increment");
    row.at_most(4);
    if (row.ok() && (initial < 0.0 || duration < 0.0 || minimum < 0.0 || maximum < 0.0)) {
      row.error("increments and period must not be negative; correct the line");
    }
    if (!row.ok()) return;
  }
  // Abaqus's defaults: period 1, first increment the period, smallest 1e-5 of the period or the first increment if
  // less.
  procedure.duration = duration > 0.0 ? duration : 1.0;
  procedure.initial_increment = initial > 0.0 ? initial : procedure.duration;
  procedure.minimum_increment =
      minimum > 0.0 ? minimum : std::min(procedure.initial_increment, 1e-5 * procedure.duration);
  procedure.maximum_increment = maximum > 0.0 ? maximum : procedure.duration;
  if (procedure.initial_increment > procedure.duration) {
    builder.error(block, block.lines[0].location,
                  fmt::format("the initial increment {} exceeds the time period {}; make it smaller",
                              procedure.initial_increment, procedure.duration));
  }
}

void read_static(Builder& builder, const Block& block) {
  if (!begin_procedure(builder, block)) return;
  auto& procedure = current_step(builder).procedure.emplace<StaticProcedure>();
  procedure.stabilize = block.has("STABILIZE");
  procedure.dissipated_energy_fraction = block.real("STABILIZE", procedure.dissipated_energy_fraction);
  read_increments(builder, block, procedure);
}

/// Parameters of the one *DYNAMIC do not belong to the other.
bool has_none(Builder& builder, const Block& block, std::initializer_list<const char*> parameters, const char* cure) {
  for (const char* parameter : parameters) {
    if (!block.has(parameter)) continue;
    builder.error(block, block.location, fmt::format("{} {}", parameter, cure));
    return false;
  }
  return true;
}

/// Alpha of APPLICATION=MODERATE DISSIPATION: beta = (1 - alpha)^2 / 4 = 0.5, gamma = 0.5 - alpha = 0.91421.
constexpr double moderate_dissipation = 1.0 - std::numbers::sqrt2;

void read_implicit_dynamic(Builder& builder, const Block& block) {
  auto& procedure = current_step(builder).procedure.emplace<DynamicProcedure>();
  if (!has_none(builder, block, {"DIRECT USER CONTROL", "SCALE FACTOR", "ENERGY ERROR"}, "belongs to *DYNAMIC, EXPLICIT; remove it")) return;
  for (const auto& material : builder.model.materials)
    if (material.damping_beta > 0.0)
      return builder.error(block, block.location,
                           fmt::format("material {} has *DAMPING, BETA, which this procedure does not count; give ALPHA, a dashpot or *VISCOELASTIC",
                                       material.name));
  procedure.finds_initial_accelerations = block.value("INITIAL", "YES") == "YES";
  const bool moderate = squeeze(block.value("APPLICATION")) == "MODERATEDISSIPATION";
  procedure.alpha = block.real("ALPHA", moderate ? moderate_dissipation : procedure.alpha);
  if (moderate && !block.has("ALPHA")) return read_increments(builder, block, procedure);
  if (!(procedure.alpha >= -1.0 / 3.0 && procedure.alpha <= 0.0))
    builder.error(block, block.location, fmt::format("ALPHA={} must lie between -1/3 and 0; correct it", procedure.alpha));
  read_increments(builder, block, procedure);
}

void read_dynamic(Builder& builder, const Block& block) {
  if (!begin_procedure(builder, block)) return;
  if (!block.has("EXPLICIT")) return read_implicit_dynamic(builder, block);
  if (!has_none(builder, block, {"ALPHA", "APPLICATION", "INITIAL"}, "belongs to *DYNAMIC without EXPLICIT; remove it")) return;
  Step& step = current_step(builder);
  auto& procedure = step.procedure.emplace<ExplicitProcedure>();
  if (builder.draft.asks_linear_geometry)
    builder.warning(block, block.location, "displacements are always finite here: NLGEOM=NO of the step changes nothing");
  builder.draft.nonlinear_geometry = true;
  procedure.scale_factor = block.real("SCALE FACTOR", 1.0);
  if (!(procedure.scale_factor > 0.0 && procedure.scale_factor <= 1.0)) {
    builder.error(block, block.location, "SCALE FACTOR must lie between 0 and 1; correct it");
  }
  const double percent = block.real("ENERGY ERROR", 100.0 * procedure.energy_error_limit);
  procedure.energy_error_limit = percent / 100.0;
  if (!(percent > 0.0)) builder.error(block, block.location, "ENERGY ERROR (percent) must be positive; correct it");
  if (block.lines.empty())
    return builder.error(block, block.location, "the time period is missing; add a line: , period");
  Row row(builder, block, block.lines[0]);
  const double first = row.real_or(0, 0.0, "time increment");
  procedure.duration = row.real(1, "time period");
  row.at_most(2);
  if (row.ok() && !(procedure.duration > 0.0))
    row.error(fmt::format("time period {} must be positive; correct it", procedure.duration));
  if (!row.ok()) return;
  if (block.has("DIRECT USER CONTROL") || block.has("DIRECT")) {
    if (!(first > 0.0)) return row.error("DIRECT USER CONTROL needs the increment in field 1; add it");
    procedure.fixed_increment = first;
  } else if (row.has(0) && first > 0.0) {
    builder.warning(block, row.location(),
                    "field 1 (the increment) has a meaning only with DIRECT USER CONTROL; the stable increment is "
                    "estimated");
  }
}

void read_bulk_viscosity(Builder& builder, const Block& block) {
  const ExplicitProcedure standard;
  auto& [linear, quadratic] =
      builder.draft.bulk_viscosity.emplace(std::array{standard.linear_bulk_viscosity, standard.quadratic_bulk_viscosity});
  builder.draft.bulk_viscosity_location = block.location;
  if (block.lines.empty()) return;
  Row row(builder, block, block.lines[0]);
  linear = row.real_or(0, linear, "linear coefficient");
  quadratic = row.real_or(1, quadratic, "quadratic coefficient");
  row.at_most(2);
  if (row.ok() && (linear < 0.0 || quadratic < 0.0)) {
    row.error("the coefficients must not be negative; correct them");
  }
}

const RegisterKeyword step{
    {"STEP",
     Phase::history,
     Place::model,
     {name("NAME"), optional_choice("NLGEOM", {"YES", "NO"}), integer("INC"), foreign("UNSYMM"),
      foreign("EXTRAPOLATION"), foreign("SOLVER"), foreign("CONVERT SDI"), choice("AMPLITUDE", {"RAMP", "STEP"}), flag("PERTURBATION")},
     begin_step}};
const RegisterKeyword end{{"END STEP", Phase::history, Place::step, {}, end_step}};
const RegisterKeyword static_analysis{
    {"STATIC",
     Phase::history,
     Place::step,
     {flag("DIRECT"), optional_real("STABILIZE"), foreign("ALLSDTOL"), choice("CONTINUE", {"NO"}), foreign("SOLVER")},
     read_static}};
const RegisterKeyword dynamic{{"DYNAMIC",
                               Phase::history,
                               Place::step,
                               {flag("EXPLICIT"), real("ALPHA"), choice("INITIAL", {"YES", "NO"}), flag("DIRECT USER CONTROL"), flag("DIRECT"),
                                choice("APPLICATION", {"TRANSIENT FIDELITY", "MODERATE DISSIPATION"}),
                                foreign("ELEMENT BY ELEMENT"), foreign("IMPROVED DT METHOD"), foreign("GLOBAL"),
                                foreign("SOLVER"), real("SCALE FACTOR"), real("ENERGY ERROR")},
                               read_dynamic}};
const RegisterKeyword bulk{{"BULK VISCOSITY", Phase::history, Place::step, {}, read_bulk_viscosity}};
}  // namespace

}  // namespace balocco::deck
