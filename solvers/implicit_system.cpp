#include "implicit_system.hpp"

#include <algorithm>
#include <iterator>
#include <cmath>

#include "constraints/rigid_body.hpp"
#include "elements/element_type.hpp"
#include "elements/initial_stress_rows.hpp"
#include "math/rotation.hpp"
#include "model/bounding_box.hpp"
#include "model/rigid_constraints.hpp"

namespace balocco {

ImplicitSystem::ImplicitSystem(Analysis& analysis, const Step& step, std::span<const std::int32_t> prescribed)
    : analysis_(analysis),
      step_(step),
      map_(analysis, prescribed),
      exchange_(map_, analysis.communicator),
      stiffness_(map_, analysis.communicator),
      guides_(analysis, step),
      residual_(map_.slots()),
      external_(map_.slots()) {
  for (auto slot = map_.first_multiplier(); slot < map_.slots(); ++slot)
    if (map_.role(slot) == ImplicitDofMap::Role::absent) analysis_.current.multiplier[map_.constraint_row(slot)] = 0.0;
  if (const auto* dynamic = std::get_if<DynamicProcedure>(&step.procedure))
    dynamics_ = std::make_unique<AlphaMethod>(analysis, map_, dynamic->alpha, has_contact());
  for (const auto& group : analysis.element_groups)
    unstiffening_rows_.push_back(unstiffening_rows(*group, step));
  analysis_.apply_interactions();
  find_levers();
  find_stabilizing_masses();
  guides_.begin_increment(analysis_);
  guides_.start_motions(analysis_);
  guides_.aim(analysis_, analysis_.current.step_time, analysis_.current.total_time, analysis_.current.step_time == 0.0);
  begin_increment();
  record_pattern();
}

/// History that is a force alone, without stiffness: thermal strain about the reference configuration, and an initial stress there unless
/// modes ask for what it stiffens.
std::vector<int> ImplicitSystem::unstiffening_rows(const ElementGroup& group, const Step& step) const {
  if (!analysis_.current.linear) return {};
  auto rows = thermal_strain_rows(group);
  if (!step.is_perturbation()) std::ranges::copy(initial_stress_rows(analysis_.model, group), std::back_inserter(rows));
  return rows;
}

void ImplicitSystem::find_levers() {
  model_size_ = balocco::model_size(analysis_.model);
  lever_.assign(map_.slots(), 1.0);
  for (std::size_t body = 0; body < analysis_.current.rigid_bodies.size(); ++body) {
    double arm = 0.0;
    for (const auto& node : analysis_.current.rigid_bodies[body].nodes)
      arm = std::max(arm, std::hypot(node.offset[0], node.offset[1], node.offset[2]));
    std::fill_n(lever_.begin() + map_.rotation_slot(static_cast<std::int32_t>(body), 0), 3,
                arm > 0.0 ? arm : model_size_);
  }
  const auto& model = analysis_.model;
  const auto& domain = analysis_.domain;
  std::vector<double> longest(domain.turning, 0.0);
  for (const auto& table : model.elements) {
    if (!table.type->turns) continue;
    const int count = table.type->nodes;
    for (std::size_t first = 0; first < table.connectivity.size(); first += count)
      for (int i = 0; i < count; ++i) {
        const auto node = domain.local_node[table.connectivity[first + i]];
        const auto &a = model.nodes.coordinates[table.connectivity[first + i]],
                   &b = model.nodes.coordinates[table.connectivity[first + (i + 1) % count]];
        if (node >= 0) longest[node] = std::max(longest[node], std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
      }
  }
  for (std::int32_t node = 0; node < domain.turning; ++node)
    std::fill_n(lever_.begin() + map_.slot(node, 3), 3, longest[node] > 0.0 ? longest[node] : model_size_);
}

void ImplicitSystem::find_stabilizing_masses() {
  mass_.assign(map_.slots(), 0.0);
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node)
    std::fill_n(mass_.begin() + 3 * node, 3, analysis_.inertia.mass[node]);
  std::array<double, 2> sum{};
  for (const auto slot : map_.owned_slots())
    if (mass_[slot] > 0.0) {
      sum[0] += mass_[slot];
      sum[1] += 1.0;
    }
  analysis_.communicator.sum(std::span<double>(sum));
  const double average = sum[1] > 0.0 ? sum[0] / sum[1] : 1.0;
  for (std::int32_t slot = 0; slot < map_.slots(); ++slot)
    if (mass_[slot] == 0.0) mass_[slot] = average * lever_[slot] * lever_[slot];
}

std::span<const NodeMotion> ImplicitSystem::motions_of(std::span<const std::int32_t> nodes) {
  motions_.clear();
  for (const auto node : nodes) motions_.push_back(map_.motion(node));
  return motions_;
}

std::span<const NodeMotion> ImplicitSystem::motions_of(const ElementGroup& group, std::int32_t element) {
  if (group.freedoms_per_node() == 3) return motions_of(group.nodes(element));
  motions_.clear();
  for (const auto node : group.nodes(element)) {
    motions_.push_back(map_.motion(node));
    motions_.push_back(map_.nodal_spin(node));
  }
  return motions_;
}

/// But see Analysis::find_acting_elements().
bool ImplicitSystem::moves_as_one(const ElementGroup& group, std::int32_t element) const {
  const auto nodes = group.nodes(element);
  const auto body = analysis_.carrier(nodes[0]);
  const bool turns = group.freedoms_per_node() == 6;
  const auto& table = analysis_.model.elements[group.table()];
  if (body < 0 || nodes.size() == 1 || strains_in_bodies(analysis_.model.sections[table.section[group.row(element)]])) return false;
  return std::ranges::all_of(nodes, [&](std::int32_t node) {
           return analysis_.carrier(node) == body && (!turns || analysis_.turning_body(node) == body);
         });
}

/// Visits every block of the assembly once, in its order: see the functions that add values.
void ImplicitSystem::record_pattern() {
  for (const auto& group : analysis_.element_groups)
    for (std::int32_t element = 0; element < group->size(); ++element)
      if (analysis_.takes_part(*group, element) && !moves_as_one(*group, element)) stiffness_.add(motions_of(*group, element), {});
  for (const auto& load : step_.surface_loads)
    for (std::int32_t item = 0; item < analysis_.loading(load).size(); ++item) stiffness_.add(motions_of(analysis_.loading(load).nodes(item)), {});
  for_each_spun_node([&](std::int32_t node, const BodyLoad&, double) { stiffness_.add(std::array{map_.motion(node)}, {}); });
  for (const auto& load : step_.concentrated_loads)
    if (const auto motion = followed_motion(load)) stiffness_.add(*motion, {});
  record_contact();
  record_constraints();
  for (const auto slot : map_.owned_free_slots()) {
    NodeMotion alone;
    alone.count = 1;
    alone.slots[0] = slot;
    stiffness_.add(std::span(&alone, 1), {});
  }
  const auto record_bodies = [&] {
    for (std::size_t body = 0; body < analysis_.model.rigid_bodies.size(); ++body)
      stiffness_.add(std::array{map_.spin(static_cast<std::int32_t>(body))}, {});
  };
  if (dynamics_) dynamics_->record_damping(stiffness_);
  record_bodies();
  if (!dynamics_) for_each_spin([&](const NodeMotion& spin, std::int32_t) { stiffness_.add(std::array{spin}, {}); });
  if (dynamics_) {
    record_bodies();  // of contact
    dynamics_->record_inertia(stiffness_);
    record_bodies();
  }
  stiffness_.finish_pattern();
}

void ImplicitSystem::move(std::span<const double> increment, double factor) {
  auto& state = analysis_.current;
  const auto global = [&](std::int32_t first_slot, std::int32_t node) -> Point {
    const auto& axes = map_.directions(node);
    Point vector{};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) vector[i] += axes(k, i) * (factor * increment[first_slot + k]);
    return vector;
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    if (analysis_.carrier(node) >= 0) continue;
    const auto displacement = global(map_.slot(node, 0), node);
    for (int i = 0; i < 3; ++i) state.position[4 * node + i] += displacement[i];
    const auto body = analysis_.reference_of(node);
    if (body < 0) continue;
    std::copy_n(&state.position[4 * node], 3, state.rigid_bodies[body].position.begin());
    rotate(state.rigid_bodies[body], global(map_.rotation_slot(body, 0), node));
  }
  analysis_.place_rigid_nodes(state.position);
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node) {
    const auto first = map_.first_spin_slot(node);
    const auto spin = global(first, map_.node_of(first));
    double* const q = &state.orientation[4 * node];
    const auto now = turned(Quaternion<double>{q[0], q[1], q[2], q[3]}, {spin});
    std::ranges::copy(now, q);
    for (int i = 0; i < 3; ++i) state.rotation[4 * node + i] += spin[i];
  }
  for (auto slot = map_.first_multiplier(); slot < map_.slots(); ++slot)
    state.multiplier[map_.constraint_row(slot)] += factor * increment[slot];
}

double ImplicitSystem::displacement(std::int32_t slot) const {
  if (map_.is_multiplier(slot)) return analysis_.current.multiplier[map_.constraint_row(slot)];
  const auto node = map_.node_of(slot);
  Point vector{};
  if (const auto body = map_.body_of(slot); body >= 0) {
    vector = analysis_.current.rigid_bodies[body].rotation;
  } else if (map_.is_rotation(slot)) {
    std::copy_n(&analysis_.current.rotation[4 * node], 3, vector.begin());
  } else {
    const auto& reference = analysis_.model.nodes.coordinates[analysis_.domain.node_row[node]];
    for (int i = 0; i < 3; ++i) vector[i] = analysis_.current.position[4 * node + i] - reference[i];
  }
  const auto axis = slot % 3;
  const auto& axes = map_.directions(node);
  return axes(axis, 0) * vector[0] + axes(axis, 1) * vector[1] + axes(axis, 2) * vector[2];
}

Point ImplicitSystem::moved(std::int32_t slot) const {
  const auto& state = analysis_.current;
  const auto node = map_.node_of(slot);
  const auto body = map_.body_of(slot);
  Point change{};
  for (int i = 0; i < 3; ++i) {
    if (body >= 0)
      change[i] = state.rigid_bodies[body].rotation[i] - start_.bodies[body].rotation[i];
    else if (map_.is_rotation(slot))
      change[i] = state.rotation[4 * node + i] - start_.rotation[4 * node + i];
    else
      change[i] = state.position[4 * node + i] - start_.position[4 * node + i];
  }
  return change;
}

Configuration ImplicitSystem::configuration() const {
  const auto& state = analysis_.current;
  return {state.position, state.orientation, state.rotation, state.rigid_bodies, state.multiplier};
}

Configuration ImplicitSystem::reference() const {
  auto result = configuration();
  const auto bodies = initial_rigid_bodies(analysis_.model);
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    const auto body = analysis_.reference_of(node);
    const auto& place = body >= 0 ? bodies[body].position : analysis_.model.nodes.coordinates[analysis_.domain.node_row[node]];
    std::ranges::copy(place, &result.position[4 * node]);
  }
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    result.bodies[body].position = bodies[body].position;
    result.bodies[body].orientation = bodies[body].orientation;
    result.bodies[body].rotation = {};
  }
  std::ranges::fill(result.rotation, 0.0);
  std::ranges::fill(result.multiplier, 0.0);
  for (std::size_t i = 0; i < result.orientation.size(); ++i) result.orientation[i] = i % 4 == 0 ? 1.0 : 0.0;
  return result;
}

void ImplicitSystem::displace(std::span<const double> displacement) {
  restore(reference());
  auto& state = analysis_.current;
  const auto add = [&](const NodeMotion& motion, double* sum) {
    for (int k = 0; k < motion.count; ++k)
      for (int i = 0; i < 3; ++i) sum[i] += motion.direction[k][i] * displacement[motion.slots[k]];
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) add(map_.motion(node), &state.position[4 * node]);
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node) {
    double* const rotation = &state.rotation[4 * node];
    add(map_.nodal_spin(node), rotation);
    std::ranges::copy(exponential(Vector3<double>{{rotation[0], rotation[1], rotation[2]}}), &state.orientation[4 * node]);
  }
  for (std::size_t body = 0; body < state.rigid_bodies.size(); ++body) {
    const auto reference = analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node];
    Point spin{};
    add(map_.spin(static_cast<std::int32_t>(body)), spin.data());
    rotate(state.rigid_bodies[body], spin);
    std::copy_n(&state.position[4 * reference], 3, state.rigid_bodies[body].position.begin());
  }
  for (auto slot = map_.first_multiplier(); slot < map_.slots(); ++slot)
    state.multiplier[map_.constraint_row(slot)] = displacement[slot];
}

void ImplicitSystem::restore(const Configuration& configuration) {
  analysis_.current.position = configuration.position;
  analysis_.current.orientation = configuration.orientation;
  analysis_.current.rotation = configuration.rotation;
  analysis_.current.rigid_bodies = configuration.bodies;
  analysis_.current.multiplier = configuration.multiplier;
}

void ImplicitSystem::begin_increment() {
  start_ = configuration();
  trial_history_ = analysis_.current.element_history;
  start_contact_ = analysis_.current.contact;
  trial_contact_ = analysis_.current.contact;
  slips_.resize(start_contact_.size());
  for (std::size_t pair = 0; pair < slips_.size(); ++pair) slips_[pair].assign(start_contact_[pair].size(), {});
  guides_.begin_increment(analysis_);
  guides_.guess(analysis_);
}

void ImplicitSystem::begin_iteration() {
  for (auto& points : slips_)
    for (auto& point : points) point.before = point.turns_back() ? Vector3<double>{} : point.now;
}

void ImplicitSystem::commit() {
  analysis_.current.element_history = trial_history_;
  analysis_.current.contact = trial_contact_;
  if (dynamics_) lower_multipliers();
  for (std::size_t group = 0; group < analysis_.element_groups.size(); ++group)
    repeat_in_padded_lanes(*analysis_.element_groups[group], analysis_.current.element_history[group]);
}

}  // namespace balocco
