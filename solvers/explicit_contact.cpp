#include "explicit_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/bounding_box.hpp"

namespace balocco {

ExplicitContact::ExplicitContact(const Analysis& analysis, const Step& step, const NodalConstraints& constraints,
                                 const RigidDynamics& bodies, std::span<const double> inverse_mass)
    : stiffness_(inverse_mass.size(), 0.0) {
  for (const auto row : step.active_contact_pairs) {
    const auto& contact = analysis.contacts[row];
    if (contact.master_body() < 0) {
      mesh_pairs_.push_back(row);
      analysis.mesh_contacts[row].add_spring_stiffness(stiffness_);
      continue;
    }
    Pair pair{.row = row,
              .master = bodies.yielding(static_cast<std::size_t>(contact.master_body())),
              .freedom = std::vector<SlaveFreedom>(static_cast<std::size_t>(contact.size())),
              .stiff = {}};
    // Single nodes stand for no face whose pressure would ask for a harder spring.
    const bool hard =
        analysis.model.surfaces[analysis.model.contact_pairs[row].slave].kind == Surface::Kind::element_faces && !contact.is_soft();
    for (std::int32_t point = 0; point < contact.size(); ++point) {
      auto& freedom = pair.freedom[point];
      freedom.inverse_mass = inverse_mass[contact.nodes()[point]];
      for (const auto& constraint : constraints.of_node(contact.nodes()[point])) {
        if (freedom.held == 3) break;
        freedom.direction[freedom.held] = constraint.direction;
        held_.push_back({pairs_.size(), static_cast<std::size_t>(point), freedom.held++, &constraint});
      }
      pair.stiff.push_back(hard && !pair.master.yields() && freedom.yields());
    }
    contact.add_spring_stiffness(pair.stiff, stiffness_);
    free_masters_ = free_masters_ || pair.master.yields();
    pairs_.push_back(std::move(pair));
  }
  find_nodal_frequency(analysis);
}

/// Of a rigid body's nodes the heaviest pull is on one alone: stiffness / mass of the body is at most the largest of its nodes.
void ExplicitContact::find_nodal_frequency(const Analysis& analysis) {
  const auto& mass = analysis.scaled_inertia().mass;
  nodal_frequency_squared_.assign(stiffness_.size(), 0.0);
  double largest = 0.0;
  for (std::size_t node = 0; node < stiffness_.size(); ++node) {
    if (mass[node] > 0.0) nodal_frequency_squared_[node] = stiffness_[node] / mass[node];
    largest = std::max(largest, nodal_frequency_squared_[node]);
  }
  largest_nodal_frequency_squared_ = analysis.communicator.maximum(largest);
}

void ExplicitContact::renew_inertia(const Analysis& analysis, const RigidDynamics& bodies, std::span<const double> inverse_mass) {
  for (auto& pair : pairs_) {
    const auto& contact = analysis.contacts[pair.row];
    pair.master = bodies.yielding(static_cast<std::size_t>(contact.master_body()));
    for (std::int32_t point = 0; point < contact.size(); ++point)
      pair.freedom[point].inverse_mass = inverse_mass[contact.nodes()[point]];
  }
  find_nodal_frequency(analysis);
}

void ExplicitContact::choose_springs(Analysis& analysis) const {
  auto& state = analysis.current;
  for (const auto& pair : pairs_) {
    const auto& contact = analysis.contacts[pair.row];
    contact.choose_springs(state.position.data(), state.rigid_bodies[contact.master_body()], pair.stiff,
                           state.contact[pair.row]);
  }
}

void ExplicitContact::tell_overclosure(const Analysis& analysis, std::int32_t row, double depth, std::int32_t node, bool thrown,
                                       Observer& observer) const {
  const auto& model = analysis.model;
  const double touching = 1e-7 * model_size(model);  // coordinates have 7 digits
  const auto id = node >= 0 ? model.nodes.id[analysis.domain.node_row[node]] : std::int64_t{-1};
  const auto deepest = analysis.communicator.minimum(Communicator::Located{-depth, id});
  if (-deepest.value <= touching) return;
  const auto& definition = model.contact_pairs[row];
  observer.log(fmt::format(
      "{}: warning: *CONTACT PAIR: node {} of {} starts {:.4g} below {}, the deepest of its surface, and {}; move the surfaces "
      "apart, or close them in a static step first",
      model.where(definition.location), deepest.payload, model.surfaces[definition.slave].name, -deepest.value,
      model.surfaces[definition.master].name,
      thrown ? "will be thrown out" : "stays there until it rises: nothing pushes it out"));
}

void ExplicitContact::report_overclosure(const Analysis& analysis, Observer& observer) const {
  const auto& state = analysis.current;
  for (const auto& pair : pairs_) {
    const auto& contact = analysis.contacts[pair.row];
    const auto [depth, node] = contact.deepest(state.position.data(), state.rigid_bodies[contact.master_body()], state.contact[pair.row],
                                               RigidContact::Which::open);
    const bool thrown = analysis.communicator.any(std::ranges::count(pair.stiff, false) > 0);
    tell_overclosure(analysis, pair.row, depth, node, thrown, observer);
  }
  for (const auto row : mesh_pairs_) {
    const auto [depth, node] = analysis.mesh_contacts[row].deepest(state.position.data(), state.contact[row], true);
    tell_overclosure(analysis, row, depth, node, true, observer);
  }
}

void ExplicitContact::add_mesh_forces(Analysis& analysis, const Instant& instant, double* force) const {
  auto& state = analysis.current;
  const MeshCycle cycle{state.position.data(), state.velocity.data(), instant.previous, instant.next};
  for (const auto row : mesh_pairs_) analysis.mesh_contacts[row].add_forces(cycle, state.contact[row], force);
}

void ExplicitContact::add_forces(Analysis& analysis, double* force) const {
  auto& state = analysis.current;
  for (const auto& pair : pairs_) {
    const auto& contact = analysis.contacts[pair.row];
    contact.add_forces(state.position.data(), state.rigid_bodies[contact.master_body()], state.contact[pair.row], force);
  }
}

void ExplicitContact::add_stiff_forces(Analysis& analysis, const Instant& instant, double* force) {
  auto& state = analysis.current;
  for (const auto& held : held_)
    pairs_[held.pair].freedom[held.point].velocity[held.direction] = held.constraint->new_velocity;
  const StiffCycle cycle{state.position.data(), state.velocity.data(), instant.previous, instant.next};
  for (const auto& pair : pairs_) {
    const auto& contact = analysis.contacts[pair.row];
    contact.add_stiff_forces(cycle, state.rigid_bodies[contact.master_body()], pair.freedom, state.contact[pair.row],
                             force);
  }
}

double ExplicitContact::frequency_squared_of_masters(const Analysis& analysis) const {
  if (!free_masters_) return 0.0;
  std::vector<ExactSum> sums(pairs_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (!pairs_[i].master.yields()) continue;
    const auto& contact = analysis.contacts[pairs_[i].row];
    const auto& master = analysis.current.rigid_bodies[contact.master_body()];
    for (std::int32_t point = 0; point < contact.size(); ++point) {
      const auto node = contact.nodes()[point];
      if (!analysis.domain.owned[node] || analysis.current.contact[pairs_[i].row][point].closed == 0.0) continue;
      double square = 0.0;
      for (int c = 0; c < 3; ++c) {
        const double arm = analysis.current.position[4 * static_cast<std::size_t>(node) + c] - master.position[c];
        square += arm * arm;
      }
      sums[i].add(contact.normal_stiffness(point) *
                  (pairs_[i].master.inverse_mass + square * pairs_[i].master.inverse_inertia));
    }
  }
  analysis.communicator.sum(std::span<ExactSum>(sums));
  double total = 0.0;
  for (const auto& sum : sums) total += sum.value();
  return total;
}

double ExplicitContact::largest_penetration(const Analysis& analysis) const {
  double deepest = 0.0;
  for (const auto& pair : pairs_) {
    const auto& contact = analysis.contacts[pair.row];
    const auto& master = analysis.current.rigid_bodies[contact.master_body()];
    deepest = std::max(deepest, contact.deepest(analysis.current.position.data(), master, analysis.current.contact[pair.row],
                                                RigidContact::Which::all)
                                    .depth);
  }
  for (const auto row : mesh_pairs_)
    deepest = std::max(deepest, analysis.mesh_contacts[row].deepest(analysis.current.position.data(), analysis.current.contact[row], false).depth);
  return pairs_.empty() && mesh_pairs_.empty() ? 0.0 : analysis.communicator.maximum(deepest);
}

void ExplicitContact::report_past_end(const Analysis& analysis, Observer& observer) {
  for (auto& pair : pairs_) {
    if (pair.past_end_told) continue;
    const auto& contact = analysis.contacts[pair.row];
    const auto& state = analysis.current;
    pair.past_end_told = analysis.communicator.any(contact.past_end(
        state.position.data(), state.rigid_bodies[contact.master_body()], state.contact[pair.row]));
    if (!pair.past_end_told) continue;
    const auto& definition = analysis.model.contact_pairs[pair.row];
    observer.log(fmt::format(
        "{}: warning: *CONTACT PAIR: at time {:.6g} nodes of {} have come to where the profile of {} ends; its last line "
        "carries them on without end: make the profile longer, or let it turn down where they shall fall",
        analysis.model.where(definition.location), state.total_time, analysis.model.surfaces[definition.slave].name,
        analysis.model.surfaces[definition.master].name));
  }
}

}  // namespace balocco
