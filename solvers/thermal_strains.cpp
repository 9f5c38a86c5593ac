#include "thermal_strains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "elements/element_type.hpp"
#include "elements/initial_stress_rows.hpp"
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
  // Without temperatures there are none but those that came with another job's state.
  acts_ = std::ranges::any_of(model.materials, [](const Material& material) { return material.expansion.has_value(); }) &&
          std::ranges::any_of(model.steps, [](const Step& step) { return !step.temperatures.empty(); });
  for (std::size_t index = 0; index < analysis.element_groups.size(); ++index) {
    const auto& group = *analysis.element_groups[index];
    Group heated{.index = index, .rows = thermal_strain_rows(group)};
    if (heated.rows.empty()) continue;
    heated.expansion = &*model.materials[model.sections[group.section()].material].expansion;
    const ElementType& type = *model.elements[group.table()].type;
    for (int point = 0; point < static_cast<int>(heated.rows.size()); ++point) add_weights(type, point, heated.weights);
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

void ThermalStrains::write(Analysis& analysis, const Group& heated) const {
  const auto& group = *analysis.element_groups[heated.index];
  const auto& initial = analysis.model.initial_temperature;
  auto& history = analysis.current.element_history[heated.index];
  const bool linear = analysis.current.linear;
  const auto lanes = static_cast<std::size_t>(group.padded_size());
  for (std::int32_t lane = 0; lane < group.padded_size(); ++lane) {
    const auto nodes = group.nodes(lane);
    for (std::size_t point = 0; point < heated.rows.size(); ++point) {
      double now = 0.0, before = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double weight = heated.weights[point * nodes.size() + i];
        now += weight * temperature_[nodes[i]];
        if (!initial.empty()) before += weight * initial[analysis.domain.node_row[nodes[i]]];
      }
      const double strain = heated.expansion->strain(now, before);
      if (!linear && !(strain > -1.0) && lane < group.size())
        throw AnalysisError(fmt::format("element {} at the temperature {:.6g} has the thermal strain {:.6g}: nothing is left of it; correct "
                                        "*EXPANSION or *TEMPERATURE",
                                        analysis.model.elements[group.table()].id[group.row(lane)], now, strain));
      const std::size_t row = static_cast<std::size_t>(heated.rows[point]);
      history[row * lanes + lane] = strain;
      history[(row + 1) * lanes + lane] = linear ? 1.0 : 0.0;
    }
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
