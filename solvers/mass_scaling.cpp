#include "mass_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/exact_sum.hpp"

namespace balocco {

namespace {

constexpr double unlimited = 1e299;  // increment of what does not resist

/// Increment of an element with its own mass that a target can be reached from.
bool can_follow(const Analysis& analysis, double own_increment) {
  return own_increment >= collapsing * analysis.undeformed_increment && own_increment < unlimited;
}

bool has_mass(const ElementGroup& group) { return group.density() > 0.0; }

/// Stable increments of the elements where they are, without viscosity of what moves, into the groups' records.
void record_increments(const Analysis& analysis, const ExplicitProcedure& procedure) {
  const auto size = 4 * (static_cast<std::size_t>(analysis.domain.size()) + 1);
  std::vector<double> force(size, 0.0), moment(size, 0.0);
  const ExplicitCycle cycle{.motion = analysis.current.motion(),
                            .forces = {.force = force.data(), .moment = moment.data()},
                            .linear_bulk_viscosity = procedure.linear_bulk_viscosity,
                            .quadratic_bulk_viscosity = procedure.quadratic_bulk_viscosity};
  for (std::size_t index = 0; index < analysis.element_groups.size(); ++index) {
    auto& group = *analysis.element_groups[index];
    auto history = analysis.current.element_history[index];
    group.record_increments(true);
    for (const auto portion : {Portion::interface, Portion::interior}) group.add_forces(portion, cycle, history);
    group.record_increments(false);
  }
}

bool has_target(const MassScaling& definition) { return definition.target != MassScaling::Target::none; }

/// Nothing moves yet, or what the steps before moved stands still when an explicit step begins.
bool starts_at_rest(const Analysis& analysis) {
  const auto before = analysis.model.general_step_before(analysis.current.step);
  return !analysis.current.dynamic || (before >= 0 && !analysis.model.steps[before].is_dynamic());
}

/// Of the speeds before the instant, at which central differences add the mass.
void count_energy(Analysis& analysis, const LumpedInertia& before) {
  auto& state = analysis.current;
  const auto& now = analysis.scaled_inertia();
  const auto square = [](const std::vector<double>& velocity, std::size_t node) {
    const double* const v = &velocity[4 * node];
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  };
  for (std::size_t node = 0; node < now.mass.size(); ++node)
    state.nodal_work[node].mass_scaling += 0.5 * (now.mass[node] - before.mass[node]) * square(state.velocity, node);
  for (std::size_t node = 0; node < now.rotary.size(); ++node)
    state.nodal_work[node].mass_scaling += 0.5 * (now.rotary[node] - before.rotary[node]) * square(state.angular_velocity, node);
}

}  // namespace

MassScalingOfStep::MassScalingOfStep(Analysis& analysis, const Step& step)
    : step_(step), procedure_(std::get<ExplicitProcedure>(step.procedure)) {
  for (const auto& group : analysis.element_groups) group->record_increments(false);  // the step before may have ended with it
  fixed_ = governing(analysis, procedure_.fixed_mass_scaling);
  variable_ = governing(analysis, procedure_.variable_mass_scaling);
  ExactSum mass;
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    if (analysis.domain.owned[node]) mass.add(analysis.inertia.mass[node]);
  analysis.communicator.sum(std::span(&mass, 1));
  model_mass_ = mass.value();
  if (analysis.current.increment == 0) start(analysis);
  sum_added_mass(analysis);
  before_ = analysis.current.mass_scale;
}

/// A definition with a set governs its elements in place of those for the whole model, a later one in place of an earlier one.
MassScalingOfStep::Governing MassScalingOfStep::governing(const Analysis& analysis, const Definitions& definitions) const {
  Governing result(analysis.element_groups.size());
  if (definitions.empty()) return result;
  for (std::size_t index = 0; index < result.size(); ++index) {
    const auto& group = *analysis.element_groups[index];
    if (!has_mass(group)) continue;
    result[index].assign(static_cast<std::size_t>(group.size()), -1);
    for (const bool local : {false, true})
      for (std::size_t d = 0; d < definitions.size(); ++d) {
        if ((definitions[d].element_set >= 0) != local) continue;
        for (std::int32_t e = 0; e < group.size(); ++e) {
          const ElementRef element{group.table(), group.row(e)};
          if (local && !std::ranges::binary_search(analysis.model.element_sets[definitions[d].element_set].elements, element))
            continue;
          result[index][e] = static_cast<std::int32_t>(d);
        }
      }
  }
  return result;
}

void MassScalingOfStep::start(Analysis& analysis) {
  const auto &fixed = procedure_.fixed_mass_scaling, &variable = procedure_.variable_mass_scaling;
  if (fixed.empty() && variable.empty()) return;
  if (std::ranges::any_of(fixed, has_target) || !variable.empty()) record_increments(analysis, procedure_);
  for (const auto& group : analysis.element_groups) group->set_added_bounds({});  // of the step before
  before_ = analysis.current.mass_scale;
  scale_afresh(analysis);
  apply(analysis, before_, !starts_at_rest(analysis));
}

void MassScalingOfStep::scale_afresh(Analysis& analysis) {
  const auto &fixed = procedure_.fixed_mass_scaling, &variable = procedure_.variable_mass_scaling;
  auto& scale_of = analysis.current.mass_scale;
  for (std::size_t index = 0; index < scale_of.size(); ++index) {
    if (!has_mass(*analysis.element_groups[index])) continue;
    if (!fixed.empty()) scale_of[index].clear();
    scale_of[index].resize(static_cast<std::size_t>(analysis.element_groups[index]->size()), 1.0);
  }
  if (!fixed.empty()) {
    due_.assign(fixed.size(), true);
    scale(analysis, fixed, fixed_);
  }
  due_.assign(variable.size(), true);
  scale(analysis, variable, variable_);
}

bool MassScalingOfStep::allow_for_added_bounds(Analysis& analysis) {
  const auto &fixed = procedure_.fixed_mass_scaling, &variable = procedure_.variable_mass_scaling;
  if (!std::ranges::any_of(fixed, has_target) && variable.empty()) return false;
  before_ = analysis.current.mass_scale;
  scale_afresh(analysis);
  if (!apply(analysis, before_, !starts_at_rest(analysis))) return false;
  sum_added_mass(analysis);
  return true;
}

void MassScalingOfStep::scale(Analysis& analysis, const Definitions& definitions, const Governing& governing) {
  using Target = MassScaling::Target;
  const auto for_each = [&](auto visit) {
    for (std::size_t index = 0; index < governing.size(); ++index) {
      const auto& group = *analysis.element_groups[index];
      for (std::size_t e = 0; e < governing[index].size(); ++e) {
        const auto d = governing[index][e];
        const auto element = static_cast<std::int32_t>(e);
        if (d < 0 || !due_[d] || !group.acts(element)) continue;
        const double own = has_target(definitions[d]) ? group.recorded_increment_with_added_bound(element) : 0.0;
        visit(static_cast<std::size_t>(d), analysis.current.mass_scale[index][e], own);
      }
    }
  };
  for_each([&](std::size_t d, double& scale, double) { scale *= definitions[d].factor; });
  smallest_.assign(definitions.size(), -unlimited);  // less the smallest increment
  for_each([&](std::size_t d, double scale, double own) {
    if (can_follow(analysis, own)) smallest_[d] = std::max(smallest_[d], -own * std::sqrt(scale));
  });
  analysis.communicator.maximum(std::span<double>(smallest_));
  for_each([&](std::size_t d, double& scale, double own) {
    const auto& [target, increment, factor, set, frequency, intervals] = definitions[d];
    if (target == Target::none) return;
    const auto square = [](double x) { return x * x; };
    if (target == Target::uniform) {
      if (smallest_[d] > -unlimited) scale *= square(increment / smallest_[d]);
    } else if (can_follow(analysis, own)) {
      const double needed = square(increment / own);
      if (target == Target::equal || needed > scale) scale = needed;
    }
  });
}

bool MassScalingOfStep::apply(Analysis& analysis, const std::vector<std::vector<double>>& before, bool moving) {
  if (!analysis.communicator.any(before != analysis.current.mass_scale)) return false;
  inertia_before_ = analysis.scaled_inertia();
  analysis.apply_mass_scale();
  if (moving) count_energy(analysis, inertia_before_);
  return true;
}

bool MassScalingOfStep::find_due(const State& state, double previous_time) {
  const auto& definitions = procedure_.variable_mass_scaling;
  due_.assign(definitions.size(), false);
  bool any = false;
  for (std::size_t d = 0; d < definitions.size(); ++d) {
    if (definitions[d].frequency) {
      due_[d] = state.increment % *definitions[d].frequency == 0;
    } else {
      const double intervals = *definitions[d].number_interval / step_.duration();
      due_[d] = std::floor(intervals * state.step_time) > std::floor(intervals * previous_time);
    }
    any = any || due_[d];
  }
  return any;
}

bool MassScalingOfStep::adapt(Analysis& analysis) {
  before_ = analysis.current.mass_scale;
  scale(analysis, procedure_.variable_mass_scaling, variable_);
  if (!apply(analysis, before_, true)) return false;
  sum_added_mass(analysis);
  return true;
}

void MassScalingOfStep::sum_added_mass(const Analysis& analysis) {
  exists_ = !procedure_.fixed_mass_scaling.empty() || !procedure_.variable_mass_scaling.empty();
  ExactSum added;
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    if (analysis.domain.owned[node]) added.add(analysis.scaled_inertia().mass[node] - analysis.inertia.mass[node]);
  analysis.communicator.sum(std::span(&added, 1));
  added_part_ = model_mass_ > 0.0 ? added.value() / model_mass_ : 0.0;
  exists_ = exists_ || added_part_ != 0.0;
}

std::vector<std::string> MassScalingOfStep::report(const Analysis& analysis) const {
  std::vector<std::string> lines;
  const auto add_lines = [&](const Definitions& definitions, const Governing& governing) {
    std::vector<ExactSum> own(definitions.size()), added(definitions.size());
    std::vector<double> share;
    for (std::size_t index = 0; index < governing.size(); ++index) {
      const auto& group = *analysis.element_groups[index];
      share.resize(static_cast<std::size_t>(group.nodes_per_element()));
      for (std::size_t e = 0; e < governing[index].size(); ++e) {
        if (governing[index][e] < 0) continue;
        group.lumped_mass(static_cast<std::int32_t>(e), share);
        double mass = 0.0;
        for (const double part : share) mass += part;
        own[governing[index][e]].add(mass);
        added[governing[index][e]].add((group.mass_scale(static_cast<std::int32_t>(e)) - 1.0) * mass);
      }
    }
    analysis.communicator.sum(std::span(own));
    analysis.communicator.sum(std::span(added));
    for (std::size_t d = 0; d < definitions.size(); ++d) {
      const auto set = definitions[d].element_set;
      lines.push_back(fmt::format("step {}: mass scaling has added {:.6g} to the elements of {}, {:.6g} % of their mass {:.6g}",
                                  step_.name, added[d].value(), set < 0 ? "the whole model" : analysis.model.element_sets[set].name,
                                  own[d].value() > 0.0 ? 100.0 * added[d].value() / own[d].value() : 0.0, own[d].value()));
    }
  };
  add_lines(procedure_.fixed_mass_scaling, fixed_);
  add_lines(procedure_.variable_mass_scaling, variable_);
  if (exists_)
    lines.push_back(fmt::format("step {}: mass scaling has added {:.6g} in all, {:.6g} % of the mass of the model", step_.name,
                                added_part_ * model_mass_, 100.0 * added_part_));
  return lines;
}

}  // namespace balocco
