// *RIGID BODY, as model data and inside a step.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/section_assignment.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

/// Reference node from an id or a set of one node.
std::optional<std::int32_t> reference_node(Builder& builder, const Block& block) {
  std::vector<std::int32_t> rows;
  if (!builder.nodes_of(block.value("REF NODE"), block, block.location, rows)) return std::nullopt;
  if (rows.size() == 1) return rows[0];
  builder.error(block, block.location,
                fmt::format("REF NODE={} stands for {} nodes; give one", block.value("REF NODE"), rows.size()));
  return std::nullopt;
}

bool nodes_of_parameter(Builder& builder, const Block& block, const char* parameter, std::vector<std::int32_t>& rows) {
  return !block.has(parameter) || builder.nodes_of(block.value(parameter), block, block.location, rows);
}

void sort_unique(std::vector<std::int32_t>& rows) {
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

void add_element_nodes(const Builder& builder, RigidBody& body) {
  for (const auto element : body.elements) {
    const auto& table = builder.model.elements[element.table];
    const auto per_element = static_cast<std::ptrdiff_t>(table.connectivity.size() / table.id.size());
    const auto begin = table.connectivity.begin() + element.row * per_element;
    body.tie_nodes.insert(body.tie_nodes.end(), begin, begin + per_element);
  }
}

/// Rigid elements have no properties but the body that they belong to; that is what their section says.
void give_section(Builder& builder, const Block& block, const std::vector<ElementRef>& elements) {
  const auto is_rigid = [&](ElementRef element) {
    return builder.model.elements[element.table].type->section == Section::Kind::rigid;
  };
  std::vector<ElementRef> rigid;
  std::ranges::copy_if(elements, std::back_inserter(rigid), is_rigid);
  if (rigid.empty()) return;
  Section section{.kind = Section::Kind::rigid, .element_set = block.value("ELSET")};
  section.location = block.location;
  assign_section(builder, block, std::move(section), rigid);
}

/// CalculiX: a node whose displacements are the rotations of the body.
bool read_rotation_node(Builder& builder, const Block& block, std::int32_t reference) {
  if (!block.has("ROT NODE")) return true;
  std::vector<std::int32_t> rows;
  if (!builder.nodes_of(block.value("ROT NODE"), block, block.location, rows)) return false;
  if (rows.size() != 1 || rows[0] == reference) {
    builder.error(block, block.location, fmt::format("ROT NODE={} must stand for one node beside the reference node", block.value("ROT NODE")));
    return false;
  }
  for (std::int32_t dof = 0; dof < 3; ++dof)
    builder.model.constraints.push_back(
        {LinearEquation{{{rows[0], dof, 1.0}, {reference, 3 + dof, -1.0}}}, "*RIGID BODY, ROT NODE", block.location.file, block.location.line});
  return true;
}

void declare(Builder& builder, const Block& block, std::int32_t reference) {
  RigidBody body;
  body.location = block.location;
  body.reference_node = reference;
  body.name = fmt::format("RIGID-{}", builder.model.nodes.id[reference]);
  body.at_center_of_mass = squeeze(block.value("POSITION")) == "CENTEROFMASS";
  bool good = nodes_of_parameter(builder, block, "TIE NSET", body.tie_nodes) &
              nodes_of_parameter(builder, block, "NSET", body.tie_nodes) & nodes_of_parameter(builder, block, "PIN NSET", body.pin_nodes) &
              read_rotation_node(builder, block, reference);
  if (block.has("ELSET"))
    good = builder.elements_of(block.value("ELSET"), block, block.location, body.elements) && good;
  if (block.has("ANALYTICAL SURFACE")) {
    const auto surface = builder.require(builder.surfaces, block.value("ANALYTICAL SURFACE"), block, block.location);
    good = good && surface;
    body.analytical_surface = surface.value_or(-1);
    if (surface && builder.model.surfaces[*surface].kind != Surface::Kind::analytical) {
      if (!builder.is_poisoned(block.value("ANALYTICAL SURFACE"))) {
        builder.error(block, block.location,
                      fmt::format("surface {} is not analytical; use TYPE=CYLINDER, REVOLUTION or SEGMENTS, "
                                  "or ELSET= for a body of elements",
                                  block.value("ANALYTICAL SURFACE")));
      }
      good = false;
    }
  }
  if (!good) return;
  give_section(builder, block, body.elements);
  add_element_nodes(builder, body);
  sort_unique(body.tie_nodes);
  sort_unique(body.pin_nodes);
  // The reference node may be one of the nodes; it is never carried. What is pinned is not tied, as in Abaqus.
  std::erase(body.tie_nodes, reference);
  std::erase(body.pin_nodes, reference);
  std::erase_if(body.tie_nodes, [&](std::int32_t row) {
    return std::binary_search(body.pin_nodes.begin(), body.pin_nodes.end(), row);
  });
  builder.body_of_reference[reference] = static_cast<std::int32_t>(builder.model.rigid_bodies.size());
  builder.model.rigid_bodies.push_back(std::move(body));
}

/// Inside a step: TIE NSET and PIN NSET attach nodes where they stand, RELEASE NSET lets them go.
void change_rigid_body(Builder& builder, const Block& block, std::int32_t body) {
  Step& step = builder.model.steps.back();
  const auto add = [&](const char* parameter, bool tie, bool release) {
    if (!block.has(parameter)) return;
    RigidAttachment attachment{body, {}, tie, release};
    if (!nodes_of_parameter(builder, block, parameter, attachment.nodes)) return;
    std::erase(attachment.nodes, builder.model.rigid_bodies[body].reference_node);
    sort_unique(attachment.nodes);
    step.attachments.push_back(std::move(attachment));
  };
  add("TIE NSET", true, false);
  add("PIN NSET", false, false);
  add("RELEASE NSET", true, true);
  for (const char* parameter : {"ELSET", "ANALYTICAL SURFACE", "POSITION"}) {
    if (block.has(parameter)) {
      builder.error(block, block.location,
                    fmt::format("{} cannot change in a step; inside a step *RIGID BODY takes REF NODE, TIE NSET, "
                                "PIN NSET and RELEASE NSET",
                                parameter));
    }
  }
}

void read_rigid_body(Builder& builder, const Block& block) {
  const auto reference = reference_node(builder, block);
  if (!reference) return;
  const auto known = builder.body_of_reference.find(*reference);
  const std::string id = builder.model.node_name(*reference);
  if (builder.in_step) {
    if (known != builder.body_of_reference.end()) return change_rigid_body(builder, block, known->second);
    if (builder.is_poisoned(block.value("REF NODE"))) return;
    return builder.error(block, block.location,
                         fmt::format("node {} is not the reference node of a rigid body; declare *RIGID BODY, "
                                     "REF NODE={} before the first step",
                                     id, id));
  }
  if (block.has("RELEASE NSET"))
    return builder.error(block, block.location, "RELEASE NSET belongs inside a *STEP; move it there");
  if (known != builder.body_of_reference.end()) {
    return builder.error(block, block.location,
                         fmt::format("node {} is the reference node of two rigid bodies; give each its own", id));
  }
  declare(builder, block, *reference);
}

const std::vector<ParameterRule> rigid_body_parameters{required(name("REF NODE")), name("ELSET"),
                                                       name("PIN NSET"),           name("TIE NSET"), name("NSET"), name("ROT NODE"),
                                                       name("RELEASE NSET"),       choice("POSITION", {"INPUT", "CENTER OF MASS"}),
                                                       name("ANALYTICAL SURFACE")};

const RegisterKeyword rigid_body{{"RIGID BODY", Phase::constraints, Place::anywhere, rigid_body_parameters, read_rigid_body}};

}  // namespace

}  // namespace balocco::deck
