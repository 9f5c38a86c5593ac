// Which nodes of a step are loaded, pushed, asked for, or turn by themselves.
#include <fmt/format.h>

#include <algorithm>

#include "explicit_restraint_bound.hpp"
#include "explicit_step.hpp"
#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

/// The elements of a group have one section.
bool ExplicitStep::measures_alone(const ElementGroup& group) const {
  const Model& model = analysis_.model;
  const auto& table = model.elements[group.table()];
  if (table.type->section != Section::Kind::connector || group.size() == 0) return false;
  const auto& connector = model.connectors[model.sections[table.section[group.row(0)]].connector];
  const auto has_law = [](const auto& component) { return component.elasticity || component.damping; };
  return std::ranges::none_of(connector.component, has_law) && connector.coupled_elasticity.empty() && connector.coupled_damping.empty();
}

void ExplicitStep::refuse_loads_without_inertia() const {
  const Model& model = analysis_.model;
  for (const auto& load : step_.concentrated_loads) {
    const auto node = analysis_.domain.local_node[load.node];
    if (node < 0) continue;
    const bool moved_otherwise = analysis_.carrier(node) >= 0 || analysis_.reference_of(node) >= 0 || linkages_.moves(node);
    if (load.dof < 3 && !moved_otherwise && inverse_.mass[node] == 0.0)
      throw InputError(
          fmt::format("{}: error: *CLOAD: node {} has no mass, so that an explicit step cannot move it; give it a "
                      "MASS element or load a node of an element",
                      model.where({load.file, load.line}), model.nodes.id[load.node]));
    const bool turns = analysis_.turning_body(node) >= 0 || gyroscopic_.contains(node) || linkages_.turns(node) ||
                       (node < analysis_.domain.turning && inverse_.rotary[node] > 0.0);
    if (load.dof >= 3 && !turns)
      throw InputError(
          fmt::format("{}: error: *CLOAD: node {} has no rotary inertia, so that an explicit step cannot turn it; give it a "
                      "ROTARYI element or load a node of a beam or shell",
                      model.where({load.file, load.line}), model.nodes.id[load.node]));
  }
}

/// Copies of nodes of a cloud that others compute take no part in the step.
bool ExplicitStep::is_idle_copy(std::int32_t node) const { return linkages_.in_cloud(node) && !analysis_.domain.computed[node]; }

void ExplicitStep::find_neighbours() {
  neighbours_ = analysis_.domain.halo->neighbours();
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const auto& by_both = analysis_.domain.computed_by_both[i].nodes;
    auto next = by_both.begin();  // in the same order
    std::erase_if(neighbours_[i].nodes, [&](std::int32_t node) {
      const bool computed = next != by_both.end() && *next == node;
      if (computed) ++next;
      return !computed && linkages_.in_cloud(node);
    });
  }
}

void ExplicitStep::find_loaded_nodes() {
  std::vector<bool> loaded(static_cast<std::size_t>(analysis_.domain.size()), false);
  for (const auto& load : step_.concentrated_loads)
    if (const auto node = analysis_.domain.local_node[load.node]; node >= 0) loaded[node] = true;
  for (const auto& load : step_.surface_loads) {
    const SurfaceLoading& loading = analysis_.loading(load);
    for (std::int32_t item = 0; item < loading.size(); ++item)
      for (const auto node : loading.nodes(item)) loaded[node] = true;
  }
  for (const auto& load : step_.body_loads) {
    const auto& share = analysis_.loaded_share(load);
    for (std::size_t node = 0; node < share.size(); ++node)
      if (share[node] != 0.0 && !is_left_out(analysis_, load, static_cast<std::int32_t>(node), CarriedGravity::left_out)) loaded[node] = true;
  }
  has_loads_ = !step_.concentrated_loads.empty() || !step_.surface_loads.empty() || !step_.body_loads.empty();
  if (has_loads_)  // what another rank loads arrives through the halo
    for (const auto& neighbour : neighbours_)
      for (const auto node : neighbour.nodes) loaded[node] = true;
  for (std::size_t node = 0; node < loaded.size(); ++node)
    if (loaded[node]) loaded_nodes_.push_back(static_cast<std::int32_t>(node));
  loaded_turning_ = static_cast<std::size_t>(std::ranges::lower_bound(loaded_nodes_, analysis_.domain.turning) - loaded_nodes_.begin());
}

RigidDynamics::Uses ExplicitStep::uses_of_nodes() const {
  const auto& domain = analysis_.domain;
  const std::vector<bool> none(static_cast<std::size_t>(domain.size()), false);
  RigidDynamics::Uses uses{none, none};
  const auto mark = [](std::vector<bool>& nodal) {
    return [&nodal](std::span<const std::int32_t> nodes) {
      for (const auto node : nodes) nodal[node] = true;
    };
  };
  const auto push = mark(uses.pushed), ask = mark(uses.asked);
  push(loaded_nodes_);
  for (const auto& neighbour : neighbours_) push(neighbour.nodes);  // what another rank does there
  for (std::size_t index = 0; index < analysis_.element_groups.size(); ++index) {
    const auto& group = *analysis_.element_groups[index];
    for (std::int32_t element = 0; element < group.size(); ++element)
      if (group.acts(element)) (measures_alone_[index] ? ask : push)(group.nodes(element));
  }
  for (const auto& contact : analysis_.contacts) push(contact.nodes());
  for (const auto& contact : analysis_.mesh_contacts) push(contact.all_nodes());
  const auto& inertia = analysis_.inertia;
  for (std::size_t node = 0; node < none.size(); ++node)
    if (inertia.damping[node] > 0.0 || (node < inertia.rotary_damping.size() && inertia.rotary_damping[node] > 0.0)) uses.pushed[node] = true;
  for (const auto index : analysis_.local_constraints)
    for (const auto row : analysis_.constraints[index]->nodes()) uses.asked[domain.local_node[row]] = true;
  return uses;
}

void ExplicitStep::set_rounding_constants() {
  const auto set = [](std::vector<double>& nodal, const std::vector<double>& constants) {
    for (std::size_t node = 0; node < constants.size() && !nodal.empty(); ++node) nodal[4 * node + 3] = constants[node];
  };
  for (auto* forces : {&force_, &external_force_}) set(*forces, scale_.rounding_constant);
  for (auto* moments : {&moment_, &external_moment_}) set(*moments, scale_.moment_constant);
}

void ExplicitStep::renew_restraints() {
  place_restraints(analysis_);
  restraints_ = nodal_restraints(analysis_);
  restraint_bound_ = find_restraint_bound(analysis_, restraints_, bodies_, linkages_);
  tell_added_bounds();
  scale_ = force_scale(analysis_, step_, restraints_);
  set_rounding_constants();
}

/// All but idle copies and those that only follow a body and that nothing pushes: they have no forces, and their places when somebody looks.
void ExplicitStep::list_acting_nodes(const RigidDynamics::Uses& uses) {
  const auto acts = [&](std::int32_t node) {
    return (analysis_.carrier(node) < 0 || uses.pushed[node] || uses.asked[node]) && !is_idle_copy(node);
  };
  acting_ = find_runs(analysis_.domain.size(), acts);
  acting_turning_ = find_runs(analysis_.domain.turning, acts);
}

/// Nodes that turn, but for idle copies and those that have their orientation from a body.
void ExplicitStep::list_drifting_nodes() {
  drifting_ = find_runs(analysis_.domain.turning, [&](std::int32_t node) { return !bodies_.orients(node) && !is_idle_copy(node); });
}

void ExplicitStep::bring_idle_copies() {
  auto& state = analysis_.current;
  for (auto* field : {&state.position, &state.velocity, &analysis_.acceleration, &state.orientation, &state.rotation, &state.angular_velocity,
                      &analysis_.angular_acceleration})
    copy_from_owners(analysis_.communicator, analysis_.domain.halo->neighbours(), analysis_.domain.owned, *field);
}

}  // namespace balocco
