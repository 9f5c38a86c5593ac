#include "mode_superposition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/rigid_body.hpp"
#include "math/rotation.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

using ModalField = std::vector<double> Mode::*;

double combined(const std::vector<Mode>& modes, ModalField shape, const Eigen::VectorXd& factors, std::size_t at) {
  double sum = 0.0;
  for (std::size_t mode = 0; mode < modes.size(); ++mode) sum += factors[static_cast<Eigen::Index>(mode)] * (modes[mode].*shape)[at];
  return sum;
}

void show_bodies(Analysis& analysis, const std::vector<Mode>& modes, const Eigen::VectorXd& amplitude, const Eigen::VectorXd& velocity) {
  auto& bodies = analysis.current.rigid_bodies;
  const auto at_rest = initial_rigid_bodies(analysis.model);
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    const auto node = static_cast<std::size_t>(analysis.domain.local_node[analysis.model.rigid_bodies[body].reference_node]);
    auto& shown = bodies[body];
    Point turn{}, spin{};
    for (std::size_t i = 0; i < 3; ++i) {
      turn[i] = combined(modes, &Mode::rotation, amplitude, 3 * node + i);
      spin[i] = combined(modes, &Mode::rotation, velocity, 3 * node + i);
    }
    shown.orientation = at_rest[body].orientation;
    shown.rotation = {};
    rotate(shown, turn);
    shown.angular_velocity = spin;
    std::copy_n(&analysis.current.position[4 * node], 3, shown.position.begin());
    std::copy_n(&analysis.current.velocity[4 * node], 3, shown.velocity.begin());
  }
}

/// Of each mode the sum of what `value(damping, mode)` says where a line speaks of it.
template <class Value>
Eigen::VectorXd by_mode(const std::vector<ModalDamping>& given, const std::vector<Mode>& modes, Value value) {
  const auto count = static_cast<std::int32_t>(modes.size());
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(count);
  for (const auto& damping : given)
    for (std::int32_t number = damping.first; number <= std::min(damping.last, count); ++number)
      sums[number - 1] += value(damping, modes[static_cast<std::size_t>(number - 1)]);
  return sums;
}

/// A step since the modes were found that has moved the state away from theirs; of linear states all is about the reference configuration.
const Step* moving_step(const Analysis& analysis) {
  if (analysis.current.linear) return nullptr;
  for (auto row = analysis.step_of_modes + 1; row < analysis.current.step; ++row)
    if (const Step& between = analysis.model.steps[row]; !between.is_perturbation()) return &between;
  return nullptr;
}

}  // namespace

std::vector<Mode> modes_of_unit_mass(const Analysis& analysis, const Step& step) {
  auto modes = analysis.modes;
  if (modes.empty())
    throw AnalysisError(fmt::format("step '{}': no modes are at hand; put a *FREQUENCY step before it, and run both in one go: checkpoints keep no modes",
                                    step.name));
  if (const Step* const between = moving_step(analysis); between != nullptr)
    throw AnalysisError(fmt::format("step '{}': the modes at hand are those of step '{}', since which step '{}' has moved the state; repeat *FREQUENCY just before it",
                                    step.name, analysis.model.steps[analysis.step_of_modes].name, between->name));
  for (auto& mode : modes) {
    const double size = std::sqrt(mode.generalized_mass);
    for (auto* shape : {&mode.displacement, &mode.rotation, &mode.slots})
      for (double& value : *shape) value /= size;
  }
  return modes;
}

Eigen::VectorXd modal_damping(const std::vector<ModalDamping>& given, const std::vector<Mode>& modes) {
  return by_mode(given, modes, [](const ModalDamping& damping, const Mode& mode) {
    const double square = std::max(mode.eigenvalue, 0.0);
    return 2.0 * damping.fraction * std::sqrt(square) + damping.alpha + damping.beta * square;
  });
}

Eigen::VectorXd structural_damping(const std::vector<ModalDamping>& given, const std::vector<Mode>& modes) {
  return by_mode(given, modes, [](const ModalDamping& damping, const Mode&) { return damping.structural; });
}

void show_superposition(Analysis& analysis, const std::vector<Mode>& modes, const Eigen::VectorXd& amplitude, const Eigen::VectorXd& velocity) {
  auto& state = analysis.current;
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(3 * node + i);
      const double reference = analysis.model.nodes.coordinates[analysis.domain.node_row[node]][i];
      state.position[4 * node + i] = reference + combined(modes, &Mode::displacement, amplitude, at);
      state.velocity[4 * node + i] = combined(modes, &Mode::displacement, velocity, at);
      if (node >= analysis.domain.turning) continue;
      state.rotation[4 * node + i] = combined(modes, &Mode::rotation, amplitude, at);
      state.angular_velocity[4 * node + i] = combined(modes, &Mode::rotation, velocity, at);
    }
  for (std::int32_t node = 0; node < analysis.domain.turning; ++node) {
    const double* const turn = &state.rotation[4 * node];
    std::ranges::copy(exponential(Vector3<double>{{turn[0], turn[1], turn[2]}}), &state.orientation[4 * node]);
  }
  show_bodies(analysis, modes, amplitude, velocity);
}

}  // namespace balocco
