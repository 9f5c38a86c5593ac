// What an analysis tells those who write results: fields of nodes and elements, contact resultants.
#include <algorithm>
#include <map>

#include "analysis.hpp"
#include "constraints/rigid_body.hpp"
#include "elements/element_type.hpp"
#include "joint_angles.hpp"
#include "contact_output.hpp"
#include "output_instant.hpp"
#include "thermal_strains.hpp"
#include "total_force.hpp"

namespace balocco {

namespace {

using NodalField = void (*)(const Analysis&, std::span<double>);

void displacement(const Analysis& analysis, std::span<double> values) {
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node) {
    const auto& reference = analysis.model.nodes.coordinates[analysis.domain.node_row[node]];
    for (int i = 0; i < 3; ++i) values[3 * node + i] = analysis.current.position[4 * node + i] - reference[i];
  }
}

void velocity(const Analysis& analysis, std::span<double> values) {
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    std::ranges::copy(velocity_now(analysis, node), &values[3 * node]);
}

void acceleration(const Analysis& analysis, std::span<double> values) {
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    std::copy_n(&analysis.acceleration[4 * node], 3, &values[3 * node]);
}

void reaction(const Analysis& analysis, std::span<double> values) {
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node) {
    const auto body = analysis.reference_of(node);
    std::copy_n(body >= 0 ? analysis.body_reaction[body].data() : &analysis.reaction[4 * node], 3, &values[3 * node]);
  }
}

/// Fills a field of rotations: of nodes that turn, and of bodies on their reference nodes; zero elsewhere.
template <class OfNode, class OfBody>
void rotational(const Analysis& analysis, std::span<double> values, OfNode of_node, OfBody of_body) {
  std::ranges::fill(values, 0.0);
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node) {
    const auto body = analysis.reference_of(node);
    if (body < 0 && node >= analysis.domain.turning) continue;
    const Point vector = body >= 0 ? of_body(body) : of_node(node);
    std::ranges::copy(vector, &values[3 * node]);
  }
}

void rotation(const Analysis& analysis, std::span<double> values) {
  rotational(
      analysis, values, [&](std::int32_t node) { return nodal_vector(analysis.current.rotation, node); },
      [&](std::int32_t body) { return analysis.current.rigid_bodies[body].rotation; });
  add_joint_angles(analysis, values);
}

void angular_velocity(const Analysis& analysis, std::span<double> values) {
  rotational(
      analysis, values, [&](std::int32_t node) { return spin_of_node(analysis, node); },
      [&](std::int32_t body) { return spin_of_body(analysis, body); });
  add_joint_rates(analysis, values);
}

void angular_acceleration(const Analysis& analysis, std::span<double> values) {
  rotational(
      analysis, values, [&](std::int32_t node) { return nodal_vector(analysis.angular_acceleration, node); },
      [&](std::int32_t body) { return analysis.body_angular_acceleration[body]; });
}

void reaction_moment(const Analysis& analysis, std::span<double> values) {
  rotational(
      analysis, values, [&](std::int32_t node) { return nodal_vector(analysis.reaction_moment, node); },
      [&](std::int32_t body) -> Point {
        const auto& six = analysis.body_reaction[body];
        return {six[3], six[4], six[5]};
      });
  add_joint_reactions(analysis, values);
}

void temperature(const Analysis& analysis, std::span<double> values) {
  const auto& steps = analysis.model.steps;
  const auto& state = analysis.current;
  const auto row = std::min<std::size_t>(state.step, steps.size() - 1);
  const double step_time = state.step < static_cast<std::int32_t>(steps.size()) ? state.step_time : steps[row].duration();
  find_nodal_temperatures(analysis, steps[row], step_time, state.total_time, values);
}

struct NodalVariable {
  int components;
  NodalField evaluate;
};

const std::map<std::string_view, NodalVariable> nodal_variables{
    {"U", {3, displacement}},
    {"V", {3, velocity}},
    {"A", {3, acceleration}},
    {"RF", {3, reaction}},
    {"UR", {3, rotation}},
    {"VR", {3, angular_velocity}},
    {"AR", {3, angular_acceleration}},
    {"RM", {3, reaction_moment}},
    {"TF", {3, total_force}},
    {"NT", {1, temperature}},
    {"CPRESS", {1, contact_pressure}},
    {"COPEN", {1, contact_opening}},
    {"CSHEAR", {1, contact_shear}},
    {"CSLIP", {1, contact_slip}},
    {"CNORMF", {3, contact_normal_force}},
    {"CSHEARF", {3, contact_shear_force}},
};

}  // namespace

int Analysis::nodal_components(std::string_view variable) const {
  const auto entry = nodal_variables.find(variable);
  return entry == nodal_variables.end() ? 0 : entry->second.components;
}

void Analysis::nodal(std::string_view variable, std::span<double> values) const {
  nodal_variables.at(variable).evaluate(*this, values);
}

SmallStrainOutput& Analysis::small_strain() const {
  if (!small_strain_) {
    std::vector<double> reference(current.position.size(), 0.0);
    for (std::int32_t node = 0; node < domain.size(); ++node)
      std::ranges::copy(model.nodes.coordinates[domain.node_row[node]], &reference[4 * node]);
    small_strain_ = std::make_unique<SmallStrainOutput>(model, std::move(reference));
  }
  return *small_strain_;
}

void Analysis::element(std::size_t index, std::string_view variable, std::int32_t element, int integration_point,
                       std::span<double> values) const {
  if (variable == "NFORC") return internal_force(index, element, values);
  const auto& group = *element_groups[index];
  std::vector<double> history(group.history_size());
  group.gather_history(element, current.element_history[index], history);
  if (current.linear)
    small_strain().output(group, variable, element, integration_point, current, history, values);
  else
    group.output(variable, element, integration_point, current.motion(), history, values);
  if (!constraints_of_connector_.empty() && variable.starts_with('C'))
    add_connector_forces({group.table(), group.row(element)}, variable, values);
}

void Analysis::element_mean(std::size_t index, std::string_view variable, std::int32_t element, std::span<double> values) const {
  const auto& group = *element_groups[index];
  if (current.linear || variable == "NFORC" || variable.starts_with('C')) return ResultSource::element_mean(index, variable, element, values);
  std::vector<double> history(group.history_size());
  group.gather_history(element, current.element_history[index], history);
  group.mean_output(variable, element, current.motion(), history, values);
}

void Analysis::internal_force(std::size_t index, std::int32_t element, std::span<double> force) const {
  const auto& group = *element_groups[index];
  std::vector<double> history(group.history_size()), unused(group.history_size());
  group.gather_history(element, current.element_history[index], history);
  if (current.linear)
    small_strain().internal_force(group, element, current, history, force);
  else
    group.linearize(element, current.motion(), history, unused, force, {});
}

ContactResultant Analysis::contact(std::int32_t pair) const {
  const auto& surface_pair = contacts[pair];
  if (surface_pair.master_body() < 0) return mesh_contacts[pair].resultant(communicator, current.position.data(), current.contact[pair]);
  return surface_pair.resultant(communicator, current.position.data(), current.rigid_bodies[surface_pair.master_body()],
                                current.contact[pair]);
}

}  // namespace balocco
