#include "analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "consistent_loads.hpp"
#include "constraints/rigid_body.hpp"
#include "elements/consistent_mass.hpp"
#include "elements/element_type.hpp"
#include "elements/failure.hpp"
#include "explicit_scale.hpp"
#include "loads/body_load.hpp"
#include "math/rotation.hpp"
#include "model/check_constraints.hpp"
#include "model/diagnostics.hpp"
#include "model/interaction_in_step.hpp"
#include "model/rigid_constraints.hpp"
#include "thermal_strains.hpp"

namespace balocco {

namespace {

/// Groups keep what they need of their inputs, which are as large as the mesh and go one by one.
std::vector<std::unique_ptr<ElementGroup>> make_groups(const Model& model, std::vector<GroupInput> inputs) {
  std::vector<std::unique_ptr<ElementGroup>> groups;
  for (auto& input : inputs) {
    groups.push_back(model.elements[input.table].type->make_group(input));
    input.rows = input.connectivity = {};
  }
  return groups;
}

std::vector<std::vector<bool>> local_elements(const Model& model, std::span<const std::unique_ptr<ElementGroup>> groups) {
  std::vector<std::vector<bool>> local(model.elements.size());
  for (std::size_t table = 0; table < local.size(); ++table) local[table].resize(model.elements[table].size());
  for (const auto& group : groups)
    for (std::int32_t e = 0; e < group->size(); ++e) local[group->table()][group->row(e)] = true;
  return local;
}

}  // namespace

void repeat_in_padded_lanes(const ElementGroup& group, std::span<double> history) {
  for (int component = 0; component < group.history_size(); ++component) {
    double* values = &history[static_cast<std::size_t>(component) * group.padded_size()];
    std::fill(values + group.size(), values + group.padded_size(), values[group.size() - 1]);
  }
}

Analysis::Analysis(const Model& model_, const Communicator& communicator_, const Partitioner& partitioner)
    : model(model_),
      communicator(communicator_),
      domain(make_domain(model_, communicator_, partitioner)),
      directions(model_),
      inertia_sums_(model, communicator, domain) {
  communicator.together([&] {
    element_groups = make_groups(model, std::exchange(domain.groups, {}));
    for (std::size_t pair = 0; pair < model.contact_pairs.size(); ++pair) {
      const auto row = static_cast<std::int32_t>(pair);
      const bool mesh = deforms(model, model.surfaces[model.contact_pairs[pair].master]);
      contacts.push_back(mesh ? RigidContact() : RigidContact(model, row, domain));
      mesh_contacts.push_back(mesh ? MeshContact(model, row, domain) : MeshContact());
    }
  });
  make_local_constraints();
  make_surface_loadings();
  mass_constant_ = inertia_sums_.sum(element_groups, false, inertia);
  collect_rotary_tensors();

  const std::size_t size = 4 * (domain.size() + 1);
  for (auto* array : {&current.position, &current.velocity, &acceleration, &reaction}) array->assign(size, 0.0);
  for (std::int32_t node = 0; node < domain.size(); ++node)
    std::copy_n(model.nodes.coordinates[domain.node_row[node]].data(), 3, &current.position[4 * node]);
  for (const auto& initial : model.initial_displacements)
    for (const auto row : initial.nodes)
      if (const auto node = domain.local_node[row]; node >= 0)
        current.position[4 * node + initial.dof] = model.nodes.coordinates[row][initial.dof] + initial.value;
  const std::size_t turning = 4 * static_cast<std::size_t>(domain.turning);
  for (auto* array : {&current.orientation, &current.angular_velocity, &current.rotation, &angular_acceleration, &reaction_moment})
    array->assign(turning, 0.0);
  for (std::size_t i = 0; i < turning; i += 4) current.orientation[i] = 1.0;
  current.nodal_work.resize(domain.size());
  work_ahead.resize(domain.size());
  for (const auto& group : element_groups) {
    current.element_history.push_back(group->initial_history());
    group->set_initial_fields(model, current.element_history.back());
  }
  ThermalStrains(*this).start(*this);
  current.mass_scale.resize(element_groups.size());
  current.restrained.resize(element_groups.size());
  for (std::size_t pair = 0; pair < contacts.size(); ++pair) current.contact.emplace_back(contacts[pair].size() + mesh_contacts[pair].size());
  current.rigid_bodies = initial_rigid_bodies(model);
  undeformed_increment = balocco::undeformed_increment(model, communicator, domain, element_groups);
  body_reaction.resize(model.rigid_bodies.size());
  body_angular_acceleration.resize(model.rigid_bodies.size());
  index_rigid_nodes();
  place_rigid_nodes(current.position);
}

void Analysis::make_local_constraints() {
  constraints = make_constraints(model);
  first_constraint_row.push_back(0);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    first_constraint_row.push_back(first_constraint_row.back() + constraints[i]->rows());
    if (const auto connector = model.constraints[i].element; connector.table >= 0)
      constraints_of_connector_[connector].push_back(static_cast<std::int32_t>(i));
    const auto& nodes = constraints[i]->nodes();
    if (std::ranges::all_of(nodes, [&](std::int32_t row) { return domain.local_node[row] >= 0; }))
      local_constraints.push_back(static_cast<std::int32_t>(i));
  }
  for (auto* of_rows : {&current.multiplier, &current.guide_motion, &current.guide_locked})
    of_rows->assign(static_cast<std::size_t>(first_constraint_row.back()), 0.0);
}

void Analysis::find_places(std::int32_t constraint, std::vector<NodePlace>& places) const {
  places.clear();
  for (const auto row : constraints[constraint]->nodes()) places.push_back(place_of(row));
}

NodePlace Analysis::place_of(std::int32_t row) const {
  const auto node = domain.local_node[row];
  NodePlace place;
  std::copy_n(&current.position[4 * node], 3, place.position.component.begin());
  if (node >= domain.turning) return place;
  const double* q = &current.orientation[4 * node];
  place.rotation = rotation_matrix(Quaternion<double>{q[0], q[1], q[2], q[3]});
  std::copy_n(&current.rotation[4 * node], 3, place.turn.component.begin());
  return place;
}

void Analysis::make_surface_loadings() {
  const auto local = local_elements(model, element_groups);
  for (const auto& step : model.steps)
    for (const auto& load : step.surface_loads)
      if (std::ranges::none_of(surface_loadings_, [&](const auto& known) { return acts_alike(known.first, load); }))
        surface_loadings_.emplace_back(load, make_surface_loading(model, load, domain.local_node, local, domain.scratch_node()));
}

const SurfaceLoading& Analysis::loading(const SurfaceLoad& load) const {
  return *std::ranges::find_if(surface_loadings_, [&](const auto& known) { return acts_alike(known.first, load); })->second;
}

void Analysis::collect_rotary_tensors() {
  for (const auto& table : model.elements) {
    if (table.type->section != Section::Kind::rotary_inertia) continue;
    for (std::int32_t row = 0; row < table.size(); ++row) {
      const auto node = domain.local_node[table.connectivity[row]];
      if (node < 0 || node >= domain.turning) continue;
      const auto& given = model.sections[table.section[row]].inertia;
      rotary_tensors.push_back({node,
                                table.section[row],
                                {{given[0], given[3], given[4], given[3], given[1], given[5], given[4], given[5], given[2]}}});
    }
  }
}

const std::vector<double>& Analysis::loaded_share(const BodyLoad& load) const {
  const bool by_mass = acts_on_mass(load), consistent = loads_are_consistent(*this);
  auto [entry, is_new] = loaded_share_.try_emplace({load.element_set, by_mass, consistent}, domain.size(), 0.0);
  auto& whole = entry->second;
  if (!is_new) return whole;
  std::vector<double> share, sums(4 * (domain.size() + 1), 0.0);
  const auto for_each_share = [&](auto visit) {
    for (const auto& group : element_groups) {
      ConsistentMass mass(model, *group);
      share.resize(group->nodes_per_element());
      for (std::int32_t e = 0; e < group->size(); ++e) {
        if (!acts_on(model, load, {group->table(), group->row(e)})) continue;
        if (consistent && mass.exists())
          std::ranges::copy(mass.row_sums(e), share.begin());
        else
          group->lumped_volume(e, share);
        if (by_mass)
          for (double& volume : share) volume *= group->density();
        for (std::size_t i = 0; i < share.size(); ++i) visit(group->nodes(e)[i], share[i]);
      }
    }
  };
  double constant = mass_constant_;
  if (!by_mass) {
    double largest = 0.0;
    for_each_share([&](std::int32_t, double volume) { largest = std::max(largest, volume); });
    constant = rounding_constant(64.0 * communicator.maximum(largest));
  }
  // Whole shares on the owners: a load is rounded once, so that it does not depend on how ranks share a node.
  for_each_share([&](std::int32_t node, double addend) { sums[4 * node] += rounded(addend, constant); });
  domain.halo->begin_sum(sums.data());
  domain.halo->finish_sum(sums.data());
  for (std::int32_t node = 0; node < domain.size(); ++node)
    if (domain.owned[node]) whole[node] = sums[4 * node];
  if (by_mass)
    for_each_point_mass(model, domain, [&](std::int32_t node, double point_mass, ElementRef element) {
      if (domain.owned[node] && acts_on(model, load, element)) whole[node] += point_mass;
    });
  return whole;
}

/// Steps are linear until one has large displacements, needs iterations for contact, for laws that remember, for ropes, for springs with
/// tables or for connectors that are stopped, rubbed or driven, or ties nodes where others have moved.
bool Analysis::stays_linear(const Step& step) const {
  if (!current.linear || step.is_perturbation()) return current.linear;
  if (std::ranges::any_of(model.materials, [](const auto& material) { return !material.options.empty(); })) return false;
  if (std::ranges::any_of(model.sections, [](const auto& section) { return !section.spring.table.empty(); })) return false;
  for (std::size_t index = 0; index < constraints.size(); ++index)
    if (constraints[index]->is_one_sided() || is_acting_guide(model, index)) return false;
  const auto* procedure = step.implicit_increments();
  const bool ties_moved_nodes =
      current.total_time > 0.0 && std::ranges::any_of(step.attachments, [](const auto& change) { return !change.release; });
  return procedure != nullptr && !procedure->nonlinear_geometry && step.active_contact_pairs.empty() && !ties_moved_nodes;
}

/// Linear displacements become the positions from which large ones go on, with the forces of finite strain there.
void Analysis::leave_linear_geometry(const Step& step) {
  current.linear = false;
  if (current.total_time == 0.0) return;
  place_rigid_nodes(current.position);
  ThermalStrains(*this).leave_first_order(*this);
  bool sound = true;
  for (std::size_t index = 0; index < element_groups.size(); ++index) {
    const auto& group = *element_groups[index];
    std::vector<double> before(group.history_size()), after(group.history_size()),
        force(static_cast<std::size_t>(group.freedoms_per_node()) * group.nodes_per_element());
    for (std::int32_t element = 0; element < group.size(); ++element) {
      group.gather_history(element, current.element_history[index], before);
      sound = group.linearize(element, current.motion(), before, after, force, {}) && sound;
      group.scatter_history(element, after, current.element_history[index]);
    }
    repeat_in_padded_lanes(group, current.element_history[index]);
  }
  if (communicator.any(!sound))
    throw AnalysisError(fmt::format("step '{}' cannot start: the displacements of the linear steps before turn elements "
                                    "inside out; give those steps NLGEOM",
                                    step.name));
}

void Analysis::start_step(const Step& step) {
  kinetic_energy.reset();
  if (current.linear && !stays_linear(step)) leave_linear_geometry(step);
  apply_attachments(step);
  apply_interactions();
  for (std::size_t pair = 0; pair < contacts.size(); ++pair) {
    const bool active = std::ranges::count(step.active_contact_pairs, static_cast<std::int32_t>(pair)) > 0;
    const bool implicit = !std::holds_alternative<ExplicitProcedure>(step.procedure);
    if (changes_law(model, model.contact_pairs[pair], current.step)) {
      contacts[pair].forget_springs(implicit, current.contact[pair]);
      mesh_contacts[pair].forget_springs(implicit, current.contact[pair]);
    }
    mesh_contacts[pair].prepare(current.position.data(), implicit);
    mesh_contacts[pair].start_step(current.position.data(), active, current.contact[pair]);
    mesh_contacts[pair].choose_springs(current.position.data(), implicit, current.contact[pair]);
    const auto& contact = contacts[pair];
    if (contact.master_body() < 0) continue;
    const auto& master = current.rigid_bodies[contact.master_body()];
    contact.start_step(current.position.data(), master, active, current.contact[pair]);
    if (implicit)
      contact.choose_implicit_springs(current.position.data(), master, current.contact[pair]);
  }
}

void Analysis::apply_interactions() {
  for (std::size_t pair = 0; pair < contacts.size(); ++pair) {
    const auto& now = interaction_in_step(model, model.contact_pairs[pair], current.step);
    contacts[pair].set_interaction(now);
    mesh_contacts[pair].set_interaction(now);
  }
  follow_friction(current.step_time);
}

void Analysis::follow_friction(double step_time) {
  for (std::size_t pair = 0; pair < contacts.size(); ++pair) {
    const double friction = friction_in_step(model, model.contact_pairs[pair], current.step, step_time);
    contacts[pair].set_friction(friction);
    mesh_contacts[pair].set_friction(friction);
  }
}

bool Analysis::takes_part(const ElementGroup& group, std::int32_t element) const {
  if (current.step >= static_cast<std::int32_t>(model.steps.size())) return true;
  return !std::ranges::binary_search(model.steps[current.step].removed_elements, ElementRef{group.table(), group.row(element)});
}

bool Analysis::holds(std::int32_t constraint) const {
  if (current.step >= static_cast<std::int32_t>(model.steps.size())) return true;
  return !std::ranges::binary_search(model.steps[current.step].removed_constraints, constraint);
}

void Analysis::apply_attachments(const Step& step) {
  const auto position_of = [&](std::int32_t row) -> Point {
    // A node is on at least one rank; all ranks need its position because bodies are replicated.
    std::array<double, 4> found{0.0, 0.0, 0.0, 0.0};
    const auto node = domain.local_node[row];
    if (node >= 0 && domain.owned[node]) std::copy_n(&current.position[4 * node], 3, found.data());
    communicator.sum(std::span<double>(found));
    return {found[0], found[1], found[2]};
  };
  for (const auto& attachment : step.attachments) {
    auto& body = current.rigid_bodies[attachment.rigid_body];
    for (const auto row : attachment.nodes) {
      if (attachment.release)
        release(body, row);
      else
        attach(body, row, attachment.tie, position_of(row));
    }
  }
  index_rigid_nodes();
}

void Analysis::apply_mass_scale() {
  bool scaled = false;
  for (std::size_t index = 0; index < element_groups.size(); ++index) {
    element_groups[index]->set_mass_scale(current.mass_scale[index]);
    scaled = scaled || !current.mass_scale[index].empty();
  }
  if (communicator.any(scaled)) inertia_sums_.sum(element_groups, true, scaled_inertia_);
}

void Analysis::take_up_checkpoint() {
  const bool ended = current.step >= static_cast<std::int32_t>(model.steps.size());
  const bool implicit = ended || !std::holds_alternative<ExplicitProcedure>(model.steps[current.step].procedure);
  for (auto& contact : mesh_contacts) contact.prepare(current.position.data(), implicit);
  index_rigid_nodes();
  apply_mass_scale();
  const std::array of_rows{&current.multiplier, &current.guide_motion, &current.guide_locked};
  for (auto* values : of_rows) values->resize(static_cast<std::size_t>(first_constraint_row.back()), 0.0);
  std::size_t next = 0;
  for (std::size_t index = 0; index < constraints.size(); ++index) {
    if (next < local_constraints.size() && local_constraints[next] == static_cast<std::int32_t>(index))
      ++next;
    else  // other ranks keep them
      for (auto* values : of_rows)
        std::fill(values->begin() + first_constraint_row[index], values->begin() + first_constraint_row[index + 1], 0.0);
  }
}

void Analysis::index_rigid_nodes() {
  carrier_.assign(domain.size(), -1);
  reference_of_.assign(domain.size(), -1);
  turning_body_.assign(domain.size(), -1);
  for (std::size_t body = 0; body < current.rigid_bodies.size(); ++body) {
    const auto reference = domain.local_node[model.rigid_bodies[body].reference_node];
    if (reference >= 0) reference_of_[reference] = turning_body_[reference] = static_cast<std::int32_t>(body);
    for (const auto& carried : current.rigid_bodies[body].nodes) {
      const auto node = domain.local_node[carried.node];
      if (node < 0) continue;
      carrier_[node] = static_cast<std::int32_t>(body);
      if (carried.tie) turning_body_[node] = static_cast<std::int32_t>(body);
    }
  }
  find_acting_elements();
}

/// An element all whose nodes move, and turn if they do, with one rigid body cannot strain: it rests. One that holds a single node
/// strains against the ground, and a spring in a direction that does not turn strains in a body that does. What is out of the model or has failed rests too.
void Analysis::find_acting_elements() {
  const ElementFailures failures(element_groups);
  for (std::size_t index = 0; index < element_groups.size(); ++index) {
    const auto& group = element_groups[index];
    const bool turns = group->freedoms_per_node() > 3;
    const auto body_of = [&](std::int32_t node) {
      if (turns) return turning_body_[node];
      return carrier_[node] >= 0 ? carrier_[node] : reference_of_[node];
    };
    std::vector<bool> acting(static_cast<std::size_t>(group->size()), true);
    for (std::int32_t element = 0; element < group->size(); ++element) {
      const auto nodes = group->nodes(element);
      const auto body = body_of(nodes[0]);
      const auto& table = model.elements[group->table()];
      const bool strains = body < 0 || nodes.size() == 1 || strains_in_bodies(model.sections[table.section[group->row(element)]]) ||
                           !std::all_of(nodes.begin(), nodes.end(), [&](std::int32_t node) { return body_of(node) == body; });
      acting[element] = strains && takes_part(*group, element) && !failures.failed(index, element, current.element_history[index]);
    }
    group->set_acting(std::move(acting));
  }
}

void Analysis::place_rigid_nodes(std::vector<double>& position) const {
  for (std::size_t index = 0; index < current.rigid_bodies.size(); ++index) {
    const auto& body = current.rigid_bodies[index];
    const auto rotation = rotation_matrix(body);
    const auto reference = domain.local_node[model.rigid_bodies[index].reference_node];
    if (reference >= 0) std::copy_n(body.position.data(), 3, &position[4 * reference]);
    for (const auto& carried : body.nodes) {
      const auto node = domain.local_node[carried.node];
      if (node < 0) continue;
      const auto arm = rigid_arm(rotation, carried);
      for (int i = 0; i < 3; ++i) position[4 * node + i] = body.position[i] + arm[i];
    }
  }
}

}  // namespace balocco
