// The steps of a deck being written.
#include <algorithm>
#include <iterator>
#include <utility>

#include "deck/steady_state.hpp"
#include "deck/writer.hpp"

namespace balocco::deck {

namespace {

/// The step whose conditions and output go on in this one.
const Step* before(const Model& model, std::size_t row) {
  const auto general = model.general_step_before(static_cast<std::int32_t>(row));
  return general < 0 ? nullptr : &model.steps[general];
}

const char* type_of_motion(BoundaryCondition::Kind kind) {
  switch (kind) {
    case BoundaryCondition::Kind::velocity:
      return ", TYPE=VELOCITY";
    case BoundaryCondition::Kind::acceleration:
      return ", TYPE=ACCELERATION";
    case BoundaryCondition::Kind::displacement:
      break;
  }
  return "";
}

}  // namespace

void Writer::procedure(const StaticProcedure& p) {
  line("*STATIC{}{}", p.direct ? ", DIRECT" : "",
       p.stabilize ? fmt::format(", STABILIZE={}", p.dissipated_energy_fraction) : "");
  line("{}, {}, {}, {}", p.initial_increment, p.duration, p.minimum_increment, p.maximum_increment);
  controls(p.controls);
}

void Writer::procedure(const ExplicitProcedure& p) {
  line("*DYNAMIC, EXPLICIT{}{}{}", p.fixed_increment ? ", DIRECT USER CONTROL" : "",
       p.scale_factor != 1.0 ? fmt::format(", SCALE FACTOR={}", p.scale_factor) : "",
       p.energy_error_limit != ExplicitProcedure{}.energy_error_limit
           ? fmt::format(", ENERGY ERROR={}", 100.0 * p.energy_error_limit)
           : "");
  line("{}, {}", p.fixed_increment ? fmt::format("{}", *p.fixed_increment) : "", p.duration);
  line("*BULK VISCOSITY\n{}, {}", p.linear_bulk_viscosity, p.quadratic_bulk_viscosity);
  for (const auto& definition : p.fixed_mass_scaling) mass_scaling("FIXED", definition);
  for (const auto& definition : p.variable_mass_scaling) mass_scaling("VARIABLE", definition);
}

void Writer::mass_scaling(const char* kind, const MassScaling& definition) {
  using Target = MassScaling::Target;
  std::string text = fmt::format("*{} MASS SCALING", kind);
  if (definition.factor != 1.0) text += fmt::format(", FACTOR={}", definition.factor);
  if (definition.target != Target::none)
    text += fmt::format(", DT={}, TYPE={}", definition.increment,
                        definition.target == Target::uniform         ? "UNIFORM"
                        : definition.target == Target::below_minimum ? "BELOW MIN"
                                                                     : "SET EQUAL DT");
  if (definition.frequency) text += fmt::format(", FREQUENCY={}", *definition.frequency);
  if (definition.number_interval) text += fmt::format(", NUMBER INTERVAL={}", *definition.number_interval);
  if (definition.element_set >= 0) text += ", ELSET=" + quoted(model_.element_sets[definition.element_set].name);
  line("{}", text);
}

void Writer::procedure(const FrequencyProcedure& p) {
  line("*FREQUENCY, NORMALIZATION={}",
       p.normalization == FrequencyProcedure::Normalization::mass ? "MASS" : "DISPLACEMENT");
  const auto field = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string(); };
  line("{}, {}, {}, {}", field(p.number), field(p.lower), field(p.upper), p.shift);
}

void Writer::procedure(const DynamicProcedure& p) {
  line("*DYNAMIC, ALPHA={}{}{}", p.alpha, p.direct ? ", DIRECT" : "", p.finds_initial_accelerations ? "" : ", INITIAL=NO");
  line("{}, {}, {}, {}", p.initial_increment, p.duration, p.minimum_increment, p.maximum_increment);
  controls(p.controls);
}

void Writer::procedure(const BuckleProcedure& p) {
  line("*BUCKLE\n{}", p.number);
}

void Writer::procedure(const ModalDynamicProcedure& p) {
  line("*MODAL DYNAMIC{}\n{}, {}", p.largest_load_change ? fmt::format(", DIRECT=NO, DELTMX={}", *p.largest_load_change) : "",
       p.increment, p.duration);
  modal_damping(p.damping);
}

void Writer::modal_damping(const std::vector<ModalDamping>& dampings) {
  for (const auto& damping : dampings) {
    if (damping.fraction != 0.0)
      line("*MODAL DAMPING\n{}, {}, {}", damping.first, damping.last, damping.fraction);
    else if (damping.structural != 0.0)
      line("*MODAL DAMPING, STRUCTURAL\n{}, {}, {}", damping.first, damping.last, damping.structural);
    else
      line("*MODAL DAMPING, RAYLEIGH\n{}, {}, {}, {}", damping.first, damping.last, damping.alpha, damping.beta);
  }
}

void Writer::procedure(const SteadyStateProcedure& p) {
  line("*STEADY STATE DYNAMICS, INTERVAL={}, FREQUENCY SCALE={}",
       p.interval == SteadyStateProcedure::Interval::range ? "RANGE" : "EIGENFREQUENCY", p.logarithmic ? "LOGARITHMIC" : "LINEAR");
  for (const auto& range : p.ranges)
    line("{}, {}, {}, {}, {}", range.lower, range.upper > range.lower ? range.upper : 0.0, range.points, range.bias, range.scale);
  modal_damping(p.damping);
  for (const auto& motion : p.base_motions) {
    const std::string type = motion.kind == BoundaryCondition::Kind::displacement ? ", TYPE=DISPLACEMENT" : type_of_motion(motion.kind);
    line("*BASE MOTION, DOF={}, SCALE={}{}{}{}", motion.dof + 1, motion.scale, type, part_parameter(motion.imaginary),
         amplitude_parameter(motion.amplitude));
    if (motion.dof >= 3) line("{}, {}, {}", motion.centre[0], motion.centre[1], motion.centre[2]);
  }
}

void Writer::procedure(const StaticPerturbationProcedure& p) {
  line("*STATIC\n, {}", p.duration);
}

void Writer::controls(const ImplicitControls& now) {
  const auto old = std::exchange(controls_, now);
  if (now.residual_tolerance != old.residual_tolerance || now.correction_tolerance != old.correction_tolerance) {
    line("*CONTROLS, PARAMETERS=FIELD\n{}, {}", now.residual_tolerance, now.correction_tolerance);
  }
  if (now.maximum_iterations != old.maximum_iterations) {
    line("*CONTROLS, PARAMETERS=TIME INCREMENTATION\n, , , {}", now.maximum_iterations);
  }
  if (now.line_search != old.line_search) line("*CONTROLS, PARAMETERS=LINE SEARCH\n{}", now.line_search ? 5 : 0);
}

void Writer::contact_changes(std::size_t row) {
  const auto& active = model_.steps[row].active_contact_pairs;
  const auto contains = [](const std::vector<std::int32_t>& pairs, std::int32_t pair) {
    return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
  };
  for (std::size_t k = 0; k < model_.contact_pairs.size(); ++k) {
    const auto pair = static_cast<std::int32_t>(k);
    const auto& [slave, master, interaction, first_step, of_faces, location] = model_.contact_pairs[k];
    const bool now = contains(active, pair), starts = first_step > 0 && first_step == static_cast<std::int32_t>(row);
    const auto* previous = before(model_, row);
    const bool was = previous == nullptr ? first_step == 0 : contains(previous->active_contact_pairs, pair);
    const std::string names = quoted(model_.surfaces[slave].name) + ", " + quoted(model_.surfaces[master].name);
    if (starts)
      line("*CONTACT PAIR, INTERACTION={}{}\n{}", quoted(model_.interactions[interaction].name),
           of_faces ? ", TYPE=SURFACE TO SURFACE" : "", names);
    if (now != (was || starts)) line("*MODEL CHANGE, TYPE=CONTACT PAIR, {}\n{}", now ? "ADD" : "REMOVE", names);
  }
  const auto* previous = before(model_, row);
  for (const auto& change : model_.steps[row].changed_interactions) {
    const auto* known = &model_.interactions[change.interaction];
    if (previous != nullptr) {
      const auto found = std::ranges::find(previous->changed_interactions, change.interaction, &ChangedInteraction::interaction);
      if (found != previous->changed_interactions.end()) known = &found->properties;
    }
    interaction_change(change.properties, *known);
  }
}

void Writer::interaction_change(const Interaction& now, const Interaction& before) {
  if (now.friction != before.friction || now.elastic_slip != before.elastic_slip || now.stick_slope != before.stick_slope ||
      now.shear_stress_limit != before.shear_stress_limit) {
    line("*CHANGE FRICTION, INTERACTION={}", quoted(now.name));
    friction(now);
  }
  if (now.behavior != before.behavior || now.penalty_scale != before.penalty_scale) {
    line("*CHANGE SURFACE BEHAVIOR, INTERACTION={}", quoted(now.name));
    if (!now.behavior.is_soft()) line("*SURFACE BEHAVIOR");
    behavior(now);
  }
}

void Writer::element_changes(std::size_t row) {
  const Step* const last = before(model_, row);
  const auto& now = model_.steps[row].removed_elements;
  const auto was = last == nullptr ? std::vector<ElementRef>{} : last->removed_elements;
  std::vector<ElementRef> removed, added;
  std::ranges::set_difference(now, was, std::back_inserter(removed));
  std::ranges::set_difference(was, now, std::back_inserter(added));
  if (!removed.empty())
    line("*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n{}", quoted(element_set_of(removed, fmt::format("_REMOVED-{}", row + 1))));
  if (!added.empty())
    line("*MODEL CHANGE, TYPE=ELEMENT, ADD=WITH STRAIN\n{}", quoted(element_set_of(added, fmt::format("_ADDED-{}", row + 1))));
}

/// Behind the last of the conditions that differ from the first in nothing but the node.
Conditions end_of_run(Conditions first, Conditions end) {
  return std::find_if(first, end, [&](const BoundaryCondition& c) {
    return c.kind != first->kind || c.dof != first->dof || c.magnitude != first->magnitude || c.fixed != first->fixed ||
           c.amplitude != first->amplitude || c.propagated != first->propagated;
  });
}

/// Conditions are stated in the step in which they are new. Where earlier ones were taken away, all are stated afresh.
void Writer::boundary(std::size_t row) {
  const auto& conditions = model_.steps[row].boundary;
  const Step* previous = before(model_, row);
  const auto still_there = [&](const BoundaryCondition& old) {
    return std::any_of(conditions.begin(), conditions.end(),
                       [&](const BoundaryCondition& c) { return c.node == old.node && c.dof == old.dof; });
  };
  const bool renew = previous != nullptr &&
                     !(conditions.size() >= previous->boundary.size() &&
                       std::equal(previous->boundary.begin(), previous->boundary.end(), conditions.begin(),
                                  [](const auto& a, const auto& b) { return a.node == b.node && a.dof == b.dof; })) &&
                     !std::all_of(previous->boundary.begin(), previous->boundary.end(), still_there);
  if (renew) line("*BOUNDARY, OP=NEW");
  std::string header;
  for (auto c = conditions.begin(); c != conditions.end();) {
    const auto end = end_of_run(c, conditions.end());
    if (c->propagated && !renew) {
      c = end;
      continue;
    }
    const std::string wanted = fmt::format("*BOUNDARY{}{}{}{}", renew ? ", OP=NEW" : "", type_of_motion(c->kind),
                                           c->fixed ? ", FIXED" : "", amplitude_parameter(c->amplitude));
    if (wanted != header) line("{}", wanted);
    header = wanted;
    const std::string value = c->fixed ? "" : fmt::format(", {}", c->magnitude);
    if (const auto* set = set_of(c, end)) {
      line("{}, {}, {}{}", quoted(set->name), c->dof + 1, c->dof + 1, value);
      c = end;
    } else {
      for (; c != end; ++c) line("{}, {}, {}{}", node_id(c->node), c->dof + 1, c->dof + 1, value);
    }
  }
}

/// The node set whose nodes, in their order, are those of a run of at least two conditions; nullptr: none.
const NodeSet* Writer::set_of(Conditions first, Conditions end) const {
  if (end - first < 2) return nullptr;
  const auto found = std::find_if(model_.node_sets.begin(), model_.node_sets.end(), [&](const NodeSet& set) {
    return std::equal(set.nodes.begin(), set.nodes.end(), first, end,
                      [](std::int32_t node, const BoundaryCondition& c) { return node == c.node; });
  });
  return found == model_.node_sets.end() ? nullptr : &*found;
}

void Writer::attachments(const Step& step) {
  for (const auto& change : step.attachments) {
    const auto& body = model_.rigid_bodies[change.rigid_body];
    line("*RIGID BODY, REF NODE={}, {} NSET={}", node_id(body.reference_node),
         change.release ? "RELEASE"
         : change.tie   ? "TIE"
                        : "PIN",
         quoted(node_set_of(change.nodes, fmt::format("_{}-{}-CHANGE", step.name, body.name))));
  }
}

/// Defines time points. @return the parameter that refers to them.
std::string Writer::time_points(const std::vector<double>& times, const std::string& name) {
  time_points_ += "*TIME POINTS, NAME=" + name + "\n";
  for (const double time : times) time_points_ += fmt::format("{}\n", time);
  return ", TIME POINTS=" + name;
}

void Writer::field_output(const FieldOutput& output, std::size_t step, std::size_t number) {
  std::string times;
  if (output.frequency) times = fmt::format(", FREQUENCY={}", *output.frequency);
  if (output.number_interval) times = fmt::format(", NUMBER INTERVAL={}", *output.number_interval);
  if (output.time_interval) times = fmt::format(", TIME INTERVAL={}", *output.time_interval);
  if (!output.time_points.empty()) times = time_points(output.time_points, fmt::format("TIMES-{}-{}", step + 1, number + 1));
  if (times.empty()) return;  // what a deck that asks for no frames gets
  line("*OUTPUT, FIELD{}{}", times, output.single_precision ? "" : ", PRECISION=DOUBLE");
  const auto request = [&](const std::string& keyword, const std::vector<std::string>& variables) {
    if (variables.empty()) return;
    line("{}", keyword);
    values(variables);
  };
  const std::string nodes = output.node_set < 0 ? "" : ", NSET=" + quoted(model_.node_sets[output.node_set].name);
  const std::string elements =
      output.element_set < 0 ? "" : ", ELSET=" + quoted(model_.element_sets[output.element_set].name);
  request("*NODE OUTPUT" + nodes, output.node_variables);
  request("*ELEMENT OUTPUT" + elements, output.element_variables);
  request("*ELEMENT OUTPUT, POSITION=INTEGRATION POINTS" + elements, output.integration_point_variables);
  request("*CONTACT OUTPUT", output.contact_variables);
}

void Writer::history_output(const HistoryOutput& output) {
  if (!output.frequency && !output.time_interval) return;  // what a deck that asks for no history gets
  if (output.frequency) line("*OUTPUT, HISTORY, FREQUENCY={}", *output.frequency);
  if (output.time_interval) line("*OUTPUT, HISTORY, TIME INTERVAL={}", *output.time_interval);
  for (const auto& request : output.nodes) {
    line("*NODE OUTPUT, NSET={}", quoted(model_.node_sets[request.set].name));
    values(request.variables);
  }
  for (const auto& request : output.elements) {
    line("*ELEMENT OUTPUT, ELSET={}", quoted(model_.element_sets[request.set].name));
    values(request.variables);
  }
  if (!output.energies.empty()) {
    line("*ENERGY OUTPUT");
    values(output.energies);
  }
  for (const auto pair : output.contact_pairs) {
    line("*CONTACT OUTPUT, SLAVE={}, MASTER={}\nCFN, CFT, CM, CAREA, XN",
         quoted(model_.surfaces[model_.contact_pairs[pair].slave].name),
         quoted(model_.surfaces[model_.contact_pairs[pair].master].name));
  }
}

void Writer::print_outputs(const Step& step, std::size_t row) {
  bool of_nodes = false, of_elements = false, of_contact = model_.contact_pairs.empty();
  for (const auto& output : step.print_outputs) {
    const auto number = &output - step.print_outputs.data();
    const auto times = output.time_points.empty()
                           ? fmt::format(", FREQUENCY={}", output.frequency)
                           : time_points(output.time_points, fmt::format("PRINTS-{}-{}", row + 1, number + 1));
    if (output.kind == PrintOutput::Kind::section) {
      line("*SECTION PRINT, SURFACE={}, NAME={}{}", quoted(model_.surfaces[output.set].name), quoted(output.section_name), times);
      values(output.variables);
      continue;
    }
    if (output.kind == PrintOutput::Kind::contact) {
      of_contact = true;
      line("*CONTACT PRINT{}{}", output.set >= 0 ? ", NSET=" + quoted(model_.node_sets[output.set].name) : "", times);
      values(output.variables);
      continue;
    }
    const bool nodes = output.kind == PrintOutput::Kind::nodes;
    (nodes ? of_nodes : of_elements) = true;
    std::string text = nodes ? "*NODE PRINT" : "*EL PRINT";
    if (output.set >= 0)
      text += nodes ? ", NSET=" + quoted(model_.node_sets[output.set].name) : ", ELSET=" + quoted(model_.element_sets[output.set].name);
    if (output.totals != PrintOutput::Totals::none) text += output.totals == PrintOutput::Totals::only ? ", TOTALS=ONLY" : ", TOTALS=YES";
    line("{}{}, GLOBAL={}", text, times, output.global_directions ? "YES" : "NO");
    values(output.variables);
  }
  if (!of_nodes) line("*NODE PRINT, FREQUENCY=0");
  if (!of_elements) line("*EL PRINT, FREQUENCY=0");
  if (!of_contact) line("*CONTACT PRINT, FREQUENCY=0");
}

void Writer::checkpoints(std::size_t row) {
  const Step& step = model_.steps[row];
  const char* const overlay = step.keeps_checkpoints ? "" : ", OVERLAY";
  if (step.checkpoint_frequency) {
    line("*RESTART, WRITE, FREQUENCY={}{}", *step.checkpoint_frequency, overlay);
  } else if (step.checkpoint_number_interval) {
    line("*RESTART, WRITE, NUMBER INTERVAL={}{}", *step.checkpoint_number_interval, overlay);
  } else if (const auto* previous = before(model_, row);
             previous != nullptr && (previous->checkpoint_frequency || previous->checkpoint_number_interval)) {
    line("*RESTART, WRITE, FREQUENCY=0");
  }
}

namespace {

/// Whether an explicit step does not go on with what the last one before it scaled.
bool ends_mass_scaling(const Model& model, std::size_t row) {
  const auto* procedure = std::get_if<ExplicitProcedure>(&model.steps[row].procedure);
  if (procedure == nullptr || !procedure->variable_mass_scaling.empty()) return false;
  while (row-- > 0)
    if (const auto* before = std::get_if<ExplicitProcedure>(&model.steps[row].procedure))
      return !before->variable_mass_scaling.empty();
  return false;
}

}  // namespace

void Writer::step(std::size_t row) {
  const Step& now = model_.steps[row];
  comment(("Step " + now.name).c_str());
  // An implicit step has large displacements where it says so, or where they have gone on from a step before.
  const auto* implicit = now.implicit_increments();
  const std::string details = now.is_perturbation() ? ", PERTURBATION"
                              : implicit == nullptr ? ", NLGEOM=YES"
                                                   : fmt::format(", NLGEOM={}, INC={}", implicit->nonlinear_geometry ? "YES" : "NO",
                                                                 implicit->maximum_increments);

  line("*STEP, NAME={}{}", quoted(now.name), details);
  std::visit([this](const auto& kind) { procedure(kind); }, now.procedure);
  if (ends_mass_scaling(model_, row)) line("*VARIABLE MASS SCALING");
  if (now.is_perturbation()) {
    boundary(row);
    if (!std::holds_alternative<FrequencyProcedure>(now.procedure)) loads(now);
    if (now.seeks_modes() || std::holds_alternative<ModalDynamicProcedure>(now.procedure)) return line("*END STEP");
  } else {
    contact_changes(row);
    element_changes(row);
    attachments(now);
    boundary(row);
    loads(now);
    checkpoints(row);
  }
  for (std::size_t k = 0; k < now.field_outputs.size(); ++k) field_output(now.field_outputs[k], row, k);
  if (now.field_outputs.empty()) line("*OUTPUT, FIELD, FREQUENCY=0");
  for (const auto& output : now.history_outputs) history_output(output);
  if (now.history_outputs.empty()) line("*OUTPUT, HISTORY, FREQUENCY=0");
  const Step* const previous = before(model_, row);
  if (!now.print_outputs.empty() || (previous != nullptr && !previous->print_outputs.empty())) print_outputs(now, row);
  line("*END STEP");
}

}  // namespace balocco::deck
