#include "explicit_restraint_bound.hpp"

#include <algorithm>
#include <cmath>

#include "math/exact_sum.hpp"

namespace balocco {

namespace {

/// Sums of the restraints on all nodes of each rigid body; `body_of` says which one moves (turns) a node.
template <class BodyOf>
std::vector<Restraint> body_restraints(const Analysis& analysis, const std::vector<Restraint>& restraints, BodyOf body_of) {
  const std::size_t bodies = analysis.model.rigid_bodies.size();
  std::vector<ExactSum> sums(2 * bodies);
  for (std::size_t node = 0; node < restraints.size(); ++node) {
    const auto body = body_of(static_cast<std::int32_t>(node));
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

/// What has masses, by row: the nodes of the model, then its rigid bodies. The same on all ranks.
class Holders {
 public:
  explicit Holders(const Analysis& analysis) : analysis_(analysis), nodes_(analysis.model.nodes.size()) {
    strained_.assign(nodes_ + analysis.model.rigid_bodies.size(), 0.0);
    for_each_element([&](const ElementGroup& group, std::int32_t element) {
      for (const auto node : group.nodes(element))
        for_each_of(node, [&](std::size_t row) { strained_[row] = 1.0; });
    });
    analysis.communicator.maximum(std::span(strained_));
    bounds_.assign(2 * strained_.size(), 0.0);
  }

  std::size_t of_node(std::int32_t local_node) const { return analysis_.domain.node_row[local_node]; }
  std::size_t of_body(std::int32_t body) const { return nodes_ + body; }
  /// Whether an element that acts moves with it.
  bool is_strained(std::size_t row) const { return strained_[row] > 0.0; }

  void add(std::size_t row, const FrequencyBound& bound) {
    bounds_[2 * row] = std::max(bounds_[2 * row], bound.omega_square);
    bounds_[2 * row + 1] = std::max(bounds_[2 * row + 1], bound.rate);
  }

  /// The largest bounds of what holds each element's nodes, of all ranks.
  void spread(std::vector<std::vector<FrequencyBound>>& of_groups) {
    analysis_.communicator.maximum(std::span(bounds_));
    for (auto& of_elements : of_groups) of_elements.clear();
    std::size_t index = 0;
    for_each_element([&](const ElementGroup& group, std::int32_t element) {
      FrequencyBound largest;
      for (const auto node : group.nodes(element))
        for_each_of(node, [&](std::size_t row) {
          largest = {std::max(largest.omega_square, bounds_[2 * row]), std::max(largest.rate, bounds_[2 * row + 1])};
        });
      if (largest == FrequencyBound{}) return;
      while (analysis_.element_groups[index].get() != &group) ++index;
      of_groups[index].resize(static_cast<std::size_t>(group.size()));
      of_groups[index][element] = largest;
    });
  }

 private:
  template <class Visit>
  void for_each_element(Visit visit) const {
    for (const auto& group : analysis_.element_groups)
      for (std::int32_t element = 0; group->density() > 0.0 && element < group->size(); ++element)
        if (group->acts(element)) visit(*group, element);
  }
  template <class Visit>
  void for_each_of(std::int32_t node, Visit visit) const {
    visit(of_node(node));
    for (const auto body : {analysis_.carrier(node), analysis_.turning_body(node)})
      if (body >= 0) visit(of_body(body));
  }

  const Analysis& analysis_;
  std::size_t nodes_;
  std::vector<double> strained_;
  std::vector<double> bounds_;  // omega square and rate of each
};

/// Where a restraint pulls (twists): K / m and C / m there, and whose mass that is.
struct End {
  FrequencyBound mobile;
  std::vector<std::size_t> holders;
};

class Ends {
 public:
  Ends(const Analysis& analysis, const NodalRestraints& restraints, const RigidDynamics& bodies, ExplicitLinkages& linkages,
       const Holders& holders)
      : analysis_(analysis),
        restraints_(restraints),
        bodies_(bodies),
        linkages_(linkages),
        holders_(holders),
        pulled_(body_restraints(analysis, restraints.translation, [&](std::int32_t node) { return body_of(node, false); })),
        twisted_(body_restraints(analysis, restraints.rotation, [&](std::int32_t node) { return body_of(node, true); })),
        rotary_(rotary_mobilities(analysis)) {}

  End at(std::int32_t node, bool rotates) const {
    const auto body = body_of(node, rotates);
    const auto& of_bodies = rotates ? twisted_ : pulled_;
    const auto& of_nodes = rotates ? restraints_.rotation : restraints_.translation;
    const Restraint& total = body >= 0 ? of_bodies[body] : of_nodes[node];
    End end;
    double mobility = 0.0;
    if (body >= 0) {
      mobility = rotates ? bodies_.rotary_mobility(analysis_, body) : bodies_.mobility(analysis_, body, node);
      end.holders = {holders_.of_body(body)};
    } else if (const double own = own_mobility(node, rotates); own > 0.0) {
      mobility = own;
      end.holders = {holders_.of_node(node)};
    } else {
      mobility = linkages_.mobility(analysis_, node, rotates);
      const auto [nodes, moved_bodies] = linkages_.company(node, rotates);
      for (const auto other : nodes) end.holders.push_back(holders_.of_node(other));
      for (const auto other : moved_bodies) end.holders.push_back(holders_.of_body(other));
    }
    end.mobile = {total.stiffness * mobility, total.viscosity * mobility};
    return end;
  }

 private:
  std::int32_t body_of(std::int32_t node, bool rotates) const {
    return rotates ? analysis_.turning_body(node) : moving_body(analysis_, node);
  }
  double own_mobility(std::int32_t node, bool rotates) const {
    if (rotates) return rotary_[node];
    const double mass = analysis_.scaled_inertia().mass[node];
    return mass > 0.0 ? 1.0 / mass : 0.0;
  }

  const Analysis& analysis_;
  const NodalRestraints& restraints_;
  const RigidDynamics& bodies_;
  ExplicitLinkages& linkages_;
  const Holders& holders_;
  std::vector<Restraint> pulled_, twisted_;
  std::vector<double> rotary_;
};

void add(FrequencyBound& sum, const FrequencyBound& other) {
  sum.omega_square += other.omega_square;
  sum.rate += other.rate;
}

FrequencyBound roots(const FrequencyBound& of) { return {std::sqrt(of.omega_square), std::sqrt(of.rate)}; }

/// The bound of one restraint beside elements; adds to `holders` what it adds to elements.
FrequencyBound bound_of(const ElementGroup& group, std::int32_t element, const Ends& ends, Holders& holders) {
  const auto nodes = group.nodes(element);
  FrequencyBound together, largest;
  std::vector<FrequencyBound> apart(nodes.size());
  std::vector<std::vector<std::size_t>> held_by(nodes.size());
  bool strained = false;
  for (const bool rotates : {false, true}) {
    if (!restrains(restraint_of(group, element, rotates))) continue;
    std::vector<FrequencyBound> mobile;
    FrequencyBound root;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const End end = ends.at(nodes[i], rotates);
      mobile.push_back(end.mobile);
      add(together, end.mobile);
      add(root, roots(end.mobile));
      held_by[i].insert(held_by[i].end(), end.holders.begin(), end.holders.end());
      strained = strained || std::ranges::any_of(end.holders, [&](std::size_t row) { return holders.is_strained(row); });
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto own = roots(mobile[i]);
      add(apart[i], {own.omega_square * root.omega_square, own.rate * root.rate});
    }
  }
  if (!strained) return together;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const auto row : held_by[i]) holders.add(row, apart[i]);
    largest = {std::max(largest.omega_square, apart[i].omega_square), std::max(largest.rate, apart[i].rate)};
  }
  return largest;
}

}  // namespace

RestraintBound find_restraint_bound(Analysis& analysis, const NodalRestraints& restraints, const RigidDynamics& bodies,
                                    ExplicitLinkages& linkages) {
  auto& state = analysis.current;
  for (auto& of_elements : state.restrained) of_elements.clear();
  state.restraint_omega_square = state.restraint_rate = 0.0;
  if (!analysis.communicator.any(!restraints.translation.empty() || !restraints.rotation.empty())) return {};
  Holders holders(analysis);
  const Ends ends(analysis, restraints, bodies, linkages, holders);
  RestraintBound largest;
  LocalStability governing;
  for_each_restraint(analysis, [&](const ElementGroup& group, std::int32_t element) {
    const RestraintBound bound{bound_of(group, element, ends, holders)};
    largest.omega_square = std::max(largest.omega_square, bound.omega_square);
    largest.rate = std::max(largest.rate, bound.rate);
    if (bound.omega_square > 0.0 || bound.rate > 0.0)
      governing.merge(bound.increment(), analysis.model.elements[group.table()].id[group.row(element)]);
  });
  holders.spread(state.restrained);
  state.restraint_omega_square = analysis.communicator.maximum(largest.omega_square);
  state.restraint_rate = analysis.communicator.maximum(largest.rate);
  const auto who = analysis.communicator.minimum(Communicator::Located{governing.increment, governing.element}).payload;
  return {{state.restraint_omega_square, state.restraint_rate}, who};
}

}  // namespace balocco
