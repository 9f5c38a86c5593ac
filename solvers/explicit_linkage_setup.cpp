// What moves the nodes of each linkage in a step, and which conditions are solved for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "explicit_linkages.hpp"
#include "model/bounding_box.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

ExplicitLinkages::ExplicitLinkages(Analysis& analysis, const Step& step, const NodalConstraints& translations,
                                   const NodalConstraints& rotations, GyroscopicNodes& gyroscopic, RigidDynamics& bodies,
                                   InverseInertia& inverse)
    : step_(step), size_(model_size(analysis.model)), translations_(translations), rotations_(rotations), gyroscopic_(gyroscopic),
      bodies_(bodies), guides_(analysis, step), inverse_(inverse) {
  moves_.assign(static_cast<std::size_t>(analysis.domain.size()), false);
  in_cloud_ = moves_;
  turns_.assign(static_cast<std::size_t>(analysis.domain.turning), false);
  if (analysis.current.increment == 0) analysis.current.implied_rows.clear();
  for (const auto& linkage : find_linkages(analysis.model)) {
    if (!std::ranges::binary_search(analysis.local_constraints, linkage.constraints.front())) continue;
    if (!clusters_.take(analysis, linkage, {translations, rotations, gyroscopic})) add_system(analysis, linkage);
  }
  clusters_.line_up();
  for (const auto& system : systems_) take_over(system, inverse);
  take_over_clusters(inverse);
  share_clouds(analysis);
}

void ExplicitLinkages::share_clouds(const Analysis& analysis) {
  std::vector<double> ranks(analysis.constraints.size(), 0.0);  // that know a cloud, by constraint
  for (const auto& system : systems_)
    for (const auto& member : system.members)
      if (member.cloud) ranks[member.constraint] = 1.0;
  analysis.communicator.sum(std::span<double>(ranks));
  std::vector<std::ptrdiff_t> place(ranks.size(), -1);
  for (std::size_t constraint = 0; constraint < ranks.size(); ++constraint)
    if (ranks[constraint] > 1.0) {
      place[constraint] = static_cast<std::ptrdiff_t>(shared_sums_.size());
      shared_sums_.resize(shared_sums_.size() + ExplicitCloud::sum_count);
    }
  for (auto& system : systems_)
    for (auto& member : system.members)
      if (member.cloud) member.shared_sums = place[member.constraint];
}

void ExplicitLinkages::add_system(Analysis& analysis, const Linkage& linkage) {
  auto& system = systems_.emplace_back();
  Uses uses;
  for (const auto index : linkage.constraints)
    for (const auto row : analysis.constraints[index]->nodes()) ++uses[row];
  for (const auto index : linkage.constraints) {
    const auto& constraint = *analysis.constraints[index];
    Member member;
    member.constraint = index;
    member.is_guide = constraint.guide() != nullptr;
    system.has_guides = system.has_guides || member.is_guide;
    member.coupling = dynamic_cast<const DistributingConstraint*>(&constraint);
    member.cloud = cloud_of(analysis, member.coupling, uses);
    if (member.cloud) {
      member.components = member.coupling->components();
      sum_whole_cloud(analysis, member);
    }
    for (std::size_t i = 0; i < (member.cloud ? 1 : constraint.nodes().size()); ++i)
      member.nodes.push_back(use_of(analysis, system, constraint.nodes()[i], constraint.turns(static_cast<int>(i))));
    const bool by_bodies = std::ranges::any_of(member.nodes, [&](const NodeUse& use) {
      return system.movers[use.translation].kind == Mover::Kind::body ||
             (use.rotation >= 0 && system.movers[use.rotation].kind != Mover::Kind::rotation);
    });
    system.is_linear = system.is_linear && constraint.is_linear() && !by_bodies;
    for (int row = 0; row < constraint.rows(); ++row) {
      member.rows.push_back(row);
      if (member.rows.size() < pack_size && row + 1 < constraint.rows()) continue;
      system.members.push_back(member);
      member.rows.clear();
    }
  }
  list_columns(system);
  if (analysis.current.increment == 0) find_implied_rows(analysis, system);
  drop_implied_rows(analysis, system);
  number(system);
  take_guides(analysis, system);
}

/// Nothing, if another constraint, a body or a condition takes part in the motion of one of its nodes, or one has no mass.
std::optional<ExplicitCloud> ExplicitLinkages::cloud_of(const Analysis& analysis, const DistributingConstraint* coupling, const Uses& uses) const {
  if (coupling == nullptr || !coupling->knows_moments_alone()) return std::nullopt;
  std::vector<std::int32_t> nodes;
  for (const auto row : std::span(coupling->nodes()).subspan(1)) {
    const auto node = analysis.domain.local_node[row];
    const bool alone = uses.at(row) == 1 && analysis.carrier(node) < 0 && analysis.reference_of(node) < 0 && translations_.of_node(node).empty();
    if (!alone || !(inverse_.mass[node] > 0.0)) return std::nullopt;
    nodes.push_back(node);
  }
  return ExplicitCloud(*coupling, nodes, analysis.domain, inverse_.mass);
}

void ExplicitLinkages::sum_whole_cloud(const Analysis& analysis, Member& member) const {
  const auto& state = analysis.current;
  const auto reference = analysis.place_of(member.coupling->nodes().front()).position;
  const ExplicitCloud::Motion motion{.position = state.position.data(), .velocity = state.velocity.data(), .force = nullptr};
  member.cloud->sum(ExplicitCloud::Share::whole, motion, reference, {.place = size_, .rate = size_ / analysis.undeformed_increment});
  member.cloud->take_sums(reference);
}

std::int32_t ExplicitLinkages::mover_of(const Analysis& analysis, System& system, Mover::Kind kind, std::int32_t index) {
  const auto same = [&](const Mover& mover) { return mover.kind == kind && mover.index == index; };
  const auto known = std::ranges::find_if(system.movers, same);
  if (known != system.movers.end()) return static_cast<std::int32_t>(known - system.movers.begin());
  Mover mover{.kind = kind, .index = index};
  mover.size = kind == Mover::Kind::body ? 6 : 3;
  mover.first = static_cast<int>(system.mover_of_column.size());
  for (int c = 0; c < mover.size; ++c) system.mover_of_column.emplace_back(static_cast<std::int32_t>(system.movers.size()), c);
  if (kind == Mover::Kind::translation || kind == Mover::Kind::rotation) find_freedoms(analysis, mover);
  system.movers.push_back(std::move(mover));
  return static_cast<std::int32_t>(system.movers.size()) - 1;
}

void ExplicitLinkages::find_freedoms(const Analysis& analysis, Mover& mover) const {
  const bool translates = mover.kind == Mover::Kind::translation;
  const auto row = analysis.domain.node_row[mover.index];
  const auto conditions = (translates ? translations_ : rotations_).of_node(mover.index);
  for (int axis = 0; axis < 3; ++axis) {
    const auto direction = analysis.directions.direction(row, axis);
    const auto holds = [&](const NodalConstraints::Constraint& condition) { return condition.direction == direction; };
    const auto condition = std::ranges::find_if(conditions, holds);
    if (condition != conditions.end()) {
      mover.conditions.push_back(&*condition);
      continue;
    }
    mover.directions.push_back(direction);
  }
  take_inertia(mover);
}

void ExplicitLinkages::take_inertia(Mover& mover) const {
  mover.inverse_inertia = mover.kind == Mover::Kind::translation ? inverse_.mass[mover.index] : inverse_.rotary[mover.index];
  mover.response = {};
  for (const auto& direction : mover.directions)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) mover.response(i, j) += mover.inverse_inertia * direction[i] * direction[j];
}

void ExplicitLinkages::renew_inertia(const Analysis& analysis, InverseInertia& inverse) {
  inverse_ = inverse;
  for (auto& system : systems_) {
    for (auto& mover : system.movers)
      if (mover.kind == Mover::Kind::translation || mover.kind == Mover::Kind::rotation) take_inertia(mover);
    for (auto& member : system.members)
      if (member.cloud) member.cloud->take_inertia(inverse_.mass);
    system.factorized_for = 0.0;
    take_over(system, inverse);
  }
  clusters_.renew_inertia(analysis);
  take_over_clusters(inverse);
}

ExplicitLinkages::NodeUse ExplicitLinkages::use_of(const Analysis& analysis, System& system, std::int32_t row, bool turns) {
  NodeUse use{.node = analysis.domain.local_node[row]};
  const auto carrier = analysis.carrier(use.node), reference = analysis.reference_of(use.node);
  use.carried = carrier >= 0;
  if (use.carried) {
    const auto& nodes = analysis.current.rigid_bodies[carrier].nodes;
    use.offset = std::ranges::lower_bound(nodes, row, {}, &RigidNode::node)->offset;
  }
  const auto body = use.carried ? carrier : reference;
  use.translation = body >= 0 ? mover_of(analysis, system, Mover::Kind::body, body)
                              : mover_of(analysis, system, Mover::Kind::translation, use.node);
  if (!turns) return use;
  if (const auto turner = analysis.turning_body(use.node); turner >= 0) {
    use.rotation = mover_of(analysis, system, Mover::Kind::body, turner);
    use.stands_with_body = use.rotation == use.translation && bodies_.orients(use.node);
  } else {
    use.rotation = mover_of(analysis, system, gyroscopic_.contains(use.node) ? Mover::Kind::gyroscopic : Mover::Kind::rotation, use.node);
  }
  return use;
}

void ExplicitLinkages::list_columns(System& system) const {
  for (auto& member : system.members) {
    for (const auto& use : member.nodes) {
      member.movers.push_back(use.translation);
      if (use.rotation >= 0) member.movers.push_back(use.rotation);
    }
    std::ranges::sort(member.movers);
    member.movers.erase(std::unique(member.movers.begin(), member.movers.end()), member.movers.end());
    std::vector<std::size_t> first;
    for (const auto m : member.movers) {
      first.push_back(member.columns.size());
      for (int c = 0; c < system.movers[m].size; ++c) member.columns.push_back(system.movers[m].first + c);
    }
    const auto place = [&](std::int32_t mover) {
      return first[static_cast<std::size_t>(std::ranges::lower_bound(member.movers, mover) - member.movers.begin())];
    };
    for (auto& use : member.nodes) {
      use.column = place(use.translation);
      if (use.rotation >= 0) use.rotation_column = place(use.rotation) + (system.movers[use.rotation].kind == Mover::Kind::body ? 3 : 0);
    }
    member.gradient.resize(member.columns.size());
    member.answer.resize(member.columns.size());
  }
}

/// What tells a row from others besides the columns of movers: columns of the response of its own cloud, in parts of its mobility.
void ExplicitLinkages::add_columns_of_cloud(const System& system, const Member& member, std::size_t row, SparseRow& columns) {
  const auto response = member.cloud->response(member.places.front().rotation);
  const auto first = static_cast<std::int64_t>(system.mover_of_column.size()) + 6 * (&member - system.members.data());
  const int component = member.components[member.rows[row]];
  for (int c = 0; c < 6; ++c) columns.emplace_back(first + c, response(component, c) / response(0, 0));
}

/// Rows that others imply would leave the multipliers without a single solution.
void ExplicitLinkages::find_implied_rows(Analysis& analysis, System& system) const {
  find_places(analysis, system);
  find_gradient(analysis, system);
  find_responses(analysis, system);
  std::vector<SparseRow> rows;
  for (const auto& member : system.members)
    for (std::size_t i = 0; i < member.rows.size(); ++i) {
      SparseRow row;
      if (member.is_guide) {  // they do not always hold
        rows.push_back(row);
        continue;
      }
      const auto line = [&](std::size_t column) { return member.gradient[column][static_cast<int>(i)]; };
      std::size_t k = 0;
      for (const auto m : member.movers) {
        const auto& mover = system.movers[m];
        const bool of_node = mover.kind == Mover::Kind::translation || mover.kind == Mover::Kind::rotation;
        const auto length = [&](int component) {  // turns angles into lengths
          const bool angle = mover.kind == Mover::Kind::body ? component >= 3 : mover.kind != Mover::Kind::translation;
          return angle ? 1.0 / size_ : 1.0;
        };
        // Along the directions in which the mover is free; those of bodies and tensors by what they answer to.
        for (std::size_t d = 0; of_node && d < mover.directions.size(); ++d) {
          const auto& direction = mover.directions[d];
          const double along = line(k) * direction[0] + line(k + 1) * direction[1] + line(k + 2) * direction[2];
          row.emplace_back(mover.first + static_cast<int>(d), length(0) * along);
        }
        for (int a = 0; !of_node && a < mover.size; ++a) {
          double answer = 0.0;
          for (int b = 0; b < mover.size; ++b) answer += mover.response(a, b) * line(k + b);
          const double scale = mover.response(a, a) > 0.0 ? length(a) / mover.response(a, a) : 0.0;
          row.emplace_back(mover.first + a, scale * answer);
        }
        k += mover.size;
      }
      if (member.cloud) add_columns_of_cloud(system, member, i, row);
      rows.push_back(std::move(row));
    }
  const auto implied = dependent_rows(rows);
  std::size_t next = 0;
  for (const auto& member : system.members)
    for (const int row : member.rows)
      if (implied[next++] && !member.is_guide) analysis.current.implied_rows.push_back(analysis.first_constraint_row[member.constraint] + row);
}

void ExplicitLinkages::drop_implied_rows(const Analysis& analysis, System& system) const {
  for (auto& member : system.members) {
    std::erase_if(member.rows, [&](int row) {
      return std::ranges::count(analysis.current.implied_rows, analysis.first_constraint_row[member.constraint] + row) > 0;
    });
  }
}

void ExplicitLinkages::number(System& system) const {
  for (auto& member : system.members) {
    member.first_row = system.rows;
    system.rows += static_cast<int>(member.rows.size());
  }
  system.unknowns = system.rows;
  for (auto& mover : system.movers) {
    const bool of_node = mover.kind == Mover::Kind::translation || mover.kind == Mover::Kind::rotation;
    if (!of_node || mover.inverse_inertia > 0.0 || mover.directions.empty()) continue;
    mover.first_unknown = system.unknowns;
    system.unknowns += static_cast<int>(mover.directions.size());
  }
  find_hub(system);
  list_shared_movers(system);
  system.solution.assign(static_cast<std::size_t>(system.unknowns), 0.0);
  system.residual.assign(static_cast<std::size_t>(system.unknowns + (system.hub >= 0 ? 6 : 0)), 0.0);
  system.holds.assign(static_cast<std::size_t>(system.rows), true);
}

void ExplicitLinkages::find_hub(System& system) const {
  constexpr std::ptrdiff_t many = 4;
  std::ptrdiff_t most = system.is_small() ? static_cast<std::ptrdiff_t>(system.members.size()) : many - 1;
  for (std::size_t m = 0; m < system.movers.size(); ++m) {
    const auto uses = std::ranges::count_if(
        system.members, [&](const Member& member) { return std::ranges::binary_search(member.movers, static_cast<std::int32_t>(m)); });
    if (system.movers[m].kind != Mover::Kind::body || uses <= most) continue;
    most = uses;
    system.hub = static_cast<std::int32_t>(m);
  }
}

void ExplicitLinkages::list_shared_movers(System& system) const {
  struct Use {
    std::int32_t member;
    std::size_t first;
  };
  std::vector<std::vector<Use>> uses(system.movers.size());
  std::vector<std::int32_t> sizes;
  std::vector<BlockSolver::Pair> pairs;
  const auto hub_block = static_cast<std::int32_t>(system.members.size());
  for (auto& member : system.members) {
    std::size_t first = 0;
    for (const auto m : member.movers) {
      uses[m].push_back({static_cast<std::int32_t>(sizes.size()), first});
      if (m == system.hub) {
        member.hub_column = static_cast<std::ptrdiff_t>(first);
        pairs.push_back({static_cast<std::int32_t>(sizes.size()), hub_block});
      }
      first += static_cast<std::size_t>(system.movers[m].size);
    }
    sizes.push_back(static_cast<std::int32_t>(member.rows.size()));
  }
  if (system.hub >= 0) {
    uses[system.hub].clear();
    sizes.push_back(6);
  }
  for (const auto& list : uses)
    for (const auto& use : list)
      for (const auto& other : list) pairs.push_back({use.member, other.member});
  system.blocks.lay_out(std::move(sizes), pairs, system.hub >= 0 ? 1 : 0);
  for (std::size_t m = 0; m < uses.size(); ++m)
    for (const auto& [member, first] : uses[m])
      for (const auto& other : uses[m])
        if (system.blocks.in_order(member, other.member))
          system.members[member].shared.push_back({static_cast<std::size_t>(other.member), first, other.first, system.movers[m].size,
                                                   system.blocks.place(member, other.member)});
  for (auto& member : system.members) std::ranges::stable_sort(member.shared, {}, &Shared::member);
}

void ExplicitLinkages::take_over(const System& system, InverseInertia& inverse) {
  for (const auto& member : system.members)
    if (member.cloud)
      member.cloud->for_each_node([&](std::int32_t node) {
        inverse.mass[node] = 0.0;
        moves_[node] = in_cloud_[node] = true;
      });
  for (const auto& mover : system.movers) {
    if (mover.kind == Mover::Kind::translation) {
      inverse.mass[mover.index] = 0.0;
      moves_[mover.index] = true;
    } else if (mover.kind == Mover::Kind::rotation) {
      inverse.rotary[mover.index] = 0.0;
      turns_[mover.index] = true;
    }
  }
}

void ExplicitLinkages::take_over_clusters(InverseInertia& inverse) {
  clusters_.for_each_node([&](std::int32_t node, bool turns) {
    inverse.mass[node] = 0.0;
    moves_[node] = true;
    if (!turns) return;
    inverse.rotary[node] = 0.0;
    turns_[node] = true;
  });
}

ExplicitLinkages::Company ExplicitLinkages::company(std::int32_t node, bool rotation) const {
  const auto kind = rotation ? Mover::Kind::rotation : Mover::Kind::translation;
  Company company{.nodes = clusters_.company(node, rotation), .bodies = {}};
  for (const auto& system : systems_) {
    const auto in_cloud = [&](const Member& member) { return !rotation && member.cloud && member.cloud->has(node); };
    if (std::ranges::none_of(system.movers, [&](const Mover& mover) { return mover.kind == kind && mover.index == node; }) &&
        std::ranges::none_of(system.members, in_cloud))
      continue;
    for (const auto& mover : system.movers)
      (mover.kind == Mover::Kind::body ? company.bodies : company.nodes).push_back(mover.index);
    for (const auto& member : system.members)
      if (member.cloud) member.cloud->for_each_node([&](std::int32_t other) { company.nodes.push_back(other); });
  }
  return company;
}

void ExplicitLinkages::report_singular(const Analysis& analysis, const System& system) const {
  const auto& definition = analysis.model.constraints[system.members.front().constraint];
  throw AnalysisError(fmt::format(
      "{}: error: {}: the motion of the linkage that this constraint belongs to is not determined: a node without mass is left free, "
      "or the linkage stands where its joints no longer act independently; give such nodes a MASS (ROTARYI), or hold them",
      analysis.model.where({definition.file, definition.line}), definition.keyword));
}

void ExplicitLinkages::report_apart(const Analysis& analysis, const System& system, double gap) const {
  const auto& definition = analysis.model.constraints[system.members.front().constraint];
  throw AnalysisError(fmt::format(
      "step {}, increment {}, time {:.6g}: the linkage of {} {} comes apart by {:.3g}: it moves too far in an increment; reduce the increment, "
      "or look for loads that throw it",
      step_.name, analysis.current.increment, analysis.current.total_time, definition.keyword,
      analysis.model.where({definition.file, definition.line}), gap));
}

}  // namespace balocco
