#include "explicit_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "constraints/rigid_body.hpp"
#include "loads/body_load.hpp"
#include "math/rotation.hpp"
#include "step_driver.hpp"
#include "vectors.hpp"

namespace balocco {

namespace {

/// Components along the degrees of freedom of a global pair (translation, rotation), and back.
Vector6 along(const Matrix3<double>& axes, const Vector3<double>& translation, const Vector3<double>& rotation) {
  return pair_of(axes * translation, axes * rotation);
}

struct Pair {
  Vector3<double> translation, rotation;
};

Pair global(const Matrix3<double>& axes, const Vector6& components) {
  const auto back = transpose(axes);
  return {back * components.translation(), back * components.rotation()};
}

}  // namespace

RigidDynamics::RigidDynamics(const Analysis& analysis, const Step& step) : step_(step) {
  const Model& model = analysis.model;
  bodies_.resize(model.rigid_bodies.size());
  sums_.resize(6 * bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    auto& body = bodies_[i];
    const auto row = model.rigid_bodies[i].reference_node;
    body.reference = analysis.domain.local_node[row];
    if (const auto* axes = analysis.directions.find(row)) body.axes = *axes;
    add_nodes(analysis, i);
  }
  for (const auto& condition : step.boundary) {
    const auto node = analysis.domain.local_node[condition.node];
    if (node < 0) continue;
    if (const auto index = analysis.reference_of(node); index >= 0) {
      bodies_[index].condition[condition.dof] = &condition;
      bodies_[index].is_free = false;
    }
  }
  for (auto& body : bodies_)
    if (body.is_free) body.axes = Matrix3<double>::identity();  // what is free has no directions of its own
  sum_gravity(analysis);
  renew_inertia(analysis);
}

void RigidDynamics::renew_inertia(const Analysis& analysis) {
  if (bodies_.empty()) return;
  sum_inertia(analysis);
  add_rotary_inertia(analysis);
  refuse_massless(analysis);
  for (auto& body : bodies_) {
    body.inertia_now = {};
    if (body.is_free) invert_free(body);
  }
}

void RigidDynamics::add_nodes(const Analysis& analysis, std::size_t index) {
  auto& body = bodies_[index];
  const auto& domain = analysis.domain;
  const auto& state = analysis.current.rigid_bodies[index];
  orients_.resize(static_cast<std::size_t>(domain.turning), false);
  const auto add = [&](std::int32_t node, bool turns, const Point& offset) {
    constexpr double alike = 1e-9;
    const auto differ = [&](const auto& of_body, const std::vector<double>& nodal) {
      for (std::size_t c = 0; c < of_body.size(); ++c)
        if (!(std::abs(of_body[c] - nodal[4 * static_cast<std::size_t>(node) + c]) < alike)) return true;
      return false;
    };
    const bool oriented = turns && !differ(state.orientation, analysis.current.orientation) && !differ(state.rotation, analysis.current.rotation);
    if (turns) orients_[node] = oriented;
    body.nodes.push_back({node, domain.owned[node], turns, oriented, offset});
  };
  add(body.reference, body.reference < domain.turning, {});
  for (const auto& carried : state.nodes) {
    body.reach = std::max(body.reach, std::sqrt(dot(vector_of(carried.offset), vector_of(carried.offset))));
    if (const auto node = domain.local_node[carried.node]; node >= 0) add(node, carried.tie && node < domain.turning, carried.offset);
  }
  body.pushed = body.active = body.nodes.size();
}

void RigidDynamics::rest_nodes(const Analysis& analysis, const Uses& uses) {
  std::vector<double> pushed(bodies_.size(), 0.0);  // on any rank
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (std::ranges::any_of(bodies_[i].nodes, [&](const CarriedNode& carried) { return uses.pushed[carried.node]; })) pushed[i] = 1.0;
  for (const auto& contact : analysis.contacts)
    if (contact.master_body() >= 0) pushed[contact.master_body()] = 1.0;
  analysis.communicator.maximum(std::span<double>(pushed));
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].is_pushed = pushed[i] > 0.0;
  for (auto& body : bodies_) {
    const auto is_pushed = [&](const CarriedNode& carried) {
      return carried.node == body.reference || uses.pushed[carried.node] || carried.turns != carried.oriented;
    };
    const auto first_asked = std::stable_partition(body.nodes.begin(), body.nodes.end(), is_pushed);
    const auto is_asked = [&](const CarriedNode& carried) { return uses.asked[carried.node]; };
    body.pushed = static_cast<std::size_t>(first_asked - body.nodes.begin());
    body.active = static_cast<std::size_t>(std::stable_partition(first_asked, body.nodes.end(), is_asked) - body.nodes.begin());
  }
}

void RigidDynamics::bring_resting_nodes(Analysis& analysis, double increment) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::span nodes(bodies_[i].nodes);
    place(analysis, analysis.current.rigid_bodies[i], nodes.subspan(bodies_[i].active));
    set_node_velocities(analysis, i, increment, nodes.subspan(bodies_[i].pushed));
  }
}

void RigidDynamics::sum_gravity(const Analysis& analysis) {
  for (const auto& load : step_.body_loads) {
    if (load.kind != BodyLoad::Kind::gravity) continue;
    const auto& share = analysis.loaded_share(load);
    std::vector<ExactSum> sums(4 * bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (const auto& carried : bodies_[i].nodes) {
        if (!carried.owned) continue;
        sums[4 * i].add(share[carried.node]);
        for (std::size_t c = 0; c < 3; ++c) sums[4 * i + 1 + c].add(share[carried.node] * carried.offset[c]);
      }
    analysis.communicator.sum(std::span<ExactSum>(sums));
    auto& gravity = gravity_.emplace_back(Gravity{.load = &load, .mass = {}, .first_moment = {}});
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      gravity.mass.push_back(sums[4 * i].value());
      gravity.first_moment.push_back({{sums[4 * i + 1].value(), sums[4 * i + 2].value(), sums[4 * i + 3].value()}});
    }
  }
}

void RigidDynamics::find_weights(const Analysis& analysis, const Instant& instant) {
  for (auto& body : bodies_) body.weight = {};
  for (const auto& [load, mass, first_moment] : gravity_) {
    const double magnitude =
        load_magnitude(analysis.model, step_, load->previous, load->magnitude, load->amplitude, instant.step_time, instant.total_time);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto& state = analysis.current.rigid_bodies[i];
      const auto pull = body_force(*load, magnitude, 1.0, state.position.data());
      bodies_[i].weight += pair_of(mass[i] * pull, cross(rotation_matrix(state) * first_moment[i], pull));
    }
  }
}

RigidDynamics::Motion RigidDynamics::motion(const Analysis& analysis, const Body& body, std::size_t index) const {
  const auto& state = analysis.current.rigid_bodies[index];
  const auto& origin = analysis.model.nodes.coordinates[analysis.model.rigid_bodies[index].reference_node];
  return {along(body.axes, vector_of(state.position) - vector_of(origin), vector_of(state.rotation)),
          along(body.axes, vector_of(state.velocity), vector_of(state.angular_velocity))};
}

void RigidDynamics::refuse_jumps(const Analysis& analysis) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto now = motion(analysis, bodies_[i], i);
    for (int dof = 0; dof < 6; ++dof)
      if (const auto* condition = bodies_[i].condition[dof])
        refuse_jump(analysis.model, *condition, now.displacement[dof]);
  }
}

void RigidDynamics::set_initial_velocities(Analysis& analysis, const Instant& instant) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    auto& state = analysis.current.rigid_bodies[i];
    const auto now = motion(analysis, bodies_[i], i);
    Vector6 velocity = now.velocity;
    for (int dof = 0; dof < 6; ++dof)
      if (const auto* condition = bodies_[i].condition[dof])
        velocity[dof] = prescribed_initial_velocity(analysis.model, step_, *condition, instant,
                                                    {now.displacement[dof], now.velocity[dof]});
    const auto [translation, rotation] = global(bodies_[i].axes, velocity);
    state.velocity = translation.component;
    state.angular_velocity = rotation.component;
    set_node_velocities(analysis, i, 0.0, bodies_[i].nodes);
  }
}

bool RigidDynamics::is_held_still(const Analysis& analysis, std::size_t index, const Instant& instant) const {
  const Body& body = bodies_[index];
  const auto is_free = [](const BoundaryCondition* condition) { return condition == nullptr; };
  if (std::ranges::any_of(body.condition, is_free)) return false;
  const Motion now = motion(analysis, body, index);
  return now.velocity == Vector6{} && prescribed(analysis, body, now, instant) == Vector6{};
}

void RigidDynamics::add_body_forces(const Analysis& analysis, const NodalForces& forces, std::size_t index,
                                    std::span<ExactSum, 6> sums) const {
  const auto rotation = rotation_matrix(analysis.current.rigid_bodies[index]);
  for (const auto& [node, owned, turns, oriented, offset] : std::span(bodies_[index].nodes).first(bodies_[index].pushed)) {
    if (!owned) continue;
    if (turns)
      for (int c = 0; c < 3; ++c) sums[3 + c].add(forces.moment[4 * static_cast<std::ptrdiff_t>(node) + c]);
    const auto nodal = vector_of(forces.force + 4 * static_cast<std::ptrdiff_t>(node));
    if (nodal.component == Point{}) continue;  // as of many where constraints alone pull
    const auto moment = cross(rotation * vector_of(offset), nodal);
    for (int c = 0; c < 3; ++c) {
      sums[c].add(nodal[c]);
      sums[3 + c].add(moment[c]);
    }
  }
}

void RigidDynamics::sum_forces(const Analysis& analysis, const NodalForces& forces, const std::vector<Point>& moments,
                               const Instant& instant, Which which) {
  const auto sums_of = [&](const Body& body) {
    return std::span<ExactSum, 6>(&sums_[6 * static_cast<std::size_t>(body.sum)], 6);
  };
  find_weights(analysis, instant);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    auto& body = bodies_[i];
    body.needs_force = which == Which::all || !is_held_still(analysis, i, instant);
    body.sum = body.needs_force && body.is_pushed ? count++ : -1;
    if (body.sum < 0) continue;
    for (auto& sum : sums_of(body)) sum.clear();
    add_body_forces(analysis, forces, i, sums_of(body));
  }
  for (const auto pair : step_.active_contact_pairs) {
    const auto& contact = analysis.contacts[pair];
    if (contact.master_body() < 0) continue;
    const auto master = static_cast<std::size_t>(contact.master_body());
    if (bodies_[master].sum < 0) continue;
    contact.add_master_resultant(analysis.current.position.data(), analysis.current.rigid_bodies[master],
                                 analysis.current.contact[pair], sums_of(bodies_[master]));
  }
  if (count > 0) analysis.communicator.sum(std::span(sums_).first(6 * static_cast<std::size_t>(count)));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    auto& body = bodies_[i];
    body.force = {};
    if (!body.needs_force) continue;
    Vector6 force;
    for (std::size_t c = 0; body.sum >= 0 && c < 6; ++c) force[c] = sums_of(body)[c].value();
    body.force = along(body.axes, force.translation() + body.weight.translation(),
                       force.rotation() + vector_of(moments[i]) + body.weight.rotation());
  }
}

Vector6 RigidDynamics::prescribed(const Analysis& analysis, const Body& body, const Motion& now,
                                  const Instant& instant) const {
  Vector6 velocity = now.velocity;
  for (int dof = 0; dof < 6; ++dof)
    if (const auto* condition = body.condition[dof])
      velocity[dof] =
          prescribed_velocity(analysis.model, step_, *condition, instant, {now.displacement[dof], now.velocity[dof]});
  return velocity;
}

RigidDynamics::NewMotion RigidDynamics::motion_under(const Analysis& analysis, std::size_t index, const Vector6& force,
                                                     const Instant& instant) const {
  const auto& body = bodies_[index];
  const auto& state = analysis.current.rigid_bodies[index];
  NewMotion result;
  if (body.is_free) {
    result.old_velocity = velocity(analysis, index);
    result.response = solve_free(state, body, force, result.old_velocity, instant);
    result.velocity = result.old_velocity + instant.average() * result.response.acceleration;
    return result;
  }
  const auto now = motion(analysis, body, index);
  const auto wanted = prescribed(analysis, body, now, instant);
  result.old_velocity = now.velocity;
  result.response = solve(state, body, force, now.velocity, instant, wanted);
  result.velocity = now.velocity + instant.average() * result.response.acceleration;
  for (int dof = 0; dof < 6; ++dof)
    if (body.condition[dof] != nullptr) result.velocity[dof] = wanted[dof];
  return result;
}

void RigidDynamics::accelerate(Analysis& analysis, const Instant& instant, const std::vector<Point>& moments) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    auto& body = bodies_[i];
    auto& state = analysis.current.rigid_bodies[i];
    const auto [old_velocity, velocity, response] = motion_under(analysis, i, body.force, instant);
    body.acceleration = response.acceleration;
    body.reaction = response.reaction;
    body.spin = response.spin;
    const auto [translation, rotation] = global(body.axes, velocity);
    state.velocity = translation.component;
    state.angular_velocity = rotation.component;

    const Vector6 path = instant.previous * old_velocity + instant.next * velocity;
    const auto [way, turn] = global(body.axes, path);
    analysis.current.nodal_work[body.reference].external +=
        0.5 * (dot(body.reaction, path) + dot(vector_of(moments[i]), turn) + dot(body.weight, pair_of(way, turn)));
    set_node_velocities(analysis, i, instant.next, std::span(body.nodes).first(body.pushed));
  }
}

void RigidDynamics::set_node_velocities(Analysis& analysis, std::size_t index, double increment, std::span<const CarriedNode> nodes) const {
  const auto& state = analysis.current.rigid_bodies[index];
  const auto spin = vector_of(state.angular_velocity);
  const bool has_arms = nodes.size() > 1 || (nodes.size() == 1 && nodes.front().node != bodies_[index].reference);
  const auto in_the_middle = has_arms ? rotation_matrix(turned(state.orientation, 0.5 * increment * spin)) : Matrix3<double>{};
  for (const auto& carried : nodes) {
    const auto turning = cross(spin, in_the_middle * vector_of(carried.offset));
    for (int c = 0; c < 3; ++c) analysis.current.velocity[4 * carried.node + c] = state.velocity[c] + turning[c];
    if (carried.turns) std::ranges::copy(state.angular_velocity, &analysis.current.angular_velocity[4 * carried.node]);
  }
}

void RigidDynamics::advance(Analysis& analysis, double increment) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    auto& state = analysis.current.rigid_bodies[i];
    for (int c = 0; c < 3; ++c) state.position[c] += increment * state.velocity[c];
    rotate(state, (increment * vector_of(state.angular_velocity)).component);
    place(analysis, state, std::span(bodies_[i].nodes).first(bodies_[i].active));
  }
}

void RigidDynamics::place(Analysis& analysis, const RigidBodyState& state, std::span<const CarriedNode> nodes) const {
  const auto rotation = rotation_matrix(state);
  for (const auto& carried : nodes) {
    const auto arm = rotation * vector_of(carried.offset);
    for (int c = 0; c < 3; ++c) analysis.current.position[4 * carried.node + c] = state.position[c] + arm[c];
    if (!carried.oriented) continue;
    std::ranges::copy(state.orientation, &analysis.current.orientation[4 * carried.node]);
    std::ranges::copy(state.rotation, &analysis.current.rotation[4 * carried.node]);
  }
}

void RigidDynamics::add_to_output(Analysis& analysis, const Instant& instant, const std::vector<Point>& moments) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto& body = bodies_[i];
    const auto [force, moment] = global(body.axes, body.reaction);
    const auto& state = analysis.current.rigid_bodies[i];
    const double power =
        dot(force + body.weight.translation(), vector_of(state.velocity)) +
        dot(moment + vector_of(moments[i]) + body.weight.rotation(), vector_of(state.angular_velocity));
    analysis.work_ahead[body.reference].external += 0.5 * instant.next * power;
    analysis.body_reaction[i] = {force[0], force[1], force[2], moment[0], moment[1], moment[2]};
    const auto [linear, angular] = global(body.axes, body.acceleration);
    analysis.body_angular_acceleration[i] = angular.component;
    const auto rotation = rotation_matrix(state);
    for (const auto& carried : body.nodes) {
      const auto arm = rotation * vector_of(carried.offset);
      const auto acceleration = linear + cross(angular, arm) + cross(body.spin, cross(body.spin, arm));
      std::copy_n(acceleration.component.data(), 3, &analysis.acceleration[4 * carried.node]);
      if (carried.turns) std::ranges::copy(angular.component, &analysis.angular_acceleration[4 * carried.node]);
    }
  }
}

RigidDynamics::Balance RigidDynamics::balance() const {
  Balance balance;
  for (const auto& body : bodies_) {
    balance.gravity += dot(body.weight.translation(), body.weight.translation());
    for (int dof = 0; dof < 6; ++dof) {
      const bool is_moment = dof >= 3;
      if (is_moment && body.reach == 0.0) continue;
      const double scale = is_moment ? 1.0 / body.reach : 1.0;
      const double squared = scale * scale * body.force[dof] * body.force[dof];
      (body.condition[dof] != nullptr ? balance.reactions : balance.unbalanced) += squared;
    }
  }
  return balance;
}

}  // namespace balocco
