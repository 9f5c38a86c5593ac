// *BOUNDARY *CLOAD.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "deck/builder.hpp"
#include "deck/joint_angles.hpp"
#include "deck/load_magnitude.hpp"
#include "deck/register.hpp"
#include "deck/steady_state.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"
#include "elements/turning_nodes.hpp"

namespace balocco::deck {

namespace {

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
  auto& boundary = current_step(builder).boundary;
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
  auto& boundary = current_step(builder).boundary;
  const bool first_step = builder.model.steps.size() == 1;
  std::erase_if(current_step(builder).connector_motions, [&](const ConnectorMotion& motion) {
    return (motion.course.propagated || first_step) && is_of_angle(builder.model, motion);
  });
  std::erase_if(boundary, [&](const BoundaryCondition& c) {
    return (c.propagated || first_step) && !builder.ground_nodes.contains(c.node);
  });
  for (std::size_t row = 0; row < boundary.size(); ++row) {
    builder.draft.boundary_of[std::int64_t{boundary[row].node} * 6 + boundary[row].dof] = row;
  }
}

void read_boundary_line(Builder& builder, const Block& block, Row& row, BoundaryCondition condition,
                        Rotations& rotations, bool& told_rotation) {
  if (!row.has(1)) return row.error("field 2 is missing: degree of freedom or named condition; add it");
  std::vector<std::int32_t> nodes;
  const bool known = builder.nodes_of(row.text(0), block, row.location(), nodes);
  const auto freedoms = freedoms_of(row);
  if (!known || !freedoms) return;
  if (condition.fixed && freedoms->magnitude != 0.0) return row.error("FIXED takes no magnitude; remove field 4");
  condition.magnitude = scaled(builder, condition.amplitude, freedoms->magnitude);
  condition.file = row.location().file;
  condition.line = row.location().line;
  for (const auto node : nodes) {
    for (const int dof : freedoms->dofs) {
      if (prescribes_angle(builder, node, dof, condition)) continue;
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
             kind_of_motion(block) != BoundaryCondition::Kind::displacement) {
    return builder.error(block, block.location, "before the first step it takes no parameters; move it into a *STEP");
  }
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  BoundaryCondition condition;
  condition.kind = kind_of_motion(block);
  condition.amplitude = *amplitude;
  condition.fixed = block.has("FIXED");
  Rotations rotations(builder);
  bool told_rotation = false;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    read_boundary_line(builder, block, row, condition, rotations, told_rotation);
  }
}

void read_concentrated(Builder& builder, const Block& block) {
  auto& loads = current_step(builder).concentrated_loads;
  auto& index = builder.draft.concentrated_of;
  if (block.value("OP") == "NEW" && !builder.draft.concentrated_renewed) {
    take_away(builder, loads);
    take_away(builder, current_step(builder).connector_loads, [&](const ConnectorLoad& load) { return is_of_angle(builder.model, load); });
    builder.draft.concentrated_renewed = true;
  }
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  const bool follower = block.has("FOLLOWER"), imaginary = is_imaginary(builder, block);
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
      const ConcentratedLoad said{.node = node, .magnitude = scaled(builder, *amplitude, magnitude), .amplitude = *amplitude,
                                  .file = line.location.file, .line = line.location.line};
      if (!follower && loads_angle(builder, node, static_cast<int>(dof) - 1, said)) continue;
      if (follower && !rotations.has(node)) {
        row.error(fmt::format("node {} does not turn, so that nothing says where a force that follows it points; nodes of shells, beams and "
                              "ROTARYI elements and reference nodes of rigid bodies turn; elsewhere leave FOLLOWER out",
                              builder.model.node_name(node)));
        break;
      }
      if (dof > 3 && !rotations.has(node)) {
        row.error(fmt::format("node {} cannot take a moment; nodes of shells, beams and ROTARYI elements and reference nodes of rigid "
                              "bodies can",
                              builder.model.node_name(node)));
        break;
      }
      const auto [place, added] = index.emplace(StepDraft::key_of(node, static_cast<std::int32_t>(dof) - 1, follower, imaginary), loads.size());
      if (added) loads.push_back({.node = node, .dof = static_cast<std::int32_t>(dof) - 1, .follower = follower, .imaginary = imaginary});
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

const RegisterKeyword boundary{
    {"BOUNDARY",
     Phase::history,
     Place::anywhere,
     {choice("OP", {"MOD", "NEW"}), choice("TYPE", {"DISPLACEMENT", "VELOCITY", "ACCELERATION"}), name("AMPLITUDE"), real("TIME DELAY"),
      flag("FIXED")},
     read_boundary}};
const RegisterKeyword cload{
    {"CLOAD",
     Phase::history,
     Place::step,
     {choice("OP", {"MOD", "NEW"}), name("AMPLITUDE"), real("TIME DELAY"), flag("FOLLOWER"), integer("LOAD CASE"), flag("REAL"),
      flag("IMAGINARY")},
     read_concentrated}};

}  // namespace

}  // namespace balocco::deck
