// A modal dynamic step: the response to the step's loads as a sum of the modes that the last frequency step found. Between two
// increments loads go on straight lines, for which the modes' equations are solved exactly: dashpots couple them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <unsupported/Eigen/MatrixFunctions>

#include "kept_state.hpp"
#include "modal_forces.hpp"
#include "mode_superposition.hpp"
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
  double load_change(double from, double to) const;
  double next_increment(double last) const;
  void make_propagator(double increment);
  void advance(double increment, const Vector& before, const Vector& after);
  void show(const State& kept, const ModalLoads& loads);

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
      modes_(modes_of_unit_mass(analysis, step)) {
  amplitude_ = velocity_ = stiffness_ = Vector::Zero(static_cast<Eigen::Index>(modes_.size()));
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) stiffness_[static_cast<Eigen::Index>(mode)] = modes_[mode].eigenvalue;
  forces_ = std::make_unique<ModalForces>(analysis, modes_);
  damping_ = forces_->damping();
  damping_ += modal_damping(procedure_.damping, modes_).asDiagonal();
  time_points_ = asked_times(step);
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
void ModalDynamicStep::show(const State& kept, const ModalLoads& loads) {
  auto& state = analysis_.current;
  show_superposition(analysis_, modes_, amplitude_, velocity_);
  forces_->show_multipliers(amplitude_);
  forces_->show(amplitude_, velocity_, loads.on_modes - damping_ * velocity_ - stiffness_.cwiseProduct(amplitude_), loads.on_held);
  analysis_.kinetic_energy = analysis_.communicator.rank() == 0 ? 0.5 * velocity_.squaredNorm() : 0.0;
  if (const auto node = analysis_.domain.local_node[0]; node >= 0) {
    state.nodal_work[node].external = kept.nodal_work[node].external + work_;
    state.nodal_work[node].damping = kept.nodal_work[node].damping + dissipated_;
  }
}

Outcome ModalDynamicStep::run() {
  auto& state = analysis_.current;
  KeptState keeper(analysis_);
  const State& kept = keeper.state();
  const double total_start = state.total_time;
  ModalLoads before = forces_->loads(step_, 0.0, total_start);
  forces_->show(amplitude_, velocity_, before.on_modes, before.on_held);
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
    const ModalLoads after = forces_->loads(step_, step_time, total_start + step_time);
    advance(increment, before.on_modes, after.on_modes);
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
