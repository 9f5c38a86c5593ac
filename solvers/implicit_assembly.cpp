// Residual and stiffness of ImplicitSystem: what each kind of force adds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "implicit_system.hpp"
#include "loads/body_load.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

Point cross_product(const double* a, const double* b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The step with every load as it stood when the step began.
Step with_initial_loads(const Step& step) {
  Step initial = step;
  const auto reset = [](auto& loads) {
    for (auto& load : loads) {
      load.magnitude = load.previous;
      load.amplitude = -1;
    }
  };
  reset(initial.concentrated_loads);
  reset(initial.surface_loads);
  reset(initial.body_loads);
  return initial;
}

}  // namespace

bool ImplicitSystem::assemble(const AssemblyRequest& request) {
  follow_faces();
  std::ranges::fill(residual_, 0.0);
  std::ranges::fill(external_, 0.0);
  force_sum_ = {};
  inverted_element_ = -1;
  stiffness_.start(request.motion);
  if (dynamics_) {
    dynamics_->follow();
    if (request.inertia) stiffness_.set_weight(dynamics_->tangent_weight());
  }

  bool sound = true;
  add_elements(request.increment, sound);
  if (!everywhere_sound(sound)) return false;
  add_loads(request);
  add_surface_load_stiffness(request);
  add_body_load_stiffness(request);
  add_follower_stiffness(request);
  if (dynamics_ && request.inertia) stiffness_.set_weight(dynamics_->contact_tangent_weight());
  analysis_.follow_friction(request.step_time);
  add_contact(request.contact_sticks);
  if (dynamics_ && request.inertia) stiffness_.set_weight(dynamics_->tangent_weight());
  guides_.aim(analysis_, request.step_time, request.total_time, request.initial_loads);
  add_constraints();
  add_stabilization(request);
  if (dynamics_) dynamics_->add_damping(&stiffness_, residual_);
  exchange_.sum(residual_);
  exchange_.sum(external_);
  for (std::size_t slot = 0; slot < residual_.size(); ++slot) residual_[slot] -= external_[slot];
  // A linear step keeps the arms of bodies as they were.
  if (!request.arms_turn || (dynamics_ && analysis_.current.linear)) stiffness_.set_weight(0.0);
  gather_at_bodies(residual_);
  if (!dynamics_) add_half_residual_turns();
  turn_into_slot_directions(residual_);
  if (dynamics_) add_dynamics(request);
  stiffness_.finish();

  analysis_.communicator.sum(std::span<double>(force_sum_));
  average_force_ = force_sum_[1] > 0.0 ? force_sum_[0] / force_sum_[1] : 0.0;
  for (const auto slot : map_.owned_slots()) sound = sound && std::isfinite(residual_[slot]);
  return everywhere_sound(sound);
}

/// Damping came with the forces; what is left are their weights, contact, and inertia.
void ImplicitSystem::add_dynamics(const AssemblyRequest& request) {
  forces_ = residual_;
  stiffness_.set_weight(request.inertia ? dynamics_->contact_tangent_weight() : 0.0);
  exchange_.sum(contact_force_);
  gather_at_bodies(contact_force_);
  turn_into_slot_directions(contact_force_);
  inertia_.assign(residual_.size(), 0.0);
  stiffness_.set_weight(request.inertia ? 1.0 : 0.0);
  dynamics_->add_inertia(&stiffness_, inertia_);
  for (std::size_t slot = 0; slot < inertia_.size(); ++slot) {
    force_sum_[0] += std::abs(inertia_[slot]) / lever_[slot];
    force_sum_[1] += inertia_[slot] != 0.0 ? 1.0 : 0.0;
  }
  dynamics_->add_body_stiffness(stiffness_);
  exchange_.sum(inertia_);
  if (analysis_.current.linear || dynamics_->finds_accelerations()) stiffness_.set_weight(0.0);
  gather_at_bodies(inertia_);
  turn_into_slot_directions(inertia_);
  if (!request.inertia) return;
  for (std::int32_t slot = 0; slot < map_.slots(); ++slot)
    residual_[slot] = dynamics_->weight() * forces_[slot] + dynamics_->old_weight() * dynamics_->old_forces()[slot] +
                      dynamics_->contact_weight() * contact_force_[slot] + inertia_[slot];
}

const std::vector<double>& ImplicitSystem::find_inertia() {
  inertia_.assign(residual_.size(), 0.0);
  dynamics_->add_inertia(nullptr, inertia_);
  exchange_.sum(inertia_);
  gather_at_bodies(inertia_, false);
  turn_into_slot_directions(inertia_);
  return inertia_;
}

bool ImplicitSystem::everywhere_sound(bool sound) {
  if (!analysis_.communicator.any(!sound)) return true;
  constexpr double none = std::numeric_limits<double>::max();
  const double local = inverted_element_ >= 0 ? static_cast<double>(inverted_element_) : none;
  const double id = analysis_.communicator.minimum(local);
  trouble_ = id < none ? fmt::format("element {:.0f} is inverted", id) : "a force is not a finite number";
  return false;
}

void ImplicitSystem::add_elements(double increment, bool& sound) {
  NodalMotion motion = analysis_.current.motion();
  motion.velocity = nullptr;
  motion.increment = increment;
  if (dynamics_) dynamics_->lend(motion);
  for (std::size_t group = 0; group < analysis_.element_groups.size(); ++group)
    for (std::int32_t element = 0; element < analysis_.element_groups[group]->size() && sound; ++element)
      if (analysis_.takes_part(*analysis_.element_groups[group], element)) add_element(group, element, motion, sound);
}

void ImplicitSystem::add_element(std::size_t index, std::int32_t element, const NodalMotion& motion, bool& sound) {
  const auto& group = *analysis_.element_groups[index];
  const auto nodes = group.nodes(element);
  const bool rigid = moves_as_one(group, element);
  const int freedoms = group.freedoms_per_node();
  force_.resize(freedoms * nodes.size());
  block_.resize(rigid ? 0 : force_.size() * force_.size());
  old_history_.resize(group.history_size());
  new_history_.resize(group.history_size());
  group.gather_history(element, analysis_.current.element_history[index], old_history_);
  if (!group.linearize(element, motion, old_history_, new_history_, force_, block_)) {
    inverted_element_ = analysis_.model.elements[group.table()].id[group.row(element)];
    sound = false;
    return;
  }
  group.scatter_history(element, new_history_, trial_history_[index]);
  if (!unstiffening_rows_[index].empty()) leave_out_initial_stress(index, element, motion);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int dof = 0; dof < freedoms; ++dof) {
      const auto slot = map_.slot(nodes[i], dof);
      const double component = force_[freedoms * i + dof];
      residual_[slot] += component;
      force_sum_[0] += std::abs(component) / lever_[slot];
    }
  force_sum_[1] += static_cast<double>(force_.size());
  if (!rigid) stiffness_.add(motions_of(group, element), block_);
}

/// Makes block_ the stiffness of the material alone: in steps of first order an initial stress is a force.
void ImplicitSystem::leave_out_initial_stress(std::size_t index, std::int32_t element, const NodalMotion& motion) {
  const auto& group = *analysis_.element_groups[index];
  other_force_.resize(force_.size());
  for (const int row : unstiffening_rows_[index]) old_history_[row] = 0.0;
  group.linearize(element, motion, old_history_, new_history_, other_force_, block_);
}

void ImplicitSystem::add_loads(const AssemblyRequest& request) {
  const auto nodes = analysis_.domain.size();
  nodal_.assign(4 * (nodes + 1), 0.0);  // a rounding constant of zero: plain sums
  nodal_moment_.assign(4 * analysis_.domain.turning, 0.0);
  const NodalForces nodal{nodal_.data(), nodal_moment_.data()};
  std::vector<Point> moments(analysis_.model.rigid_bodies.size());
  const double* position = analysis_.current.position.data();
  if (request.initial_loads)
    add_external_forces(analysis_, with_initial_loads(step_), 0.0, request.total_time, position, nodal,
                        moments);
  else
    add_external_forces(analysis_, step_, request.step_time, request.total_time, position, nodal, moments);
  for (std::int32_t node = 0; node < nodes; ++node)
    for (int axis = 0; axis < 3; ++axis) external_[map_.slot(node, axis)] += nodal_[4 * node + axis];
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node)
    for (int axis = 0; axis < 3; ++axis) external_[map_.slot(node, 3 + axis)] += nodal_moment_[4 * node + axis];
  for (std::size_t body = 0; body < moments.size(); ++body)
    for (int axis = 0; axis < 3; ++axis) {
      const auto slot = map_.rotation_slot(static_cast<std::int32_t>(body), axis);
      if (map_.owned(slot)) external_[slot] += moments[body][axis];
    }
}

/// Magnitude of a load at the instant that a request asks for.
template <class Load>
double ImplicitSystem::magnitude_of(const Load& load, const AssemblyRequest& request) const {
  if (request.initial_loads) return load.previous;
  return load_magnitude(analysis_.model, step_, load.previous, load.magnitude, load.amplitude, request.step_time,
                        request.total_time);
}

void ImplicitSystem::add_surface_load_stiffness(const AssemblyRequest& request) {
  constexpr std::size_t most = 3 * SurfaceLoading::most_nodes;
  std::array<double, most> force{};
  std::array<double, most * most> derivative{};
  for (const auto& load : step_.surface_loads) {
    const SurfaceLoading& loading = analysis_.loading(load);
    const double magnitude = request.load_stiffness ? -magnitude_of(load, request) : 0.0;  // of the residual, from which loads are taken
    for (std::int32_t item = 0; item < loading.size(); ++item) {
      loading.linearize(item, magnitude, analysis_.current.position.data(), force, derivative);
      const std::size_t size = 3 * loading.nodes(item).size();
      stiffness_.add(motions_of(loading.nodes(item)), std::span(derivative).first(size * size));
    }
  }
}

/// Centrifugal forces grow with the distance from their axis.
void ImplicitSystem::add_body_load_stiffness(const AssemblyRequest& request) {
  for_each_spun_node([&](std::int32_t node, const BodyLoad& load, double share) {
    const double magnitude = request.load_stiffness ? -magnitude_of(load, request) : 0.0;
    stiffness_.add(std::array{map_.motion(node)}, body_force_derivative(load, magnitude, share).component);
  });
}

std::optional<std::array<NodeMotion, 2>> ImplicitSystem::followed_motion(const ConcentratedLoad& load) const {
  const auto node = analysis_.domain.local_node[load.node];
  if (!load.follower || node < 0 || !analysis_.domain.owned[node]) return std::nullopt;
  const auto body = analysis_.reference_of(node);
  return std::array{map_.motion(node), body >= 0 ? map_.spin(body) : map_.nodal_spin(node)};
}

/// A spin changes a force that follows by spin x force.
void ImplicitSystem::add_follower_stiffness(const AssemblyRequest& request) {
  for (const auto& load : step_.concentrated_loads) {
    const auto motion = followed_motion(load);
    if (!motion) continue;
    const auto force = concentrated_vector(analysis_, load, request.load_stiffness ? magnitude_of(load, request) : 0.0);
    block_.assign(36, 0.0);
    for (int j = 0; j < 3; ++j) {
      Point spin{};
      spin[j] = 1.0;
      const auto change = cross_product(force.data(), spin.data());  // of the residual, from which loads are taken
      for (int i = 0; i < 3; ++i) block_[6 * (load.dof < 3 ? i : 3 + i) + 3 + j] = change[i];
    }
    stiffness_.add(*motion, block_);
  }
}

void ImplicitSystem::add_stabilization(const AssemblyRequest& request) {
  const double viscosity = request.viscosity;
  for (const auto slot : map_.owned_free_slots()) {
    const bool moves = !map_.is_multiplier(slot);
    const double damping = moves ? viscosity * mass_[slot] + request.regularization * lever_[slot] * lever_[slot] : 0.0;
    NodeMotion alone;
    alone.count = 1;
    alone.slots[0] = slot;
    alone.direction[0] = {1.0, 0.0, 0.0};
    stiffness_.add(std::span(&alone, 1), std::array{damping, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  }
  if (viscosity == 0.0) return;
  for (const auto slot : map_.owned_slots()) {
    if (map_.role(slot) == ImplicitDofMap::Role::absent || map_.is_multiplier(slot)) continue;
    residual_[slot] += viscosity * mass_[slot] * moved(slot)[slot % 3];
  }
}

/// Forces on carried nodes act on their body, with their moments; turning the body turns the arms.
void ImplicitSystem::gather_at_bodies(std::vector<double>& forces, bool with_stiffness) {
  const auto& bodies = analysis_.current.rigid_bodies;
  std::vector<double> sums(6 * bodies.size(), 0.0);
  std::vector<std::array<double, 9>> turning(bodies.size());
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    const auto body = analysis_.carrier(node);
    if (body < 0 || !analysis_.domain.owned[node]) continue;
    Point arm{};
    for (int i = 0; i < 3; ++i) arm[i] = analysis_.current.position[4 * node + i] - bodies[body].position[i];
    const double* force = &forces[map_.slot(node, 0)];
    const auto moment = cross_product(arm.data(), force);
    const double along = arm[0] * force[0] + arm[1] * force[1] + arm[2] * force[2];
    for (int i = 0; i < 3; ++i) {
      sums[6 * body + i] += force[i];
      sums[6 * body + 3 + i] += moment[i];
      // (spin x arm) x force = arm (spin . force) - spin (arm . force)
      for (int j = 0; j < 3; ++j) turning[body][3 * i + j] += arm[i] * force[j] - (i == j ? along : 0.0);
    }
  }
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node)
    if (const auto body = analysis_.turning_body(node); body >= 0 && analysis_.domain.owned[node])
      for (int i = 0; i < 3; ++i) sums[6 * body + 3 + i] += forces[map_.slot(node, 3 + i)];
  analysis_.communicator.sum(std::span<double>(sums));
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    const auto reference = analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node];
    for (int i = 0; i < 3; ++i) {
      forces[map_.slot(reference, i)] += sums[6 * body + i];
      forces[map_.rotation_slot(static_cast<std::int32_t>(body), i)] += sums[6 * body + 3 + i];
    }
    if (with_stiffness) stiffness_.add(std::array{map_.spin(static_cast<std::int32_t>(body))}, turning[body]);
  }
}

/// What makes the tangent of turning nodes and bodies symmetric (implicit_dof_map.hpp); it vanishes with the residual.
void ImplicitSystem::add_half_residual_turns() {
  for_each_spin([&](const NodeMotion& spin, std::int32_t first_slot) {
    const double *m = &residual_[first_slot], weight = analysis_.current.linear ? 0.0 : 0.5;
    stiffness_.add(std::array{spin}, std::array{0.0, -weight * m[2], weight * m[1], weight * m[2], 0.0, -weight * m[0],
                                                -weight * m[1], weight * m[0], 0.0});
  });
}

void ImplicitSystem::turn_into_slot_directions(std::vector<double>& forces) const {
  const auto turn = [&](std::int32_t first_slot, const Matrix3<double>& axes) {
    const auto turned =
        axes * Vector3<double>{{forces[first_slot], forces[first_slot + 1], forces[first_slot + 2]}};
    for (int i = 0; i < 3; ++i) forces[first_slot + i] = turned[i];
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    if (!map_.has_own_directions(node)) continue;
    turn(map_.slot(node, 0), map_.directions(node));
    if (node < analysis_.domain.turning) turn(map_.slot(node, 3), map_.directions(node));
    if (const auto body = analysis_.reference_of(node); body >= 0)
      turn(map_.rotation_slot(body, 0), map_.directions(node));
  }
  for (std::int32_t slot = 0; slot < map_.slots(); ++slot)
    if (map_.role(slot) == ImplicitDofMap::Role::absent) forces[slot] = 0.0;
}

}  // namespace balocco
