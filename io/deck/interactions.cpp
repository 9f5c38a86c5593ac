// *SURFACE INTERACTION *FRICTION *SURFACE BEHAVIOR *CHANGE FRICTION *CHANGE SURFACE BEHAVIOR.
#include "deck/interactions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

double mean_edge(const Model& model, std::int32_t surface) {
  double sum = 0.0;
  std::size_t edges = 0;
  for (const auto& face : model.surfaces[surface].faces) {
    const auto& table = model.elements[face.element.table];
    const auto& corners = table.type->faces[face.face];
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto at = [&](std::size_t corner) {
        return model.nodes.coordinates[table.connectivity[face.element.row * table.type->nodes + corners[corner]]];
      };
      sum += norm(subtract(at((k + 1) % corners.size()), at(k)));
      ++edges;
    }
  }
  return edges > 0 ? sum / static_cast<double>(edges) : 0.0;
}

namespace {

/// What *FRICTION and *SURFACE BEHAVIOR speak of: in a step the interaction that it changes.
Interaction& current_interaction(Builder& builder) {
  if (builder.in_step) return current_step(builder).changed_interactions[builder.draft.changed_interaction].properties;
  return builder.model.interactions.back();
}

/// Whether there is one: what should have begun it may be wrong, which has been told.
bool has_interaction(const Builder& builder) {
  return builder.in_step ? builder.draft.changed_interaction >= 0 : !builder.model.interactions.empty();
}

void read_interaction(Builder& builder, const Block& block) {
  const auto full = builder.define(builder.interactions, block.value("NAME"),
                                   static_cast<std::int32_t>(builder.model.interactions.size()), block);
  builder.connector_friction = nullptr;
  for (const auto& line :
       block.lines) {  // Abaqus writes the out-of-plane thickness "1.," of two-dimensional models here
    Row row(builder, block, line);
    if (row.real_or(0, 1.0, "out-of-plane thickness") != 1.0)
      row.error("models are three-dimensional: remove the data line");
  }
  Interaction interaction;
  interaction.name = full.value_or(block.value("NAME"));
  interaction.location = block.location;
  builder.model.interactions.push_back(std::move(interaction));
}

/// A fraction of the mean edge of a slave: of the first pair that has the interaction.
void set_slip_tolerance(Builder& builder, double tolerance) {
  if (!builder.in_step) {
    builder.slip_tolerance[static_cast<std::int32_t>(builder.model.interactions.size()) - 1] = tolerance;
    return;
  }
  const auto& change = current_step(builder).changed_interactions[builder.draft.changed_interaction];
  const auto pair = std::ranges::find(builder.model.contact_pairs, change.interaction, &ContactPair::interaction);
  const double edge = pair == builder.model.contact_pairs.end() ? 0.0 : mean_edge(builder.model, pair->slave);
  if (edge > 0.0) current_interaction(builder).elastic_slip = tolerance * edge;
}

/// ROUGH: a point that is closed never slips.
void read_rough_friction(Builder& builder, const Block& block) {
  constexpr double never_slips = 1e12;
  if (!block.lines.empty() || block.has("TAUMAX") || block.has("SLIP TOLERANCE") || block.has("ELASTIC SLIP"))
    return builder.error(block, block.location, "ROUGH stands alone, without a coefficient and other parameters; take them away");
  if (builder.connector_friction != nullptr)
    return builder.error(block, block.location, "ROUGH is of surfaces; hold the connector with *CONNECTOR LOCK");
  if (has_interaction(builder)) current_interaction(builder).friction = never_slips;
}

void read_friction(Builder& builder, const Block& block) {
  if (block.has("ROUGH")) return read_rough_friction(builder, block);
  if (block.lines.empty()) return builder.error(block, block.location, "the coefficient is missing; add a data line");
  Row row(builder, block, block.lines[0]);
  const double coefficient = row.real_or(0, 0.0, "friction coefficient");
  // One line holds at every slip rate, pressure and temperature, which may follow. Where CalculiX has its stick slope Abaqus has the slip
  // rate, which is zero where there is one line.
  const double slope = row.real_or(1, 0.0, "slip rate, or stick slope");
  for (int field = 2; field < 4; ++field) row.real_or(field, 0.0, "contact pressure or temperature");
  if (row.ok() && slope < 0.0) row.error(fmt::format("the stick slope {} must not be negative; correct it", slope));
  row.at_most(4);
  if (row.ok() && coefficient < 0.0)
    row.error(fmt::format("coefficient {} must not be negative; correct it", coefficient));
  if (block.lines.size() > 1)
    builder.error(block, block.lines[1].location, "tables of friction are not supported; give one coefficient");
  if (builder.connector_friction != nullptr) {
    builder.connector_friction->coefficient = coefficient;
    if (block.has("SLIP TOLERANCE") || block.has("ELASTIC SLIP"))
      builder.error(block, block.location, "connectors stick exactly, without an elastic slip; remove the parameter");
    if (block.has("TAUMAX")) builder.error(block, block.location, "TAUMAX is a stress of surfaces, which connectors do not have; remove it");
    return;
  }
  if (!has_interaction(builder)) return;
  current_interaction(builder).friction = coefficient;
  if (slope > 0.0) current_interaction(builder).stick_slope = slope;
  if (block.has("TAUMAX")) {
    const double limit = block.real("TAUMAX", 0.0);
    if (!(limit > 0.0)) return builder.error(block, block.location, "TAUMAX, the greatest shear stress, must be positive; correct it");
    current_interaction(builder).shear_stress_limit = limit;
  }
  if (block.has("SLIP TOLERANCE")) {
    const double tolerance = block.real("SLIP TOLERANCE", 0.0);
    if (!(tolerance > 0.0) || block.has("ELASTIC SLIP")) {
      return builder.error(block, block.location,
                           "SLIP TOLERANCE must be positive and stand without ELASTIC SLIP; correct it");
    }
    set_slip_tolerance(builder, tolerance);
  }
  if (block.has("ELASTIC SLIP")) {
    current_interaction(builder).elastic_slip = block.real("ELASTIC SLIP", 0.0);
    if (!(*current_interaction(builder).elastic_slip > 0.0))
      builder.error(block, block.location, "ELASTIC SLIP must be positive; correct it");
  }
}

/// The pair's laws stand alone. @return whether they do, and have data.
bool has_law(Builder& builder, const Block& block, const std::string& kind, const char* data) {
  if (block.has("PENALTY") || block.has("AUGMENTED LAGRANGE")) {
    builder.error(block, block.location, fmt::format("PENALTY and AUGMENTED LAGRANGE are of hard contact; take them away, or {}", kind));
    return false;
  }
  if (block.lines.empty()) builder.error(block, block.location, fmt::format("{} needs {}; add it", kind, data));
  return !block.lines.empty();
}

/// LINEAR: pressure per overclosure; behind it CalculiX has the tension at great clearance and how far that reaches.
PressureLaw read_linear_behavior(Builder& builder, const Block& block) {
  PressureLaw law{.kind = PressureLaw::Kind::linear};
  Row row(builder, block, block.lines[0]);
  law.slope = row.real(0, "slope of pressure over overclosure");
  law.tension = row.real_or(1, 0.0, "tension at great clearance");
  law.spring_clearance = row.real_or(2, 0.0, "clearance up to which it pulls");
  row.at_most(3);
  if (row.ok() && !(law.slope > 0.0)) row.error(fmt::format("slope {} must be positive; correct it", law.slope));
  if (row.ok() && (law.tension < 0.0 || law.spring_clearance < 0.0)) row.error("tension and clearance must not be negative; correct them");
  return law;
}

/// CalculiX's TIED: pressure per overclosure, which pulls as it presses; the stick slope of *FRICTION holds across.
PressureLaw read_tied_behavior(Builder& builder, const Block& block) {
  PressureLaw law{.kind = PressureLaw::Kind::linear, .tension = std::numeric_limits<double>::infinity()};
  Row row(builder, block, block.lines[0]);
  law.slope = row.real(0, "slope of pressure over overclosure");
  row.at_most(1);
  if (row.ok() && !(law.slope > 0.0)) row.error(fmt::format("slope {} must be positive; correct it", law.slope));
  return law;
}

/// Abaqus's meaning of the two values. Where CalculiX has its law, of the same look, the pressure at the clearance c0 is a hundredth of p0.
PressureLaw read_exponential_behavior(Builder& builder, const Block& block) {
  PressureLaw law{.kind = PressureLaw::Kind::exponential};
  Row row(builder, block, block.lines[0]);
  law.clearance = row.real(0, "clearance at which the pressure is zero");
  law.pressure = row.real(1, "pressure at zero clearance");
  law.greatest_slope = row.real_or(2, 0.0, "greatest stiffness in explicit steps");
  row.at_most(3);
  if (row.ok() && !(law.clearance > 0.0 && law.pressure > 0.0 && law.greatest_slope >= 0.0))
    row.error("clearance and pressure must be positive, the greatest stiffness not negative; correct them");
  return law;
}

PressureLaw read_table_of_pressure(Builder& builder, const Block& block) {
  PressureLaw law{.kind = PressureLaw::Kind::table};
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const PressureLaw::Row next{.overclosure = row.real(1, "overclosure"), .pressure = row.real(0, "pressure")};
    row.at_most(2);
    if (!row.ok()) return law;
    if (law.rows.empty() && next.pressure != 0.0)
      row.error(fmt::format("the first pressure {} must be zero: there is none before it; correct it", next.pressure));
    if (!law.rows.empty() && !(next.overclosure > law.rows.back().overclosure && next.pressure >= law.rows.back().pressure))
      row.error("overclosures must ascend from line to line, and pressures not descend; correct them");
    law.rows.push_back(next);
  }
  if (law.rows.size() < 2 || !(law.rows.back().pressure > law.rows[law.rows.size() - 2].pressure))
    builder.error(block, block.lines[0].location, "TABULAR needs two lines or more, pressure, overclosure, and a pressure that rises on the last; add one");
  return law;
}

/// Hard: the enforcement is the procedure's own, penalty in explicit steps, augmented Lagrange in static ones.
void read_hard_behavior(Builder& builder, const Block& block) {
  if (has_interaction(builder)) current_interaction(builder).behavior = {};
  if (block.lines.empty()) return;
  if (!block.has("PENALTY")) {
    return builder.error(block, block.lines[0].location,
                         "data lines are known only with PENALTY (a scale factor of the stiffness); remove them");
  }
  Row row(builder, block, block.lines[0]);
  const double scale = row.real_or(0, 1.0, "scale of the penalty stiffness");
  row.at_most(1);
  if (row.ok() && !(scale > 0.0)) row.error(fmt::format("scale {} must be positive; correct it", scale));
  if (has_interaction(builder)) current_interaction(builder).penalty_scale = scale;
}

void read_surface_behavior(Builder& builder, const Block& block) {
  const auto kind = block.value("PRESSURE-OVERCLOSURE", "HARD");
  if (kind == "HARD") return read_hard_behavior(builder, block);
  const bool table = kind == "TABULAR", tied = kind == "TIED", linear = kind == "LINEAR" || tied;
  if (!has_law(builder, block, kind, table    ? "lines of pressure and overclosure"
                                     : linear ? "a line with the slope of pressure over overclosure"
                                              : "a line with the clearance c0 and the pressure p0"))
    return;
  const auto law = table    ? read_table_of_pressure(builder, block)
                   : tied   ? read_tied_behavior(builder, block)
                   : linear ? read_linear_behavior(builder, block)
                            : read_exponential_behavior(builder, block);
  if (has_interaction(builder)) current_interaction(builder).behavior = law;
}

/// What follows speaks of the interaction as it is in this step.
void change_interaction(Builder& builder, const Block& block) {
  builder.connector_friction = nullptr;
  builder.draft.changed_interaction = -1;
  const auto row = builder.require(builder.interactions, block.value("INTERACTION"), block, block.location);
  if (!row) return;
  auto& changes = current_step(builder).changed_interactions;
  auto found = std::ranges::find(changes, *row, &ChangedInteraction::interaction);
  if (found == changes.end()) {
    const auto& known = builder.model.interactions[*row];
    found = changes.insert(changes.end(), {.interaction = *row, .properties = known, .friction_before = known.friction});
  }
  builder.draft.changed_interaction = static_cast<std::int32_t>(found - changes.begin());
}

/// RESET: what it was before the steps. The limit of the shear stress is not kept, the elastic slip is.
void read_change_friction(Builder& builder, const Block& block) {
  change_interaction(builder, block);
  if (builder.draft.changed_interaction < 0) return;
  auto& change = current_step(builder).changed_interactions[builder.draft.changed_interaction];
  const auto& known = builder.model.interactions[change.interaction];
  change.properties.friction = block.has("RESET") ? known.friction : 0.0;
  change.properties.shear_stress_limit = block.has("RESET") ? known.shear_stress_limit : std::numeric_limits<double>::infinity();
}

const RegisterKeyword interaction{
    {"SURFACE INTERACTION", Phase::definitions, Place::anywhere, {required(name("NAME"))}, read_interaction}};
const RegisterKeyword friction{{"FRICTION",
                                Phase::definitions,
                                Place::anywhere,
                                {real("ELASTIC SLIP"), real("SLIP TOLERANCE"), real("TAUMAX"), flag("ROUGH")},
                                read_friction,
                                "SURFACE INTERACTION or CONNECTOR BEHAVIOR or CHANGE FRICTION"}};
const RegisterKeyword surface_behavior{
    {"SURFACE BEHAVIOR",
     Phase::definitions,
     Place::anywhere,
     {choice("PRESSURE-OVERCLOSURE", {"HARD", "LINEAR", "EXPONENTIAL", "TABULAR", "TIED"}), flag("PENALTY"), flag("AUGMENTED LAGRANGE")},
     read_surface_behavior,
     "SURFACE INTERACTION or CHANGE SURFACE BEHAVIOR"}};
const RegisterKeyword change_friction{
    {"CHANGE FRICTION", Phase::history, Place::step, {required(name("INTERACTION")), flag("RESET")}, read_change_friction}};
const RegisterKeyword change_behavior{
    {"CHANGE SURFACE BEHAVIOR", Phase::history, Place::step, {required(name("INTERACTION"))}, change_interaction}};

}  // namespace

}  // namespace balocco::deck
