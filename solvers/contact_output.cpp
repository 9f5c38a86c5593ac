#include "contact_output.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "local_places.hpp"
#include "output_instant.hpp"

namespace balocco {

namespace {

/// What a slave node tells: its own place, or the places of the faces around it, each with its share.
struct NodalContact {
  double gap = 0.0, pressure = 0.0, shear = 0.0, slip = 0.0;
  Point normal_force{}, friction_force{};
};

/// Sums of three components over the copies of shared nodes.
void sum_over_copies(const Analysis& analysis, std::vector<double>& nodal) {
  analysis.domain.halo->begin_sum(nodal.data());
  analysis.domain.halo->finish_sum(nodal.data());
}

/// Of every slave node on this rank of a pair with a deformable master; each rank knows the places that it owns. Collective.
std::map<std::int32_t, NodalContact> nodes_of_mesh_contact(const Analysis& analysis, std::size_t pair) {
  const auto& contact = analysis.mesh_contacts[pair];
  const std::size_t size = 4 * (static_cast<std::size_t>(analysis.domain.size()) + 1);  // no constants in the fourths: plain sums
  std::vector<double> normal(size), friction(size), first(size), second(size);
  std::map<std::int32_t, NodalContact> nodes;
  for (std::int32_t place = 0; place < contact.size(); ++place) {
    for (const auto node : contact.nodes(place)) nodes[node];
    if (!contact.owned(place)) continue;
    const auto output = contact.output(place, analysis.current.position.data(), analysis.current.contact[pair][place]);
    for (std::size_t i = 0; i < contact.nodes(place).size(); ++i) {
      const std::size_t at = 4 * static_cast<std::size_t>(contact.nodes(place)[i]);
      const double weight = contact.weights(place)[i], share = std::abs(weight) * contact.area(place);
      const Vector3<double> told{output.gap, output.pressure, output.shear};
      for (int k = 0; k < 3; ++k) {
        normal[at + k] += weight * output.normal_force[k];
        friction[at + k] += weight * output.friction_force[k];
        first[at + k] += share * told[k];
      }
      second[at] += share * output.slip;
      second[at + 1] += share;
    }
  }
  for (auto* sums : {&normal, &friction, &first, &second}) sum_over_copies(analysis, *sums);
  for (auto& [node, sum] : nodes) {
    const std::size_t at = 4 * static_cast<std::size_t>(node);
    const double whole = second[at + 1];
    sum = {.gap = first[at] / whole, .pressure = first[at + 1] / whole, .shear = first[at + 2] / whole, .slip = second[at] / whole,
           .normal_force = {normal[at], normal[at + 1], normal[at + 2]}, .friction_force = {friction[at], friction[at + 1], friction[at + 2]}};
  }
  return nodes;
}

/// Calls visit(local node, what it tells) for the slave nodes on this rank of all pairs. Collective.
template <class Visit>
void for_each_slave_node(const Analysis& analysis, Visit visit) {
  for_each_contact_point(analysis, [&](std::int32_t node, const RigidContact::Output& output, const auto&...) { visit(node, output); });
  for (std::size_t pair = 0; pair < analysis.mesh_contacts.size(); ++pair)
    if (analysis.contacts[pair].master_body() < 0)
      for (const auto& [node, sum] : nodes_of_mesh_contact(analysis, pair)) visit(node, sum);
}

/// A scalar; where a node is in several pairs the largest counts.
template <class Value>
void contact_scalar(const Analysis& analysis, std::span<double> values, Value value) {
  std::ranges::fill(values, 0.0);
  for_each_slave_node(analysis, [&](std::int32_t node, const auto& output) { values[node] = std::max(values[node], value(output)); });
}

template <class Value>
void contact_vector(const Analysis& analysis, std::span<double> values, Value value) {
  std::ranges::fill(values, 0.0);
  for_each_slave_node(analysis, [&](std::int32_t node, const auto& output) {
    for (int i = 0; i < 3; ++i) values[3 * node + i] += value(output)[i];
  });
}

}  // namespace

void contact_pressure(const Analysis& analysis, std::span<double> values) {
  contact_scalar(analysis, values, [](const auto& output) { return output.pressure; });
}

void contact_shear(const Analysis& analysis, std::span<double> values) {
  contact_scalar(analysis, values, [](const auto& output) { return output.shear; });
}

void contact_slip(const Analysis& analysis, std::span<double> values) {
  contact_scalar(analysis, values, [](const auto& output) { return output.slip; });
}

void contact_opening(const Analysis& analysis, std::span<double> values) {
  std::ranges::fill(values, 0.0);
  std::vector<bool> seen(values.size());
  for_each_slave_node(analysis, [&](std::int32_t node, const auto& output) {
    values[node] = seen[node] ? std::min(values[node], output.gap) : output.gap;
    seen[node] = true;
  });
}

void contact_normal_force(const Analysis& analysis, std::span<double> values) {
  contact_vector(analysis, values, [](const auto& output) { return output.normal_force; });
}

void contact_shear_force(const Analysis& analysis, std::span<double> values) {
  contact_vector(analysis, values, [](const auto& output) { return output.friction_force; });
}

std::vector<ContactPlace> Analysis::contact_places(std::int32_t pair) const {
  const auto& contact = mesh_contacts[pair];
  if (contact.size() == 0) return {};
  std::vector<ContactPlace> places;
  const auto local = local_slave_places(model, pair, domain);
  for (std::int32_t place = 0; place < contact.size(); ++place) {
    const auto at = contact.output(place, current.position.data(), current.contact[pair][place]);
    if (!contact.owned(place) || !at.closed) continue;
    constexpr double along_x = 0.998;
    const Vector3<double> axis = std::abs(at.normal[0]) > along_x ? Vector3<double>{0.0, 0.0, 1.0} : Vector3<double>{1.0, 0.0, 0.0};
    auto first = axis - dot(axis, at.normal) * at.normal;
    first = (1.0 / std::sqrt(dot(first, first))) * first;
    const auto second = cross(at.normal, first);
    const auto holding = (-1.0 / contact.area(place)) * at.friction_force;
    places.push_back({.row = local[place].row,
                      .gap = at.gap,
                      .pressure = at.pressure,
                      .energy = at.spring_energy,
                      .displacement = {dot(at.displacement, first), dot(at.displacement, second)},
                      .shear = {dot(holding, first), dot(holding, second)}});
  }
  return places;
}

}  // namespace balocco
