// The state at the instant of which output tells: explicit velocities are half an increment ahead of positions.
#pragma once

#include "analysis.hpp"

namespace balocco {

/// Time by which the state's velocities are ahead of its positions: half an explicit increment.
inline double lead(const Analysis& analysis) {
  const auto& steps = analysis.model.steps;
  const auto step = static_cast<std::size_t>(analysis.current.step);
  const bool is_explicit = step < steps.size() && std::holds_alternative<ExplicitProcedure>(steps[step].procedure);
  return is_explicit ? 0.5 * analysis.current.time_increment : 0.0;
}

/// Velocity at the present instant.
inline Point velocity_now(const Analysis& analysis, std::int32_t node) {
  const auto& state = analysis.current;
  Point velocity{};
  if (state.dynamic)
    for (int i = 0; i < 3; ++i)
      velocity[i] = state.velocity[4 * node + i] - lead(analysis) * analysis.acceleration[4 * node + i];
  return velocity;
}

/// Three components of a nodal array.
inline Point nodal_vector(const std::vector<double>& nodal, std::int32_t node) {
  return {nodal[4 * node], nodal[4 * node + 1], nodal[4 * node + 2]};
}

/// Angular velocity at the present instant.
inline Point spin_now(const Analysis& analysis, const Point& half_step, const Point& acceleration) {
  Point now = half_step;
  for (int i = 0; i < 3; ++i) now[i] -= lead(analysis) * acceleration[i];
  return now;
}

inline Point spin_of_node(const Analysis& analysis, std::int32_t node) {
  return spin_now(analysis, nodal_vector(analysis.current.angular_velocity, node), nodal_vector(analysis.angular_acceleration, node));
}

inline Point spin_of_body(const Analysis& analysis, std::int32_t body) {
  return spin_now(analysis, analysis.current.rigid_bodies[body].angular_velocity, analysis.body_angular_acceleration[body]);
}

/// Calls `visit(local node, output, contact point, master body)` for every slave node on this rank of every pair with a rigid master.
template <class Visit>
void for_each_contact_point(const Analysis& analysis, Visit visit) {
  for (std::size_t pair = 0; pair < analysis.contacts.size(); ++pair) {
    const auto& contact = analysis.contacts[pair];
    if (contact.size() == 0) continue;
    const auto& master = analysis.current.rigid_bodies[contact.master_body()];
    for (std::int32_t point = 0; point < contact.size(); ++point)
      visit(contact.nodes()[point],
            contact.output(point, analysis.current.position.data(), master, analysis.current.contact[pair][point]),
            analysis.current.contact[pair][point], master);
  }
}

}  // namespace balocco
