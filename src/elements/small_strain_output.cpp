#include "elements/small_strain_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "elements/initial_stress_rows.hpp"
#include "elements/membranes/membrane_output.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

/// Strain at which derivatives are sampled: five-point formulas then err by 1e-12 in both truncation and round-off.
constexpr double sampling_strain = 1e-3;

bool is_energy(std::string_view variable) { return variable == "SENER" || variable == "ELSE" || variable == "ELASE"; }

}  // namespace

/// History without stiffness about the reference configuration: thermal strains, and but in perturbations initial stresses.
std::vector<int> SmallStrainOutput::unstiffening_rows(const ElementGroup& group, const State& state) const {
  const bool perturbs = state.step < static_cast<std::int32_t>(model_.steps.size()) && model_.steps[state.step].is_perturbation();
  if (base_ && !base_->linear) return {};
  auto rows = thermal_strain_rows(group);
  if (!perturbs) std::ranges::copy(initial_stress_rows(model_, group), std::back_inserter(rows));
  return rows;
}

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

/// The element's nodes with `factor` times their displacement, from the base.
NodalMotion SmallStrainOutput::place(const ElementGroup& group, std::int32_t element, const State& state, double factor) {
  for (const auto node : group.nodes(element))
    for (int i = 0; i < 3; ++i) {
      const auto here = 4 * node + i;
      trial_[here] = (base_ ? base_->position : reference_)[here] + factor * (state.position[here] - reference_[here]);
    }
  if (group.freedoms_per_node() == 3) return {.position = trial_.data()};
  trial_orientation_.resize(state.orientation.size());
  trial_rotation_.resize(state.rotation.size());
  for (const auto node : group.nodes(element)) {
    const double* const turn = &state.rotation[4 * node];
    for (int i = 0; i < 3; ++i) trial_rotation_[4 * node + i] = factor * turn[i];
    auto orientation = exponential(Vector3<double>{{factor * turn[0], factor * turn[1], factor * turn[2]}});
    if (base_) {
      const double* const q = &base_->orientation[4 * node];
      orientation = product(orientation, {q[0], q[1], q[2], q[3]});
      for (int i = 0; i < 3; ++i) trial_rotation_[4 * node + i] += base_->rotation[4 * node + i];
    }
    std::ranges::copy(orientation, &trial_orientation_[4 * node]);
  }
  return {.position = trial_.data(), .orientation = trial_orientation_.data(), .rotation = trial_rotation_.data()};
}

template <class Evaluate>
void SmallStrainOutput::sample(const ElementGroup& group, std::int32_t element, const State& state, std::span<const double> history,
                               Evaluate evaluate, std::size_t count, double step, Samples& samples) {
  trial_history_.resize(history.size());
  force_.resize(static_cast<std::size_t>(group.freedoms_per_node()) * group.nodes(element).size());
  for (int k = 0; k < 5; ++k) {
    const auto motion = place(group, element, state, (k - 2) * step);
    group.linearize(element, motion, history, trial_history_, force_, {});
    evaluate(motion, trial_history_, std::span(samples[k]).first(count));
  }
}

/// Taylor's polynomial of `order` 1 or 2: values of `evaluate(motion, history, values)` where the displacement is whole.
template <class Evaluate>
void SmallStrainOutput::expand(const ElementGroup& group, std::int32_t element, const State& state,
                               std::span<const double> history, Evaluate evaluate, int order, std::span<double> values) {
  Samples whole{}, unstressed{};
  const double h = step(group, element, state);
  sample(group, element, state, history, evaluate, values.size(), h, whole);
  const auto rows = unstiffening_rows(group, state);
  if (!rows.empty()) {
    unstressed_history_.assign(history.begin(), history.end());
    for (const int row : rows) unstressed_history_[row] = 0.0;
    sample(group, element, state, unstressed_history_, evaluate, values.size(), h, unstressed);
  }
  // What the material resists: the slope of forces and stresses, the curvature of energies.
  const auto& material = rows.empty() ? whole : unstressed;
  const auto& sloping = order < 2 ? material : whole;
  for (std::size_t c = 0; c < values.size(); ++c) {
    values[c] = base_ ? 0.0 : whole[2][c];
    if (h == 0.0) continue;
    if (order < 2 || !base_) values[c] += (8.0 * (sloping[3][c] - sloping[1][c]) - (sloping[4][c] - sloping[0][c])) / (12.0 * h);
    if (order < 2) continue;
    const double twice = 2.0 * material[2][c], outer = material[4][c] + material[0][c] - twice, inner = material[3][c] + material[1][c] - twice;
    values[c] += 0.5 * (16.0 * inner - outer) / (12.0 * h * h);
  }
}

void SmallStrainOutput::output(const ElementGroup& group, std::string_view variable, std::int32_t element, int point,
                               const State& state, std::span<const double> history, std::span<double> values) {
  if (variable == "STATUS") return group.output(variable, element, point, state.motion(), history, values);
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
    sample[4] = energies.heat;
  };
  std::array<double, 5> values{};
  expand(group, element, state, history, evaluate, 2, values);
  return {.strain = values[0], .hourglass = values[1], .viscous = values[2], .plastic = values[3], .heat = values[4]};
}

}  // namespace balocco
