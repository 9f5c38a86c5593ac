// What an analysis tells those who write results: nodal fields, energies, contact resultants.
#include <algorithm>
#include <map>

#include "analysis.hpp"
#include "constraints/rigid_body.hpp"
#include "elements/element_type.hpp"
#include "joint_angles.hpp"
#include "math/rotation.hpp"
#include "total_force.hpp"

namespace balocco {

namespace {

/// Time by which the state's velocities are ahead of its positions: half an explicit increment.
double lead(const Analysis& analysis) {
  const auto &steps = analysis.model.steps;
  const auto step = static_cast<std::size_t>(analysis.current.step);
  const bool is_explicit = step < steps.size() && std::holds_alternative<ExplicitProcedure>(steps[step].procedure);
  return is_explicit ? 0.5 * analysis.current.time_increment : 0.0;
}

/// Velocity at the present instant.
Point velocity_now(const Analysis& analysis, std::int32_t node) {
  const auto& state = analysis.current;
  Point velocity{};
  if (state.dynamic)
    for (int i = 0; i < 3; ++i)
      velocity[i] = state.velocity[4 * node + i] - lead(analysis) * analysis.acceleration[4 * node + i];
  return velocity;
}

double square(const double* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

/// Twice the kinetic energy per mass that central differences conserve with the energy of position: the product of the velocities
/// before and behind the instant, v(n-1/2) . v(n+1/2) = v^2 - (a dt / 2)^2. Near the limit of stability v^2 alone does not.
double conserved_square(const Analysis& analysis, const double* velocity, const double* acceleration) {
  const double half = 0.5 * analysis.output_increment;
  return square(velocity) - half * half * square(acceleration);
}

/// Calls `visit(local node, output, contact point, master body)` for every slave node on this rank of every pair.
template <class Visit>
void for_each_contact_point(const Analysis& analysis, Visit visit) {
  for (std::size_t pair = 0; pair < analysis.contacts.size(); ++pair) {
    const auto& contact = analysis.contacts[pair];
    const auto& master = analysis.current.rigid_bodies[contact.master_body()];
    for (std::int32_t point = 0; point < contact.size(); ++point)
      visit(contact.nodes()[point],
            contact.output(point, analysis.current.position.data(), master, analysis.current.contact[pair][point]),
            analysis.current.contact[pair][point], master);
  }
}

/// What the energy of a stiff spring at an instant lacks, so that it stays in balance through an impact: central differences and the
/// discrete gradient conserve the mean of its energies in the middles of both increments, plus (dt / 2)^2 force . acceleration; at the
/// end of a step, behind which there is no increment, that in the middle before, less dt / 2 force . velocity there.
double stiff_spring_correction(const Analysis& analysis, const RigidBodyState& master, std::int32_t node,
                               const RigidContact::Output& output, const ContactPoint& point) {
  const Vector3<double> force{output.normal_force};
  const double pressure = std::sqrt(dot(force, force)), half = 0.5 * analysis.output_increment;
  if (!(pressure > 0.0) || point.stiff_spring == 0.0) return 0.0;
  const auto normal = (1.0 / pressure) * force;
  const double* const x = &analysis.current.position[4 * node];
  const double* const a = &analysis.acceleration[4 * node];
  const auto arm = Vector3<double>{x[0], x[1], x[2]} - Vector3<double>{master.position};
  const auto below = Vector3<double>{master.velocity} + cross(Vector3<double>{master.angular_velocity}, arm);
  const double departure = dot(Vector3<double>{velocity_now(analysis, node)} - below, normal);
  const double change = half * dot(Vector3<double>{a[0], a[1], a[2]}, normal);
  const auto energy = [&](double gap) {
    const double stretched = std::max(0.0, point.multiplier - point.stiff_spring * gap);
    return 0.5 * stretched * stretched / point.stiff_spring;
  };
  const double before = energy(output.gap - half * (departure - change));
  if (analysis.current.time_increment == 0.0) return before - energy(output.gap) - half * pressure * (departure - change);
  const double after = energy(output.gap + half * (departure + change));
  return 0.5 * (before + after) - energy(output.gap) + half * pressure * change;
}

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

Point entry(const std::vector<double>& nodal, std::int32_t node) {
  return {nodal[4 * node], nodal[4 * node + 1], nodal[4 * node + 2]};
}

/// Angular velocity at the present instant.
Point spin_now(const Analysis& analysis, const Point& half_step, const Point& acceleration) {
  Point now = half_step;
  for (int i = 0; i < 3; ++i) now[i] -= lead(analysis) * acceleration[i];
  return now;
}

Point spin_of_node(const Analysis& analysis, std::int32_t node) {
  return spin_now(analysis, entry(analysis.current.angular_velocity, node), entry(analysis.angular_acceleration, node));
}

void rotation(const Analysis& analysis, std::span<double> values) {
  rotational(
      analysis, values, [&](std::int32_t node) { return entry(analysis.current.rotation, node); },
      [&](std::int32_t body) { return analysis.current.rigid_bodies[body].rotation; });
  add_joint_angles(analysis, values);
}

void angular_velocity(const Analysis& analysis, std::span<double> values) {
  rotational(
      analysis, values, [&](std::int32_t node) { return spin_of_node(analysis, node); },
      [&](std::int32_t body) {
        return spin_now(analysis, analysis.current.rigid_bodies[body].angular_velocity,
                        analysis.body_angular_acceleration[body]);
      });
  add_joint_rates(analysis, values);
}

void angular_acceleration(const Analysis& analysis, std::span<double> values) {
  rotational(
      analysis, values, [&](std::int32_t node) { return entry(analysis.angular_acceleration, node); },
      [&](std::int32_t body) { return analysis.body_angular_acceleration[body]; });
}

void reaction_moment(const Analysis& analysis, std::span<double> values) {
  rotational(
      analysis, values, [&](std::int32_t node) { return entry(analysis.reaction_moment, node); },
      [&](std::int32_t body) -> Point {
        const auto& six = analysis.body_reaction[body];
        return {six[3], six[4], six[5]};
      });
  add_joint_reactions(analysis, values);
}

/// A scalar of the contact points; where a node is in several pairs the largest counts.
template <class Value>
void contact_scalar(const Analysis& analysis, std::span<double> values, double elsewhere, Value value) {
  std::ranges::fill(values, elsewhere);
  for_each_contact_point(analysis, [&](std::int32_t node, const RigidContact::Output& output, const auto&...) {
    values[node] = std::max(values[node], value(output));
  });
}

void contact_pressure(const Analysis& analysis, std::span<double> values) {
  contact_scalar(analysis, values, 0.0, [](const auto& output) { return output.pressure; });
}

void contact_shear(const Analysis& analysis, std::span<double> values) {
  contact_scalar(analysis, values, 0.0, [](const auto& output) { return output.shear; });
}

void contact_slip(const Analysis& analysis, std::span<double> values) {
  contact_scalar(analysis, values, 0.0, [](const auto& output) { return output.slip; });
}

/// Distance to the nearest master; zero on nodes of no contact pair.
void contact_opening(const Analysis& analysis, std::span<double> values) {
  std::ranges::fill(values, 0.0);
  std::vector<bool> seen(values.size());
  for_each_contact_point(analysis, [&](std::int32_t node, const RigidContact::Output& output, const auto&...) {
    values[node] = seen[node] ? std::min(values[node], output.gap) : output.gap;
    seen[node] = true;
  });
}

template <class Value>
void contact_vector(const Analysis& analysis, std::span<double> values, Value value) {
  std::ranges::fill(values, 0.0);
  for_each_contact_point(analysis, [&](std::int32_t node, const RigidContact::Output& output, const auto&...) {
    for (int i = 0; i < 3; ++i) values[3 * node + i] += value(output)[i];
  });
}

void contact_normal_force(const Analysis& analysis, std::span<double> values) {
  contact_vector(analysis, values, [](const auto& output) { return output.normal_force; });
}

void contact_shear_force(const Analysis& analysis, std::span<double> values) {
  contact_vector(analysis, values, [](const auto& output) { return output.friction_force; });
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
    small_strain_ = std::make_unique<SmallStrainOutput>(std::move(reference));
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

void Analysis::add_kinetic_energy_of_rotary_inertia(ExactSum& sum) const {
  std::vector<double> spin(3 * domain.size());
  angular_velocity(*this, spin);
  for (const auto& elements : model.elements) {
    if (elements.type->section != Section::Kind::rotary_inertia) continue;
    for (std::int32_t row = 0; row < elements.size(); ++row) {
      const auto node = domain.local_node[elements.connectivity[row]];
      if (node < 0 || !domain.owned[node] || reference_of(node) < 0) continue;
      // Into the body frame, in which the inertia is constant.
      const auto turned = transpose(rotation_matrix(current.rigid_bodies[reference_of(node)])) *
                          Vector3<double>{{spin[3 * node], spin[3 * node + 1], spin[3 * node + 2]}};
      const auto& inertia = model.sections[elements.section[row]].inertia;
      const Matrix3<double> tensor{{inertia[0], inertia[3], inertia[4], inertia[3], inertia[1], inertia[5], inertia[4],
                                    inertia[5], inertia[2]}};
      sum.add(0.5 * dot(turned, tensor * turned));
    }
  }
}

EnergyBalance Analysis::energies() const {
  if (sampled_.step != current.step || sampled_.increment != current.increment || current.increment == 0)
    sampled_ = {current.step, current.increment, sum_energies()};
  return sampled_.balance;
}

/// Calls `visit` with the energies of each element of a group that takes part.
template <class Visit>
void Analysis::for_each_energies(std::size_t index, Visit visit) const {
  const auto& group = *element_groups[index];
  const bool all_take_part = model.steps.empty() || current.step >= static_cast<std::int32_t>(model.steps.size()) ||
                             model.steps[current.step].removed_elements.empty();
  std::array<ElementEnergies, 8 * pack_size> energies;
  std::vector<double> history(group.history_size());
  for (std::int32_t first = 0; first < group.size(); first += static_cast<std::int32_t>(energies.size())) {
    const auto lanes = std::span(energies).first(
        std::min<std::size_t>(energies.size(), static_cast<std::size_t>(group.padded_size() - first)));
    if (!current.linear) group.energies(first, current.motion(), current.element_history[index], lanes);
    const auto last = std::min(first + static_cast<std::int32_t>(lanes.size()), group.size());
    for (std::int32_t element = first; element < last; ++element) {
      if (!all_take_part && !takes_part(group, element)) continue;
      if (!current.linear) {
        visit(energies[element - first]);
        continue;
      }
      group.gather_history(element, current.element_history[index], history);
      visit(small_strain().energies(group, element, current, history));
    }
  }
}

/// That of the explicit loop: of lumped masses, and as central differences conserve it.
void Analysis::add_kinetic_energy(ExactSum& sum) const {
  const auto add = [&](double addend) {
    if (addend != 0.0) sum.add(addend);
  };
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    if (!domain.owned[node]) continue;
    const auto v = velocity_now(*this, node);
    add(0.5 * scaled_inertia().mass[node] * conserved_square(*this, v.data(), &acceleration[4 * node]));
    if (node >= domain.turning) continue;
    const auto w = spin_of_node(*this, node);
    add(0.5 * scaled_inertia().rotary[node] * conserved_square(*this, w.data(), &angular_acceleration[4 * node]));
  }
  add_kinetic_energy_of_rotary_inertia(sum);
  for (const auto& given : rotary_tensors) {
    if (!domain.owned[given.node] || reference_of(given.node) >= 0) continue;
    const double* const q = &current.orientation[4 * given.node];
    const Vector3<double> spin{spin_of_node(*this, given.node)};
    const auto in_reference = transpose(rotation_matrix(Quaternion<double>{q[0], q[1], q[2], q[3]})) * spin;
    sum.add(0.5 * dot(in_reference, given.tensor * in_reference));
  }
}

EnergyBalance Analysis::sum_energies() const {
  enum { kinetic, strain, hourglass, viscous, plastic, friction, contact_springs, work, mass_scaling, count };
  std::array<ExactSum, count> sums;
  // Most of the addends are zero in most models.
  const auto add = [&](int kind, double addend) {
    if (addend != 0.0) sums[kind].add(addend);
  };
  for (std::size_t index = 0; index < element_groups.size(); ++index)
    for_each_energies(index, [&](const ElementEnergies& energies) {
      add(strain, energies.strain);
      add(hourglass, energies.hourglass);
      add(viscous, energies.viscous);
      add(plastic, energies.plastic);
    });
  kinetic_energy ? sums[kinetic].add(*kinetic_energy) : add_kinetic_energy(sums[kinetic]);
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    if (!domain.owned[node]) continue;
    add(work, current.nodal_work[node].external);
    add(viscous, current.nodal_work[node].damping);
    add(friction, current.nodal_work[node].friction);
    add(mass_scaling, current.nodal_work[node].mass_scaling);
    add(work, -work_ahead[node].external);
    add(viscous, -work_ahead[node].damping);
    add(friction, -work_ahead[node].friction);
  }
  for_each_contact_point(*this, [&](std::int32_t node, const RigidContact::Output& output, const ContactPoint& point,
                                    const RigidBodyState& master) {
    if (!domain.owned[node]) return;
    sums[contact_springs].add(output.spring_energy + stiff_spring_correction(*this, master, node, output, point));
    sums[friction].add(point.frictional_dissipation);
  });
  communicator.sum(std::span<ExactSum>(sums));

  EnergyBalance balance;
  balance.kinetic = sums[kinetic].value();
  balance.strain = sums[strain].value();
  balance.hourglass = sums[hourglass].value();
  balance.plastic = sums[plastic].value();
  balance.contact = sums[contact_springs].value();
  balance.viscous = sums[viscous].value();
  balance.friction = sums[friction].value();
  balance.work = sums[work].value();
  balance.mass_scaling = sums[mass_scaling].value();
  balance.internal = balance.strain + balance.hourglass + balance.plastic + balance.contact;
  balance.total = balance.kinetic + balance.internal + balance.viscous + balance.friction - balance.work - balance.mass_scaling;
  return balance;
}

ContactResultant Analysis::contact(std::int32_t pair) const {
  const auto& surface_pair = contacts[pair];
  return surface_pair.resultant(communicator, current.position.data(), current.rigid_bodies[surface_pair.master_body()],
                                current.contact[pair]);
}

}  // namespace balocco
