#include "elements/small_strain_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "elements/membranes/membrane_output.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

/// Strain at which derivatives are sampled: five-point formulas then err by 1e-12 in both truncation and round-off.
constexpr double sampling_strain = 1e-3;
constexpr std::size_t most_values = 60;  // forces on 20 nodes

bool is_energy(std::string_view variable) { return variable == "SENER" || variable == "ELSE" || variable == "ELASE"; }

}  // namespace

/// Part of the displacement that strains the element by about the sampling strain; 0 where nothing moves.
double SmallStrainOutput::step(const ElementGroup& group, std::int32_t element, const State& state) const {
  const auto nodes = group.nodes(element);
  double size = 0.0, motion = 0.0, rotation = 0.0;
  for (const auto node : nodes) {
    Point apart{}, moved{};
    for (int i = 0; i < 3; ++i) {
      const auto here = 4 * node + i, first = 4 * nodes[0] + i;
      apart[i] = reference_[here] - reference_[first];
      moved[i] = state.position[here] - reference_[here] - (state.position[first] - reference_[first]);
    }
    size = std::max(size, std::hypot(apart[0], apart[1], apart[2]));
    motion = std::max(motion, std::hypot(moved[0], moved[1], moved[2]));
    if (group.freedoms_per_node() == 3) continue;
    const double* const turn = &state.rotation[4 * node];
    rotation = std::max(rotation, std::hypot(turn[0], turn[1], turn[2]));
  }
  const double strain = std::max(rotation, size > 0.0 ? motion / size : motion);
  return strain > 0.0 ? sampling_strain / strain : 0.0;
}

/// The element's nodes with `factor` times their displacement.
NodalMotion SmallStrainOutput::place(const ElementGroup& group, std::int32_t element, const State& state, double factor) {
  for (const auto node : group.nodes(element))
    for (int i = 0; i < 3; ++i) {
      const auto here = 4 * node + i;
      trial_[here] = reference_[here] + factor * (state.position[here] - reference_[here]);
    }
  if (group.freedoms_per_node() == 3) return {.position = trial_.data()};
  trial_orientation_.resize(state.orientation.size());
  trial_rotation_.resize(state.rotation.size());
  for (const auto node : group.nodes(element)) {
    const double* const turn = &state.rotation[4 * node];
    for (int i = 0; i < 3; ++i) trial_rotation_[4 * node + i] = factor * turn[i];
    std::ranges::copy(exponential(Vector3<double>{{factor * turn[0], factor * turn[1], factor * turn[2]}}),
                      &trial_orientation_[4 * node]);
  }
  return {.position = trial_.data(), .orientation = trial_orientation_.data(), .rotation = trial_rotation_.data()};
}

/// Taylor's polynomial of `order` 1 or 2: values of `evaluate(motion, history, values)` where the displacement is whole.
template <class Evaluate>
void SmallStrainOutput::expand(const ElementGroup& group, std::int32_t element, const State& state,
                               std::span<const double> history, Evaluate evaluate, int order, std::span<double> values) {
  std::array<std::array<double, most_values>, 5> sample{};  // at -2, -1, 0, 1, 2 steps
  trial_history_.resize(history.size());
  force_.resize(static_cast<std::size_t>(group.freedoms_per_node()) * group.nodes(element).size());
  const double h = step(group, element, state);
  for (int k = 0; k < 5; ++k) {
    const auto motion = place(group, element, state, (k - 2) * h);
    group.linearize(element, motion, history, trial_history_, force_, {});
    evaluate(motion, trial_history_, std::span(sample[k]).first(values.size()));
  }
  for (std::size_t c = 0; c < values.size(); ++c) {
    const double far = sample[4][c] - sample[0][c], near = sample[3][c] - sample[1][c], centre = sample[2][c];
    values[c] = centre;
    if (h == 0.0) continue;
    values[c] += (8.0 * near - far) / (12.0 * h);
    if (order < 2) continue;
    const double outer = sample[4][c] + sample[0][c] - 2.0 * centre, inner = sample[3][c] + sample[1][c] - 2.0 * centre;
    values[c] += 0.5 * (16.0 * inner - outer) / (12.0 * h * h);
  }
}

void SmallStrainOutput::output(const ElementGroup& group, std::string_view variable, std::int32_t element, int point,
                               const State& state, std::span<const double> history, std::span<double> values) {
  if (variable == "MISES") {  // has no derivative where there is no stress
    std::array<double, 6> stress{};
    output(group, "S", element, point, state, history, std::span(stress).first(group.output_components("S")));
    values[0] = mises_stress(stress);
    return;
  }
  const auto evaluate = [&](const NodalMotion& motion, std::span<const double> trial_history, std::span<double> sample) {
    group.output(variable, element, point, motion, trial_history, sample);
  };
  expand(group, element, state, history, evaluate, is_energy(variable) ? 2 : 1, values);
}

void SmallStrainOutput::internal_force(const ElementGroup& group, std::int32_t element, const State& state,
                                       std::span<const double> history, std::span<double> values) {
  const auto evaluate = [&](const NodalMotion&, std::span<const double>, std::span<double> sample) {
    std::ranges::copy(force_, sample.begin());
  };
  expand(group, element, state, history, evaluate, 1, values);
}

ElementEnergies SmallStrainOutput::energies(const ElementGroup& group, std::int32_t element, const State& state,
                                            std::span<const double> history) {
  const auto evaluate = [&](const NodalMotion& motion, std::span<const double> trial_history, std::span<double> sample) {
    const auto energies = group.energies(element, motion, trial_history);
    sample[0] = energies.strain;
    sample[1] = energies.hourglass;
    sample[2] = energies.viscous;
    sample[3] = energies.plastic;
  };
  std::array<double, 4> values{};
  expand(group, element, state, history, evaluate, 2, values);
  return {.strain = values[0], .hourglass = values[1], .viscous = values[2], .plastic = values[3]};
}

}  // namespace balocco
