// A modal dynamic step: the response to the step's loads as a sum of the modes that the last frequency step found. Between two
// increments loads go on straight lines, for which the modes' equations are solved exactly: dashpots couple them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <unsupported/Eigen/MatrixFunctions>

#include "constraints/rigid_body.hpp"
#include "kept_state.hpp"
#include "math/rotation.hpp"
#include "modal_forces.hpp"
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
  void add_modal_damping();
  double load_change(double from, double to) const;
  double next_increment(double last) const;
  void make_propagator(double increment);
  void advance(double increment, const Vector& before, const Vector& after);
  void show(const State& kept, const Vector& loads);
  void show_bodies();

  Analysis& analysis_;
  const Step& step_;
  const ModalDynamicProcedure& procedure_;
  Observer& observer_;
  std::vector<Mode> modes_;  // of generalised mass 1
  std::unique_ptr<ModalForces> forces_;
  Matrix damping_;
  Vector stiffness_;  // eigenvalues
  Vector amplitude_, velocity_;
  double work_ = 0.0, dissipated_ = 0.0;  // of the loads, in damping
  std::vector<double> time_points_;
  Matrix propagator_;  // of amplitudes' integrals, amplitudes, velocities, forces and the forces' rates over an increment
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
    for (auto* shape : {&mode.displacement, &mode.rotation, &mode.slots})
      for (double& value : *shape) value /= size;
  }
  amplitude_ = velocity_ = stiffness_ = Vector::Zero(static_cast<Eigen::Index>(modes_.size()));
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) stiffness_[static_cast<Eigen::Index>(mode)] = modes_[mode].eigenvalue;
  forces_ = std::make_unique<ModalForces>(analysis, modes_);
  damping_ = forces_->damping();
  add_modal_damping();
  time_points_ = asked_times(step);
}

void ModalDynamicStep::add_modal_damping() {
  for (const auto& given : procedure_.damping)
    for (std::int32_t number = given.first; number <= std::min<std::int32_t>(given.last, static_cast<std::int32_t>(modes_.size())); ++number) {
      const double square = std::max(modes_[number - 1].eigenvalue, 0.0);
      damping_(number - 1, number - 1) += 2.0 * given.fraction * std::sqrt(square) + given.alpha + given.beta * square;
    }
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
  look(step_.surface_loads);
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

/// Exponential of the first-order system: integrals of the amplitudes q, these, their velocities, forces f and the rates of these,
/// which are constant. Scaled to unit times, and velocities of faster modes by their frequencies: in the deck's units their sizes are so far
/// apart that the exponential would lose half of its digits.
void ModalDynamicStep::make_propagator(double increment) {
  const auto n = static_cast<Eigen::Index>(modes_.size());
  Matrix system = Matrix::Zero(5 * n, 5 * n);
  system.block(0, n, n, n).setIdentity();
  system.block(n, 2 * n, n, n).setIdentity();
  system.block(2 * n, n, n, n) = -stiffness_.asDiagonal().toDenseMatrix();
  system.block(2 * n, 2 * n, n, n) = -damping_;
  system.block(2 * n, 3 * n, n, n).setIdentity();
  system.block(3 * n, 4 * n, n, n).setIdentity();
  Vector scale(5 * n);
  scale << Vector::Constant(n, 1.0 / increment), Vector::Ones(n), stiffness_.cwiseAbs().cwiseSqrt().cwiseMax(1.0 / increment).cwiseInverse(),
      Vector::Constant(n, increment * increment), Vector::Constant(n, increment * increment * increment);
  const Vector back = scale.cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * (increment * system) * back.asDiagonal();
  propagator_ = back.asDiagonal() * scaled.exp() * scale.asDiagonal();
}

/// Over an increment in which forces go from `before` to `after`. The solution is exact, and so are the work of the forces, their
/// product with the velocities integrated by parts, and what of it the modes do not keep.
void ModalDynamicStep::advance(double increment, const Vector& before, const Vector& after) {
  const auto n = amplitude_.size();
  const auto energy = [&] { return 0.5 * (velocity_.squaredNorm() + amplitude_.dot(stiffness_.cwiseProduct(amplitude_))); };
  const double energy_before = energy(), work_before = before.dot(amplitude_);
  const Vector rate = (after - before) / increment;
  Vector system(5 * n);
  system << Vector::Zero(n), amplitude_, velocity_, before, rate;
  system = propagator_ * system;
  amplitude_ = system.segment(n, n);
  velocity_ = system.segment(2 * n, n);
  const double work = after.dot(amplitude_) - work_before - rate.dot(system.head(n));
  work_ += work;
  if (!damping_.isZero(0.0)) dissipated_ += work - (energy() - energy_before);
}

/// The response alone, about the reference configuration, for whoever writes results. What the modes know is of the whole
/// structure: one node of all stands for it.
void ModalDynamicStep::show(const State& kept, const Vector& loads) {
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
  show_bodies();
  forces_->show_multipliers(amplitude_);
  forces_->show(amplitude_, velocity_, loads - damping_ * velocity_ - stiffness_.cwiseProduct(amplitude_));
  analysis_.kinetic_energy = analysis_.communicator.rank() == 0 ? 0.5 * velocity_.squaredNorm() : 0.0;
  if (const auto node = analysis_.domain.local_node[0]; node >= 0) {
    state.nodal_work[node].external = kept.nodal_work[node].external + work_;
    state.nodal_work[node].damping = kept.nodal_work[node].damping + dissipated_;
  }
}

void ModalDynamicStep::show_bodies() {
  auto& bodies = analysis_.current.rigid_bodies;
  const auto at_rest = initial_rigid_bodies(analysis_.model);
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    const auto node = static_cast<std::size_t>(analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node]);
    auto& shown = bodies[body];
    Point turn{}, spin{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
        turn[i] += amplitude_[static_cast<Eigen::Index>(mode)] * modes_[mode].rotation[3 * node + i];
        spin[i] += velocity_[static_cast<Eigen::Index>(mode)] * modes_[mode].rotation[3 * node + i];
      }
    shown.orientation = at_rest[body].orientation;
    shown.rotation = {};
    rotate(shown, turn);
    shown.angular_velocity = spin;
    std::copy_n(&analysis_.current.position[4 * node], 3, shown.position.begin());
    std::copy_n(&analysis_.current.velocity[4 * node], 3, shown.velocity.begin());
  }
}

Outcome ModalDynamicStep::run() {
  auto& state = analysis_.current;
  KeptState keeper(analysis_);
  const State& kept = keeper.state();
  const double total_start = state.total_time;
  Vector before = forces_->loads(step_, 0.0, total_start);
  forces_->show(amplitude_, velocity_, before);
  observer_.step_started(analysis_, state.step);
  observer_.log(fmt::format("step {} '{}': modal dynamics, {} modes", state.step + 1, step_.name, modes_.size()));
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
    const Vector after = forces_->loads(step_, step_time, total_start + step_time);
    advance(increment, before, after);
    before = after;
    state.linear = state.dynamic = true;
    state.increment = shown.increment + 1;
    state.step_time = step_time;
    state.total_time = total_start + step_time;
    show(kept, after);
    go_on = observer_.advanced(analysis_, {.increment = state.increment,
                                           .step_time = step_time,
                                           .total_time = state.total_time,
                                           .time_increment = increment,
                                           .step_finished = ends});
  }
  keeper.restore();
  return go_on ? Outcome::finished : Outcome::stopped;
}

}  // namespace

Outcome run_modal_dynamic_step(Analysis& analysis, const Step& step, Observer& observer) {
  if (analysis.current.increment == 0) analysis.start_step(step);
  return ModalDynamicStep(analysis, step, observer).run();
}

namespace {
const RegisterProcedure<ModalDynamicProcedure> modal_dynamic_procedure(run_modal_dynamic_step);
}  // namespace

}  // namespace balocco
