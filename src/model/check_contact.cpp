#include "model/check_contact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/element_type.hpp"

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

void check_interaction(const Model& model, const ContactPair& pair, Errors& errors) {
  const bool soft = pair.interaction >= 0 && model.interactions[pair.interaction].pressure_slope.has_value();
  if (soft && is_rigid(model, model.surfaces[pair.master]))
    errors.emplace_back(pair.location, fmt::format("*CONTACT PAIR: PRESSURE-OVERCLOSURE=LINEAR is of pairs with deformable masters, and {} "
                                                   "is rigid; write HARD",
                                                   model.surfaces[pair.master].name));
}

}  // namespace

Errors check_contact(const Model& model) {
  Errors errors;
  for (const auto& pair : model.contact_pairs) {
    check_surfaces(model, pair, errors);
    check_slave_nodes(model, pair, errors);
    check_interaction(model, pair, errors);
  }
  return errors;
}

}  // namespace balocco
