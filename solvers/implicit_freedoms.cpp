#include "implicit_freedoms.hpp"

#include <fmt/format.h>

#include "elements/springs/spring.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

const Freedoms translations("000111"), rotations("111000");

using Table = std::vector<std::uint8_t>;

/// Springs and dashpots between degrees of freedom know those alone; other elements move their nodes every way.
Freedoms freedoms_of(const Analysis& analysis, const ElementGroup& group, std::int32_t element, int end) {
  const auto whole = group.turns_node(end) ? translations | rotations : translations;
  const auto* spring = dynamic_cast<const SpringGroup*>(&group);
  if (spring == nullptr) return whole;
  const auto row = analysis.domain.node_row[group.nodes(element)[end]];
  Freedoms found;
  for (int axis = 0; axis < 3; ++axis)
    found.set(group.freedoms_per_node() == 6 ? 3 + axis : axis,
              spring->acts_along(element, end, analysis.directions.direction(row, axis)));
  return found;
}

void add_elements(const Analysis& analysis, Table& table) {
  for (const auto& group : analysis.element_groups)
    for (std::int32_t element = 0; element < group->size(); ++element) {
      if (!analysis.takes_part(*group, element)) continue;
      for (std::size_t end = 0; end < group->nodes(element).size(); ++end)
        table[analysis.domain.node_row[group->nodes(element)[end]]] |= freedoms_of(analysis, *group, element, static_cast<int>(end)).to_ulong();
    }
}

void add_constraints(const Analysis& analysis, Table& table) {
  for (std::size_t index = 0; index < analysis.constraints.size(); ++index) {
    const auto& constraint = *analysis.constraints[index];
    if (!analysis.holds(static_cast<std::int32_t>(index))) continue;
    for (std::size_t i = 0; i < constraint.nodes().size(); ++i)
      for (int dof = 0; dof < 6; ++dof)
        if (constraint.uses(static_cast<int>(i), dof)) table[constraint.nodes()[i]] |= 1U << dof;
  }
}

/// Inertia holds what nothing else does. `known_alone`: of nodes that the table knows already.
void add_inertia(const Analysis& analysis, Table& table, bool known_alone) {
  const auto add = [&](std::int32_t node, Freedoms freedoms) {
    auto& of_node = table[analysis.domain.node_row[node]];
    if (of_node != 0 || !known_alone) of_node |= freedoms.to_ulong();
  };
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    if (analysis.inertia.mass[node] > 0.0) add(node, translations);
  for (std::int32_t node = 0; node < analysis.domain.turning; ++node)
    if (analysis.inertia.rotary[node] > 0.0) add(node, rotations);
  for (const auto& tensor : analysis.rotary_tensors) add(tensor.node, rotations);
}

}  // namespace

std::vector<Freedoms> used_freedoms(const Analysis& analysis) {
  const auto& procedure = analysis.model.steps[analysis.current.step].procedure;
  Table table(analysis.model.nodes.size(), 0);
  const auto share = [&] {
    MPI_Allreduce(MPI_IN_PLACE, table.data(), static_cast<int>(table.size()), MPI_UINT8_T, MPI_BOR, analysis.communicator.handle());
  };
  add_elements(analysis, table);
  add_constraints(analysis, table);
  if (std::holds_alternative<DynamicProcedure>(procedure)) add_inertia(analysis, table, false);
  share();
  if (std::holds_alternative<FrequencyProcedure>(procedure)) {
    add_inertia(analysis, table, true);
    share();
  }
  return {table.begin(), table.end()};
}

void refuse_loads_on_nothing(const Analysis& analysis, const std::vector<Freedoms>& used) {
  const auto& step = analysis.model.steps[analysis.current.step];
  if (std::holds_alternative<FrequencyProcedure>(step.procedure)) return;  // its loads are those of the state, and move nothing
  auto acted_on = used;
  for (const auto& body : analysis.model.rigid_bodies) acted_on[body.reference_node].set();
  for (const auto& body : analysis.current.rigid_bodies)
    for (const auto& node : body.nodes) acted_on[node.node].set();
  std::vector<std::string> errors;
  for (const auto& load : step.concentrated_loads)
    if (load.magnitude != 0.0 && !acted_on[load.node].test(load.dof))
      errors.push_back(fmt::format("{}: error: *CLOAD: nothing uses degree of freedom {} of node {} in step {}, neither an element nor a "
                                   "constraint, so that the load acts on nothing; take it away",
                                   analysis.model.where({load.file, load.line}), load.dof + 1, analysis.model.nodes.id[load.node],
                                   analysis.current.step + 1));
  if (!errors.empty()) throw InputError(std::move(errors));
}

}  // namespace balocco
