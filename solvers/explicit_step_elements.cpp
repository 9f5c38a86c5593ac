// What changes the elements of a step while it runs: scaled masses, bounds that others add to their frequencies, failure.
#include <algorithm>

#include "explicit_step.hpp"

namespace balocco {

void ExplicitStep::look_at_mass_scaling(double previous_time) {
  const bool due = mass_scaling_.find_due(analysis_.current, previous_time);
  if (due != scales_masses_)
    for (const auto& group : analysis_.element_groups) group->record_increments(due);
  scales_masses_ = due;
}

void ExplicitStep::tell_added_bounds() {
  const auto& of_contact = contact_.nodal_frequencies_squared();
  for (std::size_t index = 0; index < analysis_.element_groups.size(); ++index) {
    auto& group = *analysis_.element_groups[index];
    auto added = analysis_.current.restrained[index];
    for (std::int32_t element = 0; group.density() > 0.0 && element < group.size(); ++element) {
      double largest = 0.0;
      for (const auto node : group.nodes(element)) largest = std::max(largest, of_contact[node]);
      if (largest == 0.0) continue;
      added.resize(static_cast<std::size_t>(group.size()));
      added[element].omega_square += largest;
    }
    group.set_added_bounds(added);
  }
}

void ExplicitStep::scale_masses() {
  if (!scales_masses_) return;
  timers.measure(Phase::update, [&] {
    if (!mass_scaling_.adapt(analysis_)) return;
    renew_inertia();
    stability_ = {};
    for (const auto& group : analysis_.element_groups)
      if (const auto stable = group->smallest_recorded_increment(); stable.element >= 0)
        stability_.merge(stable.increment, analysis_.model.elements[group->table()].id[group->row(stable.element)]);
  });
}

void ExplicitStep::rest_failed_elements() {
  timers.measure(Phase::elements, [&] {
    for (std::size_t index = 0; index < analysis_.element_groups.size(); ++index)
      failures_.rest(index, analysis_.current.element_history[index]);
  });
}

}  // namespace balocco
