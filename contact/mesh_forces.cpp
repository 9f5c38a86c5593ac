// What explicit steps ask of contact with deformable masters.
#include <algorithm>
#include <cmath>

#include "mesh_contact.hpp"

namespace balocco {

void MeshContact::choose_springs(const double* position, bool implicit, std::vector<ContactPoint>& points) const {
  for (std::int32_t i = 0; i < size(); ++i) {
    const auto& place = places_[i];
    const double spring = implicit && !soft_ ? stiff_factor * place.stiffness : 0.0;
    if (spring == points[i].implicit_spring) continue;
    if (points[i].closed > 0.0) keep_force(position, place, spring, points[i]);
    points[i].implicit_spring = spring;
  }
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
  point.multiplier = acting->force + law.stiffness * foot.distance;
  const double tangential = tangential_stiffness(law, law.sliding_limit(acting->force));
  if (has_anchor(point) && tangential > 0.0) set_anchor(position, on_surface + (1.0 / tangential) * friction, foot, point);
}

void MeshContact::add_forces(const double* position, std::vector<ContactPoint>& points, double* force) {
  follow(position);
  for (std::int32_t i = 0; i < size(); ++i)
    if (places_[i].owned) advance(position, places_[i], points[i], force);
}

void MeshContact::advance(const double* position, const Place& place, ContactPoint& point, double* force) const {
  const auto where = at(place, position);
  const auto foot = faces_.nearest(position, where);
  const auto spring = spring_at(place, foot, point);
  if (!spring || !spring->closed) return open(foot, point);
  ContactForce<double> contact;
  contact.pressure = spring->force;
  if (has_anchor(point) && spring->force > 0.0) {
    auto stretch = where - anchor_of(position, point);
    stretch = stretch - dot(stretch, foot.normal) * foot.normal;
    const double kept = add_tangential_spring(parameters(place, point), stretch, point, contact);
    if (kept < 1.0) slide(position, contact.slip, where - foot.distance * foot.normal - kept * stretch, foot, point);
  } else {
    point.anchor = {static_cast<double>(foot.face), foot.xi, foot.eta};
  }
  point.closed = 1.0;
  const auto push = spring->force * foot.normal + contact.friction;
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
    stiffest = std::max(stiffest, place.stiffness);
    densest = std::max(densest, place.stiffness / place.area);
    for (std::size_t i = 0; i < place.nodes.size(); ++i) sum[place.nodes[i]] += both_sides * place.stiffness * std::abs(place.weights[i]);
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
