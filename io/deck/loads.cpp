// *BOUNDARY *CLOAD *DLOAD *DSLOAD.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"
#include "elements/turning_nodes.hpp"

namespace balocco::deck {

namespace {

Step& current(Builder& builder) {
  return builder.model.steps.back();
}

/// Named conditions and the degrees of freedom (from 0) that they hold.
const std::map<std::string, std::vector<int>>& named_conditions() {
  static const std::map<std::string, std::vector<int>> table{{"ENCASTRE", {0, 1, 2, 3, 4, 5}},
                                                             {"PINNED", {0, 1, 2}},
                                                             {"XSYMM", {0, 4, 5}},
                                                             {"YSYMM", {1, 3, 5}},
                                                             {"ZSYMM", {2, 3, 4}},
                                                             {"XASYMM", {1, 2, 3}},
                                                             {"YASYMM", {0, 2, 4}},
                                                             {"ZASYMM", {0, 1, 5}}};
  return table;
}

std::optional<std::int32_t> amplitude_of(Builder& builder, const Block& block) {
  if (!block.has("AMPLITUDE")) return -1;
  return builder.require(builder.amplitudes, block.value("AMPLITUDE"), block, block.location);
}

/// With VALUE=ABSOLUTE the amplitude gives the magnitude itself.
double scaled(const Builder& builder, std::int32_t amplitude, double magnitude) {
  return builder.absolute_amplitudes.contains(amplitude) ? 1.0 : magnitude;
}

/// Which nodes have rotations; found out when first asked.
class Rotations {
 public:
  explicit Rotations(const Builder& builder) : builder_(builder) {}

  bool has(std::int32_t node) {
    if (turning_.empty()) turning_ = turning_nodes(builder_.model);
    return turning_[node] || builder_.body_of_reference.contains(node);
  }

 private:
  const Builder& builder_;
  std::vector<bool> turning_;
};

/// Degrees of freedom and magnitude of a data line.
struct Freedoms {
  std::vector<int> dofs;
  double magnitude = 0.0;
  bool named = false;
};

std::optional<Freedoms> freedoms_of(Row& row) {
  Freedoms result;
  if (!parse_integer(row.text(1))) {
    const auto found = named_conditions().find(row.name(1));
    if (found == named_conditions().end()) {
      std::vector<std::string> names;
      for (const auto& [name, dofs] : named_conditions()) names.push_back(name);
      row.error(
          fmt::format("field 2 ('{}') is neither a degree of freedom nor a named condition{}; allowed: 1 to 6, {}",
                      row.text(1), did_you_mean(row.text(1), names), join(names)));
      return std::nullopt;
    }
    row.at_most(2);
    result.dofs = found->second;
    result.named = true;
    return row.ok() ? std::optional(result) : std::nullopt;
  }
  const std::int64_t first = row.integer(1, "first degree of freedom"),
                     last = row.integer_or(2, first, "last degree of freedom");
  result.magnitude = row.real_or(3, 0.0, "magnitude");
  row.at_most(4);
  if (row.ok() && (first < 1 || last > 6 || last < first)) {
    row.error(fmt::format("degrees of freedom {} to {} do not exist; they run from 1 to 6", first, last));
  }
  if (!row.ok()) return std::nullopt;
  for (auto dof = first; dof <= last; ++dof) result.dofs.push_back(static_cast<int>(dof) - 1);
  return result;
}

void set_condition(Builder& builder, const BoundaryCondition& condition) {
  if (!builder.in_step) return builder.initial_boundary.push_back(condition);
  auto& boundary = current(builder).boundary;
  const auto [place, added] =
      builder.draft.boundary_of.emplace(std::int64_t{condition.node} * 6 + condition.dof, boundary.size());
  if (added) {
    boundary.push_back(condition);
  } else {
    boundary[place->second] = condition;
  }
}

/// OP=NEW: what earlier steps said is gone (once a step).
void renew_boundary(Builder& builder, const Block& block) {
  if (block.value("OP") != "NEW" || builder.draft.boundary_renewed) return;
  builder.draft.boundary_renewed = true;
  builder.draft.boundary_of.clear();
  auto& boundary = current(builder).boundary;
  const bool first_step = builder.model.steps.size() == 1;
  std::erase_if(boundary, [&](const BoundaryCondition& c) { return c.propagated || first_step; });
  for (std::size_t row = 0; row < boundary.size(); ++row) {
    builder.draft.boundary_of[std::int64_t{boundary[row].node} * 6 + boundary[row].dof] = row;
  }
}

BoundaryCondition::Kind kind_of(const Block& block) {
  const std::string type = block.value("TYPE", "DISPLACEMENT");
  if (type == "VELOCITY") return BoundaryCondition::Kind::velocity;
  return type == "ACCELERATION" ? BoundaryCondition::Kind::acceleration : BoundaryCondition::Kind::displacement;
}

void read_boundary_line(Builder& builder, const Block& block, Row& row, BoundaryCondition condition,
                        Rotations& rotations, bool& told_rotation) {
  if (!row.has(1)) return row.error("field 2 is missing: degree of freedom or named condition; add it");
  std::vector<std::int32_t> nodes;
  const bool known = builder.nodes_of(row.text(0), block, row.location(), nodes);
  const auto freedoms = freedoms_of(row);
  if (!known || !freedoms) return;
  if (!builder.in_step && freedoms->magnitude != 0.0) {
    return row.error("before the first step conditions can only be zero; move it into a *STEP");
  }
  if (condition.fixed && freedoms->magnitude != 0.0) return row.error("FIXED takes no magnitude; remove field 4");
  condition.magnitude = scaled(builder, condition.amplitude, freedoms->magnitude);
  condition.file = row.location().file;
  condition.line = row.location().line;
  for (const auto node : nodes) {
    for (const int dof : freedoms->dofs) {
      if (dof >= 3 && !rotations.has(node)) {
        if (!freedoms->named && freedoms->magnitude != 0.0) {
          return row.error(fmt::format(
              "node {} has no rotation to prescribe; nodes of shells, beams and ROTARYI elements and reference nodes of rigid "
              "bodies have degrees of freedom 4 to 6",
              builder.model.node_name(node)));
        }
        if (!freedoms->named && !told_rotation) {
          builder.warning(block, row.location(),
                          fmt::format("node {} has no rotations: degrees of freedom 4 to 6 are left out",
                                      builder.model.node_name(node)));
          told_rotation = true;
        }
        continue;
      }
      condition.node = node;
      condition.dof = dof;
      set_condition(builder, condition);
    }
  }
}

void read_boundary(Builder& builder, const Block& block) {
  if (builder.in_step) {
    renew_boundary(builder, block);
  } else if (block.has("OP") || block.has("AMPLITUDE") || block.has("FIXED") ||
             kind_of(block) != BoundaryCondition::Kind::displacement) {
    return builder.error(block, block.location, "before the first step it takes no parameters; move it into a *STEP");
  }
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  BoundaryCondition condition;
  condition.kind = kind_of(block);
  condition.amplitude = *amplitude;
  condition.fixed = block.has("FIXED");
  Rotations rotations(builder);
  bool told_rotation = false;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    read_boundary_line(builder, block, row, condition, rotations, told_rotation);
  }
}

/// OP=NEW: loads of earlier steps go to zero, in a static step gradually, as in Abaqus.
template <class Loads>
void take_away(const Builder& builder, Loads& loads) {
  for (auto& load : loads) {
    if (builder.draft.said_here(load)) continue;
    load.magnitude = 0.0;
    load.amplitude = -1;
  }
}

void read_concentrated(Builder& builder, const Block& block) {
  auto& loads = current(builder).concentrated_loads;
  auto& index = builder.draft.concentrated_of;
  if (block.value("OP") == "NEW" && !builder.draft.concentrated_renewed) {
    take_away(builder, loads);
    builder.draft.concentrated_renewed = true;
  }
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  Rotations rotations(builder);
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    std::vector<std::int32_t> nodes;
    const std::int64_t dof = row.integer(1, "degree of freedom");
    const double magnitude = row.real(2, "magnitude");
    row.at_most(3);
    if (row.ok() && (dof < 1 || dof > 6))
      row.error(fmt::format("degree of freedom {} does not exist; give 1 to 6", dof));
    if (!row.ok() || !builder.nodes_of(row.text(0), block, line.location, nodes)) continue;
    for (const auto node : nodes) {
      if (dof > 3 && !rotations.has(node)) {
        row.error(fmt::format("node {} cannot take a moment; nodes of shells, beams and ROTARYI elements and reference nodes of rigid "
                              "bodies can",
                              builder.model.node_name(node)));
        break;
      }
      const auto [place, added] = index.emplace(std::int64_t{node} * 6 + dof - 1, loads.size());
      if (added) loads.push_back({node, static_cast<std::int32_t>(dof) - 1});
      auto& load = loads[place->second];
      // Repeated in one step: forces add up. From an earlier step: the new magnitude takes the old one's place.
      const double sum = builder.draft.said_here(load) && load.amplitude == *amplitude ? load.magnitude : 0.0;
      load.magnitude = sum + scaled(builder, *amplitude, magnitude);
      load.amplitude = *amplitude;
      load.file = line.location.file;
      load.line = line.location.line;
      builder.draft.said.insert({load.file, load.line});
    }
  }
}

void renew_distributed(Builder& builder, const Block& block) {
  if (block.value("OP") != "NEW" || builder.draft.distributed_renewed) return;
  builder.draft.distributed_renewed = true;
  take_away(builder, current(builder).pressures);
  take_away(builder, current(builder).gravity);
}

void set_pressure(Builder& builder, std::int32_t surface, double magnitude, std::int32_t amplitude, Location location) {
  auto& pressures = current(builder).pressures;
  auto found = std::find_if(pressures.begin(), pressures.end(),
                            [&](const PressureLoad& load) { return load.surface == surface; });
  if (found == pressures.end()) found = pressures.insert(pressures.end(), PressureLoad{surface});
  found->magnitude = scaled(builder, amplitude, magnitude);
  found->amplitude = amplitude;
  found->file = location.file;
  found->line = location.line;
  builder.draft.said.insert({location.file, location.line});
}

void read_surface_load(Builder& builder, const Block& block) {
  renew_distributed(builder, block);
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const auto surface = builder.require(builder.surfaces, row.name(0), block, line.location);
    const double magnitude = row.real(2, "pressure");
    row.at_most(3);
    if (row.ok() && row.name(1) != "P")
      row.error(fmt::format("load type '{}' is not supported; allowed: P", row.text(1)));
    if (!row.ok() || !surface) continue;
    if (builder.model.surfaces[*surface].kind != Surface::Kind::element_faces) {
      row.error(fmt::format("surface {} has no element faces to press on; use a surface of TYPE=ELEMENT", row.name(0)));
      continue;
    }
    set_pressure(builder, *surface, magnitude, *amplitude, line.location);
  }
}

/// Face that Pn or P presses on; P on a membrane or shell acts along its normal, so on the negative side.
int pressed_face(const ElementType& type, const std::string& label) {
  if (type.section == Section::Kind::membrane || type.section == Section::Kind::shell) return label == "P" && type.faces.size() > 1 ? 1 : -1;
  if (type.section != Section::Kind::solid || label.size() != 2) return -1;
  const int face = label[1] - '1';
  return face >= 0 && face < static_cast<int>(type.faces.size()) ? face : -1;
}

/// Surface of the faces that a *DLOAD line presses on, made when first needed.
std::optional<std::int32_t> pressed_surface(Builder& builder, const Block& block, Row& row) {
  const std::string label = row.name(1), key = fmt::format("_DLOAD-{}-{}", row.name(0), label);
  if (const auto known = builder.find(builder.surfaces, key)) return known;
  std::vector<ElementRef> elements;
  if (!builder.elements_of(row.text(0), block, row.location(), elements)) return std::nullopt;
  Surface surface;
  surface.name = key;
  surface.location = row.location();
  for (const auto element : elements) {
    const ElementType& type = *builder.model.elements[element.table].type;
    const int face = pressed_face(type, label);
    if (face < 0) {
      row.error(fmt::format("element {} of type {} cannot take the load {}; solids take P1 to P6 by face, membranes P",
                            builder.model.element_name(element), type.name, label));
      return std::nullopt;
    }
    surface.faces.push_back({element, face});
  }
  const auto number = static_cast<std::int32_t>(builder.model.surfaces.size());
  builder.surfaces.rows.emplace(key, number);
  builder.model.surfaces.push_back(std::move(surface));
  return number;
}

void read_gravity(Builder& builder, const Block& block, Row& row, std::int32_t amplitude) {
  GravityLoad load;
  load.magnitude = scaled(builder, amplitude, row.real(2, "acceleration"));
  for (int i = 0; i < 3; ++i) load.direction[i] = row.real_or(3 + i, 0.0, "direction");
  row.at_most(6);
  const double length = norm(load.direction);
  if (row.ok() && !(length > 0.0)) row.error("the direction is missing; give three components");
  if (!row.ok()) return;
  for (double& component : load.direction) component /= length;
  if (row.has(0)) {
    std::vector<ElementRef> elements;
    if (!builder.elements_of(row.text(0), block, row.location(), elements)) return;
    if (parse_integer(row.text(0))) {
      load.element_set = builder.element_set_row("_DLOAD-" + row.name(0));
      builder.add_to_element_set(load.element_set, elements[0]);
      builder.elements_in(load.element_set);
    } else {
      load.element_set = *builder.find(builder.element_sets, row.name(0));
    }
  }
  load.amplitude = amplitude;
  load.file = row.location().file;
  load.line = row.location().line;
  builder.draft.said.insert({load.file, load.line});
  auto& loads = current(builder).gravity;
  const auto found = std::find_if(loads.begin(), loads.end(), [&](const GravityLoad& other) {
    return other.element_set == load.element_set && other.direction == load.direction;
  });
  if (found == loads.end()) {
    loads.push_back(load);
  } else {
    load.previous = found->previous;
    *found = load;
  }
}

void read_distributed(Builder& builder, const Block& block) {
  renew_distributed(builder, block);
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const std::string label = row.name(1);
    if (label == "GRAV") {
      read_gravity(builder, block, row, *amplitude);
      continue;
    }
    const double magnitude = row.real(2, "pressure");
    row.at_most(3);
    if (row.ok() && label != "P" && !(label.size() == 2 && label[0] == 'P')) {
      row.error(fmt::format("load type '{}' is not supported; allowed: P, P1 to P6, GRAV", row.text(1)));
    }
    if (!row.ok()) continue;
    if (const auto surface = pressed_surface(builder, block, row)) {
      set_pressure(builder, *surface, magnitude, *amplitude, line.location);
    }
  }
}

const RegisterKeyword boundary{
    {"BOUNDARY",
     Phase::history,
     Place::anywhere,
     {choice("OP", {"MOD", "NEW"}), choice("TYPE", {"DISPLACEMENT", "VELOCITY", "ACCELERATION"}), name("AMPLITUDE"),
      flag("FIXED")},
     read_boundary}};
const RegisterKeyword cload{
    {"CLOAD", Phase::history, Place::step, {choice("OP", {"MOD", "NEW"}), name("AMPLITUDE")}, read_concentrated}};
const RegisterKeyword dload{
    {"DLOAD", Phase::history, Place::step, {choice("OP", {"MOD", "NEW"}), name("AMPLITUDE")}, read_distributed}};
const RegisterKeyword dsload{
    {"DSLOAD", Phase::history, Place::step, {choice("OP", {"MOD", "NEW"}), name("AMPLITUDE")}, read_surface_load}};

}  // namespace

}  // namespace balocco::deck
