#include "step_driver.hpp"

#include <algorithm>

#include "consistent_loads.hpp"
#include "loads/body_load.hpp"
#include "math/rotation.hpp"

namespace balocco {

double amplitude_factor(const Model& model, const Step& step, std::int32_t amplitude, double step_time, double total_time) {
  if (amplitude >= 0) {
    const auto& curve = model.amplitudes[amplitude];
    return curve.value(curve.total_time ? total_time : step_time);
  }
  return step.ramps_loads() && step.duration() > 0.0 ? step_time / step.duration() : 1.0;
}

bool has_arrived(const Model& model, const BoundaryCondition& condition) {
  const bool goes_on = condition.amplitude >= 0 && model.amplitudes[condition.amplitude].total_time;
  return condition.fixed || (condition.propagated && !goes_on);
}

double load_magnitude(const Model& model, const Step& step, double previous, double magnitude, std::int32_t amplitude,
                      double step_time, double total_time) {
  const double factor = amplitude_factor(model, step, amplitude, step_time, total_time);
  return amplitude >= 0 ? magnitude * factor : previous + (magnitude - previous) * factor;
}

Point concentrated_vector(const Analysis& analysis, const ConcentratedLoad& load, double magnitude) {
  const auto vector = magnitude * Vector3<double>{analysis.directions.direction(load.node, load.dof % 3)};
  const auto node = analysis.domain.local_node[load.node];
  if (!load.follower) return vector.component;
  const auto body = analysis.reference_of(node);
  const auto& state = analysis.current;
  const double* const q = body >= 0 ? state.rigid_bodies[body].orientation.data() : &state.orientation[4 * static_cast<std::size_t>(node)];
  return (rotation_matrix(Quaternion<double>{q[0], q[1], q[2], q[3]}) * vector).component;
}

bool is_left_out(const Analysis& analysis, const BodyLoad& load, std::int32_t node, CarriedGravity carried) {
  return carried == CarriedGravity::left_out && load.kind == BodyLoad::Kind::gravity &&
         (analysis.carrier(node) >= 0 || analysis.reference_of(node) >= 0);
}

namespace {

void add_rounded(double* force, const Point& addend) {
  for (int i = 0; i < 3; ++i) force[i] += rounded(addend[i], force[3]);
}

void add_concentrated_load(const Analysis& analysis, const ConcentratedLoad& load, double magnitude,
                           const NodalForces& forces, std::vector<Point>& moments) {
  const auto node = analysis.domain.local_node[load.node];
  if (node < 0) return;
  const auto vector = concentrated_vector(analysis, load, magnitude);
  const auto body = analysis.reference_of(node);
  if (load.dof >= 3 && body >= 0) {
    for (int i = 0; i < 3; ++i) moments[body][i] += vector[i];
  } else if (analysis.domain.owned[node]) {
    add_rounded((load.dof < 3 ? forces.force : forces.moment) + 4 * static_cast<std::ptrdiff_t>(node), vector);
  }
}

void add_body_load(const Analysis& analysis, const BodyLoad& load, double magnitude, const double* position, double* force,
                   CarriedGravity carried) {
  const auto& share = analysis.loaded_share(load);
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    if (share[node] != 0.0 && !is_left_out(analysis, load, node, carried)) {
      const auto addend = body_force(load, magnitude, share[node], position + 4 * node);
      add_rounded(force + 4 * node, {addend[0], addend[1], addend[2]});
    }
  if (load.kind == BodyLoad::Kind::centrifugal && loads_are_consistent(analysis))
    add_centrifugal_coupling(analysis, load, magnitude, position, force);
}

}  // namespace

std::vector<double> asked_times(const Step& step) {
  std::vector<double> times;
  const auto collect = [&](const auto& outputs) {
    for (const auto& output : outputs) times.insert(times.end(), output.time_points.begin(), output.time_points.end());
  };
  collect(step.field_outputs);
  collect(step.print_outputs);
  std::ranges::sort(times);
  return times;
}

void add_external_forces(const Analysis& analysis, const Step& step, double step_time, double total_time,
                         const double* position, const NodalForces& forces, std::vector<Point>& moments, CarriedGravity carried) {
  const auto magnitude_of = [&](const auto& load) {
    return load_magnitude(analysis.model, step, load.previous, load.magnitude, load.amplitude, step_time, total_time);
  };
  for (const auto& load : step.concentrated_loads) add_concentrated_load(analysis, load, magnitude_of(load), forces, moments);
  for (const auto& load : step.surface_loads)
    analysis.loading(load).add_forces(magnitude_of(load), position, forces.force);
  for (const auto& load : step.body_loads) add_body_load(analysis, load, magnitude_of(load), position, forces.force, carried);
}

}  // namespace balocco
