#include "model/check_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

#include "elements/element_type.hpp"
#include "elements/surface_nodes.hpp"

namespace balocco {

namespace {

using Errors = std::vector<std::pair<Location, std::string>>;

void check_surfaces(const Model& model, const ContactPair& pair, Errors& errors) {
  const auto& slave = model.surfaces[pair.slave];
  const auto& master = model.surfaces[pair.master];
  const auto carries = [&](const RigidBody& body) { return body.analytical_surface == pair.master; };
  if (slave.kind == Surface::Kind::analytical || !(is_rigid(model, master) || deforms(model, master)))
    errors.emplace_back(pair.location, fmt::format("*CONTACT PAIR: slave {} must be made of element faces or nodes and master {} be "
                                                   "analytical or made of element faces",
                                                   slave.name, master.name));
  else if (master.kind == Surface::Kind::analytical && std::ranges::none_of(model.rigid_bodies, carries))
    errors.emplace_back(pair.location, fmt::format("*CONTACT PAIR: surface {} belongs to no rigid body; add *RIGID BODY, ANALYTICAL "
                                                   "SURFACE={}, REF NODE=...",
                                                   master.name, master.name));
}

/// The areas that stand for the corners of a quadratic face are negative or zero.
void check_slave_nodes(const Model& model, const ContactPair& pair, Errors& errors) {
  if (pair.of_faces) return;
  for (const auto& face : model.surfaces[pair.slave].faces) {
    const ElementType& type = *model.elements[face.element.table].type;
    if (type.face_midsides.empty()) continue;
    errors.emplace_back(
        pair.location, fmt::format("*CONTACT PAIR: element {} of the slave surface {} is a {}: contact of the nodes of "
                                   "quadratic faces is not supported; use linear elements there, or TYPE=SURFACE TO SURFACE with a "
                                   "deformable master",
                                   model.element_name(face.element), model.surfaces[pair.slave].name, type.name));
    return;
  }
}

/// A node that is on the master itself is never off it.
void check_self(const Model& model, const ContactPair& pair, Errors& errors) {
  const auto& master = model.surfaces[pair.master];
  if (!deforms(model, master)) return;
  const auto slaves = surface_nodes(model, model.surfaces[pair.slave]), masters = surface_nodes(model, master);
  if (slaves.empty() || !std::ranges::includes(masters, slaves)) return;
  errors.emplace_back(pair.location, fmt::format("*CONTACT PAIR: all nodes of the slave {} are nodes of the master {} too: contact of a surface "
                                                 "with itself is not supported; make surfaces and pairs of the parts that touch",
                                                 model.surfaces[pair.slave].name, master.name));
}

/// Between the two sides of one sheet nothing tells on which a place stands.
void check_sides(const Model& model, const ContactPair& pair, Errors& errors) {
  const auto& master = model.surfaces[pair.master];
  if (!deforms(model, master)) return;
  std::set<ElementRef> sheets;
  for (const auto& face : master.faces) {
    const auto& table = model.elements[face.element.table];
    const bool sheet = table.type->section == Section::Kind::shell || table.type->section == Section::Kind::membrane;
    if (!sheet || sheets.insert(face.element).second) continue;
    errors.emplace_back(pair.location, fmt::format("*CONTACT PAIR: the master {} has both sides of element {}; give each side, SPOS and SNEG, a "
                                                   "surface and a pair of its own",
                                                   master.name, model.element_name(face.element)));
    return;
  }
}

/// In any step.
bool is_ever_tied(const Model& model, const ContactPair& pair) {
  const auto ties = [](const Interaction& interaction) { return std::isinf(interaction.behavior.tension); };
  if (pair.interaction < 0) return false;
  return ties(model.interactions[pair.interaction]) || std::ranges::any_of(model.steps, [&](const Step& step) {
           return std::ranges::any_of(step.changed_interactions, [&](const ChangedInteraction& change) {
             return change.interaction == pair.interaction && ties(change.properties);
           });
         });
}

/// Springs that stick wherever they are pulled: explicit steps have *TIE, which bounds no increment.
void check_tied(const Model& model, const ContactPair& pair, Errors& errors) {
  if (!is_ever_tied(model, pair)) return;
  const bool is_explicit = std::ranges::any_of(model.steps, [](const Step& step) { return std::holds_alternative<ExplicitProcedure>(step.procedure); });
  if (pair.of_faces && !is_rigid(model, model.surfaces[pair.master]) && !is_explicit) return;
  errors.emplace_back(pair.location, "*CONTACT PAIR: PRESSURE-OVERCLOSURE=TIED is of pairs of TYPE=SURFACE TO SURFACE with deformable masters, in "
                                     "jobs without explicit steps; use *TIE");
}

/// In any step.
bool may_pull(const Model& model, const ContactPair& pair) {
  if (pair.interaction < 0) return false;
  if (model.interactions[pair.interaction].behavior.tension > 0.0) return true;
  return std::ranges::any_of(model.steps, [&](const Step& step) {
    return std::ranges::any_of(step.changed_interactions, [&](const ChangedInteraction& change) {
      return change.interaction == pair.interaction && change.properties.behavior.tension > 0.0;
    });
  });
}

void check_interaction(const Model& model, const ContactPair& pair, Errors& errors) {
  if (may_pull(model, pair) && !is_ever_tied(model, pair) && is_rigid(model, model.surfaces[pair.master]))
    errors.emplace_back(pair.location, fmt::format("*CONTACT PAIR: PRESSURE-OVERCLOSURE=LINEAR with a tension is of pairs with deformable masters, "
                                                   "and {} is rigid; leave the tension out",
                                                   model.surfaces[pair.master].name));
}

}  // namespace

Errors check_contact(const Model& model) {
  Errors errors;
  for (const auto& pair : model.contact_pairs) {
    check_surfaces(model, pair, errors);
    check_slave_nodes(model, pair, errors);
    check_self(model, pair, errors);
    check_sides(model, pair, errors);
    check_interaction(model, pair, errors);
    check_tied(model, pair, errors);
  }
  return errors;
}

}  // namespace balocco
