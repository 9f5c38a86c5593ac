// The force law of one contact point, in the frame of the master body: the same lines for the explicit loop (T =
// double) and for the implicit solver (T = Dual).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "master_surface.hpp"
#include "math/dual.hpp"
#include "math/scalar.hpp"
#include "math/tensor.hpp"
#include "model/pressure_law.hpp"
#include "model/state.hpp"

namespace balocco {

/// Stiffness of a stiff or implicit spring over that of the pair: under a pressure p the penetration is then p h / (10 M), h and M being
/// those of the layer of elements behind the slave (slave_surface.hpp).
inline constexpr double stiff_factor = 20.0;

struct PenaltyParameters {
  double stiffness = 0.0;     // force per length, normal, and the most that the tangential spring has
  double tangential = 0.0;    // what the tangential spring has at most; 0: as `stiffness`
  double friction = 0.0;      // Coulomb's coefficient
  double elastic_slip = 0.0;  // stretch of the tangential spring at the limit of sticking; 0: as `stiffness` makes it
  double shear_limit = std::numeric_limits<double>::infinity();  // of friction, a force
  const PressureLaw* law = nullptr;  // a curved one; null: the normal spring is straight
  double area = 0.0, straight_from = std::numeric_limits<double>::infinity();  // with it: see PressureLaw::at

  double tangential_spring() const { return tangential > 0.0 ? tangential : stiffness; }
  /// Of the normal spring, at a distance above the surface; below zero where the point is open.
  template <class T>
  T normal_force(double multiplier, const T& distance) const {
    if (law == nullptr) return multiplier - stiffness * distance;
    const auto found = law->at(-value_of(distance), straight_from);
    return multiplier + area * found.pressure - (area * found.slope) * (distance - value_of(distance));
  }
  /// What a law that goes on straight lacks of the curved one, at a distance: it goes as the point rises, and nothing stays.
  double lacking_force(double distance) const {
    return area * (law->at(-distance).pressure - law->at(-distance, straight_from).pressure);
  }
  /// Where that is all of a multiplier > 0. By Newton's steps from above: it grows ever faster.
  double overclosure_lacking(double multiplier) const {
    double overclosure = straight_from + std::abs(law->start());
    while (lacking_force(-overclosure) < multiplier) overclosure = 2.0 * overclosure - straight_from;
    for (int i = 0; i < 60; ++i) {
      const double slope = area * (law->at(overclosure).slope - law->at(overclosure, straight_from).slope);
      const double step = (lacking_force(-overclosure) - multiplier) / slope;
      overclosure -= step;
      if (!(step > 1e-12 * (overclosure - straight_from))) break;
    }
    return overclosure;
  }
  /// Energy of the normal spring of a law, with what a multiplier gives back as the point rises.
  double energy_of_law(double multiplier, double overclosure) const {
    const double straight = area * law->energy(overclosure, straight_from);
    if (!(multiplier > 0.0)) return straight;
    const double held = overclosure_lacking(multiplier), until = std::min(overclosure, held);
    return straight + area * (law->energy(until) - law->energy(until, straight_from)) + multiplier * std::max(0.0, overclosure - held);
  }
  /// The force at which a point slips.
  template <class T>
  T sliding_limit(const T& pressure) const {
    return -maximum(-(pressure * friction), T(-shear_limit));
  }
};

/// The spring of a point that an explicit step follows.
struct ContactSpring {
  double stiffness = 0.0;  // force per length, the greatest
  double straight_from = std::numeric_limits<double>::infinity();  // see PressureLaw::at
};

/// `penalty`: stiffness that hard contact has there, and the greatest of an exponential law that the deck does not bound.
inline ContactSpring contact_spring(const PressureLaw& law, double area, double penalty) {
  if (law.kind == PressureLaw::Kind::hard) return {.stiffness = penalty};
  if (law.kind != PressureLaw::Kind::exponential) return {.stiffness = area * law.steepest()};
  const double greatest = law.greatest_slope > 0.0 ? law.greatest_slope : penalty / area;
  return {.stiffness = area * greatest, .straight_from = law.where_slope_is(greatest)};
}

/// Forces on the slave node, in the body frame.
template <class T>
struct ContactForce {
  bool closed = false;
  T pressure{};  // normal force, >= 0
  Vector3<T> normal{}, friction{};
  double tangential_stiffness = 0.0;
  Vector3<double> slip{};  // by which the anchor gives way
};

/// An open point has no multiplier; its anchor follows it, so that friction knows how it moved in the increment in
/// which it closes. `place`: in the frame of the master body.
inline void open(ContactPoint& point, const Vector3<double>& place) {
  point.multiplier = point.closed = point.stiff_force = 0.0;
  point.anchor = place.component;
  point.stiff_friction = {};
}

/// Force of the tangential spring of a stretch in the tangential plane, cut at Coulomb's limit. Work done in slipping, limit x slip, goes
/// to the dissipation (backward Euler). @return the part of the stretch that the spring can hold: 1 where the point sticks.
template <class T>
double add_tangential_spring(const PenaltyParameters& parameters, const Vector3<T>& stretch, ContactPoint& point, ContactForce<T>& force) {
  const T limit = parameters.sliding_limit(force.pressure);
  T stiffness(parameters.tangential_spring());
  if (parameters.elastic_slip > 0.0 && value_of(limit) < parameters.tangential_spring() * parameters.elastic_slip)
    stiffness = limit / parameters.elastic_slip;
  force.tangential_stiffness = value_of(stiffness);
  const T square = dot(stretch, stretch);
  const double reach = value_of(limit) / value_of(stiffness);
  if (value_of(square) <= reach * reach) {
    force.friction = -stiffness * stretch;
    return 1.0;
  }
  const T length = square_root(square);
  force.friction = -(limit / length) * stretch;
  const double kept = reach / value_of(length);
  const double slip = value_of(length) - reach;
  force.slip = {(1.0 - kept) * value_of(stretch[0]), (1.0 - kept) * value_of(stretch[1]), (1.0 - kept) * value_of(stretch[2])};
  point.slip += slip;
  point.frictional_dissipation += value_of(limit) * slip;
  return kept;
}

/// Tangential part of the force: spring from the anchor; slipping drags the anchor along, and closing brings it down to the surface.
template <class T>
void add_friction(const PenaltyParameters& parameters, const Vector3<T>& place, const SurfacePoint<T>& nearest,
                  ContactPoint& point, ContactForce<T>& force) {
  Vector3<T> stretch{place[0] - point.anchor[0], place[1] - point.anchor[1], place[2] - point.anchor[2]};
  stretch = stretch - dot(stretch, nearest.normal) * nearest.normal;
  const double kept = add_tangential_spring(parameters, stretch, point, force);
  if (kept == 1.0 && point.closed > 0.0) return;
  for (int i = 0; i < 3; ++i)
    point.anchor[i] =
        value_of(place[i]) - value_of(nearest.distance) * value_of(nearest.normal[i]) - kept * value_of(stretch[i]);
}

/// Stiffness of the tangential spring under a Coulomb limit.
inline double tangential_stiffness(const PenaltyParameters& parameters, double limit) {
  const double most = parameters.tangential_spring();
  return parameters.elastic_slip > 0.0 ? std::min(most, limit / parameters.elastic_slip) : most;
}

/// Energy that the tangential spring holds with a force under a Coulomb limit.
inline double tangential_energy(const PenaltyParameters& parameters, double limit, const Vector3<double>& force) {
  const double stiffness = tangential_stiffness(parameters, limit);
  return stiffness > 0.0 ? 0.5 * dot(force, force) / stiffness : 0.0;
}

/// Displacement per tangential force, of a point that may be held in some directions: along `axis` (zero: there is none such) and
/// across it.
struct TangentialYielding {
  Vector3<double> axis{};
  double along = 0.0, across = 0.0;
};

/// Friction over a cycle of a tangential spring stiffer than an explicit cycle could follow: Coulomb's law at the end of the next
/// increment (backward Euler), by when the force itself has moved the point. `stretch`: of the spring then if no friction acts.
/// `slip`: by how much the anchor gives way. Stable and dissipative for any stiffness.
struct StiffFriction {
  Vector3<double> force, slip;
};

inline StiffFriction stiff_friction(double limit, double stiffness, const Vector3<double>& stretch,
                                    const TangentialYielding& yielding) {
  const auto along = dot(stretch, yielding.axis) * yielding.axis;
  const auto sticking = (-stiffness / (1.0 + stiffness * yielding.across)) * (stretch - along) -
                        (stiffness / (1.0 + stiffness * yielding.along)) * along;
  const double size = std::sqrt(dot(sticking, sticking));
  if (size <= limit) return {sticking, {}};
  const double kept = limit / size;
  return {kept * sticking, (1.0 - kept) * stretch};
}

/// Force over a cycle of a unilateral spring, stiffer than an explicit cycle could follow: that which gives the node just the
/// energy that the spring loses between the middles of two increments (discrete gradient; Simo, Tarnow and Wong, Comput.
/// Methods Appl. Mech. Engrg. 100, 1992), there the trapezoidal rule, stable for any stiffness. Pressure p(gap) = max(0,
/// multiplier - stiffness * gap), energy p^2 / (2 stiffness). `before`: gap in the middle of the increment that led here;
/// `after`: in the middle of the next one if no force acts; `yielding`: what a unit force adds to it.
inline double stiff_normal_force(double multiplier, double stiffness, double before, double after, double yielding) {
  const double old_pressure = multiplier - stiffness * before, new_pressure = multiplier - stiffness * after;
  if (old_pressure <= 0.0) {
    if (new_pressure <= 0.0) return 0.0;
    const double k = stiffness, c = yielding;  // f (before - after - c f) = (new_pressure - k c f)^2 / (2 k)
    const double half = k * (before - after + c * new_pressure);
    const double root = std::sqrt(std::max(0.0, half * half - (k * c + 2.0) * k * c * new_pressure * new_pressure));
    return new_pressure * new_pressure / (half + root);
  }
  const double kept = 0.5 * (old_pressure + new_pressure) / (1.0 + 0.5 * stiffness * yielding);
  if (new_pressure - stiffness * yielding * kept >= 0.0) return kept;
  const double opening = after - before;  // it opens: f (opening + c f) = old_pressure^2 / (2 k)
  const double square = old_pressure * old_pressure / stiffness;
  return square / (opening + std::sqrt(opening * opening + 2.0 * yielding * square));
}

/// `point`: history at the start on entry, at the end on return. Friction acts from the increment in which the point
/// closes: the spring starts from where the point was over the surface when that increment began.
template <class T>
ContactForce<T> contact_force(const MasterSurface& surface, const PenaltyParameters& parameters, const Vector3<T>& place,
                              ContactPoint& point) {
  ContactForce<T> force;
  const Vector3<double> values{value_of(place[0]), value_of(place[1]), value_of(place[2])};
  const bool pushes_afar = parameters.law != nullptr && parameters.law->start() < 0.0;
  if (point.multiplier == 0.0 && !pushes_afar && surface.surely_outside(values)) {
    open(point, values);
    return force;
  }
  const SurfacePoint<T> nearest = surface.nearest(place);
  if (parameters.law != nullptr && point.multiplier > 0.0)
    point.multiplier = std::clamp(parameters.lacking_force(value_of(nearest.distance)), 0.0, point.multiplier);
  const T pressure = parameters.normal_force(point.multiplier, nearest.distance);
  if (value_of(pressure) <= 0.0) {  // what is not a number must be seen by the solver
    open(point, values);
    return force;
  }
  force.closed = true;
  force.pressure = pressure;
  force.normal = pressure * nearest.normal;
  if (parameters.friction > 0.0)
    add_friction(parameters, place, nearest, point, force);
  else  // where friction would begin if a later step has some
    for (int i = 0; i < 3; ++i) point.anchor[i] = values[i] - value_of(nearest.distance) * value_of(nearest.normal[i]);
  point.closed = 1.0;
  return force;
}

}  // namespace balocco
