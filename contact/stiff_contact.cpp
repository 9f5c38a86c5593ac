// Springs stiffer than an explicit cycle could follow: their forces are found together with the motion that they cause.
#include <algorithm>
#include <cmath>

#include "master_frame.hpp"
#include "rigid_contact.hpp"

namespace balocco {

namespace {

/// What is left of a vector in the directions in which a point is free.
Vector3<double> free_part(const SlaveFreedom& freedom, Vector3<double> vector) {
  for (int i = 0; i < freedom.held; ++i) {
    const Vector3<double> direction{freedom.direction[i]};
    vector = vector - dot(vector, direction) * direction;
  }
  return vector;
}

/// `across`: displacement of a free point per force. A held direction stiffens the tangential plane along its shadow there, two leave
/// it soft along the shadow of the third.
TangentialYielding tangential_yielding(const SlaveFreedom& freedom, const Vector3<double>& normal, double across) {
  if (freedom.held == 0) return {.across = across};
  const Vector3<double> first{freedom.direction[0]};
  const auto kept = freedom.held == 1 ? first : cross(first, Vector3<double>{freedom.direction[1]});
  const auto shadow = kept - dot(kept, normal) * normal;
  const double square = dot(shadow, shadow);
  TangentialYielding yielding{.along = freedom.held == 1 ? across * (1.0 - square) : across * square,
                              .across = freedom.held == 1 ? across : 0.0};
  if (square > 1e-20) yielding.axis = (1.0 / std::sqrt(square)) * shadow;
  return yielding;
}

}  // namespace

/// A stiff point on its way over the cycle, seen from the master body: global directions, without the force of its own contact.
struct RigidContact::StiffMotion {
  Vector3<double> arm, old_velocity, new_velocity;
  double previous = 0.0, next = 0.0;  // increments
  double average = 0.0;               // time over which the force of the instant changes the velocity
  double yielding = 0.0;              // velocity per force

  StiffMotion(const MasterFrame& frame, const StiffCycle& cycle, const RigidBodyState& master, const SlaveFreedom& freedom,
              std::ptrdiff_t at, const double* force)
      : arm(frame.arm(cycle.position + at)), previous(cycle.previous), next(cycle.next), average(0.5 * (previous + next)) {
    const double* const v = cycle.velocity + at;
    const auto below = Vector3<double>{master.velocity} + cross(Vector3<double>{master.angular_velocity}, arm);
    const Vector3<double> now{v[0], v[1], v[2]};
    yielding = average * freedom.inverse_mass;
    auto then = free_part(freedom, now + yielding * Vector3<double>{force[0], force[1], force[2]});
    for (int i = 0; i < freedom.held; ++i) then = then + freedom.velocity[i] * Vector3<double>{freedom.direction[i]};
    old_velocity = now - below;
    new_velocity = then - below;
  }
};

void RigidContact::forget_springs(bool implicit, std::vector<ContactPoint>& points) const {
  for (std::int32_t i = 0; i < size(); ++i) {
    points[i].multiplier = points[i].stiff_spring = points[i].stiff_force = 0.0;
    points[i].stiff_friction = {};
    points[i].implicit_spring = implicit ? implicit_spring(i) : 0.0;
  }
}

void RigidContact::choose_implicit_springs(const double* position, const RigidBodyState& master,
                                           std::vector<ContactPoint>& points) const {
  const MasterFrame frame(master);
  for (std::int32_t i = 0; i < size(); ++i) change_springs(frame, position, i, {0.0, implicit_spring(i)}, points[i]);
}

void RigidContact::choose_springs(const double* position, const RigidBodyState& master, const std::vector<bool>& stiff,
                                  std::vector<ContactPoint>& points) const {
  const MasterFrame frame(master);
  for (std::int32_t i = 0; i < size(); ++i)
    change_springs(frame, position, i, {stiff[i] ? stiff_factor * stiffness_[i] : 0.0, 0.0}, points[i]);
}

void RigidContact::change_springs(const MasterFrame& frame, const double* position, std::int32_t i, const Springs& springs,
                                  ContactPoint& point) const {
  if (springs.stiff == point.stiff_spring && springs.implicit == point.implicit_spring) return;
  const auto place = frame.inverse * frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]));
  if (is_soft()) return choose_soft_spring(i, place, springs.implicit, point);
  if (point.closed > 0.0)
    keep_force(i, place, springs, point);
  else if (springs.stiff > 0.0 && !surface_.surely_outside(place))
    point.multiplier = std::min(0.0, springs.stiff * surface_.nearest(place).distance);  // below the surface it begins down there
  point.stiff_spring = springs.stiff;
  point.implicit_spring = springs.implicit;
}

/// In implicit steps the law is the force. An explicit one goes on with what its straight part lacks as a multiplier.
void RigidContact::choose_soft_spring(std::int32_t i, const Vector3<double>& place, double spring, ContactPoint& point) const {
  point.stiff_spring = 0.0;
  point.implicit_spring = spring;
  point.multiplier = 0.0;
  if (is_curved() && spring == 0.0 && point.closed > 0.0)
    point.multiplier = std::max(0.0, parameters(i, point).lacking_force(surface_.nearest(place).distance));
}

/// The anchor is where the spring starts along the surface, and as high above it as statics left the point.
void RigidContact::keep_force(std::int32_t i, const Vector3<double>& place, const Springs& springs, ContactPoint& point) const {
  const auto nearest = surface_.nearest(place);
  const auto acting = acting_force(i, place, point);
  point.stiff_spring = springs.stiff;
  point.implicit_spring = springs.implicit;
  const auto law = parameters(i, point);
  // Negative where a soft spring holds the node below the surface: the stiff one then begins down there.
  point.multiplier = acting.pressure + law.stiffness * nearest.distance;
  point.stiff_force = acting.pressure;
  point.stiff_friction = acting.friction.component;
  const double stiffness = tangential_stiffness(law, law.sliding_limit(acting.pressure));
  auto anchor = place - std::min(0.0, nearest.distance) * nearest.normal;
  if (stiffness > 0.0) anchor = anchor + (1.0 / stiffness) * acting.friction;
  point.anchor = anchor.component;
}

void RigidContact::add_stiff_forces(const StiffCycle& cycle, const RigidBodyState& master,
                                    std::span<const SlaveFreedom> freedom, std::vector<ContactPoint>& points,
                                    double* force) const {
  for (std::int32_t i = 0; i < size(); ++i)
    if (points[i].stiff_spring > 0.0) add_stiff_force(i, cycle, master, freedom[i], points[i], force);
}

void RigidContact::add_stiff_force(std::int32_t point, const StiffCycle& cycle, const RigidBodyState& master,
                                   const SlaveFreedom& freedom, ContactPoint& state, double* force) const {
  const MasterFrame frame(master);
  const auto at = 4 * static_cast<std::ptrdiff_t>(nodes_[point]);
  double* sum = force + at;
  StiffMotion motion(frame, cycle, master, freedom, at, sum);
  const auto place = frame.inverse * motion.arm;
  if (state.closed == 0.0 && surface_.surely_outside(place) &&
      surface_.surely_outside(frame.inverse * (motion.arm + (0.5 * motion.average) * motion.new_velocity))) {
    open(state, place);
    return;
  }
  const auto nearest = surface_.nearest(place);
  const auto normal = frame.rotation * nearest.normal;
  const auto free_normal = free_part(freedom, normal);
  // Not half of either increment but half of the time over which the force acts: so it gives the energy that the spring loses even
  // where the increment changes.
  const double half = 0.5 * motion.average;
  const double before = nearest.distance - half * dot(motion.old_velocity, normal);
  const double after = nearest.distance + half * dot(motion.new_velocity, normal);
  // An open spring holds no energy: where the start of a step, or another increment, finds it below the surface it begins down there.
  if (state.closed == 0.0) state.multiplier = std::min(state.multiplier, state.stiff_spring * before);
  const double old_pressure = state.stiff_force;
  state.stiff_force = stiff_normal_force(state.multiplier, state.stiff_spring, before, after,
                                         half * motion.yielding * dot(free_normal, normal));
  motion.new_velocity = motion.new_velocity + (motion.yielding * state.stiff_force) * free_normal;
  if (friction_ > 0.0) advance_stiff_friction(point, frame, motion, freedom, nearest, old_pressure, state);
  if (!(state.stiff_force > 0.0)) {
    // What began below the surface goes on from the highest place to which it has risen.
    const double highest = state.multiplier < 0.0 ? std::max(state.multiplier, state.stiff_spring * nearest.distance) : 0.0;
    open(state, place);
    state.multiplier = std::min(0.0, highest);
    return;
  }
  state.closed = 1.0;
  // A multiplier from statics ends as the point rises above where it was found, so that nothing pushes across a gap.
  const double rise = std::min(nearest.distance, dot(place - Vector3<double>{state.anchor}, nearest.normal));
  if (rise > 0.0) state.multiplier = std::max(0.0, state.multiplier - state.stiff_spring * rise);
  const auto global = state.stiff_force * normal + frame.rotation * Vector3<double>{state.stiff_friction};
  for (int k = 0; k < 3; ++k) sum[k] += rounded(global[k], sum[3]);
}

/// What friction does over the increment before, half with its old force, half with the new one, and what leaves its spring, is
/// dissipated: so the balance of energies closes exactly.
void RigidContact::advance_stiff_friction(std::int32_t point, const MasterFrame& frame, const StiffMotion& motion, const SlaveFreedom& freedom,
                                          const SurfacePoint<double>& nearest, double old_pressure,
                                          ContactPoint& state) const {
  const PenaltyParameters law = parameters(point, state);
  const double limit = law.sliding_limit(state.stiff_force), old_limit = law.sliding_limit(old_pressure);
  const Vector3<double> old_friction{state.stiff_friction};
  Vector3<double> friction{};
  if (state.stiff_force > 0.0) {
    const auto place = frame.inverse * motion.arm;
    const auto foot = place - nearest.distance * nearest.normal;
    if (state.closed == 0.0) state.anchor = foot.component;  // it sticks where it comes down
    auto stretch = foot - Vector3<double>{state.anchor} + frame.inverse * (motion.next * motion.new_velocity);
    stretch = stretch - dot(stretch, nearest.normal) * nearest.normal;
    const auto normal = frame.rotation * nearest.normal;
    auto yielding = tangential_yielding(freedom, normal, motion.next * motion.yielding);
    yielding.axis = frame.inverse * yielding.axis;
    const auto found = stiff_friction(limit, tangential_stiffness(law, limit), stretch, yielding);
    friction = found.force;
    state.anchor = (Vector3<double>{state.anchor} + found.slip).component;
    state.slip += std::sqrt(dot(found.slip, found.slip));
  }
  state.frictional_dissipation -= 0.5 * dot(old_friction + friction, frame.inverse * (motion.previous * motion.old_velocity)) +
                                  tangential_energy(law, limit, friction) -
                                  tangential_energy(law, old_limit, old_friction);
  state.stiff_friction = friction.component;
}

/// Force of a point whose history `state` is up to date.
ContactForce<double> RigidContact::acting_force(std::int32_t point, const Vector3<double>& place,
                                                const ContactPoint& state) const {
  ContactPoint scratch = state;
  if (state.stiff_spring == 0.0) return contact_force(surface_, parameters(point, state), place, scratch);
  ContactForce<double> contact;
  contact.closed = state.closed > 0.0;
  if (!contact.closed) return contact;
  contact.pressure = state.stiff_force;
  contact.normal = contact.pressure * surface_.nearest(place).normal;
  contact.friction = Vector3<double>{state.stiff_friction};
  const auto law = parameters(point, state);
  contact.tangential_stiffness = tangential_stiffness(law, law.sliding_limit(contact.pressure));
  return contact;
}

}  // namespace balocco
