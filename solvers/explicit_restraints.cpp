#include "explicit_restraints.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>

#include "elements/element_type.hpp"
#include "math/exact_sum.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

/// Sums over all elements that act on displacements, or on rotations, for the first `count` local nodes; empty if there are none.
std::vector<Restraint> summed(const Analysis& analysis, std::int32_t count, bool rotations) {
  const auto for_each_of_kind = [&](auto visit) {
    for_each_restraint(analysis, [&](const ElementGroup& group, std::int32_t element) {
      if (const auto of = restraint_of(group, element, rotations); restrains(of)) visit(of, group.nodes(element));
    });
  };
  bool exist = false;
  double largest = 0.0;
  for_each_of_kind([&](const Restraint& of, std::span<const std::int32_t>) {
    exist = true;
    largest = std::max({largest, of.stiffness, of.viscosity, of.force});
  });
  if (!analysis.communicator.any(exist)) return {};
  largest = analysis.communicator.maximum(largest);
  std::vector<Restraint> result(static_cast<std::size_t>(count));
  if (largest == 0.0) return result;
  // As nodal masses are summed: at most 64 of the largest in one node.
  const double constant = rounding_constant(64.0 * largest);
  std::vector<double> sums(4 * (static_cast<std::size_t>(analysis.domain.size()) + 1), 0.0);
  for_each_of_kind([&](const Restraint& of, std::span<const std::int32_t> nodes) {
    for (const auto node : nodes) {
      sums[4 * node] += rounded(of.stiffness, constant);
      sums[4 * node + 1] += rounded(of.viscosity, constant);
      sums[4 * node + 2] += rounded(of.force, constant);
    }
  });
  analysis.domain.halo->begin_sum(sums.data());
  analysis.domain.halo->finish_sum(sums.data());
  for (std::size_t node = 0; node < result.size(); ++node)
    result[node] = {sums[4 * node], sums[4 * node + 1], sums[4 * node + 2]};
  return result;
}

}  // namespace

Restraint restraint_of(const ElementGroup& group, std::int32_t element, bool rotations) {
  return rotations ? group.rotary_restraint(element) : group.restraint(element);
}

bool restrains(const Restraint& of) { return of.stiffness > 0.0 || of.viscosity > 0.0 || of.force > 0.0; }

std::int32_t moving_body(const Analysis& analysis, std::int32_t node) {
  return std::max(analysis.carrier(node), analysis.reference_of(node));
}

std::vector<double> rotary_mobilities(const Analysis& analysis) {
  std::vector<double> inertia(analysis.scaled_inertia().rotary);
  for (const auto& [node, section, tensor] : analysis.rotary_tensors) {
    const Eigen::Map<const Eigen::Matrix3d> matrix(tensor.component.data());
    inertia[node] += Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
  }
  for (double& value : inertia) value = value > 0.0 ? 1.0 / value : 0.0;
  return inertia;
}

NodalRestraints nodal_restraints(const Analysis& analysis) {
  return {summed(analysis, analysis.domain.size(), false), summed(analysis, analysis.domain.turning, true)};
}

void place_restraints(Analysis& analysis) {
  auto& state = analysis.current;
  for (std::size_t index = 0; index < analysis.element_groups.size(); ++index)
    analysis.element_groups[index]->set_reach(state.motion(), state.element_history[index]);
}

void replace_restraints(const Analysis& analysis) {
  for (std::size_t index = 0; index < analysis.element_groups.size(); ++index)
    analysis.element_groups[index]->restore_reach(analysis.current.element_history[index]);
}

bool restraints_are_left(const Analysis& analysis) {
  return std::ranges::any_of(analysis.element_groups, [&](const auto& group) { return group->is_beyond_reach(analysis.current.motion()); });
}

void refuse_massless_restraints(const Analysis& analysis, const Step& step, const ExplicitLinkages& linkages) {
  const auto size = static_cast<std::size_t>(analysis.domain.size());
  std::vector<bool> held(size), held_rotation(size);
  for (const auto& condition : step.boundary)
    if (const auto node = analysis.domain.local_node[condition.node]; node >= 0)
      (condition.dof < 3 ? held : held_rotation)[node] = true;
  const auto rotary = rotary_mobilities(analysis);
  for_each_restraint(analysis, [&](const ElementGroup& group, std::int32_t element) {
    for (const bool rotates : {false, true})
      for (std::size_t end = 0; end < group.nodes(element).size(); ++end) {
        const auto node = group.nodes(element)[end];
        if (!restrains(restraint_of(group, element, rotates)) || (rotates && !group.turns_node(static_cast<int>(end)))) continue;
        if (rotates ? analysis.turning_body(node) >= 0 || held_rotation[node] || rotary[node] > 0.0 || linkages.turns(node)
                    : moving_body(analysis, node) >= 0 || held[node] || analysis.scaled_inertia().mass[node] > 0.0 ||
                          linkages.moves(node))
          continue;
        const auto& table = analysis.model.elements[group.table()];
        throw InputError(fmt::format(
            "{}: error: *ELEMENT: {} {} {} node {}, which has no {} and is not held, so that an explicit step cannot {} it; give it a "
            "{} element or constrain it",
            analysis.model.where(table.location[group.row(element)]), table.type->name, table.id[group.row(element)],
            rotates ? "twists" : "pulls at", analysis.model.nodes.id[analysis.domain.node_row[node]],
            rotates ? "rotary inertia" : "mass", rotates ? "turn" : "move", rotates ? "ROTARYI" : "MASS"));
      }
  });
}

}  // namespace balocco
