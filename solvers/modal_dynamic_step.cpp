// A modal dynamic step: the response to the step's loads as a sum of the modes that the last frequency step found. Between two
// increments loads go on straight lines, for which the modes' equations are solved exactly: dashpots couple them.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "math/rotation.hpp"
#include "model/diagnostics.hpp"
#include "procedures.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

constexpr double free_growth = 1.5;  // of increments that are not fixed

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

class ModalDynamicStep {
 public:
  ModalDynamicStep(Analysis& analysis, const Step& step, Observer& observer);

  Outcome run();

 private:
  Matrix dashpots() const;
  Matrix damping() const;
  double load_change(double from, double to) const;
  double next_increment(double last) const;
  void make_propagator(double increment);
  Vector forces(double step_time, double total_time) const;
  void show();

  Analysis& analysis_;
  const Step& step_;
  const ModalDynamicProcedure& procedure_;
  Observer& observer_;
  std::vector<Mode> modes_;  // of generalised mass 1
  Vector amplitude_, velocity_;
  std::vector<double> time_points_;
  Matrix propagator_;  // of amplitudes, velocities, forces and the forces' rates over an increment
};

ModalDynamicStep::ModalDynamicStep(Analysis& analysis, const Step& step, Observer& observer)
    : analysis_(analysis),
      step_(step),
      procedure_(std::get<ModalDynamicProcedure>(step.procedure)),
      observer_(observer),
      modes_(analysis.modes) {
  if (modes_.empty())
    throw AnalysisError(fmt::format("step '{}': no modes are at hand; put a *FREQUENCY step before it, and run both in one go: checkpoints keep no modes",
                                    step.name));
  for (auto& mode : modes_) {
    const double size = std::sqrt(mode.generalized_mass);
    for (auto* shape : {&mode.displacement, &mode.rotation})
      for (double& value : *shape) value /= size;
  }
  amplitude_ = velocity_ = Vector::Zero(static_cast<Eigen::Index>(modes_.size()));
  time_points_ = asked_times(step);
}

/// What elements without mass resist velocities with, as the modes feel it: the part of their stiffness that grows with velocity_slope.
Matrix ModalDynamicStep::dashpots() const {
  const auto count = static_cast<Eigen::Index>(modes_.size());
  Matrix sum = Matrix::Zero(count, count);
  const std::vector<double> still(4 * (static_cast<std::size_t>(analysis_.domain.size()) + 1), 0.0);
  NodalMotion motion = analysis_.current.motion();
  motion.velocity = motion.angular_velocity = still.data();
  for (std::size_t index = 0; index < analysis_.element_groups.size(); ++index) {
    const auto& group = *analysis_.element_groups[index];
    const auto kind = analysis_.model.sections[group.section()].kind;
    if (kind != Section::Kind::dashpot && kind != Section::Kind::connector) continue;
    const auto freedoms = static_cast<std::size_t>(group.freedoms_per_node()), size = freedoms * group.nodes_per_element();
    std::vector<double> history(group.history_size()), unused(group.history_size()), force(size);
    Matrix with(size, size), without(size, size), shapes(size, count);
    for (std::int32_t element = 0; element < group.size(); ++element) {
      if (!analysis_.takes_part(group, element)) continue;
      group.gather_history(element, analysis_.current.element_history[index], history);
      for (const auto& [slope, block] : {std::pair{1.0, &with}, std::pair{1e-300, &without}}) {
        motion.velocity_slope = slope;
        group.linearize(element, motion, history, unused, force, std::span(block->data(), size * size));
      }
      for (std::size_t row = 0; row < size; ++row)
        for (Eigen::Index mode = 0; mode < count; ++mode) {
          const auto& shape = row % freedoms < 3 ? modes_[mode].displacement : modes_[mode].rotation;
          shapes(row, mode) = shape[3 * group.nodes(element)[row / freedoms] + row % freedoms % 3];
        }
      sum += shapes.transpose() * (with - without) * shapes;
    }
  }
  analysis_.communicator.sum(std::span<double>(sum.data(), static_cast<std::size_t>(sum.size())));
  return sum;
}

Matrix ModalDynamicStep::damping() const {
  Matrix sum = dashpots();
  for (const auto& given : procedure_.damping)
    for (std::int32_t number = given.first; number <= std::min<std::int32_t>(given.last, static_cast<std::int32_t>(modes_.size())); ++number) {
      const double square = std::max(modes_[number - 1].eigenvalue, 0.0);
      sum(number - 1, number - 1) += 2.0 * given.fraction * std::sqrt(square) + given.alpha + given.beta * square;
    }
  return sum;
}

/// The greatest change of a load of the step between two of its times.
double ModalDynamicStep::load_change(double from, double to) const {
  const double total_start = analysis_.current.total_time - analysis_.current.step_time;
  double greatest = 0.0;
  const auto look = [&](const auto& loads) {
    for (const auto& load : loads) {
      const auto at = [&](double time) {
        return load_magnitude(analysis_.model, step_, load.previous, load.magnitude, load.amplitude, time, total_start + time);
      };
      greatest = std::max(greatest, std::abs(at(to) - at(from)));
    }
  };
  look(step_.concentrated_loads);
  look(step_.pressures);
  look(step_.body_loads);
  return greatest;
}

/// The increment to try: of fixed length or half as long again as the last one, less where a load would change too much; up to the
/// next time point or the end where what is left beyond would not be worth an increment.
double ModalDynamicStep::next_increment(double last) const {
  const double now = analysis_.current.step_time, resolution = 1e-9 * procedure_.duration;
  double increment = procedure_.increment;
  if (procedure_.largest_load_change) {
    if (last > 0.0) increment = free_growth * last;
    if (const double change = load_change(now, std::min(now + increment, procedure_.duration));
        change > *procedure_.largest_load_change)
      increment *= *procedure_.largest_load_change / change;
    const auto mark = std::ranges::find_if(time_points_, [&](double time) { return time > now + resolution; });
    if (mark != time_points_.end() && now + increment > *mark - resolution) increment = *mark - now;
  }
  const double rest = procedure_.duration - now;
  return rest < (1.0 + 1e-6) * increment ? rest : increment;
}

/// Exponential of the first-order system: amplitudes q, their velocities, forces f and the rates of these, which are constant.
void ModalDynamicStep::make_propagator(double increment) {
  const auto n = static_cast<Eigen::Index>(modes_.size());
  Matrix system = Matrix::Zero(4 * n, 4 * n);
  system.block(0, n, n, n).setIdentity();
  for (Eigen::Index mode = 0; mode < n; ++mode) system(n + mode, mode) = -modes_[mode].eigenvalue;
  system.block(n, n, n, n) = -damping();
  system.block(n, 2 * n, n, n).setIdentity();
  system.block(2 * n, 3 * n, n, n).setIdentity();
  propagator_ = (increment * system).exp();
}

/// Loads of an instant, as the modes feel them where the state stands. Collective.
Vector ModalDynamicStep::forces(double step_time, double total_time) const {
  const auto& domain = analysis_.domain;
  std::vector<double> force(4 * (static_cast<std::size_t>(domain.size()) + 1), 0.0), moment(4 * static_cast<std::size_t>(domain.turning), 0.0);
  std::vector<Point> of_bodies(analysis_.model.rigid_bodies.size());
  add_external_forces(analysis_, step_, step_time, total_time, analysis_.current.position.data(), {force.data(), moment.data()}, of_bodies);
  Vector sum = Vector::Zero(static_cast<Eigen::Index>(modes_.size()));
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
    const auto& [displacement, rotation] = std::tie(modes_[mode].displacement, modes_[mode].rotation);
    for (std::int32_t node = 0; node < domain.size(); ++node)
      for (int i = 0; i < 3; ++i) {
        sum[mode] += displacement[3 * node + i] * force[4 * node + i];
        if (node < domain.turning) sum[mode] += rotation[3 * node + i] * moment[4 * node + i];
        const auto body = analysis_.reference_of(node);
        if (body >= 0 && domain.owned[node]) sum[mode] += rotation[3 * node + i] * of_bodies[body][i];
      }
  }
  analysis_.communicator.sum(std::span<double>(sum.data(), static_cast<std::size_t>(sum.size())));
  return sum;
}

/// The response alone, about the reference configuration, for whoever writes results.
void ModalDynamicStep::show() {
  auto& state = analysis_.current;
  const auto combined = [&](auto shape, const Vector& factors, std::size_t at) {
    double sum = 0.0;
    for (std::size_t mode = 0; mode < modes_.size(); ++mode) sum += factors[mode] * (modes_[mode].*shape)[at];
    return sum;
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node)
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(3 * node + i);
      const double reference = analysis_.model.nodes.coordinates[analysis_.domain.node_row[node]][i];
      state.position[4 * node + i] = reference + combined(&Mode::displacement, amplitude_, at);
      state.velocity[4 * node + i] = combined(&Mode::displacement, velocity_, at);
      if (node >= analysis_.domain.turning) continue;
      state.rotation[4 * node + i] = combined(&Mode::rotation, amplitude_, at);
      state.angular_velocity[4 * node + i] = combined(&Mode::rotation, velocity_, at);
    }
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node) {
    const double* const turn = &state.rotation[4 * node];
    std::ranges::copy(exponential(Vector3<double>{{turn[0], turn[1], turn[2]}}), &state.orientation[4 * node]);
  }
}

Outcome ModalDynamicStep::run() {
  auto& state = analysis_.current;
  const State kept = state;
  observer_.log(fmt::format("step {} '{}': modal dynamics, {} modes", state.step + 1, step_.name, modes_.size()));
  const double total_start = state.total_time;
  Vector before = forces(0.0, total_start);
  double last = 0.0;
  // What is written is the response alone: the loads act where the state stands, and are found before that is shown.
  bool go_on = true;
  for (bool ends = false; !ends && go_on;) {
    const State shown = state;
    if (shown.increment >= procedure_.maximum_increments)
      throw AnalysisError(fmt::format("step '{}': all {} increments are used up; allow more with *STEP, INC=", step_.name, procedure_.maximum_increments));
    const double increment = next_increment(last);
    ends = increment == procedure_.duration - shown.step_time;
    if (std::abs(increment - last) > 1e-9 * increment) make_propagator(increment);
    last = increment;
    const double step_time = ends ? procedure_.duration : shown.step_time + increment;
    state = kept;
    const Vector after = forces(step_time, total_start + step_time);
    const auto n = amplitude_.size();
    Vector system(4 * n);
    system << amplitude_, velocity_, before, (after - before) / increment;
    system = propagator_ * system;
    amplitude_ = system.head(n);
    velocity_ = system.segment(n, n);
    before = after;
    state.linear = state.dynamic = true;
    state.increment = shown.increment + 1;
    state.step_time = step_time;
    state.total_time = total_start + step_time;
    show();
    go_on = observer_.advanced(analysis_, {.increment = state.increment,
                                           .step_time = step_time,
                                           .total_time = state.total_time,
                                           .time_increment = increment,
                                           .step_finished = ends});
  }
  const auto [increment, step_time, total_time] = std::tuple(state.increment, state.step_time, state.total_time);
  state = kept;
  state.increment = increment;
  state.step_time = step_time;
  state.total_time = total_time;
  return go_on ? Outcome::finished : Outcome::stopped;
}

}  // namespace

Outcome run_modal_dynamic_step(Analysis& analysis, const Step& step, Observer& observer) {
  if (analysis.current.increment == 0) analysis.start_step(step);
  observer.step_started(analysis, analysis.current.step);
  return ModalDynamicStep(analysis, step, observer).run();
}

namespace {
const RegisterProcedure<ModalDynamicProcedure> modal_dynamic_procedure(run_modal_dynamic_step);
}  // namespace

}  // namespace balocco
