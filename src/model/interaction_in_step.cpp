#include "model/interaction_in_step.hpp"

#include <algorithm>

namespace balocco {

namespace {

const ChangedInteraction* change_in_step(const Model& model, const ContactPair& pair, std::int32_t step) {
  if (step < 0 || step >= std::ssize(model.steps)) return nullptr;
  const auto& changes = model.steps[step].changed_interactions;
  const auto found = std::ranges::find(changes, pair.interaction, &ChangedInteraction::interaction);
  return found == changes.end() ? nullptr : &*found;
}

bool needs_penalty(const PressureLaw& law) {
  return law.kind == PressureLaw::Kind::hard || (law.kind == PressureLaw::Kind::exponential && law.greatest_slope == 0.0);
}

}  // namespace

const Interaction& interaction_in_step(const Model& model, const ContactPair& pair, std::int32_t step) {
  static const Interaction plain;
  if (pair.interaction < 0) return plain;
  const auto last = std::min(step, static_cast<std::int32_t>(model.steps.size()) - 1);
  const auto* const change = change_in_step(model, pair, last);
  return change != nullptr ? change->properties : model.interactions[pair.interaction];
}

double friction_in_step(const Model& model, const ContactPair& pair, std::int32_t step, double step_time) {
  const double after = interaction_in_step(model, pair, step).friction;
  const auto* const change = change_in_step(model, pair, step);
  if (change == nullptr || !model.steps[step].ramps_loads() || !(model.steps[step].duration() > 0.0)) return after;
  const double passed = std::min(1.0, step_time / model.steps[step].duration());
  return change->friction_before + passed * (after - change->friction_before);
}

bool changes_law(const Model& model, const ContactPair& pair, std::int32_t step) {
  return interaction_in_step(model, pair, step).behavior != interaction_in_step(model, pair, step - 1).behavior;
}

bool needs_penalty_stiffness(const Model& model, const ContactPair& pair) {
  if (pair.interaction < 0 || needs_penalty(model.interactions[pair.interaction].behavior)) return true;
  return std::ranges::any_of(model.steps, [&](const Step& step) {
    return std::ranges::any_of(step.changed_interactions, [&](const ChangedInteraction& change) {
      return change.interaction == pair.interaction && needs_penalty(change.properties.behavior);
    });
  });
}

}  // namespace balocco
