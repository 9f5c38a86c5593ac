#include "thermal_strains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "elements/element_type.hpp"
#include "elements/initial_stress_rows.hpp"
#include "materials/elastic_by_temperature.hpp"
#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

/// From a brick's quadratic shape functions to fields that are linear between its corners: a corner's value is the mean of what its three
/// edges extrapolate to it from their middles and far ends, 2 T_middle - T_far (what CalculiX does).
void make_linear(const ElementType& type, std::span<double> weights) {
  const std::vector<double> quadratic(weights.begin(), weights.end());
  std::array<double, 8> linear{};
  std::ranges::fill(weights, 0.0);
  const auto each_side_of_an_edge = [&](auto&& visit) {
    for (std::size_t face = 0; face < type.faces.size(); ++face)
      for (std::size_t i = 0; i < 4; ++i) visit(type.faces[face][i], type.face_midsides[face][i], type.faces[face][(i + 1) % 4]);
  };
  for (std::size_t corner = 0; corner < 8; ++corner) linear[corner] = quadratic[corner];
  each_side_of_an_edge([&](int end, int middle, int other) {
    linear[end] += 0.25 * quadratic[middle];
    linear[other] += 0.25 * quadratic[middle];
  });
  each_side_of_an_edge([&](int end, int middle, int other) {
    weights[middle] += (linear[end] + linear[other]) / 3.0;
    weights[end] -= linear[other] / 6.0;
    weights[other] -= linear[end] / 6.0;
  });
}

/// What the temperature at a point is made of. Of linear elements the mean of their nodes, so that expansion and the strains that they can
/// have are of one order (a linear field would stress a free brick); of quadratic ones the shape functions, of which the strains are, but
/// of C3D20, whose many points would see more than its strains can follow, a linear field. CalculiX has the same rules.
void add_weights(const ElementType& type, int point, std::vector<double>& weights) {
  const auto first = weights.size();
  weights.resize(first + static_cast<std::size_t>(type.nodes), 1.0 / type.nodes);
  const bool quadratic = type.nodes > 8 && type.point_shapes != nullptr;
  if (!quadratic) return;
  const auto own = std::span(weights).subspan(first);
  type.point_shapes(point, own);
  if (type.shape == Shape::quadratic_hexahedron && type.integration_points == 27) make_linear(type, own);
}

}  // namespace

void find_nodal_temperatures(const Analysis& analysis, const Step& step, double step_time, double total_time, std::span<double> temperature) {
  const auto& initial = analysis.model.initial_temperature;
  std::ranges::fill(temperature, 0.0);
  for (std::size_t node = 0; node < temperature.size() && !initial.empty(); ++node)
    temperature[node] = initial[analysis.domain.node_row[node]];
  for (const auto& said : step.temperatures)
    if (const auto node = analysis.domain.local_node[said.node]; node >= 0)
      temperature[node] = load_magnitude(analysis.model, step, said.previous, said.magnitude, said.amplitude, step_time, total_time);
}

ThermalStrains::ThermalStrains(const Analysis& analysis) : temperature_(static_cast<std::size_t>(analysis.domain.size())) {
  const Model& model = analysis.model;
  // Without temperatures there are no strains but those that came with another job's state.
  acts_ = std::ranges::any_of(model.materials, follows_temperature) &&
          std::ranges::any_of(model.steps, [](const Step& step) { return !step.temperatures.empty(); });
  for (std::size_t index = 0; index < analysis.element_groups.size(); ++index) {
    const auto& group = *analysis.element_groups[index];
    Group heated{.index = index, .rows = thermal_strain_rows(group)};
    for (int point = 0; point < group.integration_points(); ++point)
      if (const int row = group.law_field_row(ElasticByTemperature::changes_field, point); row >= 0) heated.of_constants.push_back(row);
    if (heated.rows.empty() && heated.of_constants.empty()) continue;
    heated.material = &model.materials[model.sections[group.section()].material];
    const ElementType& type = *model.elements[group.table()].type;
    for (int point = 0; point < group.integration_points(); ++point) add_weights(type, point, heated.weights);
    groups_.push_back(std::move(heated));
  }
}

bool ThermalStrains::move_in(const Step& step) const {
  return acts_ && std::ranges::any_of(step.temperatures, [](const auto& said) { return said.amplitude >= 0; });
}

void ThermalStrains::set(Analysis& analysis, const Step& step, double step_time, double total_time) {
  if (!acts_) return;
  find_nodal_temperatures(analysis, step, step_time, total_time, temperature_);
  analysis.communicator.together([&] {
    for (const auto& heated : groups_) write(analysis, heated);
  });
}

void ThermalStrains::start(Analysis& analysis) {
  const auto& initial = analysis.model.initial_temperature;
  for (std::size_t node = 0; node < temperature_.size(); ++node)
    temperature_[node] = initial.empty() ? 0.0 : initial[analysis.domain.node_row[node]];
  for (const auto& heated : groups_) {
    if (heated.of_constants.empty()) continue;
    write(analysis, heated);
    // Nothing has worked to make them so.
    auto& history = analysis.current.element_history[heated.index];
    const auto lanes = static_cast<std::ptrdiff_t>(analysis.element_groups[heated.index]->padded_size());
    for (const int row : heated.of_constants)
      std::copy_n(history.begin() + row * lanes, 2 * lanes, history.begin() + (row + ElasticByTemperature::done_row) * lanes);
  }
}

ThermalStrains::Temperatures ThermalStrains::at_point(const Analysis& analysis, const Group& heated, std::int32_t lane, std::size_t point) const {
  const auto nodes = analysis.element_groups[heated.index]->nodes(lane);
  const auto& initial = analysis.model.initial_temperature;
  Temperatures found;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double weight = heated.weights[point * nodes.size() + i];
    found.now += weight * temperature_[nodes[i]];
    if (!initial.empty()) found.initial += weight * initial[analysis.domain.node_row[nodes[i]]];
  }
  return found;
}

void ThermalStrains::write_strain(Analysis& analysis, const Group& heated, std::int32_t lane, std::size_t point, Temperatures temperatures) const {
  const auto& group = *analysis.element_groups[heated.index];
  const bool linear = analysis.current.linear;
  const double strain = heated.material->expansion->strain(temperatures.now, temperatures.initial);
  if (!linear && !(strain > -1.0) && lane < group.size())
    throw AnalysisError(fmt::format("element {} at the temperature {:.6g} has the thermal strain {:.6g}: nothing is left of it; correct "
                                    "*EXPANSION or *TEMPERATURE",
                                    analysis.model.elements[group.table()].id[group.row(lane)], temperatures.now, strain));
  const auto lanes = static_cast<std::size_t>(group.padded_size()), row = static_cast<std::size_t>(heated.rows[point]);
  auto& history = analysis.current.element_history[heated.index];
  history[row * lanes + lane] = strain;
  history[(row + 1) * lanes + lane] = linear ? 1.0 : 0.0;
}

void ThermalStrains::write(Analysis& analysis, const Group& heated) const {
  const auto& group = *analysis.element_groups[heated.index];
  auto& history = analysis.current.element_history[heated.index];
  const auto lanes = static_cast<std::size_t>(group.padded_size());
  const auto points = std::max(heated.rows.size(), heated.of_constants.size());
  for (std::int32_t lane = 0; lane < group.padded_size(); ++lane)
    for (std::size_t point = 0; point < points; ++point) {
      const auto temperatures = at_point(analysis, heated, lane, point);
      if (!heated.rows.empty()) write_strain(analysis, heated, lane, point, temperatures);
      if (heated.of_constants.empty()) continue;
      const ElasticTable table(heated.material->parameters);
      const auto now = table.at(temperatures.now), first = table.first();
      const auto row = static_cast<std::size_t>(heated.of_constants[point]);
      history[row * lanes + lane] = now.lambda - first.lambda;
      history[(row + 1) * lanes + lane] = now.mu - first.mu;
    }
}

void ThermalStrains::leave_first_order(Analysis& analysis) const {
  for (const auto& heated : groups_) {
    auto& history = analysis.current.element_history[heated.index];
    const auto lanes = static_cast<std::size_t>(analysis.element_groups[heated.index]->padded_size());
    for (const int row : heated.rows) std::fill_n(history.begin() + static_cast<std::ptrdiff_t>((row + 1) * lanes), lanes, 0.0);
  }
}

}  // namespace balocco
