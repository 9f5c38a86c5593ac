#include "alpha_method.hpp"

#include <algorithm>
#include <limits>

#include "constraints/rigid_body.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

using Three = Vector3<double>;

Three three(const double* p) { return {{p[0], p[1], p[2]}}; }
void put(const Three& vector, double* p) { std::ranges::copy(vector.component, p); }

Quaternion<double> quaternion(std::span<const double> q) { return {q[0], q[1], q[2], q[3]}; }

/// The matrix of a cross product: cross(a, b) = skew(a) b.
Matrix3<double> skew(const Three& a) { return {{0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0}}; }

/// Sum of mass * r x (b r), given the sum of mass * r r^T.
Three moment_of(const Matrix3<double>& b, const Matrix3<double>& second) {
  const auto product = b * second;
  return {{product(2, 1) - product(1, 2), product(0, 2) - product(2, 0), product(1, 0) - product(0, 1)}};
}

constexpr Point unit(int axis) {
  Point e{};
  e[static_cast<std::size_t>(axis)] = 1.0;
  return e;
}

}  // namespace

AlphaMethod::AlphaMethod(Analysis& analysis, const ImplicitDofMap& map, double alpha, bool contact)
    : analysis_(analysis),
      map_(map),
      alpha_(alpha),
      beta_(contact ? 0.5 * (0.5 - alpha) : 0.25 * (1.0 - alpha) * (1.0 - alpha)),
      gamma_(0.5 - alpha),
      old_forces_(static_cast<std::size_t>(map.slots())),
      body_(analysis.current.rigid_bodies.size()),
      second_moment_(body_.size()),
      first_moment_(body_.size()) {
  const auto nodes = static_cast<std::size_t>(analysis.domain.size());
  for (auto* values : {&velocity_, &acceleration_, &spin_, &spin_acceleration_}) values->assign(4 * (nodes + 1), 0.0);
  auto& state = analysis.current;
  state.alpha_memory.resize(nodes);
  state.alpha_memory_of_spins.resize(static_cast<std::size_t>(analysis.domain.turning));
  state.alpha_memory_of_bodies.resize(body_.size());
  for (std::size_t body = 0; body < body_.size(); ++body)
    for (const auto& carried : state.rigid_bodies[body].nodes) {
      const auto node = analysis.domain.local_node[carried.node];
      if (node < 0 || !analysis.domain.owned[node]) continue;
      const Three arm{carried.offset};
      first_moment_[body] = first_moment_[body] + analysis.inertia.mass[node] * arm;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) second_moment_[body](i, j) += analysis.inertia.mass[node] * arm[i] * arm[j];
    }
}

void AlphaMethod::advance(const Configuration& start, double increment) {
  start_ = start;
  increment_ = increment;
  weight_ = tangent_weight_ = 1.0 + alpha_;
  old_weight_ = -alpha_;
  mass_tangent_ = 1.0 / (beta_ * increment * increment);
  velocity_tangent_ = gamma_ / (beta_ * increment);
  acceleration_factor_ = {mass_tangent_, -1.0 / (beta_ * increment), 1.0 - 0.5 / beta_};
  velocity_factor_ = {velocity_tangent_, 1.0 - gamma_ / beta_, increment * (1.0 - 0.5 * gamma_ / beta_)};
  gather_start();
}

void AlphaMethod::stand(const Configuration& start, double increment) {
  start_ = start;
  increment_ = increment;
  weight_ = 1.0;
  old_weight_ = 0.0;
  // An increment in which even the stiffest mode hardly moves: what has no mass keeps in step with what has.
  tangent_weight_ = 1e-12 * increment * increment;
  mass_tangent_ = 1.0;
  velocity_tangent_ = 0.0;
  acceleration_factor_ = {};
  velocity_factor_ = {0.0, 1.0, 0.0};
  gather_start();
}

void AlphaMethod::hold(const Configuration& start) {
  stand(start, 0.0);
  acceleration_factor_ = {0.0, 0.0, 1.0};
}

/// Forces of the last increment, from nodes to slots.
void AlphaMethod::gather_start() {
  const auto& state = analysis_.current;
  const auto copy = [&](const AlphaMemory& memory, std::int32_t slot) {
    std::ranges::copy(memory.force, &old_forces_[static_cast<std::size_t>(slot)]);
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) copy(state.alpha_memory[node], map_.slot(node, 0));
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node) copy(state.alpha_memory_of_spins[node], map_.slot(node, 3));
  for (std::size_t body = 0; body < body_.size(); ++body)
    copy(state.alpha_memory_of_bodies[body], map_.rotation_slot(static_cast<std::int32_t>(body), 0));
}

AlphaMethod::Three AlphaMethod::acceleration_of(const Three& moved, const Three& velocity, const Three& acceleration) const {
  const auto& [by_motion, by_velocity, by_acceleration] = acceleration_factor_;
  return by_motion * moved + by_velocity * velocity + by_acceleration * acceleration;
}

AlphaMethod::Three AlphaMethod::velocity_of(const Three& moved, const Three& velocity, const Three& acceleration) const {
  const auto& [by_motion, by_velocity, by_acceleration] = velocity_factor_;
  return by_motion * moved + by_velocity * velocity + by_acceleration * acceleration;
}

/// `turned`: sum of the increment's spins, which is what a linear step knows of it.
AlphaMethod::Spinning AlphaMethod::spinning(std::span<const double> orientation, std::span<const double> start_orientation,
                                            const Point& turned, const Spinning& start) const {
  if (analysis_.current.linear)
    return {velocity_of(Three{turned}, start.velocity, start.acceleration), acceleration_of(Three{turned}, start.velocity, start.acceleration)};
  const auto q = quaternion(orientation), q0 = quaternion(start_orientation);
  const auto rotation = rotation_vector(product(q, {q0[0], -q0[1], -q0[2], -q0[3]}));
  const auto back = transpose(rotation_matrix(q0)), forth = rotation_matrix(q);
  const auto moved = back * rotation, velocity = back * start.velocity, acceleration = back * start.acceleration;
  return {forth * velocity_of(moved, velocity, acceleration), forth * acceleration_of(moved, velocity, acceleration)};
}

void AlphaMethod::follow() {
  const auto& state = analysis_.current;
  const bool spins_matter = !state.linear;
  for (std::size_t body = 0; body < body_.size(); ++body) {
    const auto &now = state.rigid_bodies[body], &before = start_.bodies[body];
    const Point turned{now.rotation[0] - before.rotation[0], now.rotation[1] - before.rotation[1], now.rotation[2] - before.rotation[2]};
    body_[body] = spinning(now.orientation, before.orientation, turned,
                           {Three{before.angular_velocity}, Three{state.alpha_memory_of_bodies[body].acceleration}});
  }
  const auto follow_node = [&](std::int32_t node) {
    const auto at = 4 * static_cast<std::size_t>(node);
    const auto moved = three(&state.position[at]) - three(&start_.position[at]);
    const auto body = analysis_.reference_of(node);
    const auto velocity = body >= 0 ? Three{start_.bodies[body].velocity} : three(&state.velocity[at]);
    const Three acceleration{state.alpha_memory[node].acceleration};
    put(velocity_of(moved, velocity, acceleration), &velocity_[at]);
    put(acceleration_of(moved, velocity, acceleration), &acceleration_[at]);
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node)
    if (analysis_.carrier(node) < 0) follow_node(node);
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    const auto at = 4 * static_cast<std::size_t>(node);
    if (const auto body = analysis_.carrier(node); body >= 0) {
      const auto reference = 4 * static_cast<std::size_t>(analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node]);
      const auto& [spin, rate] = body_[body];
      const auto arm = three(&state.position[at]) - Three{state.rigid_bodies[body].position};
      put(three(&velocity_[reference]) + cross(spin, arm), &velocity_[at]);
      auto acceleration = three(&acceleration_[reference]) + cross(rate, arm);
      if (spins_matter) acceleration = acceleration + cross(spin, cross(spin, arm));
      put(acceleration, &acceleration_[at]);
    }
    const auto turner = analysis_.turning_body(node);
    if (turner < 0 && node >= analysis_.domain.turning) continue;
    Spinning own;
    if (turner >= 0) {
      own = body_[turner];
    } else {
      const Point turned{state.rotation[at] - start_.rotation[at], state.rotation[at + 1] - start_.rotation[at + 1],
                         state.rotation[at + 2] - start_.rotation[at + 2]};
      own = spinning(std::span(state.orientation).subspan(at, 4), std::span(start_.orientation).subspan(at, 4), turned,
                     {three(&state.angular_velocity[at]), Three{state.alpha_memory_of_spins[node].acceleration}});
    }
    put(own.velocity, &spin_[at]);
    put(own.acceleration, &spin_acceleration_[at]);
  }
}

void AlphaMethod::lend(NodalMotion& motion) const {
  motion.velocity = velocity_.data();
  motion.angular_velocity = spin_.data();
  // Where nothing has moved velocities are known all the same, and that is what a slope says.
  motion.velocity_slope = std::max(velocity_tangent_, std::numeric_limits<double>::min());
}

void AlphaMethod::record(InertiaKind kind, ImplicitStiffness& stiffness) const {
  std::vector<NodeMotion> motions;
  for_each_inertia(analysis_, kind, [&](std::span<const Inertial> freedoms, auto) {
    motions.clear();
    for (const auto freedom : freedoms) motions.push_back(motion_of(analysis_, map_, freedom));
    stiffness.add(motions, {});
  });
}

void AlphaMethod::record_damping(ImplicitStiffness& stiffness) const { record(InertiaKind::damping, stiffness); }

void AlphaMethod::record_inertia(ImplicitStiffness& stiffness) const {
  record(InertiaKind::mass, stiffness);
  for (std::size_t body = 0; body < body_.size(); ++body) {
    const auto index = static_cast<std::int32_t>(body);
    const auto reference = analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node];
    stiffness.add(std::array{map_.motion(reference), map_.spin(index)}, {});
  }
}

/// Block * motion of its freedoms to the forces, tangent * block to the stiffness; of spins also the gyroscopic moment.
void AlphaMethod::add_forces(InertiaKind kind, ImplicitStiffness* stiffness, double tangent, std::span<double> force) const {
  const bool is_mass = kind == InertiaKind::mass, spins_matter = is_mass && !analysis_.current.linear;
  std::vector<NodeMotion> motions;
  std::vector<double> scaled;
  for_each_inertia(analysis_, kind, [&](std::span<const Inertial> freedoms, std::span<const double> block) {
    const std::size_t size = 3 * freedoms.size();
    motions.clear();
    scaled.assign(block.begin(), block.end());
    for (double& entry : scaled) entry *= tangent;
    for (std::size_t a = 0; a < freedoms.size(); ++a) {
      const auto body = freedoms[a].spins ? analysis_.reference_of(freedoms[a].node) : -1;
      const auto slot = body >= 0 ? map_.rotation_slot(body, 0) : map_.slot(freedoms[a].node, freedoms[a].spins ? 3 : 0);
      for (std::size_t b = 0; b < freedoms.size(); ++b) {
        const auto& moving = freedoms[b].spins ? (is_mass ? spin_acceleration_ : spin_) : (is_mass ? acceleration_ : velocity_);
        const double* const rate = &moving[4 * static_cast<std::size_t>(freedoms[b].node)];
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) force[slot + i] += block[size * (3 * a + i) + 3 * b + j] * rate[j];
      }
      motions.push_back(motion_of(analysis_, map_, freedoms[a]));
      if (!freedoms[a].spins || !spins_matter) continue;
      Matrix3<double> inertia;
      std::ranges::copy(block, inertia.component.begin());
      const auto spin = three(&spin_[4 * static_cast<std::size_t>(freedoms[a].node)]);
      const auto rate = three(&spin_acceleration_[4 * static_cast<std::size_t>(freedoms[a].node)]);
      const auto moment = cross(spin, inertia * spin);
      for (int i = 0; i < 3; ++i) force[slot + i] += moment[i];
      // d(I rate + spin x I spin): the tensor turns, and the spin changes.
      if (finds_accelerations()) continue;
      const auto turned = (-1.0) * skew(inertia * rate) + inertia * skew(rate) + skew(spin) * ((-1.0) * skew(inertia * spin) + inertia * skew(spin));
      const auto gyroscopic = velocity_tangent_ * (skew(spin) * inertia - skew(inertia * spin));
      for (int i = 0; i < 9; ++i) scaled[i] += turned.component[i] + gyroscopic.component[i];
    }
    if (stiffness != nullptr) stiffness->add(motions, scaled);
  });
}

void AlphaMethod::add_damping(ImplicitStiffness* stiffness, std::span<double> force) const {
  add_forces(InertiaKind::damping, stiffness, velocity_tangent_, force);
}

void AlphaMethod::add_inertia(ImplicitStiffness* stiffness, std::span<double> force) const {
  add_forces(InertiaKind::mass, stiffness, mass_tangent_, force);
}

/// Derivatives of the carried masses' forces by the turning of their arms, and of centripetal accelerations by the spin.
void AlphaMethod::add_body_stiffness(ImplicitStiffness& stiffness) const {
  std::array<double, 36> block{};
  for (std::size_t body = 0; body < body_.size(); ++body) {
    block.fill(0.0);
    if (!analysis_.current.linear && !finds_accelerations()) {
      const auto rotation = rotation_matrix(analysis_.current.rigid_bodies[body]);
      const auto first = rotation * first_moment_[body];
      const auto second = rotation * second_moment_[body] * transpose(rotation);
      const auto& [spin, rate] = body_[body];
      const auto by_arm = skew(rate) + skew(spin) * skew(spin);
      for (int k = 0; k < 3; ++k) {
        const auto turn = skew(Three{unit(k)});
        const auto change = by_arm * turn + velocity_tangent_ * (turn * skew(spin) + skew(spin) * turn);
        const auto force = change * first, moment = moment_of(change, second);
        for (int i = 0; i < 3; ++i) {
          block[6 * i + 3 + k] = force[i];
          block[6 * (3 + i) + 3 + k] = moment[i];
        }
      }
    }
    const auto index = static_cast<std::int32_t>(body);
    const auto reference = analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node];
    stiffness.add(std::array{map_.motion(reference), map_.spin(index)}, block);
  }
}

Point AlphaMethod::slot_components(std::span<const double> slots, std::int32_t first) const {
  return {slots[first], slots[first + 1], slots[first + 2]};
}

/// Forces that the next increment takes a share of, and accelerations for it and for output.
void AlphaMethod::remember(std::span<const double> forces) {
  auto& state = analysis_.current;
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    const auto at = 4 * static_cast<std::size_t>(node);
    state.alpha_memory[node] = {three(&acceleration_[at]).component, slot_components(forces, map_.slot(node, 0))};
    std::copy_n(&acceleration_[at], 3, &analysis_.acceleration[at]);
  }
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node) {
    const auto at = 4 * static_cast<std::size_t>(node);
    state.alpha_memory_of_spins[node] = {three(&spin_acceleration_[at]).component, slot_components(forces, map_.slot(node, 3))};
    std::copy_n(&spin_acceleration_[at], 3, &analysis_.angular_acceleration[at]);
  }
  for (std::size_t body = 0; body < body_.size(); ++body) {
    const auto first = map_.rotation_slot(static_cast<std::int32_t>(body), 0);
    state.alpha_memory_of_bodies[body] = {body_[body].acceleration.component, slot_components(forces, first)};
    analysis_.body_angular_acceleration[body] = body_[body].acceleration.component;
  }
  analysis_.output_increment = 0.0;
  find_kinetic_energy();
}

void AlphaMethod::commit(std::span<const double> forces) {
  auto& state = analysis_.current;
  std::ranges::copy(velocity_, state.velocity.begin());
  std::copy_n(spin_.begin(), state.angular_velocity.size(), state.angular_velocity.begin());
  for (std::size_t body = 0; body < body_.size(); ++body) {
    const auto reference = analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node];
    state.rigid_bodies[body].velocity = three(&velocity_[4 * static_cast<std::size_t>(reference)]).component;
    state.rigid_bodies[body].angular_velocity = body_[body].velocity.component;
  }
  remember(forces);
}

void AlphaMethod::commit_accelerations(std::span<const double> slots, std::span<const double> forces) {
  const auto global = [&](const NodeMotion& motion) {
    Three sum{};
    for (int k = 0; k < motion.count; ++k) sum = sum + slots[motion.slots[k]] * Three{motion.direction[k]};
    return sum;
  };
  for (std::size_t body = 0; body < body_.size(); ++body) body_[body].acceleration = global(map_.spin(static_cast<std::int32_t>(body)));
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    const auto at = 4 * static_cast<std::size_t>(node);
    auto acceleration = global(map_.motion(node));
    // What a body carries has its centripetal acceleration beside, which follow() found with the others at rest.
    if (analysis_.carrier(node) >= 0) acceleration = acceleration + three(&acceleration_[at]);
    put(acceleration, &acceleration_[at]);
    if (node < analysis_.domain.turning) put(global(map_.nodal_spin(node)), &spin_acceleration_[at]);
  }
  remember(forces);
}

std::vector<double> AlphaMethod::prediction() const {
  const auto& state = analysis_.current;
  std::vector<double> slots(static_cast<std::size_t>(map_.slots()), 0.0);
  const double h = increment_, half = 0.5 * h * h;
  const auto put_slots = [&](std::int32_t first, const Three& velocity, const Three& acceleration) {
    const auto motion = map_.directions(map_.node_of(first)) * (h * velocity + half * acceleration);
    std::ranges::copy(motion.component, &slots[static_cast<std::size_t>(first)]);
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    if (analysis_.carrier(node) >= 0) continue;
    const auto body = analysis_.reference_of(node);
    put_slots(map_.slot(node, 0), body >= 0 ? Three{state.rigid_bodies[body].velocity} : three(&state.velocity[4 * node]),
              Three{state.alpha_memory[node].acceleration});
  }
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node)
    if (analysis_.turning_body(node) < 0)
      put_slots(map_.slot(node, 3), three(&state.angular_velocity[4 * node]), Three{state.alpha_memory_of_spins[node].acceleration});
  for (std::size_t body = 0; body < body_.size(); ++body)
    put_slots(map_.rotation_slot(static_cast<std::int32_t>(body), 0), Three{state.rigid_bodies[body].angular_velocity},
              Three{state.alpha_memory_of_bodies[body].acceleration});
  return slots;
}

void AlphaMethod::find_kinetic_energy() const {
  double energy = 0.0;
  for_each_inertia(analysis_, InertiaKind::mass, [&](std::span<const Inertial> freedoms, std::span<const double> block) {
    const std::size_t size = 3 * freedoms.size();
    const auto rate = [&](std::size_t a) {
      return &(freedoms[a].spins ? spin_ : velocity_)[4 * static_cast<std::size_t>(freedoms[a].node)];
    };
    for (std::size_t a = 0; a < freedoms.size(); ++a)
      for (std::size_t b = 0; b < freedoms.size(); ++b)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) energy += 0.5 * rate(a)[i] * block[size * (3 * a + i) + 3 * b + j] * rate(b)[j];
  });
  analysis_.kinetic_energy = energy;
}

}  // namespace balocco
