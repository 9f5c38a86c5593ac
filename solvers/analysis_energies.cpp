// Energies of an analysis, for output and the balance.
#include <algorithm>
#include <cmath>

#include "constraints/rigid_body.hpp"
#include "elements/element_type.hpp"
#include "math/rotation.hpp"
#include "output_instant.hpp"

namespace balocco {

namespace {

double square(const double* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

/// Twice the kinetic energy per mass that central differences conserve with the energy of position: the product of the velocities
/// before and behind the instant, v(n-1/2) . v(n+1/2) = v^2 - (a dt / 2)^2. Near the limit of stability v^2 alone does not.
double conserved_square(const Analysis& analysis, const double* velocity, const double* acceleration) {
  const double half = 0.5 * analysis.output_increment;
  return square(velocity) - half * half * square(acceleration);
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

}  // namespace

void Analysis::add_kinetic_energy_of_rotary_inertia(ExactSum& sum) const {
  for (const auto& elements : model.elements) {
    if (elements.type->section != Section::Kind::rotary_inertia) continue;
    for (std::int32_t row = 0; row < elements.size(); ++row) {
      const auto node = domain.local_node[elements.connectivity[row]];
      if (node < 0 || !domain.owned[node] || reference_of(node) < 0) continue;
      const auto body = reference_of(node);
      // Into the body frame, in which the inertia is constant.
      const auto turned = transpose(rotation_matrix(current.rigid_bodies[body])) * Vector3<double>{spin_of_body(*this, body)};
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
      add(work, energies.heat);
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
  for (std::size_t pair = 0; pair < mesh_contacts.size(); ++pair)
    for (std::int32_t place = 0; place < mesh_contacts[pair].size(); ++place) {
      if (!mesh_contacts[pair].owned(place)) continue;
      const auto& point = current.contact[pair][place];
      sums[contact_springs].add(mesh_contacts[pair].output(place, current.position.data(), point).spring_energy);
      sums[friction].add(point.frictional_dissipation);
    }
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

}  // namespace balocco
