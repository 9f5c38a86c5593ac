#include "lumped_inertia.hpp"

#include <algorithm>

#include "math/exact_sum.hpp"

namespace balocco {

/// Calls `visit(node, share, alpha)`.
template <class Visit>
void InertiaSums::for_each_share(Groups groups, Kind kind, bool scaled, Visit visit) {
  for (const auto& group : groups) {
    if (kind == Kind::rotary && group->freedoms_per_node() == 3) continue;
    share_.resize(static_cast<std::size_t>(group->nodes_per_element()));
    const auto material = model_.sections[group->section()].material;
    const double alpha = material >= 0 ? model_.materials[material].damping_alpha : 0.0;
    for (std::int32_t e = 0; e < group->size(); ++e) {
      kind == Kind::mass ? group->lumped_mass(e, share_) : group->lumped_rotary_inertia(e, share_);
      const double scale = scaled ? group->mass_scale(e) : 1.0;
      for (std::size_t i = 0; i < share_.size(); ++i) visit(group->nodes(e)[i], scale * share_[i], alpha);
    }
  }
}

/// Leaves inertia and damping of each node in the first two of four values. The largest share of one element in one node gives the
/// quantum in which they are counted.
double InertiaSums::sum(Groups groups, Kind kind, bool scaled) {
  double largest = 0.0;
  for_each_share(groups, kind, scaled,
                 [&](std::int32_t, double inertia, double alpha) { largest = std::max({largest, inertia, alpha * inertia}); });
  const double constant = rounding_constant(64.0 * communicator_.maximum(largest));
  sums_.assign(4 * (static_cast<std::size_t>(domain_.size()) + 1), 0.0);
  for_each_share(groups, kind, scaled, [&](std::int32_t node, double inertia, double alpha) {
    sums_[4 * node] += rounded(inertia, constant);
    sums_[4 * node + 1] += rounded(alpha * inertia, constant);
  });
  domain_.halo->begin_sum(sums_.data());
  domain_.halo->finish_sum(sums_.data());
  return constant;
}

double InertiaSums::sum(Groups groups, bool scaled, LumpedInertia& inertia) {
  const auto take = [&](std::int32_t nodes, std::vector<double>& sums, std::vector<double>& damping) {
    sums.resize(static_cast<std::size_t>(nodes));
    damping.resize(static_cast<std::size_t>(nodes));
    for (std::int32_t node = 0; node < nodes; ++node) {
      sums[node] = sums_[4 * node];
      damping[node] = sums_[4 * node + 1];
    }
  };
  sum(groups, Kind::rotary, scaled);
  take(domain_.turning, inertia.rotary, inertia.rotary_damping);
  const double constant = sum(groups, Kind::mass, scaled);
  take(domain_.size(), inertia.mass, inertia.damping);
  for_each_point_mass(model_, domain_, [&](std::int32_t node, double mass, ElementRef) { inertia.mass[node] += mass; });
  if (!scaled) sums_ = {};  // only scaled ones are asked for again
  return constant;
}

}  // namespace balocco
