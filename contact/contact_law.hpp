// The force law of one contact point, in the frame of the master body: the same lines for the explicit loop (T =
// double) and for the implicit solver (T = Dual).
#pragma once

#include <cmath>

#include "math/dual.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"
#include "model/state.hpp"
#include "rigid_surface.hpp"

namespace balocco {

struct PenaltyParameters {
  double stiffness = 0.0;     // force per length, normal, and the most that the tangential spring has
  double friction = 0.0;      // Coulomb's coefficient
  double elastic_slip = 0.0;  // stretch of the tangential spring at the limit of sticking; 0: as `stiffness` makes it
};

/// Forces on the slave node, in the body frame.
template <class T>
struct ContactForce {
  bool closed = false;
  T pressure{};  // normal force, >= 0
  Vector3<T> normal{}, friction{};
  double tangential_stiffness = 0.0;
};

inline void open(ContactPoint& point) {
  point.multiplier = 0.0;
  point.closed = 0.0;
  point.anchor = {};
}

/// Tangential part of the force: spring from the anchor, cut at Coulomb's limit; slipping drags the anchor along. Work
/// done in slipping, limit x slip, goes to the dissipation (backward Euler).
template <class T>
void add_friction(const PenaltyParameters& parameters, const Vector3<T>& place, const Vector3<T>& normal,
                  ContactPoint& point, ContactForce<T>& force) {
  const T limit = force.pressure * parameters.friction;
  T stiffness(parameters.stiffness);
  if (parameters.elastic_slip > 0.0 && value_of(limit) < parameters.stiffness * parameters.elastic_slip)
    stiffness = limit / parameters.elastic_slip;
  force.tangential_stiffness = value_of(stiffness);

  Vector3<T> stretch{place[0] - point.anchor[0], place[1] - point.anchor[1], place[2] - point.anchor[2]};
  stretch = stretch - dot(stretch, normal) * normal;
  const T square = dot(stretch, stretch);
  const double reach = value_of(limit) / value_of(stiffness);
  if (value_of(square) <= reach * reach) {
    force.friction = -stiffness * stretch;
    return;
  }
  const T length = square_root(square);
  force.friction = -(limit / length) * stretch;
  const double kept = reach / value_of(length), slip = value_of(length) - reach;
  for (int i = 0; i < 3; ++i) point.anchor[i] = value_of(place[i]) - kept * value_of(stretch[i]);
  point.slip += slip;
  point.frictional_dissipation += value_of(limit) * slip;
}

/// `point`: history at the start on entry, at the end on return. A point that closes sticks from where it first stands
/// in contact, so friction begins with the increment after; one that opens forgets anchor and multiplier.
template <class T>
ContactForce<T> contact_force(const RigidSurface& surface, const PenaltyParameters& parameters, const Vector3<T>& place,
                              ContactPoint& point) {
  ContactForce<T> force;
  const Vector3<double> values{value_of(place[0]), value_of(place[1]), value_of(place[2])};
  if (point.multiplier == 0.0 && surface.surely_outside(values)) {
    open(point);
    return force;
  }
  const SurfacePoint<T> nearest = surface.nearest(place);
  const T pressure = point.multiplier - parameters.stiffness * nearest.distance;
  if (!(value_of(pressure) > 0.0)) {
    open(point);
    return force;
  }
  force.closed = true;
  force.pressure = pressure;
  force.normal = pressure * nearest.normal;
  if (point.closed == 0.0) {
    point.closed = 1.0;
    for (int i = 0; i < 3; ++i)
      point.anchor[i] = value_of(place[i]) - value_of(nearest.distance) * value_of(nearest.normal[i]);
  } else if (parameters.friction > 0.0) {
    add_friction(parameters, place, nearest.normal, point, force);
  }
  return force;
}

}  // namespace balocco
