#include "explicit_restraints.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/element_type.hpp"
#include "math/exact_sum.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

template <class Visit>
void for_each_restraint(const Analysis& analysis, Visit visit) {
  for (const auto& group : analysis.element_groups) {
    const auto kind = analysis.model.sections[group->section()].kind;
    if (kind != Section::Kind::spring && kind != Section::Kind::dashpot) continue;
    for (std::int32_t element = 0; element < group->size(); ++element) visit(*group, element);
  }
}

/// Sums of the restraints on all nodes of each rigid body.
std::vector<Restraint> body_restraints(const Analysis& analysis, const std::vector<Restraint>& restraints) {
  const std::size_t bodies = analysis.model.rigid_bodies.size();
  std::vector<ExactSum> sums(2 * bodies);
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node) {
    const auto body = std::max(analysis.carrier(node), analysis.reference_of(node));
    if (body < 0 || !analysis.domain.owned[node]) continue;
    sums[2 * body].add(restraints[node].stiffness);
    sums[2 * body + 1].add(restraints[node].viscosity);
  }
  analysis.communicator.sum(std::span<ExactSum>(sums));
  std::vector<Restraint> result(bodies);
  for (std::size_t body = 0; body < bodies; ++body)
    result[body] = {.stiffness = sums[2 * body].value(), .viscosity = sums[2 * body + 1].value()};
  return result;
}

}  // namespace

std::vector<Restraint> nodal_restraints(const Analysis& analysis) {
  double largest = 0.0;
  for_each_restraint(analysis, [&](const ElementGroup& group, std::int32_t element) {
    const auto [stiffness, viscosity, force] = group.restraint(element);
    largest = std::max({largest, stiffness, viscosity, force});
  });
  std::vector<Restraint> result(static_cast<std::size_t>(analysis.domain.size()));
  largest = analysis.communicator.maximum(largest);
  if (largest == 0.0) return result;
  // As nodal masses are summed: at most 64 of the largest in one node.
  const double constant = rounding_constant(64.0 * largest);
  std::vector<double> sums(4 * (result.size() + 1), 0.0);
  for_each_restraint(analysis, [&](const ElementGroup& group, std::int32_t element) {
    const auto [stiffness, viscosity, force] = group.restraint(element);
    for (const auto node : group.nodes(element)) {
      sums[4 * node] += rounded(stiffness, constant);
      sums[4 * node + 1] += rounded(viscosity, constant);
      sums[4 * node + 2] += rounded(force, constant);
    }
  });
  analysis.domain.halo->begin_sum(sums.data());
  analysis.domain.halo->finish_sum(sums.data());
  for (std::size_t node = 0; node < result.size(); ++node)
    result[node] = {sums[4 * node], sums[4 * node + 1], sums[4 * node + 2]};
  return result;
}

RestraintBound restraint_bound(const Analysis& analysis, const std::vector<Restraint>& restraints,
                               const RigidDynamics& bodies) {
  const auto of_bodies = body_restraints(analysis, restraints);
  RestraintBound largest;
  for_each_restraint(analysis, [&](const ElementGroup& group, std::int32_t element) {
    RestraintBound bound;
    for (const auto node : group.nodes(element)) {
      const auto body = std::max(analysis.carrier(node), analysis.reference_of(node));
      const Restraint& total = body >= 0 ? of_bodies[body] : restraints[node];
      const double mass = analysis.nodal_mass[node];
      const double mobility = body >= 0 ? bodies.mobility(analysis, body, node) : mass > 0.0 ? 1.0 / mass : 0.0;
      bound.omega_square += total.stiffness * mobility;
      bound.rate += total.viscosity * mobility;
    }
    largest.omega_square = std::max(largest.omega_square, bound.omega_square);
    largest.rate = std::max(largest.rate, bound.rate);
  });
  return {analysis.communicator.maximum(largest.omega_square), analysis.communicator.maximum(largest.rate)};
}

void refuse_massless_restraints(const Analysis& analysis, const Step& step) {
  std::vector<bool> held(static_cast<std::size_t>(analysis.domain.size()));
  for (const auto& condition : step.boundary)
    if (const auto node = analysis.domain.local_node[condition.node]; node >= 0 && condition.dof < 3) held[node] = true;
  for_each_restraint(analysis, [&](const ElementGroup& group, std::int32_t element) {
    for (const auto node : group.nodes(element)) {
      const bool moved_by_body = analysis.carrier(node) >= 0 || analysis.reference_of(node) >= 0;
      if (moved_by_body || held[node] || analysis.nodal_mass[node] > 0.0) continue;
      const auto& table = analysis.model.elements[group.table()];
      throw InputError(fmt::format(
          "{}: error: *ELEMENT: {} {} pulls at node {}, which has no mass and is not held, so that an explicit step cannot "
          "move it; give it a MASS element or constrain it",
          analysis.model.where(table.location[group.row(element)]), table.type->name, table.id[group.row(element)],
          analysis.model.nodes.id[analysis.domain.node_row[node]]));
    }
  });
}

}  // namespace balocco
