// What contact adds to ImplicitSystem, with rigid masters and with those that deform.
#include <algorithm>
#include <cmath>

#include "implicit_system.hpp"

namespace balocco {

template <class Visit>
void ImplicitSystem::for_each_contact(Visit visit) const {
  for (const auto pair : step_.active_contact_pairs) {
    const auto& rigid = analysis_.contacts[pair];
    for (std::int32_t point = 0; point < rigid.size(); ++point) visit(pair, rigid, point, analysis_.domain.owned[rigid.nodes()[point]]);
    const auto& mesh = analysis_.mesh_contacts[pair];
    for (std::int32_t place = 0; place < mesh.size(); ++place) visit(pair, mesh, place, mesh.owned(place));
  }
}

void ImplicitSystem::record_contact() {
  pairings_.resize(analysis_.mesh_contacts.size());
  std::vector<std::int32_t> nodes;
  for (const auto pair : step_.active_contact_pairs) {
    const auto& contact = analysis_.contacts[pair];
    for (const auto node : contact.nodes()) {
      const auto master = analysis_.domain.local_node[analysis_.model.rigid_bodies[contact.master_body()].reference_node];
      if (analysis_.domain.owned[node])
        stiffness_.add(std::array{map_.motion(node), map_.motion(master), map_.spin(contact.master_body())}, {});
    }
    const auto& mesh = analysis_.mesh_contacts[pair];
    pairings_[pair].resize(mesh.size());
    for (std::int32_t place = 0; place < mesh.size(); ++place) {
      if (!mesh.owned(place)) continue;
      mesh.coupled_nodes(place, pairings_[pair][place], nodes);
      stiffness_.add(motions_of(nodes), {});
    }
  }
}

/// Takes up the faces that places have come upon; where they are others than before, the pattern of the stiffness is recorded anew.
void ImplicitSystem::follow_faces() {
  bool changed = false;
  for (const auto pair : step_.active_contact_pairs) {
    auto& contact = analysis_.mesh_contacts[pair];
    contact.follow(analysis_.current.position.data());
    for (std::int32_t place = 0; place < contact.size(); ++place) {
      if (!contact.owned(place)) continue;
      const auto now = contact.pairing(place, analysis_.current.position.data(), start_contact_[pair][place]);
      if (now.face < 0 || now == pairings_[pair][place]) continue;
      pairings_[pair][place] = now;
      changed = true;
    }
  }
  if (!has_contact() || !analysis_.communicator.any(changed)) return;
  stiffness_.forget_pattern();
  record_pattern();
}

void ImplicitSystem::add_contact(bool sticks) {
  const auto before = trial_contact_;
  contact_force_.assign(residual_.size(), 0.0);
  sticking_.assign(residual_.size(), 0.0);
  for (const auto pair : step_.active_contact_pairs) {
    for (std::int32_t point = 0; point < analysis_.contacts[pair].size(); ++point) add_contact_point(pair, point, sticks);
    for (std::int32_t place = 0; place < analysis_.mesh_contacts[pair].size(); ++place) add_contact_place(pair, place, sticks);
  }
  count_points(before);
}

void ImplicitSystem::count_points(const std::vector<std::vector<ContactPoint>>& closed_before) {
  std::array<double, 3> counts{};
  double &turned = counts[0], &closed = counts[1], &changed = counts[2];
  for_each_contact([&](std::int32_t pair, const auto&, std::int32_t point, bool owned) {
    if (!owned) return;
    const bool now = trial_contact_[pair][point].closed > 0.0, before = closed_before[pair][point].closed > 0.0;
    turned += slips_[pair][point].turns_back() ? 1 : 0;
    closed += now ? 1 : 0;
    changed += now != before ? 1 : 0;
  });
  if (has_contact()) analysis_.communicator.sum(std::span<double>(counts));
  turned_points_ = static_cast<std::int64_t>(turned);
  closed_points_ = static_cast<std::int64_t>(closed);
  changed_points_ = static_cast<std::int64_t>(changed);
}

void ImplicitSystem::add_contact_point(std::int32_t pair, std::int32_t point, bool sticks) {
  const auto& contact = analysis_.contacts[pair];
  const auto body = contact.master_body();
  const auto& master = analysis_.current.rigid_bodies[body];
  const double* position = analysis_.current.position.data();
  auto& slips = slips_[pair][point];
  const auto tangent =
      contact.linearize(point, position, master, start_contact_[pair][point], trial_contact_[pair][point], sticks, slips.before);
  slips.now = tangent.slip;
  const auto node = contact.nodes()[point];
  if (!analysis_.domain.owned[node]) return;

  const auto reference = analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node];
  Point arm{};
  for (int i = 0; i < 3; ++i) arm[i] = position[4 * node + i] - master.position[i];
  const auto moment = cross(Vector3<double>{arm}, Vector3<double>{tangent.force});
  // The residual is internal - external - contact; the master feels the opposite of the slave's force.
  auto& sum = dynamics_ ? contact_force_ : residual_;
  for (int i = 0; i < 3; ++i) {
    sum[map_.slot(node, i)] -= tangent.force[i];
    sum[map_.slot(reference, i)] += tangent.force[i];
    sum[map_.rotation_slot(body, i)] += moment[i];
  }
  block_.assign(81, 0.0);
  for (int column = 0; column < 9; ++column) {
    Point change{}, arm_change{};
    for (int i = 0; i < 3; ++i) change[i] = tangent.derivative[9 * i + column];
    if (column < 6) arm_change[column % 3] = column < 3 ? 1.0 : -1.0;
    const auto from_force = cross(Vector3<double>{arm}, Vector3<double>{change});
    const auto from_arm = cross(Vector3<double>{arm_change}, Vector3<double>{tangent.force});
    for (int i = 0; i < 3; ++i) {
      block_[9 * i + column] = -change[i];
      block_[9 * (3 + i) + column] = change[i];
      block_[9 * (6 + i) + column] = from_force[i] + from_arm[i];
    }
  }
  const std::array motions{map_.motion(node), map_.motion(reference), map_.spin(body)};
  stiffness_.add(motions, block_);
  if (slips.turns_back()) stiffness_.add_product(motions, block_, std::array{1.0}, slips.now.component, sticking_);
}

void ImplicitSystem::add_contact_place(std::int32_t pair, std::int32_t place, bool sticks) {
  const auto& contact = analysis_.mesh_contacts[pair];
  if (!contact.owned(place)) return;
  auto& slips = slips_[pair][place];
  auto& tangent = mesh_tangent_;
  contact.linearize(place, pairings_[pair][place], analysis_.current.position.data(), start_contact_[pair][place],
                    trial_contact_[pair][place], sticks, slips.before, tangent);
  slips.now = tangent.slip;
  auto& sum = dynamics_ ? contact_force_ : residual_;
  for (std::size_t i = 0; i < tangent.force.size(); ++i)
    sum[map_.slot(tangent.nodes[i / 3], static_cast<int>(i % 3))] -= tangent.force[i];
  for (double& value : tangent.derivative) value = -value;
  const auto motions = motions_of(tangent.nodes);
  stiffness_.add(motions, tangent.derivative);
  if (slips.turns_back())
    stiffness_.add_product(motions, tangent.derivative, tangent.slave_shares, slips.now.component, sticking_);
}

double ImplicitSystem::greatest_misfit() const {
  double misfit = 0.0;
  const double* position = analysis_.current.position.data();
  for (const auto pair : step_.active_contact_pairs) {
    const auto& contact = analysis_.contacts[pair];
    auto points = start_contact_[pair];  // only looked at
    misfit = std::max(misfit, contact.size() > 0 ? contact.augment(position, analysis_.current.rigid_bodies[contact.master_body()], points)
                                                 : analysis_.mesh_contacts[pair].augment(position, points));
  }
  return analysis_.communicator.maximum(misfit);
}

bool ImplicitSystem::starts_in_contact() const {
  const auto closed = [](const std::vector<ContactPoint>& points) {
    return std::ranges::any_of(points, [](const ContactPoint& point) { return point.closed > 0.0; });
  };
  return has_contact() && analysis_.communicator.any(std::ranges::any_of(start_contact_, closed));
}

void ImplicitSystem::augment_contact() {
  const double* position = analysis_.current.position.data();
  for (const auto pair : step_.active_contact_pairs) {
    const auto& contact = analysis_.contacts[pair];
    if (contact.size() > 0)
      contact.augment(position, analysis_.current.rigid_bodies[contact.master_body()], start_contact_[pair]);
    analysis_.mesh_contacts[pair].augment(position, start_contact_[pair]);
  }
}

/// Nothing may push across a gap when an increment of dynamics ends: that would give energy.
void ImplicitSystem::lower_multipliers() {
  auto& state = analysis_.current;
  for (const auto pair : step_.active_contact_pairs) {
    const auto& contact = analysis_.contacts[pair];
    if (contact.size() > 0)
      contact.lower_multipliers(state.position.data(), state.rigid_bodies[contact.master_body()], state.contact[pair]);
    analysis_.mesh_contacts[pair].lower_multipliers(state.position.data(), state.contact[pair]);
  }
}

double ImplicitSystem::contact_length() const {
  std::array<double, 2> sum{};
  for_each_contact([&](std::int32_t, const auto& contact, std::int32_t point, bool owned) {
    if (!owned) return;
    sum[0] += std::sqrt(contact.area(point));
    sum[1] += 1.0;
  });
  analysis_.communicator.sum(std::span<double>(sum));
  return sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
}

}  // namespace balocco
