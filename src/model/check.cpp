#include "model/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "constraints/linkages.hpp"
#include "elements/element_type.hpp"
#include "elements/solids/solid_jacobian.hpp"
#include "materials/material_option.hpp"
#include "model/check_constraints.hpp"
#include "model/check_density.hpp"
#include "model/check_contact.hpp"
#include "model/check_failure.hpp"
#include "model/check_quadratic.hpp"
#include "model/check_temperature.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

/// Collects messages; each function below looks at one kind of trouble.
class Checker {
 public:
  explicit Checker(const Model& model) : model_(model) {}

  Findings run() {
    if (model_.elements.empty())
      found_.errors.push_back((model_.files.empty() ? model_.name : model_.files[0]) +
                        ": error: the model has no elements; add *NODE and *ELEMENT");
    check_sections();
    check_geometry();
    check_materials();
    check_laws_of_sections();
    check_rigid_bodies();
    check_initial_fields();
    find_idle_nodes();
    for (const auto& step : model_.steps) check_step(step);
    for (const auto& check : {check_constraints, check_contact, check_density, check_failure, check_quadratic, check_temperature})
      for (const auto& [location, text] : check(model_)) error(location, text);
    return std::move(found_);
  }

 private:
  void tell(std::vector<std::string>& messages, Location location, const char* severity, const std::string& text) {
    if (messages.size() >= 100) return;
    std::string message = fmt::format("{}: {}: {}", model_.where(location), severity, text);
    if (std::find(messages.begin(), messages.end(), message) == messages.end()) messages.push_back(std::move(message));
  }
  void error(Location location, const std::string& text) { tell(found_.errors, location, "error", text); }
  void warning(Location location, const std::string& text) { tell(found_.warnings, location, "warning", text); }

  void check_sections();
  void check_geometry();
  void check_element(ElementRef element);
  void check_jacobian(ElementRef element, double tolerance);
  void check_materials();
  void check_options(const Material& material, const MaterialLaw& law);
  void check_laws_of_sections();
  void check_law(const Section& section, std::int32_t material);
  void check_rigid_bodies();
  void check_initial_fields();
  void find_idle_nodes();
  void check_loads(const Step& step);
  /// Connectors, and springs and dashpots between degrees of freedom, may join nodes that lie in one place.
  bool acts_in_fixed_directions(std::int32_t section) const {
    return section >= 0 && (model_.sections[section].spring.freedom[0] >= 0 || model_.sections[section].connector >= 0);
  }
  void check_step(const Step& step);
  void check_boundary(const Step& step);
  Point point(const ElementTable& table, std::int32_t row, int node) const {
    return model_.nodes.coordinates[table.connectivity[row * table.type->nodes + node]];
  }

  const Model& model_;
  Findings found_;
  std::vector<std::int32_t> carrier_;  // rigid body that carries a node from the start, -1: none
  std::vector<bool> idle_;             // nodes that belong to no element and no rigid body
};

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Six times the volume between a triangle and the origin.
double six_volumes(const Point& a, const Point& b, const Point& c) {
  return dot(a, cross(b, c));
}

void Checker::check_sections() {
  for (std::size_t t = 0; t < model_.elements.size(); ++t) {
    const auto& table = model_.elements[t];
    const auto none = std::find(table.section.begin(), table.section.end(), -1);
    if (none == table.section.end()) continue;
    const ElementRef first{static_cast<std::int32_t>(t), static_cast<std::int32_t>(none - table.section.begin())};
    const auto count = std::count(table.section.begin(), table.section.end(), -1);
    error(table.location[first.row],
          fmt::format("*ELEMENT: element {} of type {} has no section ({} in all); {}", model_.element_name(first), table.type->name,
                      count,
                      table.type->section == Section::Kind::rigid
                          ? "name a set that holds it under *RIGID BODY, ELSET="
                          : "add a section for a set that holds it, or delete it if a mesher left it there"));
  }
}

/// Volume of a solid by its outward faces; a bilinear face counts as the mean of its two triangulations, which is
/// exact.
void Checker::check_element(ElementRef element) {
  const ElementTable& table = model_.elements[element.table];
  const std::int32_t row = element.row;
  const Point base = point(table, row, 0);
  const auto at = [&](int node) { return minus(point(table, row, node), base); };
  const ElementType& type = *table.type;
  double measure = 0.0, size = 0.0;
  for (int node = 1; node < type.nodes; ++node) size = std::max(size, std::sqrt(dot(at(node), at(node))));
  if (type.section == Section::Kind::solid) {
    for (const auto& face : type.faces) {
      if (face.size() == 3) measure += six_volumes(at(face[0]), at(face[1]), at(face[2]));
      if (face.size() != 4) continue;
      const std::array<Point, 4> p{at(face[0]), at(face[1]), at(face[2]), at(face[3])};
      measure += 0.5 * (six_volumes(p[0], p[1], p[2]) + six_volumes(p[0], p[2], p[3]) + six_volumes(p[0], p[1], p[3]) +
                        six_volumes(p[1], p[2], p[3]));
    }
    // Round-off of a flat element: far below any shape that can be computed with.
    if (measure <= 1e-12 * size * size * size) {
      error(table.location[row],
            fmt::format("*ELEMENT: element {} has {} volume; list its nodes so that the first face runs "
                        "counter-clockwise seen from the opposite face, as {} wants",
                        model_.element_name(element), measure < -1e-12 * size * size * size ? "a negative" : "no",
                        type.name));
    } else {
      check_jacobian(element, 1e-12 * size * size * size);
    }
  } else if (type.shape == Shape::triangle || type.shape == Shape::quadrilateral) {
    const Point normal = type.nodes == 3 ? cross(at(1), at(2)) : cross(at(2), minus(at(3), at(1)));
    if (std::sqrt(dot(normal, normal)) <= 1e-12 * size * size) {
      error(table.location[row],
            fmt::format("*ELEMENT: element {} has no area; its nodes must not lie on a line",
                        model_.element_name(element)));
    }
  } else if (type.shape == Shape::line && !(size > 0.0) && !acts_in_fixed_directions(table.section[row])) {
    error(table.location[row],
          fmt::format("*ELEMENT: element {} has no length; its nodes must not coincide",
                      model_.element_name(element)));
  }
}

/// A brick may have a volume and yet be folded: two of its nodes interchanged.
void Checker::check_jacobian(ElementRef element, double tolerance) {
  const ElementTable& table = model_.elements[element.table];
  std::vector<Point> nodes;
  for (int node = 0; node < table.type->nodes; ++node) nodes.push_back(point(table, element.row, node));
  const auto [jacobian, at] = smallest_jacobian(table.type->shape, nodes);
  if (jacobian > tolerance) return;
  error(table.location[element.row],
        fmt::format("*ELEMENT: element {} is folded: its Jacobian determinant is {:.3g} at integration point {}; correct the "
                    "order of its nodes (two interchanged?) or its shape",
                    model_.element_name(element), jacobian, at + 1));
}

void Checker::check_geometry() {
  for (std::size_t t = 0; t < model_.elements.size(); ++t) {
    for (std::int32_t row = 0; row < model_.elements[t].size(); ++row) check_element({static_cast<std::int32_t>(t), row});
  }
}

void Checker::check_materials() {
  for (const auto& material : model_.materials) {
    if (material.law.empty()) {
      error(material.location,
            fmt::format("*MATERIAL: material {} has no law; add *ELASTIC or *HYPERELASTIC below it", material.name));
      continue;
    }
    const MaterialLaw* law = find_material_law(material.law);
    if (law == nullptr) {
      error(material.location,
            fmt::format("*MATERIAL: material {} has the unknown law {}", material.name, material.law));
      continue;
    }
    check_options(material, *law);
    try {  // conditions between parameters, such as a positive definite stiffness, are the law's own business
      make_law<PointKind::solid>(material);
      make_law<PointKind::plane>(material);
    } catch (const InputError& trouble) {
      error(material.location, fmt::format("*MATERIAL: material {}: {}", material.name, trouble.what()));
    }
  }
}

void Checker::check_options(const Material& material, const MaterialLaw& law) {
  bool plastic = false;
  for (const auto& option : material.options) plastic |= find_material_option(option.name)->keyword == "PLASTIC";
  for (const auto& option : material.options) {
    const std::string& keyword = find_material_option(option.name)->keyword;
    if (std::ranges::find(law.options, option.name) == law.options.end())
      error(material.location, fmt::format("*{}: the law {} of material {} cannot take it; {}", keyword, law.name,
                                           material.name,
                                           law.options.empty() ? "remove it" : "give another law or remove it"));
    else if (!plastic && keyword != "VISCOELASTIC")
      error(material.location,
            fmt::format("*{}: material {} has no *PLASTIC, to which it belongs; add that", keyword, material.name));
  }
}

/// Stresses belong to points; hardening means nothing to a law that does not yield.
void Checker::check_initial_fields() {
  const auto yields_as = [&](std::int32_t material) {
    return material >= 0 && std::ranges::any_of(model_.materials[material].options, [](const auto& option) { return option.name.starts_with("plastic"); });
  };
  const auto yields = [&](const Section& section) {
    return yields_as(section.material) || std::ranges::any_of(section.plies, [&](const Ply& ply) { return yields_as(ply.material); });
  };
  for (const auto& field : model_.initial_fields)
    for (const auto element : field.elements) {
      const ElementTable& table = model_.elements[element.table];
      if (table.section[element.row] < 0) continue;  // told
      const auto& section = model_.sections[table.section[element.row]];
      const bool general_shell = section.kind == Section::Kind::shell && section.shell.general;
      const bool general_beam = section.kind == Section::Kind::beam && section.beam.shape == BeamProfile::Shape::general;
      if (general_shell || general_beam) {
        error(field.location, fmt::format("*INITIAL CONDITIONS: element {} has a section without points ({}); give it {}, or take it out of the set",
                                          table.id[element.row], general_shell ? "*SHELL GENERAL SECTION" : "SECTION=GENERAL",
                                          general_shell ? "a *SHELL SECTION" : "a profile"));
        break;
      }
      if (field.field == "S0" || yields(section)) continue;
      error(field.location, fmt::format("*INITIAL CONDITIONS: element {} does not yield, so that it has no hardening; give its material "
                                        "*PLASTIC or take it out of the set",
                                        table.id[element.row]));
      break;
    }
}

void Checker::check_law(const Section& section, std::int32_t material) {
  const MaterialLaw* law = find_material_law(model_.materials[material].law);
  if (law == nullptr) return;  // told
  const bool composite = !section.plies.empty();
  const bool fits = section.kind == Section::Kind::solid   ? law->solid != nullptr
                    : section.kind == Section::Kind::truss ? law->line != nullptr
                    : section.kind == Section::Kind::beam  ? law->line != nullptr && law->lamina_stiffness != nullptr
                    : section.kind == Section::Kind::shell ? law->plane != nullptr
                    : section.kind == Section::Kind::membrane
                        ? (composite ? law->lamina_stiffness != nullptr : law->plane != nullptr)
                        : true;
  if (!fits) {
    error(section.location,
          fmt::format("*{}: the law {} of material {} does not exist for these elements; choose another law",
                      section.kind == Section::Kind::membrane ? "MEMBRANE SECTION"
                      : section.kind == Section::Kind::beam   ? "BEAM SECTION"
                      : section.kind == Section::Kind::shell  ? "SHELL SECTION"
                                                              : "SOLID SECTION",
                      law->name,
                      model_.materials[material].name));
  }
}

void Checker::check_laws_of_sections() {
  for (const auto& section : model_.sections) {
    if (section.material >= 0) check_law(section, section.material);
    for (const auto& ply : section.plies) check_law(section, ply.material);
  }
}

void Checker::check_rigid_bodies() {
  carrier_.assign(model_.nodes.id.size(), -1);
  std::vector<std::int32_t> reference(model_.nodes.id.size(), -1);
  for (std::size_t b = 0; b < model_.rigid_bodies.size(); ++b) {
    reference[model_.rigid_bodies[b].reference_node] = static_cast<std::int32_t>(b);
  }
  for (std::size_t b = 0; b < model_.rigid_bodies.size(); ++b) {
    const auto& body = model_.rigid_bodies[b];
    for (const auto* nodes : {&body.tie_nodes, &body.pin_nodes}) {
      for (const auto node : *nodes) {
        const std::string id = model_.node_name(node);
        if (reference[node] >= 0) {
          error(body.location,
                fmt::format("*RIGID BODY: node {} is the reference node of another rigid body; take it out of the set",
                            id));
          break;
        }
        if (carrier_[node] >= 0) {
          error(body.location,
                fmt::format("*RIGID BODY: node {} already belongs to the rigid body of {}; take it out of one of them",
                            id, model_.where(model_.rigid_bodies[carrier_[node]].location)));
          break;
        }
        carrier_[node] = static_cast<std::int32_t>(b);
      }
    }
  }
}

void Checker::find_idle_nodes() {
  idle_.assign(model_.nodes.id.size(), true);
  for (const auto& table : model_.elements) {
    for (const auto node : table.connectivity) idle_[node] = false;
  }
  for (const auto& body : model_.rigid_bodies) {
    idle_[body.reference_node] = false;
    for (const auto* nodes : {&body.tie_nodes, &body.pin_nodes}) {
      for (const auto node : *nodes) idle_[node] = false;
    }
  }
  for (const auto& step : model_.steps) {
    for (const auto& attachment : step.attachments) {
      for (const auto node : attachment.nodes) idle_[node] = false;
    }
  }
  for (const auto& constraint : model_.constraints)
    for (const auto node : constrained_nodes(constraint.kind)) idle_[node] = false;
  const auto count = std::count(idle_.begin(), idle_.end(), true);
  if (count == 0) return;
  const auto first = static_cast<std::int32_t>(std::find(idle_.begin(), idle_.end(), true) - idle_.begin());
  warning(model_.nodes.location[first],
          fmt::format("*NODE: node {} belongs to no element and no rigid body ({} in all): nothing moves it", model_.node_name(first),
                      count));
}

void Checker::check_loads(const Step& step) {
  for (const auto& load : step.concentrated_loads) {
    if (!idle_[load.node]) continue;
    error({load.file, load.line},
          fmt::format("*CLOAD: node {} belongs to no element and no rigid body, so the load acts on nothing; correct the node",
                      model_.node_name(load.node)));
  }
}

void Checker::check_boundary(const Step& step) {
  for (const auto& condition : step.boundary) {
    const bool moves = std::holds_alternative<StaticPerturbationProcedure>(step.procedure) && condition.kind == BoundaryCondition::Kind::displacement;
    if (step.is_perturbation() && !moves && !condition.propagated && condition.magnitude != 0.0)
      error({condition.file, condition.line},
            fmt::format("*BOUNDARY: node {}: modes move nothing by a given amount; give 0 in a frequency step, or move the node in a "
                        "step before",
                        model_.node_name(condition.node)));
    const std::int32_t body = carrier_[condition.node];
    if (body < 0) continue;
    error({condition.file, condition.line},
          fmt::format("*BOUNDARY: node {} is carried by the rigid body of {}; prescribe its reference node {} instead "
                      "(in a step that attaches "
                      "nodes, *BOUNDARY, OP=NEW drops their earlier conditions)",
                      model_.node_name(condition.node), model_.where(model_.rigid_bodies[body].location),
                      model_.node_name(model_.rigid_bodies[body].reference_node)));
  }
}

void Checker::check_step(const Step& step) {
  for (const auto& change : step.attachments) {
    for (const auto node : change.nodes) carrier_[node] = change.release ? -1 : change.rigid_body;
  }
  check_boundary(step);
  check_loads(step);
}

}  // namespace

Findings check_model(const Model& model) {
  return Checker(model).run();
}

}  // namespace balocco
