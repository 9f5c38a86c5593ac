// *SURFACE INTERACTION *FRICTION *SURFACE BEHAVIOR *CONTACT PAIR *MODEL CHANGE.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "constraints/face_projection.hpp"
#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"
#include "elements/surface_nodes.hpp"

namespace balocco::deck {

namespace {

Interaction& current_interaction(Builder& builder) {
  return builder.model.interactions.back();
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

/// ROUGH: a point that is closed never slips.
void read_rough_friction(Builder& builder, const Block& block) {
  constexpr double never_slips = 1e12;
  if (!block.lines.empty() || block.has("TAUMAX") || block.has("SLIP TOLERANCE") || block.has("ELASTIC SLIP"))
    return builder.error(block, block.location, "ROUGH stands alone, without a coefficient and other parameters; take them away");
  if (builder.connector_friction != nullptr)
    return builder.error(block, block.location, "ROUGH is of surfaces; hold the connector with *CONNECTOR LOCK");
  if (!builder.model.interactions.empty()) current_interaction(builder).friction = never_slips;
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
  if (builder.model.interactions.empty()) return;  // the *CONNECTOR FRICTION above it is wrong, which has been told
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
    builder.slip_tolerance[static_cast<std::int32_t>(builder.model.interactions.size()) - 1] = tolerance;
  }
  if (block.has("ELASTIC SLIP")) {
    current_interaction(builder).elastic_slip = block.real("ELASTIC SLIP", 0.0);
    if (!(*current_interaction(builder).elastic_slip > 0.0))
      builder.error(block, block.location, "ELASTIC SLIP must be positive; correct it");
  }
}

/// LINEAR: pressure per overclosure; behind it CalculiX has the tension at great clearance and how far that reaches.
void read_linear_behavior(Builder& builder, const Block& block) {
  if (block.has("PENALTY") || block.has("AUGMENTED LAGRANGE"))
    return builder.error(block, block.location, "PENALTY and AUGMENTED LAGRANGE are of hard contact; take them away, or LINEAR");
  if (block.lines.empty())
    return builder.error(block, block.location, "LINEAR needs a line with the slope of pressure over overclosure; add it");
  Row row(builder, block, block.lines[0]);
  const double slope = row.real(0, "slope of pressure over overclosure");
  auto& interaction = current_interaction(builder);
  interaction.tension = row.real_or(1, 0.0, "tension at great clearance");
  interaction.spring_clearance = row.real_or(2, 0.0, "clearance up to which it pulls");
  row.at_most(3);
  if (row.ok() && !(slope > 0.0)) row.error(fmt::format("slope {} must be positive; correct it", slope));
  if (row.ok() && (interaction.tension < 0.0 || interaction.spring_clearance < 0.0))
    row.error("tension and clearance must not be negative; correct them");
  interaction.pressure_slope = slope;
}

/// Hard: the enforcement is the procedure's own, penalty in explicit steps, augmented Lagrange in static ones.
void read_surface_behavior(Builder& builder, const Block& block) {
  if (block.value("PRESSURE-OVERCLOSURE") == "LINEAR") return read_linear_behavior(builder, block);
  if (block.lines.empty()) return;
  if (!block.has("PENALTY")) {
    return builder.error(block, block.lines[0].location,
                         "data lines are known only with PENALTY (a scale factor of the stiffness); remove them");
  }
  Row row(builder, block, block.lines[0]);
  const double scale = row.real_or(0, 1.0, "scale of the penalty stiffness");
  row.at_most(1);
  if (row.ok() && !(scale > 0.0)) row.error(fmt::format("scale {} must be positive; correct it", scale));
  current_interaction(builder).penalty_scale = scale;
}

std::optional<std::array<std::int32_t, 2>> surfaces_of(Builder& builder, const Block& block, Row& row) {
  row.at_most(2);
  if (!row.has(0) || !row.has(1)) row.error("a pair needs two surfaces: slave, master");
  if (!row.ok()) return std::nullopt;
  const auto slave = builder.require(builder.surfaces, row.name(0), block, row.location());
  const auto master = builder.require(builder.surfaces, row.name(1), block, row.location());
  if (!slave || !master) return std::nullopt;
  return std::array{*slave, *master};
}

std::int32_t find_pair(const Model& model, const std::array<std::int32_t, 2>& surfaces) {
  const auto found = std::find_if(model.contact_pairs.begin(), model.contact_pairs.end(), [&](const ContactPair& pair) {
    return pair.slave == surfaces[0] && pair.master == surfaces[1];
  });
  return found == model.contact_pairs.end() ? -1 : static_cast<std::int32_t>(found - model.contact_pairs.begin());
}

void activate(std::vector<std::int32_t>& active, std::int32_t pair) {
  if (std::find(active.begin(), active.end(), pair) == active.end()) active.push_back(pair);
  std::sort(active.begin(), active.end());
}

/// SLIP TOLERANCE is a fraction of the mean edge of the slave's faces, as in Abaqus.
void apply_slip_tolerance(Builder& builder, std::int32_t pair) {
  const auto& [slave, master, interaction, first_step, of_faces, location] = builder.model.contact_pairs[pair];
  const auto tolerance = builder.slip_tolerance.find(interaction);
  if (tolerance == builder.slip_tolerance.end() || builder.model.interactions[interaction].elastic_slip) return;
  double sum = 0.0;
  std::size_t edges = 0;
  for (const auto& face : builder.model.surfaces[slave].faces) {
    const auto& table = builder.model.elements[face.element.table];
    const auto& corners = table.type->faces[face.face];
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto at = [&](std::size_t corner) {
        return builder.model.nodes
            .coordinates[table.connectivity[face.element.row * table.type->nodes + corners[corner]]];
      };
      sum += norm(subtract(at((k + 1) % corners.size()), at(k)));
      ++edges;
    }
  }
  // A surface of nodes has no edges: the automatic elastic slip stays.
  if (edges > 0)
    builder.model.interactions[interaction].elastic_slip = tolerance->second * sum / static_cast<double>(edges);
}

/// Whether surfaces can form a pair, slave first.
bool fit(Builder& builder, Row& row, const std::array<std::int32_t, 2>& pair) {
  const auto &slave = builder.model.surfaces[pair[0]], &master = builder.model.surfaces[pair[1]];
  if (slave.kind != Surface::Kind::analytical && (is_rigid(builder.model, master) || deforms(builder.model, master))) return true;
  if (!builder.is_poisoned(row.name(0)) && !builder.is_poisoned(row.name(1)))
    row.error(fmt::format("slave {} and master {} do not fit: the slave is made of element faces or nodes, the master is an analytical "
                          "rigid surface or made of element faces; swap or replace them",
                          row.name(0), row.name(1)));
  return false;
}

/// ADJUST: slave nodes of a set, or within a distance of the master, begin on the master, without strain.
void adjust(Builder& builder, const Block& block, const Row& row, const std::array<std::int32_t, 2>& pair) {
  Model& model = builder.model;
  const auto text = block.value("ADJUST");
  const auto distance = parse_real(text);
  std::vector<std::int32_t> chosen;
  if (distance && *distance < 0.0)
    return builder.error(block, row.location(), fmt::format("ADJUST={} must not be negative; correct it", *distance));
  if (!distance && !builder.nodes_of(text, block, row.location(), chosen)) return;
  std::ranges::sort(chosen);
  const FaceProjection faces(model, model.surfaces[pair[1]]);
  for (const auto node : surface_nodes(model, model.surfaces[pair[0]])) {
    if (!distance && !std::ranges::binary_search(chosen, node)) continue;
    if (const auto place = faces.nearest(model.nodes.coordinates[node], distance.value_or(HUGE_VAL)))
      model.nodes.coordinates[node] = place->position;
  }
}

/// Values of an interaction that another kind of pair would follow.
void tell_what_has_no_effect(Builder& builder, const Block& block, const Interaction& interaction, bool mesh, bool of_faces) {
  if (interaction.stick_slope && !mesh)
    builder.warning(block, block.location, "*FRICTION: the second value, CalculiX's stick slope, counts with deformable masters only");
  if (interaction.tension > 0.0 && of_faces)
    builder.warning(block, block.location, "*SURFACE BEHAVIOR: the tension counts with TYPE=NODE TO SURFACE only, as in CalculiX");
}

/// Adds the pair, or in a step takes up the one that is known (a deck may repeat its pairs for the explicit steps).
void add_pair(Builder& builder, const Block& block, Row& row, std::int32_t interaction) {
  const auto surfaces = surfaces_of(builder, block, row);
  if (!surfaces) return;
  if (!fit(builder, row, *surfaces)) return;
  const bool mesh = deforms(builder.model, builder.model.surfaces[(*surfaces)[1]]);
  const bool of_faces = block.value("TYPE") == "SURFACE TO SURFACE";
  if (of_faces && !mesh)
    builder.warning(block, block.location, "TYPE=SURFACE TO SURFACE: the nodes of the slave are kept from the rigid master");
  tell_what_has_no_effect(builder, block, builder.model.interactions[interaction], mesh, of_faces);
  if (of_faces && mesh && builder.model.surfaces[(*surfaces)[0]].kind == Surface::Kind::nodes)
    return row.error(fmt::format("TYPE=SURFACE TO SURFACE needs faces, and {} is made of nodes; write NODE TO SURFACE", row.name(0)));
  std::int32_t pair = find_pair(builder.model, *surfaces);
  if (pair >= 0 && !builder.in_step) return row.error("this pair is given twice; remove one");
  if (pair >= 0 && builder.model.contact_pairs[pair].interaction != interaction) {
    return row.error("this pair already has another interaction; a pair keeps its interaction in all steps");
  }
  if (pair >= 0 && block.has("TYPE") && builder.model.contact_pairs[pair].of_faces != (of_faces && mesh))
    return row.error("this pair already has another TYPE; a pair keeps its type in all steps");
  if (pair < 0) {
    pair = static_cast<std::int32_t>(builder.model.contact_pairs.size());
    const auto step = builder.in_step ? static_cast<std::int32_t>(builder.model.steps.size()) - 1 : 0;
    builder.model.contact_pairs.push_back({(*surfaces)[0], (*surfaces)[1], interaction, step, of_faces && mesh, row.location()});
  }
  if (block.has("ADJUST") && !mesh) return row.error("ADJUST moves nodes onto masters of deformable faces; move these nodes in the mesh");
  if (block.has("ADJUST") && builder.in_step)
    return row.error("ADJUST belongs before the steps, where nothing has moved yet; declare the pair there");
  if (block.has("ADJUST")) adjust(builder, block, row, *surfaces);
  if (block.has("CPSET")) builder.contact_pair_sets[block.value("CPSET")].insert(pair);
  apply_slip_tolerance(builder, pair);
  if (builder.in_step) activate(builder.model.steps.back().active_contact_pairs, pair);
}

void read_contact_pair(Builder& builder, const Block& block) {
  const auto interaction = builder.require(builder.interactions, block.value("INTERACTION"), block, block.location);
  if (block.lines.empty())
    return builder.error(block, block.location, "the surfaces are missing; add a line slave, master");
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    if (block.value("OP") == "DELETE") {
      const auto surfaces = surfaces_of(builder, block, row);
      const std::int32_t pair = surfaces ? find_pair(builder.model, *surfaces) : -1;
      if (surfaces && pair < 0) row.error("no such pair to delete; correct the names");
      if (pair >= 0) std::erase(builder.model.steps.back().active_contact_pairs, pair);
    } else if (interaction) {
      add_pair(builder, block, row, *interaction);
    }
  }
}

void read_contact_pair_in_model(Builder& builder, const Block& block) {
  if (block.value("OP") == "DELETE")
    return builder.error(block, block.location, "OP=DELETE belongs inside a *STEP; move it there");
  read_contact_pair(builder, block);
}

/// How Balocco enforces contact does not hang on these: told, because another code would get other pressures.
void tell_enforcement(Builder& builder, const Block& block) {
  if (block.value("MECHANICAL CONSTRAINT") == "KINEMATIC") {
    builder.warning(block, block.location,
                    "MECHANICAL CONSTRAINT=KINEMATIC: explicit steps enforce contact by penalty; the penetration is small but "
                    "not zero");
  }
}

void read_pair(Builder& builder, const Block& block) {
  tell_enforcement(builder, block);
  builder.in_step ? read_contact_pair(builder, block) : read_contact_pair_in_model(builder, block);
}

/// Elements taken out of the model, or taken up again with the strains that they then have: those of the total motion.
void change_elements(Builder& builder, const Block& block) {
  if (block.has("ADD") && block.value("ADD") != "WITH STRAIN")
    return builder.error(block, block.location,
                         "elements that come back free of strain are not supported; write ADD=WITH STRAIN, which counts their strains "
                         "from the undeformed model");
  auto& removed = builder.model.steps.back().removed_elements;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field) {
      std::vector<ElementRef> elements;
      if (!row.has(field) || !builder.elements_of(row.text(field), block, line.location, elements)) continue;
      for (const auto element : elements) {
        const auto& table = builder.model.elements[element.table];
        if (table.type->make_group == nullptr)
          return row.error(fmt::format("element {} of type {} has no forces to be taken out; name elements that have a stiffness",
                                       table.id[element.row], table.type->name));
      }
      std::ranges::sort(elements);
      std::vector<ElementRef> result;
      if (block.has("ADD"))
        std::ranges::set_difference(removed, elements, std::back_inserter(result));
      else
        std::ranges::set_union(removed, elements, std::back_inserter(result));
      removed = std::move(result);
    }
  }
}

void read_model_change(Builder& builder, const Block& block) {
  if (block.has("ADD") == block.has("REMOVE")) return builder.error(block, block.location, "give either ADD or REMOVE");
  if (block.value("TYPE") == "ELEMENT") return change_elements(builder, block);
  auto& active = builder.model.steps.back().active_contact_pairs;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const auto surfaces = surfaces_of(builder, block, row);
    if (!surfaces) continue;
    const std::int32_t pair = find_pair(builder.model, *surfaces);
    if (pair < 0) {
      row.error("there is no contact pair of these surfaces; declare it under *CONTACT PAIR");
    } else if (block.has("ADD")) {
      activate(active, pair);
    } else {
      std::erase(active, pair);
    }
  }
}

const RegisterKeyword interaction{
    {"SURFACE INTERACTION", Phase::definitions, Place::anywhere, {required(name("NAME"))}, read_interaction}};
const RegisterKeyword friction{{"FRICTION",
                                Phase::definitions,
                                Place::anywhere,
                                {real("ELASTIC SLIP"), real("SLIP TOLERANCE"), real("TAUMAX"), flag("ROUGH")},
                                read_friction,
                                "SURFACE INTERACTION or CONNECTOR BEHAVIOR"}};
const RegisterKeyword surface_behavior{{"SURFACE BEHAVIOR",
                                        Phase::definitions,
                                        Place::anywhere,
                                        {choice("PRESSURE-OVERCLOSURE", {"HARD", "LINEAR"}), flag("PENALTY"), flag("AUGMENTED LAGRANGE")},
                                        read_surface_behavior,
                                        "SURFACE INTERACTION"}};
const RegisterKeyword pair{
    {"CONTACT PAIR",
     Phase::history,
     Place::anywhere,
     {required(name("INTERACTION")), choice("TYPE", {"NODE TO SURFACE", "SURFACE TO SURFACE"}),
      choice("MECHANICAL CONSTRAINT", {"PENALTY", "KINEMATIC"}), choice("OP", {"ADD", "DELETE"}), name("CPSET"), text("ADJUST"),
      foreign("NO THICKNESS"), foreign("WEIGHT"), foreign("SMALL SLIDING")},
     read_pair}};
const RegisterKeyword model_change{{"MODEL CHANGE",
                                    Phase::history,
                                    Place::step,
                                    {required(choice("TYPE", {"CONTACT PAIR", "ELEMENT"})),
                                     optional_choice("ADD", {"STRAIN FREE", "WITH STRAIN"}), flag("REMOVE")},
                                    read_model_change}};

}  // namespace

}  // namespace balocco::deck
