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

/// Where a stop, a lock or a driver holds, what friction could bear as well counts as theirs.
bool is_held(const Analysis& analysis, std::int32_t index, int row, std::span<const double> measured) {
  const auto& guide = *analysis.constraints[index]->guide();
  const auto place = static_cast<std::size_t>(analysis.first_constraint_row[index] + row);
  const auto& state = analysis.current;
  if (state.guide_locked[place] != 0.0) return true;
  const auto stop = guide.of_motion(row, guide.definition().rows[row].stop);
  const double motion = guide.nearest(row, measured[row], state.guide_motion[place]), resolution = 1e-9 * guide.size();
  if (motion <= stop[0] + resolution || motion >= stop[1] - resolution) return true;
  if (state.step >= static_cast<std::int32_t>(analysis.model.steps.size())) return false;
  const auto& motions = analysis.model.steps[state.step].connector_motions;
  return std::ranges::any_of(motions, [&](const auto& driver) { return driver.guide == index && driver.row == row; });
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
    std::vector<NodePlace> places;
    std::vector<double> measured(rows);
    find_places(index, places);
    guide->gaps(places, measured);
    for (int row = 0; row < guide->rows(); ++row) {
      const double force = guide->lever(row) * multipliers[row], load = load_on(*this, index, row);
      const bool rubs = guide->definition().rows[row].friction && !is_held(*this, index, row, measured);
      if (total) values[guide->component(row)] += force;
      if (variable == (rubs ? "CSF" : "CRF")) values[guide->component(row)] += force + load;
      if (variable == "CCF") values[guide->component(row)] += load;
    }
  }
}

}  // namespace balocco
