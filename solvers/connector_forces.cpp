// Forces of connectors that constraints exert: held components, and those that guides stop, lock, rub, drive or load.
#include <algorithm>

#include "analysis.hpp"
#include "constraints/guide.hpp"
#include "constraints/joint.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

/// Of the step that runs.
double load_on(const Analysis& analysis, std::int32_t guide, int row) {
  const auto& state = analysis.current;
  if (state.step >= static_cast<std::int32_t>(analysis.model.steps.size())) return 0.0;
  const auto& step = analysis.model.steps[state.step];
  const auto is_on = [&](const ConnectorLoad& load) { return load.guide == guide && load.row == row; };
  const auto load = std::ranges::find_if(step.connector_loads, is_on);
  if (load == step.connector_loads.end()) return 0.0;
  return load_magnitude(analysis.model, step, load->previous, load->magnitude, load->amplitude, state.step_time, state.total_time);
}

}  // namespace

void Analysis::add_connector_forces(ElementRef connector, std::string_view variable, std::span<double> values) const {
  const bool total = variable == "CTF";
  if (!total && variable != "CRF" && variable != "CSF" && variable != "CCF") return;
  const auto entry = constraints_of_connector_.find(connector);
  if (entry == constraints_of_connector_.end()) return;
  for (const auto index : entry->second) {
    const auto rows = static_cast<std::size_t>(constraints[index]->rows());
    const auto multipliers = std::span(current.multiplier).subspan(static_cast<std::size_t>(first_constraint_row[index]), rows);
    const auto* guide = constraints[index]->guide();
    if (guide == nullptr) {
      const auto held = static_cast<const JointConstraint&>(*constraints[index]).component_forces(multipliers);
      for (int c = 0; c < 6 && (total || variable == "CRF"); ++c) values[c] += held[c];
      continue;
    }
    for (int row = 0; row < guide->rows(); ++row) {
      const double force = guide->lever(row) * multipliers[row], load = load_on(*this, index, row);
      const auto* part = guide->definition().rows[row].friction ? "CSF" : "CRF";
      if (total) values[guide->component(row)] += force;
      if (variable == part) values[guide->component(row)] += force + load;
      if (variable == "CCF") values[guide->component(row)] += load;
    }
  }
}

}  // namespace balocco
