// Constraints in the equations of a static step: their multipliers are unknowns, their gaps the residual of these.
#include <algorithm>

#include "implicit_system.hpp"

namespace balocco {

namespace {

constexpr std::array<Point, 3> unit_directions{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

}  // namespace

/// A node's pair with the first one (or all nodes, where any two are coupled), and the multipliers in threes. What couples the first
/// node with itself and with the multipliers is in the first of them.
template <class Add>
void ImplicitSystem::for_each_constraint_block(std::size_t local_constraint, Add add) {
  const auto& constraint = *analysis_.constraints[analysis_.local_constraints[local_constraint]];
  const auto first_slot = map_.multiplier_slot(local_constraint);
  const auto local = [&](std::size_t i) { return analysis_.domain.local_node[constraint.nodes()[i]]; };
  const std::size_t nodes = constraint.nodes().size();
  std::vector<std::size_t> members;
  for (std::size_t i = nodes == 1 ? 0 : 1; i < nodes; ++i) {
    members = {0};
    for (std::size_t k = constraint.couples_all() ? 1 : i; k > 0 && k <= (constraint.couples_all() ? nodes - 1 : i); ++k) members.push_back(k);
    motions_.clear();
    const auto add_node = [&](std::size_t which) {
      motions_.push_back(map_.motion(local(which)));
      if (local(which) < analysis_.domain.turning) motions_.push_back(map_.nodal_spin(local(which)));
    };
    for (const auto which : members) add_node(which);
    for (int row = 0; row < constraint.rows(); row += 3) {
      NodeMotion multipliers;
      multipliers.count = std::min(3, constraint.rows() - row);
      for (int k = 0; k < multipliers.count; ++k) multipliers.slots[k] = first_slot + row + k;
      std::ranges::copy(unit_directions, multipliers.direction.begin());
      motions_.push_back(multipliers);
    }
    add(std::span<const std::size_t>(members));
    if (constraint.couples_all()) return;
  }
}

void ImplicitSystem::record_constraints() {
  for (std::size_t i = 0; i < analysis_.local_constraints.size(); ++i)
    if (map_.owned(map_.multiplier_slot(i))) for_each_constraint_block(i, [&](auto) { stiffness_.add(motions_, {}); });
}

void ImplicitSystem::add_constraints() {
  for (std::size_t i = 0; i < analysis_.local_constraints.size(); ++i)
    if (map_.owned(map_.multiplier_slot(i))) add_constraint(i);
}

/// A rope that hangs loose, or an equation that the step goes without: its multiplier vanishes, as a pivot of the sign that
/// constraints have.
void ImplicitSystem::add_slack(std::size_t local_constraint) {
  const auto index = analysis_.local_constraints[local_constraint];
  analysis_.current.multiplier[analysis_.first_constraint_row[index]] = 0.0;
  for_each_constraint_block(local_constraint, [&](auto) {
    const std::size_t size = 3 * motions_.size();
    block_.assign(size * size, 0.0);
    block_[(size - 3) * size + size - 3] = -1.0;
    stiffness_.add(motions_, block_);
  });
}

/// Motions become gaps of rows that hold; the forces of the others are what their laws say.
void ImplicitSystem::follow_guides(std::int32_t constraint, std::size_t rows) {
  for (std::size_t row = 0; row < rows; ++row) {
    const auto place = analysis_.first_constraint_row[constraint] + static_cast<std::int32_t>(row);
    auto& multiplier = analysis_.current.multiplier[place];
    const double motion = guides_.motion(analysis_, constraint, static_cast<int>(row), gaps_[row]);
    guides_.renew_friction(analysis_, place);
    guides_.settle(place, motion, multiplier);
    const auto& law = guides_.of(place);
    holds_[row] = law.holds();
    gaps_[row] = holds_[row] ? motion - law.held_at() : 0.0;
    if (!holds_[row]) multiplier = law.force();
  }
}

bool ImplicitSystem::is_guided(std::int32_t slot) const { return map_.is_multiplier(slot) && guides_.contains(map_.constraint_row(slot)); }

void ImplicitSystem::add_guide_work() {
  auto& state = analysis_.current;
  for (const auto index : analysis_.local_constraints) {
    const auto* guide = analysis_.constraints[index]->guide();
    if (guide == nullptr) continue;
    analysis_.find_places(index, places_);
    gaps_.assign(guide->rows(), 0.0);
    guide->gaps(places_, gaps_);
    for (int row = 0; row < guide->rows(); ++row) {
      const auto place = analysis_.first_constraint_row[index] + row;
      const double moved = guides_.motion(analysis_, index, row, gaps_[row]) - state.guide_motion[place];
      guides_.add_work(place, 0.5 * (start_.multiplier[place] + state.multiplier[place]), moved,
                       state.nodal_work[analysis_.domain.local_node[guide->nodes().front()]]);
    }
  }
}

void ImplicitSystem::add_constraint(std::size_t local_constraint) {
  const auto index = analysis_.local_constraints[local_constraint];
  const auto& constraint = *analysis_.constraints[index];
  const auto rows = static_cast<std::size_t>(constraint.rows()), width = static_cast<std::size_t>(constraint.columns());
  const std::size_t nodes = constraint.nodes().size();
  const std::span multipliers(&analysis_.current.multiplier[analysis_.first_constraint_row[index]], rows);
  analysis_.find_places(index, places_);
  if (!analysis_.holds(index)) return add_slack(local_constraint);
  const bool coupled = constraint.couples_all();
  const std::size_t side = coupled ? width : 12;
  gaps_.assign(rows, 0.0);
  gradient_.assign(rows * width, 0.0);
  curvature_.assign(coupled ? side * side : 144 * std::max<std::size_t>(nodes - 1, 1), 0.0);
  constraint.gaps(places_, gaps_);
  if (constraint.is_one_sided() && (multipliers[0] < 0.0 || (multipliers[0] == 0.0 && gaps_[0] <= 0.0))) return add_slack(local_constraint);
  holds_.assign(rows, true);
  if (constraint.guide() != nullptr) follow_guides(index, rows);
  constraint.gradient(places_, gradient_);
  constraint.add_curvature(places_, multipliers, curvature_);

  for (std::size_t row = 0; row < rows; ++row) {
    residual_[map_.multiplier_slot(local_constraint) + row] += gaps_[row];
    for (std::size_t i = 0; i < nodes; ++i) {
      const auto node = analysis_.domain.local_node[constraint.nodes()[i]];
      for (int k = 0; k < (node < analysis_.domain.turning ? 6 : 3); ++k)
        residual_[map_.slot(node, k)] += multipliers[row] * gradient_[row * width + 6 * i + k];
    }
  }
  for_each_constraint_block(local_constraint, [&](std::span<const std::size_t> members) {
    const auto turns = [&](std::size_t which) {
      return analysis_.domain.local_node[constraint.nodes()[which]] < analysis_.domain.turning;
    };
    // Columns of the gradient, and of the node's pair in the curvature, that the motions stand for.
    std::vector<std::size_t> columns, pair;
    const std::size_t last = members.back();
    for (const std::size_t which : members) {
      for (std::size_t k = 0; k < (turns(which) ? 6U : 3U); ++k) {
        columns.push_back(6 * which + k);
        pair.push_back((coupled ? 6 * which : which == 0 ? 0 : 6) + k);
      }
    }
    const std::size_t moving = columns.size(), size = 3 * motions_.size();
    block_.assign(size * size, 0.0);
    const double* curvature = &curvature_[coupled || last == 0 ? 0 : 144 * (last - 1)];
    for (std::size_t a = 0; a < moving; ++a) {
      for (std::size_t b = 0; b < moving; ++b) block_[a * size + b] = curvature[side * pair[a] + pair[b]];
      const bool of_first = columns[a] < 6;
      if (of_first && last > 1 && !coupled) continue;
      for (std::size_t row = 0; row < rows; ++row)
        if (holds_[row]) block_[a * size + moving + row] = block_[(moving + row) * size + a] = gradient_[row * width + columns[a]];
    }
    // One negative eigenvalue, as a row that holds brings (eigenmodes.hpp counts them).
    for (std::size_t row = 0; row < rows; ++row)
      if (!holds_[row]) block_[(moving + row) * size + moving + row] = -1.0;
    stiffness_.add(motions_, block_);
  });
}

}  // namespace balocco
