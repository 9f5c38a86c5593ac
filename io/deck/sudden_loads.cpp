#include "deck/sudden_loads.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace balocco::deck {

namespace {

/// Row of the curve that is 1 at all times, which a static step follows where it would ramp.
std::int32_t constant_curve(Builder& builder) {
  const std::string name = "AT-ONCE-AND-CONSTANT";
  const auto row = static_cast<std::int32_t>(builder.model.amplitudes.size());
  const auto [known, added] = builder.amplitudes.rows.emplace(name, row);
  if (added) builder.model.amplitudes.push_back({.name = name, .points = {{0.0, 1.0}, {1.0, 1.0}}});
  return known->second;
}

/// What a static step lets go of fades over it, however its loads act.
void refuse_releases(Builder& builder, const Step& before, const Step& step) {
  const auto is_held = [&](const BoundaryCondition& old) {
    return std::ranges::any_of(step.boundary, [&](const auto& now) { return now.node == old.node && now.dof == old.dof; });
  };
  const auto released = std::ranges::find_if_not(before.boundary, is_held);
  if (released == before.boundary.end() && step.connector_motions.size() >= before.connector_motions.size()) return;
  builder.diagnostics.error(
      builder.draft.location, "STEP",
      fmt::format("AMPLITUDE=STEP: the step lets go of {}, and what held it fades linearly over a static step; let go of it in a step of its own",
                  released == before.boundary.end() ? "a connector's motion" : "node " + builder.model.node_name(released->node)));
}

/// OP=NEW: CalculiX lets loads that are gone fade in such a step too.
template <class Load>
void refuse_removal(Builder& builder, const Load& load) {
  builder.diagnostics.error(builder.draft.location, "STEP",
                            fmt::format("AMPLITUDE=STEP: whether the load of {} goes at once or fades is not clear; say it in this step, with magnitude 0 "
                                        "where it goes at once",
                                        builder.model.where({load.file, load.line})));
}

}  // namespace

void act_at_once(Builder& builder) {
  Step& step = current_step(builder);
  const auto before = builder.model.general_step_before(static_cast<std::int32_t>(builder.model.steps.size()) - 1);
  if (before >= 0) refuse_releases(builder, builder.model.steps[before], step);
  const auto load = [&](auto& loads) {
    for (auto& each : loads) {
      if (each.amplitude >= 0 || each.magnitude == each.previous) continue;
      if (!builder.draft.said_here(each)) return refuse_removal(builder, each);
      each.amplitude = constant_curve(builder);
    }
  };
  load(step.concentrated_loads);
  load(step.surface_loads);
  load(step.temperatures);
  load(step.body_loads);
  load(step.connector_loads);
  const auto move = [&](BoundaryCondition& condition) {
    const bool stays = condition.propagated || condition.fixed || (before < 0 && condition.magnitude == 0.0);
    if (condition.kind == BoundaryCondition::Kind::displacement && condition.amplitude < 0 && !stays) condition.amplitude = constant_curve(builder);
  };
  for (auto& condition : step.boundary) move(condition);
  for (auto& motion : step.connector_motions) move(motion.course);
  for (auto& change : step.changed_interactions) change.friction_before = change.properties.friction;
}

}  // namespace balocco::deck
