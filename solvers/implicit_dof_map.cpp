#include "implicit_dof_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "constraints/linkages.hpp"
#include "implicit_freedoms.hpp"
#include "model/bounding_box.hpp"

namespace balocco {

namespace {

const Matrix3<double> identity = Matrix3<double>::identity();

MPI_Datatype integer_type() {
  return sizeof(PetscInt) == 8 ? MPI_INT64_T : MPI_INT32_T;
}

Point row(const Matrix3<double>& matrix, int i) {
  return {matrix(i, 0), matrix(i, 1), matrix(i, 2)};
}

Point cross_product(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

ImplicitDofMap::ImplicitDofMap(const Analysis& analysis, std::span<const std::int32_t> prescribed)
    : analysis_(analysis), layout_(analysis) {
  for (std::int32_t node = 0; node < layout_.nodes; ++node)
    directions_.push_back(analysis.directions.find(analysis.domain.node_row[node]));
  list_multipliers();
  find_roles(prescribed);
  drop_dependent_rows();
  number();
}

void ImplicitDofMap::list_multipliers() {
  for (const auto index : analysis_.local_constraints) {
    const auto& constraint = *analysis_.constraints[index];
    first_multiplier_.push_back(layout_.first_multiplier() + static_cast<std::int32_t>(constraint_row_.size()));
    for (int row = 0; row < constraint.rows(); ++row) {
      constraint_row_.push_back(analysis_.first_constraint_row[index] + row);
      constraint_node_.push_back(analysis_.domain.local_node[constraint.nodes().front()]);
    }
  }
}

std::int32_t ImplicitDofMap::node_of(std::int32_t slot) const {
  if (is_multiplier(slot)) return constraint_node_[slot - layout_.first_multiplier()];
  if (!is_rotation(slot)) return slot / 3;
  const auto body = body_of(slot);
  if (body < 0) return slot / 3 - layout_.nodes;
  return analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node];
}

const Matrix3<double>& ImplicitDofMap::directions(std::int32_t node) const {
  return directions_[node] != nullptr ? *directions_[node] : identity;
}

void ImplicitDofMap::find_roles(std::span<const std::int32_t> prescribed) {
  role_.assign(layout_.first_multiplier() + constraint_row_.size(), Role::free);
  const auto used = used_freedoms(analysis_);
  refuse_loads_on_nothing(analysis_, used);
  for (std::int32_t node = 0; node < layout_.nodes; ++node) {
    const auto freedoms = used[analysis_.domain.node_row[node]];
    const bool moves = analysis_.carrier(node) < 0, turns = node < layout_.turning && analysis_.turning_body(node) < 0;
    const bool leads = analysis_.reference_of(node) >= 0;  // a rigid body
    for (int dof = 0; dof < (node < layout_.turning ? 6 : 3); ++dof) {
      const bool is_used = freedoms.test(dof) || (dof < 3 && leads);
      if (!is_used || !(dof < 3 ? moves : turns)) role_[slot(node, dof)] = Role::absent;
    }
  }
  for (const auto slot : prescribed)
    if (role_[slot] == Role::free) role_[slot] = Role::prescribed;
}

/// Rows that others imply, where motions are prescribed and bodies rigid, would leave the equations without a single solution.
void ImplicitDofMap::drop_dependent_rows() {
  if (constraint_row_.empty()) return;
  std::vector<SparseRow> rows(constraint_row_.size());
  std::vector<bool> of_guide(constraint_row_.size(), false);
  std::vector<NodePlace> places;
  std::vector<double> gradient;
  std::size_t first = 0;
  const double size = model_size(analysis_.model);  // turns angles into lengths
  for (const auto index : analysis_.local_constraints) {
    const auto& constraint = *analysis_.constraints[index];
    const auto width = static_cast<std::size_t>(constraint.columns());
    if (constraint.guide() != nullptr || !analysis_.holds(index)) {  // they do not always hold
      std::fill_n(of_guide.begin() + static_cast<std::ptrdiff_t>(first), constraint.rows(), true);
      first += constraint.rows();
      continue;
    }
    analysis_.find_places(index, places);
    gradient.resize(constraint.rows() * width);
    constraint.gradient(places, gradient);
    for (std::size_t i = 0; i < constraint.nodes().size(); ++i) {
      const auto node = analysis_.domain.local_node[constraint.nodes()[i]];
      const auto add = [&](const NodeMotion& motion, std::size_t column) {
        for (int k = 0; k < motion.count; ++k) {
          if (role_[motion.slots[k]] != Role::free) continue;
          const auto& d = motion.direction[k];
          for (int row = 0; row < constraint.rows(); ++row) {
            const double* g = &gradient[row * width + column];
            const double value = (g[0] * d[0] + g[1] * d[1] + g[2] * d[2]) / (is_rotation(motion.slots[k]) ? size : 1.0);
            if (value != 0.0) rows[first + row].emplace_back(motion.slots[k], value);
          }
        }
      };
      add(motion(node), 6 * i);
      if (node < layout_.turning) add(nodal_spin(node), 6 * i + 3);
    }
    first += constraint.rows();
  }
  const auto dependent = dependent_rows(rows);
  for (std::size_t i = 0; i < dependent.size(); ++i)
    if (dependent[i] && !of_guide[i]) role_[layout_.first_multiplier() + i] = Role::absent;
}

std::vector<std::int32_t> ImplicitDofMap::dependent_constraint_rows() const {
  std::vector<std::int32_t> rows;
  for (std::size_t i = 0; i < constraint_row_.size(); ++i)
    if (role_[layout_.first_multiplier() + i] == Role::absent) rows.push_back(constraint_row_[i]);
  return rows;
}

int ImplicitDofMap::multipliers() const {
  const auto mine = std::ranges::count_if(owned_free_slots_, [&](std::int32_t slot) { return is_multiplier(slot); });
  return static_cast<int>(analysis_.communicator.sum(static_cast<std::int64_t>(mine)));
}

/// Place of a slot in tables over the whole model, alike on every rank.
std::size_t ImplicitDofMap::table_index(std::int32_t slot) const {
  const std::size_t rows = analysis_.model.nodes.size();
  if (is_multiplier(slot)) return 3 * (2 * rows + layout_.bodies) + constraint_row(slot);
  if (const auto body = body_of(slot); body >= 0) return 3 * (2 * rows + body) + slot % 3;
  return 3 * ((is_rotation(slot) ? rows : 0) + analysis_.domain.node_row[node_of(slot)]) + slot % 3;
}

void ImplicitDofMap::number() {
  for (std::int32_t slot = 0; slot < slots(); ++slot) {
    if (!owned(slot)) continue;
    owned_slots_.push_back(slot);
    if (role_[slot] == Role::free) owned_free_slots_.push_back(slot);
  }
  const auto handle = analysis_.communicator.handle();
  const std::array<PetscInt, 2> counts{static_cast<PetscInt>(owned_slots_.size()),
                                       static_cast<PetscInt>(owned_free_slots_.size())};
  std::array<PetscInt, 2> first{}, total{};
  MPI_Exscan(counts.data(), first.data(), 2, integer_type(), MPI_SUM, handle);
  MPI_Allreduce(counts.data(), total.data(), 2, integer_type(), MPI_SUM, handle);
  if (analysis_.communicator.is_root()) first = {};
  first_equation_ = first[1];
  equations_ = total[1];

  // Copies learn the owners' numbers through tables over the whole model: slot number + 1 and equation number + 1, 0:
  // not mine.
  const std::size_t table_size = 3 * (2 * static_cast<std::size_t>(analysis_.model.nodes.size()) + layout_.bodies) +
                                 analysis_.current.multiplier.size();
  std::vector<PetscInt> table(2 * table_size, 0);
  for (const auto slot : owned_slots_) table[table_index(slot)] = ++first[0];
  for (const auto slot : owned_free_slots_) table[table_size + table_index(slot)] = ++first[1];
  MPI_Allreduce(MPI_IN_PLACE, table.data(), static_cast<int>(table.size()), integer_type(), MPI_MAX, handle);
  for (std::int32_t slot = 0; slot < slots(); ++slot) {
    global_slot_.push_back(table[table_index(slot)] - 1);
    equation_.push_back(table[table_size + table_index(slot)] - 1);
  }
}

NodeMotion ImplicitDofMap::motion(std::int32_t node) const {
  NodeMotion result;
  const auto body = analysis_.carrier(node);
  const auto leader = body < 0 ? node : analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node];
  const auto& axes = directions(leader);
  for (int k = 0; k < 3; ++k) {
    result.slots[k] = slot(leader, k);
    result.direction[k] = row(axes, k);
  }
  result.count = 3;
  if (body < 0) return result;
  Point arm{};
  for (int i = 0; i < 3; ++i)
    arm[i] = analysis_.current.position[4 * node + i] - analysis_.current.rigid_bodies[body].position[i];
  for (int k = 0; k < 3; ++k) {
    result.slots[3 + k] = rotation_slot(body, k);
    result.direction[3 + k] = cross_product(row(axes, k), arm);
  }
  result.count = 6;
  return result;
}

NodeMotion ImplicitDofMap::spin(std::int32_t body) const { return spin_by(rotation_slot(body, 0)); }

NodeMotion ImplicitDofMap::nodal_spin(std::int32_t node) const { return spin_by(first_spin_slot(node)); }

std::int32_t ImplicitDofMap::first_spin_slot(std::int32_t node) const {
  const auto body = analysis_.turning_body(node);
  return body < 0 ? slot(node, 3) : rotation_slot(body, 0);
}

NodeMotion ImplicitDofMap::spin_by(std::int32_t first_slot) const {
  NodeMotion result;
  const auto& axes = directions(node_of(first_slot));
  result.count = 3;
  for (int k = 0; k < 3; ++k) {
    result.slots[k] = first_slot + k;
    result.direction[k] = row(axes, k);
  }
  return result;
}

std::string ImplicitDofMap::describe(std::int32_t slot) const {
  const auto id = analysis_.model.node_name(analysis_.domain.node_row[node_of(slot)]);
  if (is_multiplier(slot)) return fmt::format("a constraint of node {}", id);
  return fmt::format("node {}, dof {}", id, slot % 3 + (is_rotation(slot) ? 4 : 1));
}

std::string ImplicitDofMap::describe_equation(PetscInt equation) const {
  const auto local = equation - first_equation_;
  const bool mine = local >= 0 && local < static_cast<PetscInt>(owned_free_slots_.size());
  std::array<std::int64_t, 2> found{-1, -1};
  if (mine) {
    const auto slot = owned_free_slots_[local];
    found = {analysis_.domain.node_row[node_of(slot)],
             is_multiplier(slot) ? 0 : slot % 3 + (is_rotation(slot) ? 4 : 1)};
  }
  MPI_Allreduce(MPI_IN_PLACE, found.data(), 2, MPI_INT64_T, MPI_MAX, analysis_.communicator.handle());
  const auto name = analysis_.model.node_name(static_cast<std::int32_t>(found[0]));
  return found[1] == 0 ? fmt::format("a constraint of node {}", name) : fmt::format("node {}, dof {}", name, found[1]);
}

}  // namespace balocco
