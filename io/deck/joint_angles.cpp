#include "deck/joint_angles.hpp"

#include <algorithm>

namespace balocco::deck {

namespace {

const Builder::JointAngle* angle_at(const Builder& builder, std::int32_t node, int dof) {
  const auto found = builder.joint_angles.find(node);
  return dof != 5 || found == builder.joint_angles.end() ? nullptr : &found->second;
}

template <class Actuation>
Actuation& actuation_of(std::vector<Actuation>& all, const Builder::JointAngle& angle) {
  const auto same = std::ranges::find_if(all, [&](const Actuation& each) { return each.guide == angle.guide && each.row == angle.row; });
  if (same != all.end()) return *same;
  auto& added = all.emplace_back();
  added.guide = angle.guide;
  added.row = angle.row;
  return added;
}

}  // namespace

bool prescribes_angle(Builder& builder, std::int32_t node, int dof, const BoundaryCondition& condition) {
  const auto* angle = angle_at(builder, node, dof);
  if (angle == nullptr) return false;
  actuation_of(builder.in_step ? current_step(builder).connector_motions : builder.initial_angles, *angle).course = condition;
  return true;
}

bool loads_angle(Builder& builder, std::int32_t node, int dof, const ConcentratedLoad& load) {
  const auto* angle = angle_at(builder, node, dof);
  if (angle == nullptr) return false;
  auto& sum = actuation_of(current_step(builder).connector_loads, *angle);
  // As of other nodes: moments add up within a step, and take the place of those of earlier ones.
  const double here = builder.draft.said_here(sum) && sum.amplitude == load.amplitude ? sum.magnitude : 0.0;
  sum.magnitude = here + load.magnitude;
  sum.amplitude = load.amplitude;
  sum.file = load.file;
  sum.line = load.line;
  builder.draft.said.insert({sum.file, sum.line});
  return true;
}

}  // namespace balocco::deck
