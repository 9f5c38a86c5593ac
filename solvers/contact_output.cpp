#include "contact_output.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "output_instant.hpp"

namespace balocco {

namespace {

/// What a slave node tells: its own place, or the places of the faces around it, each with its share.
struct NodalContact {
  double gap = 0.0, pressure = 0.0, shear = 0.0, slip = 0.0;
  Point normal_force{}, friction_force{};
};

std::map<std::int32_t, NodalContact> nodes_of_mesh_contact(const Analysis& analysis, std::size_t pair) {
  const auto& contact = analysis.mesh_contacts[pair];
  std::map<std::int32_t, NodalContact> nodes;
  std::map<std::int32_t, double> shares;
  for (std::int32_t place = 0; place < contact.size(); ++place) {
    const auto output = contact.output(place, analysis.current.position.data(), analysis.current.contact[pair][place]);
    for (std::size_t i = 0; i < contact.nodes(place).size(); ++i) {
      const auto node = contact.nodes(place)[i];
      const double weight = contact.weights(place)[i], share = std::abs(weight) * contact.area(place);
      auto& sum = nodes[node];
      shares[node] += share;
      sum.gap += share * output.gap;
      sum.pressure += share * output.pressure;
      sum.shear += share * output.shear;
      sum.slip += share * output.slip;
      for (int k = 0; k < 3; ++k) {
        sum.normal_force[k] += weight * output.normal_force[k];
        sum.friction_force[k] += weight * output.friction_force[k];
      }
    }
  }
  for (auto& [node, sum] : nodes)
    for (double* value : {&sum.gap, &sum.pressure, &sum.shear, &sum.slip}) *value /= shares[node];
  return nodes;
}

/// Calls visit(local node, what it tells) for the slave nodes on this rank of all pairs.
template <class Visit>
void for_each_slave_node(const Analysis& analysis, Visit visit) {
  for_each_contact_point(analysis, [&](std::int32_t node, const RigidContact::Output& output, const auto&...) { visit(node, output); });
  for (std::size_t pair = 0; pair < analysis.mesh_contacts.size(); ++pair)
    if (analysis.mesh_contacts[pair].size() > 0)
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

}  // namespace balocco
