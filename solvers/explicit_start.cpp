#include "explicit_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/tensor.hpp"

namespace balocco {

namespace {

Vector3<double> vector(const double* p) {
  return {{p[0], p[1], p[2]}};
}
Vector3<double> vector(const Point& point) {
  return {point};
}

/// Sets what a line says of the velocity of one place; a rotation carries the velocity of its axis along.
void set_velocity(const InitialVelocity& initial, const Vector3<double>& position, double* velocity) {
  if (initial.kind == InitialVelocity::Kind::translation) {
    velocity[initial.dof] = initial.velocity[initial.dof];
    return;
  }
  const auto turning =
      initial.angular_speed * cross(vector(initial.axis_direction), position - vector(initial.axis_point));
  for (int c = 0; c < 3; ++c) velocity[c] = initial.velocity[c] + turning[c];
}

/// Spin that a rotation gives to whatever turns with it.
Vector3<double> spin_of(const InitialVelocity& rotation) {
  return rotation.angular_speed * vector(rotation.axis_direction);
}

void apply_to_bodies(Analysis& analysis, const InitialVelocity& initial, const std::vector<bool>& in_set) {
  for (std::size_t i = 0; i < analysis.current.rigid_bodies.size(); ++i) {
    auto& body = analysis.current.rigid_bodies[i];
    const bool all_nodes =
        !body.nodes.empty() && std::all_of(body.nodes.begin(), body.nodes.end(),
                                           [&](const RigidNode& carried) { return in_set[carried.node]; });
    if (!all_nodes && !in_set[analysis.model.rigid_bodies[i].reference_node]) continue;
    set_velocity(initial, vector(body.position), body.velocity.data());
    if (initial.kind == InitialVelocity::Kind::rotation)
      body.angular_velocity = spin_of(initial).component;
  }
}

/// Distance of a point from the axis of a rotation.
double radius(const InitialVelocity& rotation, const Vector3<double>& position) {
  const auto axis = vector(rotation.axis_direction);
  const auto arm = position - vector(rotation.axis_point);
  const auto across = arm - dot(arm, axis) * axis;
  return std::sqrt(dot(across, across));
}

/// Speed at which boundary conditions drive the reference node of a body across an axis; 0 if they do not.
double driven_speed(const Analysis& analysis, const Step& step, std::int32_t body, const Point& axis) {
  Vector3<double> velocity{};
  for (const auto& condition : step.boundary) {
    if (condition.node != analysis.model.rigid_bodies[body].reference_node || condition.dof >= 3) continue;
    if (condition.kind != BoundaryCondition::Kind::velocity) continue;
    velocity = velocity + condition.magnitude * vector(analysis.directions.direction(condition.node, condition.dof));
  }
  const auto across = velocity - dot(velocity, vector(axis)) * vector(axis);
  return std::sqrt(dot(across, across));
}

struct Radii {
  double loaded = 1e300, free = 0.0;
};

/// Radii about its axis of what a rotation turns of a contact pair's slave surface: of the nearest closed node, and of the farthest node.
Radii radii_of(const Analysis& analysis, std::int32_t pair, const InitialVelocity& rotation) {
  const auto& contact = analysis.contacts[pair];
  std::vector<bool> turns(static_cast<std::size_t>(analysis.model.nodes.size()), false);
  for (const auto row : rotation.nodes) turns[row] = true;
  Radii radii;
  for (std::int32_t point = 0; point < contact.size(); ++point) {
    if (!turns[analysis.domain.node_row[contact.nodes()[point]]]) continue;
    const double r = radius(rotation, vector(&analysis.current.position[4 * contact.nodes()[point]]));
    radii.free = std::max(radii.free, r);
    if (analysis.current.contact[pair][point].closed > 0.0) radii.loaded = std::min(radii.loaded, r);
  }
  return {analysis.communicator.minimum(radii.loaded), analysis.communicator.maximum(radii.free)};
}

}  // namespace

void apply_initial_velocities(Analysis& analysis) {
  auto& state = analysis.current;
  std::vector<bool> in_set;
  for (const auto& initial : analysis.model.initial_velocities) {
    in_set.assign(static_cast<std::size_t>(analysis.model.nodes.size()), false);
    for (const auto row : initial.nodes) {
      in_set[row] = true;
      const auto node = analysis.domain.local_node[row];
      if (node < 0) continue;
      set_velocity(initial, vector(&state.position[4 * node]), &state.velocity[4 * node]);
      if (initial.kind == InitialVelocity::Kind::rotation && node < analysis.domain.turning)
        std::copy_n(spin_of(initial).component.data(), 3, &state.angular_velocity[4 * node]);
    }
    apply_to_bodies(analysis, initial, in_set);
  }
}

void check_rolling_radius(const Analysis& analysis, const Step& step, Observer& observer) {
  for (const auto& initial : analysis.model.initial_velocities) {
    if (initial.kind != InitialVelocity::Kind::rotation || initial.angular_speed == 0.0) continue;
    for (const auto pair : step.active_contact_pairs) {
      const double speed = driven_speed(analysis, step, analysis.contacts[pair].master_body(), initial.axis_direction);
      const auto radii = radii_of(analysis, pair, initial);
      if (speed == 0.0 || radii.loaded >= radii.free) continue;
      // A belted tyre rolls on about its free radius less a third of its deflection (Dixon, Tires, Suspension and
      // Handling, 1996).
      const double rolling = radii.free - (radii.free - radii.loaded) / 3.0;
      const double given = speed / std::abs(initial.angular_speed);
      if (std::abs(given - rolling) <= 0.02 * rolling) continue;
      observer.log(
          fmt::format("warning: road speed {:.6g} / spin {:.6g} = {:.6g} does not fit the tyre: free radius {:.6g}, "
                      "loaded radius {:.6g}, "
                      "rolling radius about {:.6g}; a spin of {:.6g} would roll",
                      speed, initial.angular_speed, given, radii.free, radii.loaded, rolling,
                      std::copysign(speed / rolling, initial.angular_speed)));
    }
  }
}

}  // namespace balocco
