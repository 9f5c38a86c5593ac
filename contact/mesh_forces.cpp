// What explicit steps ask of contact with deformable masters.
#include <algorithm>
#include <cmath>

#include "mesh_contact.hpp"

namespace balocco {

void MeshContact::forget_springs(bool implicit, std::vector<ContactPoint>& points) const {
  for (std::int32_t i = 0; i < size(); ++i) {
    points[i].multiplier = points[i].stiff_force = 0.0;
    points[i].implicit_spring = implicit ? implicit_spring(places_[i]) : 0.0;
  }
}

void MeshContact::choose_springs(const double* position, bool implicit, std::vector<ContactPoint>& points) const {
  for (std::int32_t i = 0; i < size(); ++i) {
    const auto& place = places_[i];
    if (soft_ && (implicit || !curved_)) points[i].multiplier = 0.0;  // the law alone
    const double spring = implicit ? implicit_spring(place) : 0.0;
    if (spring == points[i].implicit_spring) continue;
    if (points[i].closed > 0.0 && !soft_) keep_force(position, place, spring, points[i]);
    if (points[i].closed > 0.0 && curved_ && !implicit) points[i].multiplier = lacking_force(position, place);
    points[i].implicit_spring = spring;
  }
}

/// What an explicit step has begun without, of the force of a curved law.
double MeshContact::lacking_force(const double* position, const Place& place) const {
  const auto foot = faces_.nearest(position, at(place, position));
  return foot.face < 0 ? 0.0 : parameters(place, {}).lacking_force(foot.distance);
}

/// The multiplier and the anchor become those with which the other spring exerts the same force. The multiplier is negative where a soft
/// spring held the place below the surface: the stiff one begins down there.
void MeshContact::keep_force(const double* position, const Place& place, double spring, ContactPoint& point) const {
  const auto where = at(place, position);
  const auto foot = faces_.nearest(position, where);
  const auto acting = spring_at(place, foot, point);
  if (!acting) return;
  const auto on_surface = where - foot.distance * foot.normal;
  Vector3<double> friction{};
  if (has_anchor(point) && acting->force > 0.0) {
    auto scratch = point;
    ContactForce<double> contact{.pressure = acting->force};
    const auto stretch = where - anchor_of(position, point);
    add_tangential_spring(parameters(place, point), stretch - dot(stretch, foot.normal) * foot.normal, scratch, contact);
    friction = contact.friction;
  }
  point.implicit_spring = spring;
  const auto law = parameters(place, point);
  point.stiff_force = point.multiplier;
  point.multiplier = acting->force + law.stiffness * foot.distance;
  const double tangential = tangential_stiffness(law, law.sliding_limit(acting->force));
  if (has_anchor(point) && tangential > 0.0) set_anchor(position, on_surface + (1.0 / tangential) * friction, foot, point);
}

void MeshContact::add_forces(const MeshCycle& cycle, std::vector<ContactPoint>& points, double* force) {
  follow(cycle.position);
  for (std::int32_t i = 0; i < size(); ++i)
    if (places_[i].owned) advance(cycle, places_[i], points[i], force);
}

/// What gives the bodies the energy that the spring loses between the middles of the increments before and behind, if the place goes on as
/// it came: where a spring closes or opens within a cycle, its force at the instant would give too much or too little.
double MeshContact::mean_force(const MeshCycle& cycle, const Place& place, const FacePlace& foot, const ContactPoint& point) const {
  const auto nodes = faces_.nodes(foot.face);
  const auto shapes = face_shapes(nodes.size(), foot.xi, foot.eta);
  const auto velocity_of = [&](std::int32_t node) {
    const double* const v = cycle.velocity + 4 * static_cast<std::ptrdiff_t>(node);
    return foot.normal[0] * v[0] + foot.normal[1] * v[1] + foot.normal[2] * v[2];
  };
  double opening = 0.0;
  for (std::size_t i = 0; i < place.nodes.size(); ++i) opening += place.weights[i] * velocity_of(place.nodes[i]);
  for (std::size_t a = 0; a < nodes.size(); ++a) opening -= shapes.value[a] * velocity_of(nodes[a]);
  if (curved_) {
    const double from = 0.5 * cycle.previous * opening - foot.distance, to = -0.5 * cycle.next * opening - foot.distance;
    return point.multiplier + place.area * law_.mean_pressure(from, to, straight_from(place, point));
  }
  const double k = stiffness(place, point);
  const double before = point.multiplier - k * (foot.distance - 0.5 * cycle.previous * opening);
  const double behind = point.multiplier - k * (foot.distance + 0.5 * cycle.next * opening);
  if (before >= 0.0 && behind >= 0.0) return 0.5 * (before + behind);
  if (before <= 0.0 && behind <= 0.0) return 0.0;
  const double held = std::max(before, behind);
  return 0.5 * held * held / std::abs(before - behind);
}

/// A multiplier from statics goes with its stiff spring: as the place rises, no more is left of it than that spring would exert. Nothing
/// pushes across a gap.
void MeshContact::lower_multiplier(const Place& place, const FacePlace& foot, ContactPoint& point) const {
  if (!(point.multiplier > 0.0)) return;
  const double of_stiff_spring = curved_ ? parameters(place, point).lacking_force(foot.distance) : point.stiff_force - (stiff_factor - 1.0) * place.stiffness * foot.distance;
  point.multiplier = std::clamp(of_stiff_spring, 0.0, point.multiplier);
}

void MeshContact::advance(const MeshCycle& cycle, const Place& place, ContactPoint& point, double* force) const {
  const double* const position = cycle.position;
  const auto where = at(place, position);
  const auto foot = faces_.nearest(position, where);
  if (foot.face >= 0) lower_multiplier(place, foot, point);
  const auto spring = spring_at(place, foot, point);
  double pressure = spring ? spring->force : 0.0;
  if (foot.face >= 0 && tension_width_ == 0.0) pressure = mean_force(cycle, place, foot, point);
  if (pressure == 0.0) return open(foot, point);
  ContactForce<double> contact;
  contact.pressure = pressure;
  if (has_anchor(point) && pressure > 0.0) {
    auto stretch = where - anchor_of(position, point);
    stretch = stretch - dot(stretch, foot.normal) * foot.normal;
    const double kept = add_tangential_spring(parameters(place, point), stretch, point, contact);
    if (kept < 1.0) slide(position, contact.slip, where - foot.distance * foot.normal - kept * stretch, foot, point);
  } else {
    point.anchor = {static_cast<double>(foot.face), foot.xi, foot.eta};
  }
  point.closed = 1.0;
  const auto push = pressure * foot.normal + contact.friction;
  const auto add = [&](std::int32_t node, double share) {
    double* const sum = force + 4 * static_cast<std::ptrdiff_t>(node);
    for (int k = 0; k < 3; ++k) sum[k] += rounded(share * push[k], sum[3]);
  };
  for (std::size_t i = 0; i < place.nodes.size(); ++i) add(place.nodes[i], place.weights[i]);
  const auto nodes = faces_.nodes(foot.face);
  const auto shapes = face_shapes(nodes.size(), foot.xi, foot.eta);
  for (std::size_t a = 0; a < nodes.size(); ++a) add(nodes[a], -shapes.value[a]);
}

void MeshContact::add_spring_stiffness(std::span<double> sum) const {
  // The coefficients of a spring sum to one on either side, in magnitude to little more where shape functions are negative.
  constexpr double both_sides = 2.5;
  double stiffest = 0.0, densest = 0.0;
  for (const auto& place : places_) {
    const double stiffness = std::max(place.stiffness, stick_slope_ * place.area);  // one acts along the normal, one across it
    stiffest = std::max(stiffest, stiffness);
    densest = std::max(densest, stiffness / place.spacing);
    for (std::size_t i = 0; i < place.nodes.size(); ++i) sum[place.nodes[i]] += both_sides * stiffness * std::abs(place.weights[i]);
  }
  // Below a node of the master there are as many places as its area holds, and one more.
  for (const auto node : nodes_)
    if (master_area_[node] > 0.0) sum[node] += both_sides * (stiffest + densest * master_area_[node]);
}

MeshContact::Deepest MeshContact::deepest(const double* position, const std::vector<ContactPoint>& points, bool open_alone) const {
  Deepest deepest;
  for (std::int32_t i = 0; i < size(); ++i) {
    if (!places_[i].owned || (open_alone && points[i].closed > 0.0)) continue;
    const auto foot = faces_.nearest(position, at(places_[i], position));
    if (foot.face >= 0 && -foot.distance > deepest.depth) deepest = {-foot.distance, places_[i].nodes.front()};
  }
  return deepest;
}

}  // namespace balocco
