#include "joint_angles.hpp"

#include <algorithm>

#include "constraints/guide.hpp"

namespace balocco {

namespace {

/// Calls visit(constraint, guide, row, where the third component of the angle's node is) for each angle.
template <class Visit>
void for_each_angle(const Analysis& analysis, Visit visit) {
  for (const auto index : analysis.local_constraints) {
    const auto* guide = analysis.constraints[index]->guide();
    for (int row = 0; guide != nullptr && row < guide->rows(); ++row)
      if (const auto node = guide->definition().rows[row].angle_node; node >= 0)
        visit(index, *guide, row, 3 * static_cast<std::size_t>(analysis.domain.local_node[node]) + 2);
  }
}

/// Sum of a row's derivatives by the turns of nodes times these, in angles. Of displacements an angle knows nothing.
template <class TurnOf>
double change_of_angle(const GuideConstraint& guide, int row, std::span<const NodePlace> places, TurnOf turn_of) {
  std::vector<double> gradient(static_cast<std::size_t>(guide.rows() * guide.columns()));
  guide.gradient(places, gradient);
  double sum = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto turn = turn_of(i);
    for (int c = 0; c < 3; ++c) sum += gradient[static_cast<std::size_t>(row * guide.columns()) + 6 * i + 3 + c] * turn[c];
  }
  return sum / guide.lever(row);
}

}  // namespace

void add_joint_angles(const Analysis& analysis, std::span<double> rotation) {
  std::vector<NodePlace> places;
  std::vector<double> motions;
  for_each_angle(analysis, [&](std::int32_t index, const GuideConstraint& guide, int row, std::size_t at) {
    analysis.find_places(index, places);
    if (analysis.current.linear) {  // rotations are small, and what they are measured by stands as at the start
      const std::vector<NodePlace> start(places.size());
      rotation[at] = change_of_angle(guide, row, start, [&](std::size_t i) { return places[i].turn; });
      return;
    }
    motions.resize(static_cast<std::size_t>(guide.rows()));
    guide.gaps(places, motions);
    const double last = analysis.current.guide_motion[analysis.first_constraint_row[index] + row];
    rotation[at] = guide.nearest(row, motions[row], last) / guide.lever(row);
  });
}

void add_joint_rates(const Analysis& analysis, std::span<double> spin) {
  std::vector<NodePlace> places;
  for_each_angle(analysis, [&](std::int32_t index, const GuideConstraint& guide, int row, std::size_t at) {
    analysis.find_places(index, places);
    if (analysis.current.linear) places.assign(places.size(), {});
    spin[at] = change_of_angle(guide, row, places, [&](std::size_t i) {
      const auto node = 3 * static_cast<std::size_t>(analysis.domain.local_node[guide.nodes()[i]]);
      return Vector3<double>{{spin[node], spin[node + 1], spin[node + 2]}};
    });
  });
}

void add_joint_reactions(const Analysis& analysis, std::span<double> moment) {
  const auto& state = analysis.current;
  if (state.step >= static_cast<std::int32_t>(analysis.model.steps.size())) return;
  const auto& motions = analysis.model.steps[state.step].connector_motions;
  for_each_angle(analysis, [&](std::int32_t index, const GuideConstraint& guide, int row, std::size_t at) {
    if (std::ranges::none_of(motions, [&](const ConnectorMotion& motion) { return motion.guide == index && motion.row == row; })) return;
    // A multiplier counts as the moment of a spring that is wound up by the angle.
    moment[at] = -guide.lever(row) * state.multiplier[analysis.first_constraint_row[index] + row];
  });
}

}  // namespace balocco
