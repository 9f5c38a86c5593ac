// *CONTACT PAIR *MODEL CHANGE.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "constraints/face_projection.hpp"
#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/interactions.hpp"
#include "deck/register.hpp"
#include "deck/steady_state.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"
#include "elements/surface_nodes.hpp"

namespace balocco::deck {

namespace {

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

/// SLIP TOLERANCE is a fraction of the mean edge of the slave's faces, as in Abaqus. A surface of nodes has no edges: the automatic elastic
/// slip stays.
void apply_slip_tolerance(Builder& builder, std::int32_t pair) {
  const auto& [slave, master, interaction, first_step, of_faces, location] = builder.model.contact_pairs[pair];
  const auto tolerance = builder.slip_tolerance.find(interaction);
  if (tolerance == builder.slip_tolerance.end() || builder.model.interactions[interaction].elastic_slip) return;
  const double edge = mean_edge(builder.model, slave);
  if (edge > 0.0) builder.model.interactions[interaction].elastic_slip = tolerance->second * edge;
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
  if (interaction.behavior.tension > 0.0 && !std::isinf(interaction.behavior.tension) && of_faces)
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
  refuse_in_harmonics(builder, block, "the modes are those of the model that *FREQUENCY found; change it in a step before that one");
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
