#include "explicit_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/rigid_body.hpp"
#include "rolling_start.hpp"
#include "vectors.hpp"

namespace balocco {

namespace {

/// The undeformed model's, as every place in a deck.
RotationAxis axis_in_deck(const InitialVelocity& rotation) {
  return {vector_of(rotation.axis_point), vector_of(rotation.axis_direction)};
}

/// Distance of a point from an axis.
double radius(const RotationAxis& axis, const Vector3<double>& position) {
  const auto arm = position - axis.point;
  const auto across = arm - dot(arm, axis.direction) * axis.direction;
  return std::sqrt(dot(across, across));
}

/// Where the axis is now: a rigid body in the set on whose reference node it lies carries it along.
RotationAxis axis_now(const Analysis& analysis, const InitialVelocity& rotation) {
  constexpr double on_the_axis = 1e-3;  // of the largest radius
  auto axis = axis_in_deck(rotation);
  double largest = 0.0;
  for (const auto row : rotation.nodes) largest = std::max(largest, radius(axis, vector_of(analysis.model.nodes.coordinates[row])));
  const auto start = initial_rigid_bodies(analysis.model);
  for (std::size_t i = 0; i < start.size(); ++i) {
    const auto hub = vector_of(start[i].position);
    if (std::ranges::count(rotation.nodes, analysis.model.rigid_bodies[i].reference_node) == 0) continue;
    if (radius(axis, hub) > on_the_axis * largest) continue;
    const auto& body = analysis.current.rigid_bodies[i];
    const auto turn = rotation_matrix(body);
    return {vector_of(body.position) + turn * (axis.point - hub), turn * axis.direction};
  }
  return axis;
}

/// Sets what a line says of the velocity of one place; a rotation carries the velocity of its axis along.
void set_velocity(const InitialVelocity& initial, const RotationAxis& axis, const Vector3<double>& position, double* velocity) {
  if (initial.kind == InitialVelocity::Kind::translation) {
    velocity[initial.dof] = initial.velocity[initial.dof];
    return;
  }
  const auto turning = initial.angular_speed * cross(axis.direction, position - axis.point);
  for (int c = 0; c < 3; ++c) velocity[c] = initial.velocity[c] + turning[c];
}

void apply_to_bodies(Analysis& analysis, const InitialVelocity& initial, const RotationAxis& axis,
                     const std::vector<bool>& in_set) {
  for (std::size_t i = 0; i < analysis.current.rigid_bodies.size(); ++i) {
    auto& body = analysis.current.rigid_bodies[i];
    const bool all_nodes =
        !body.nodes.empty() && std::all_of(body.nodes.begin(), body.nodes.end(),
                                           [&](const RigidNode& carried) { return in_set[carried.node]; });
    if (!all_nodes && !in_set[analysis.model.rigid_bodies[i].reference_node]) continue;
    set_velocity(initial, axis, vector_of(body.position), body.velocity.data());
    if (initial.kind == InitialVelocity::Kind::rotation)
      body.angular_velocity = (initial.angular_speed * axis.direction).component;
  }
}

/// Speed across an axis at which boundary conditions drive the reference node of a body past it; 0 if they do not.
double passing_speed(const Analysis& analysis, const Step& step, std::int32_t body, const InitialVelocity& rotation,
                     const RotationAxis& axis) {
  Vector3<double> velocity = -1.0 * vector_of(rotation.velocity);
  for (const auto& condition : step.boundary) {
    if (condition.node != analysis.model.rigid_bodies[body].reference_node || condition.dof >= 3) continue;
    if (condition.kind != BoundaryCondition::Kind::velocity) continue;
    velocity = velocity + condition.magnitude * vector_of(analysis.directions.direction(condition.node, condition.dof));
  }
  const auto across = velocity - dot(velocity, axis.direction) * axis.direction;
  return std::sqrt(dot(across, across));
}

struct Radii {
  double loaded = 1e300, free = 0.0;
};

/// Radii about its axis of what a rotation turns of a contact pair's slave surface: of the nearest closed node, and of the
/// farthest node.
Radii radii_of(const Analysis& analysis, std::int32_t pair, const InitialVelocity& rotation, const RotationAxis& axis) {
  const auto& contact = analysis.contacts[pair];
  std::vector<bool> turns(static_cast<std::size_t>(analysis.model.nodes.size()), false);
  for (const auto row : rotation.nodes) turns[row] = true;
  Radii radii;
  for (std::int32_t point = 0; point < contact.size(); ++point) {
    if (!turns[analysis.domain.node_row[contact.nodes()[point]]]) continue;
    const double r = radius(axis, vector_of(&analysis.current.position[4 * contact.nodes()[point]]));
    radii.free = std::max(radii.free, r);
    if (analysis.current.contact[pair][point].closed > 0.0) radii.loaded = std::min(radii.loaded, r);
  }
  return {analysis.communicator.minimum(radii.loaded), analysis.communicator.maximum(radii.free)};
}

/// A rotation on the master of a contact pair.
struct Rolling {
  double speed = 0.0;
  Radii radii;
};

/// The pairs on which a rotation rolls: the master passes below, and presses what turns flat.
std::vector<Rolling> rolling_on(const Analysis& analysis, const Step& step, const InitialVelocity& rotation,
                                const RotationAxis& axis) {
  std::vector<Rolling> all;
  if (rotation.kind != InitialVelocity::Kind::rotation || rotation.angular_speed == 0.0) return all;
  for (const auto pair : step.active_contact_pairs) {
    if (analysis.contacts[pair].master_body() < 0) continue;
    const Rolling rolling{passing_speed(analysis, step, analysis.contacts[pair].master_body(), rotation, axis),
                          radii_of(analysis, pair, rotation, axis)};
    if (rolling.speed > 0.0 && rolling.radii.loaded < rolling.radii.free) all.push_back(rolling);
  }
  return all;
}

/// Current positions, on all ranks.
std::vector<Vector3<double>> positions_of(const Analysis& analysis, const std::vector<std::int32_t>& rows) {
  std::vector<double> values(3 * rows.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const auto node = analysis.domain.local_node[rows[i]]; node >= 0 && analysis.domain.owned[node])
      std::copy_n(&analysis.current.position[4 * static_cast<std::size_t>(node)], 3, &values[3 * i]);
  analysis.communicator.sum(std::span<double>(values));
  std::vector<Vector3<double>> positions;
  for (std::size_t i = 0; i < rows.size(); ++i) positions.push_back(vector_of(&values[3 * i]));
  return positions;
}

/// A rigid spin would throw the flat of a tyre into the road: its material runs through it instead.
/// @return the number of nodes that do.
std::size_t add_flow(Analysis& analysis, const InitialVelocity& rotation, const RotationAxis& axis) {
  std::vector<Vector3<double>> undeformed;
  for (const auto row : rotation.nodes) undeformed.push_back(vector_of(analysis.model.nodes.coordinates[row]));
  const auto flow = flow_through_shape(undeformed, positions_of(analysis, rotation.nodes), axis_in_deck(rotation), axis);
  for (std::size_t i = 0; i < flow.size(); ++i) {
    const auto node = analysis.domain.local_node[rotation.nodes[i]];
    for (int c = 0; c < 3 && node >= 0 && flow[i]; ++c)
      analysis.current.velocity[4 * static_cast<std::size_t>(node) + c] += rotation.angular_speed * (*flow[i])[c];
  }
  return static_cast<std::size_t>(std::ranges::count_if(flow, [](const auto& each) { return each.has_value(); }));
}

}  // namespace

void apply_initial_velocities(Analysis& analysis, const Step& step, Observer& observer) {
  auto& state = analysis.current;
  std::vector<bool> in_set;
  for (const auto& initial : analysis.model.initial_velocities) {
    const bool rotation = initial.kind == InitialVelocity::Kind::rotation;
    const auto axis = rotation ? axis_now(analysis, initial) : RotationAxis{};
    in_set.assign(static_cast<std::size_t>(analysis.model.nodes.size()), false);
    for (const auto row : initial.nodes) {
      in_set[row] = true;
      const auto node = analysis.domain.local_node[row];
      if (node < 0) continue;
      set_velocity(initial, axis, vector_of(&state.position[4 * node]), &state.velocity[4 * node]);
      if (rotation && node < analysis.domain.turning)
        std::copy_n((initial.angular_speed * axis.direction).component.data(), 3, &state.angular_velocity[4 * node]);
    }
    apply_to_bodies(analysis, initial, axis, in_set);
    if (rolling_on(analysis, step, initial, axis).empty()) continue;
    const auto flowing = add_flow(analysis, initial, axis);
    observer.log(fmt::format("{}: note: *INITIAL CONDITIONS: it rolls about ({:.6g}, {:.6g}, {:.6g}); {} of {} nodes run through its "
                             "loaded shape",
                             analysis.model.where(initial.location), axis.point[0], axis.point[1], axis.point[2], flowing,
                             initial.nodes.size()));
  }
}

void check_rolling_radius(const Analysis& analysis, const Step& step, Observer& observer) {
  for (const auto& initial : analysis.model.initial_velocities) {
    for (const auto& [speed, radii] : rolling_on(analysis, step, initial, axis_now(analysis, initial))) {
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
