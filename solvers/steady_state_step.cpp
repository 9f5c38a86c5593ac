// A steady-state step: the complex response u exp(i omega t) to harmonic loads f exp(i omega t) and motions of the base, at one frequency
// after the other, as a sum of the modes that the last frequency step found. About a moving base the response is relative: the base's
// acceleration acts on all mass, and dampers to the ground are dampers to the base, as in Abaqus.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "excitation_frequencies.hpp"
#include "harmonic_results.hpp"
#include "kept_state.hpp"
#include "modal_forces.hpp"
#include "modal_harmonics.hpp"
#include "mode_superposition.hpp"
#include "model/diagnostics.hpp"
#include "procedures.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;
constexpr Complex imaginary_unit{0.0, 1.0};

/// A harmonic load or motion: forces on modes and on held freedoms.
struct HarmonicForces {
  ComplexVector on_modes, on_held;

  void add(const ModalLoads& loads, Complex factor) {
    on_modes += factor * loads.on_modes;
    on_held += factor * loads.on_held;
  }
};

/// The step with the real or the imaginary parts of its loads alone.
Step step_of_part(const Step& step, bool imaginary) {
  Step part = step;
  const auto keep = [&](auto& loads) { std::erase_if(loads, [&](const auto& load) { return load.imaginary != imaginary; }); };
  keep(part.concentrated_loads);
  keep(part.surface_loads);
  keep(part.body_loads);
  return part;
}

/// What strains are counted from: where the state stands, of linear states the reference configuration.
SmallStrainOutput::Base base_of(const Analysis& analysis) {
  const auto& state = analysis.current;
  SmallStrainOutput::Base base{state.position, state.orientation, state.rotation, state.linear};
  if (!state.linear) return base;
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    std::ranges::copy(analysis.model.nodes.coordinates[analysis.domain.node_row[node]], &base.position[4 * node]);
  for (std::size_t i = 0; i < base.orientation.size(); ++i) base.orientation[i] = i % 4 == 0 ? 1.0 : 0.0;
  std::ranges::fill(base.rotation, 0.0);
  return base;
}

class SteadyStateStep {
 public:
  SteadyStateStep(Analysis& analysis, const Step& step, Observer& observer);

  Outcome run();

 private:
  RigidBaseMotion rigid_motion_of(const BaseMotion& motion) const;
  void tell_missing_modes() const;
  void move_base(double frequency);
  HarmonicForces forces_at(double frequency);
  ComplexVector respond(double frequency, const HarmonicForces& forces) const;
  void show_part(double omega, const ComplexVector& amplitude, const HarmonicForces& forces, int part);
  double largest_displacement() const;
  bool tell(double frequency, std::int64_t increment, bool last);

  Analysis& analysis_;
  const Step& step_;
  const SteadyStateProcedure& procedure_;
  Observer& observer_;
  const std::vector<Mode> modes_;  // of generalised mass 1
  const Step real_, imaginary_;
  ModalForces forces_;
  ModalEquations equations_;
  std::vector<double> frequencies_;
  std::vector<RigidBaseMotion> base_;    // per motion of the procedure
  std::vector<ModalLoads> base_inertia_;  // likewise, of a unit acceleration
  KeptState keeper_;
  HarmonicResults results_;
};

SteadyStateStep::SteadyStateStep(Analysis& analysis, const Step& step, Observer& observer)
    : analysis_(analysis),
      step_(step),
      procedure_(std::get<SteadyStateProcedure>(step.procedure)),
      observer_(observer),
      modes_(modes_of_unit_mass(analysis, step)),
      real_(step_of_part(step, false)),
      imaginary_(step_of_part(step, true)),
      forces_(analysis, modes_),
      keeper_(analysis),
      results_(analysis, base_) {
  equations_.stiffness.resize(static_cast<Eigen::Index>(modes_.size()));
  std::vector<double> eigenfrequencies;
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
    equations_.stiffness[static_cast<Eigen::Index>(mode)] = modes_[mode].eigenvalue;
    eigenfrequencies.push_back(modes_[mode].frequency);
  }
  equations_.structural = structural_damping(procedure_.damping, modes_);
  equations_.damping = forces_.damping();
  equations_.damping += modal_damping(procedure_.damping, modes_).asDiagonal();
  frequencies_ = excitation_frequencies(procedure_, eigenfrequencies);
  for (const auto& motion : procedure_.base_motions) {
    base_.push_back(rigid_motion_of(motion));
    base_inertia_.push_back(forces_.inertia(base_.back().displacement, base_.back().rotation));
  }
}

/// *FREQUENCY may have stopped short of what the step asks for.
void SteadyStateStep::tell_missing_modes() const {
  const auto& search = std::get<FrequencyProcedure>(analysis_.model.steps[analysis_.step_of_modes].procedure);
  const double wanted = frequencies_.back(), highest = modes_.back().frequency;
  const bool all_asked = search.number && *search.number == static_cast<std::int32_t>(modes_.size());
  if (highest >= wanted || !(all_asked || (search.upper && *search.upper < wanted))) return;
  observer_.log(fmt::format("  warning: modes were sought up to {:.7g} cycles/time only, the response is asked for up to {:.7g}: it lacks those beyond, if there "
                            "are any; let *FREQUENCY find more",
                            all_asked ? highest : *search.upper, wanted));
}

/// A unit motion along the axis, or about it, of the model where its modes were found.
RigidBaseMotion SteadyStateStep::rigid_motion_of(const BaseMotion& motion) const {
  const auto nodes = static_cast<std::size_t>(analysis_.domain.size());
  RigidBaseMotion rigid{.displacement = std::vector<double>(3 * nodes, 0.0), .rotation = std::vector<double>(3 * nodes, 0.0)};
  const int axis = motion.dof % 3, next = (axis + 1) % 3, last = (axis + 2) % 3;
  for (std::size_t node = 0; node < nodes; ++node) {
    if (motion.dof < 3) {
      rigid.displacement[3 * node + axis] = 1.0;
      continue;
    }
    const double* const x = analysis_.current.linear ? analysis_.model.nodes.coordinates[analysis_.domain.node_row[node]].data()
                                                     : &analysis_.current.position[4 * node];
    rigid.rotation[3 * node + axis] = 1.0;
    rigid.displacement[3 * node + last] = x[next] - motion.centre[next];
    rigid.displacement[3 * node + next] = motion.centre[last] - x[last];
  }
  return rigid;
}

/// The base's displacement, velocity and acceleration at a frequency.
void SteadyStateStep::move_base(double frequency) {
  const Complex rate = imaginary_unit * (2.0 * std::numbers::pi * frequency);
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const auto& motion = procedure_.base_motions[i];
    auto& rigid = base_[i];
    const Complex said = motion.scale * amplitude_factor(analysis_.model, step_, motion.amplitude, frequency, frequency) *
                         (motion.imaginary ? imaginary_unit : Complex(1.0));
    using Kind = BoundaryCondition::Kind;
    rigid.value = motion.kind == Kind::displacement ? said : motion.kind == Kind::velocity ? said / rate : said / (rate * rate);
    rigid.velocity = rate * rigid.value;
    rigid.acceleration = rate * rigid.velocity;
  }
}

/// Loads where the state stands, whose amplitudes count frequencies, and what the base's acceleration does to the mass.
HarmonicForces SteadyStateStep::forces_at(double frequency) {
  const auto loads = forces_.loads(real_, frequency, frequency);
  HarmonicForces forces{loads.on_modes.cast<Complex>(), loads.on_held.cast<Complex>()};
  forces.add(forces_.loads(imaginary_, frequency, frequency), imaginary_unit);
  for (std::size_t i = 0; i < base_.size(); ++i) forces.add(base_inertia_[i], -base_[i].acceleration);
  return forces;
}

ComplexVector SteadyStateStep::respond(double frequency, const HarmonicForces& forces) const {
  const auto found = modal_harmonics(equations_, 2.0 * std::numbers::pi * frequency, forces.on_modes);
  if (found.unbounded < 0) return found.amplitude;
  const auto& mode = modes_[static_cast<std::size_t>(found.unbounded)];
  throw AnalysisError(fmt::format("step '{}': the response at {:.7g} cycles/time has no bound: mode {} of {:.7g} cycles/time is excited at its own "
                                  "frequency and not damped; give it *MODAL DAMPING, or name frequencies off it (INTERVAL=RANGE)",
                                  step_.name, frequency, mode.number, mode.frequency));
}

/// The real (0) or imaginary (1) part of the response alone, about the reference configuration.
void SteadyStateStep::show_part(double omega, const ComplexVector& amplitude, const HarmonicForces& forces, int part) {
  const auto of_part = [&](const ComplexVector& values) { return part == 0 ? Eigen::VectorXd(values.real()) : Eigen::VectorXd(values.imag()); };
  const Complex rate = imaginary_unit * omega;
  const auto displacement = of_part(amplitude), velocity = of_part(rate * amplitude);
  show_superposition(analysis_, modes_, displacement, velocity);
  forces_.show_multipliers(displacement);
  forces_.show(displacement, velocity, of_part(rate * rate * amplitude), of_part(forces.on_held));
  results_.take(part);
}

/// Greatest size of a component of the relative displacement over a cycle, of any node of any rank.
double SteadyStateStep::largest_displacement() const {
  std::vector<double> real(3 * static_cast<std::size_t>(analysis_.domain.size())), imaginary(real.size());
  const auto parts = results_.parts();
  parts[0].source->nodal("U", real);
  parts[1].source->nodal("U", imaginary);
  double largest = 0.0;
  for (std::size_t i = 0; i < real.size(); ++i) largest = std::max(largest, std::hypot(real[i], imaginary[i]));
  return analysis_.communicator.maximum(largest);
}

/// Finds the response at a frequency and shows it. @return false where the run is to stop.
bool SteadyStateStep::tell(double frequency, std::int64_t increment, bool last) {
  auto& state = analysis_.current;
  results_.put_away();
  state = keeper_.state();
  move_base(frequency);
  const auto forces = forces_at(frequency);
  const auto amplitude = respond(frequency, forces);
  state.linear = state.dynamic = true;
  state.increment = increment;
  for (const int part : {0, 1}) show_part(2.0 * std::numbers::pi * frequency, amplitude, forces, part);
  return observer_.advanced(results_, {.increment = increment,
                                       .step_time = state.step_time,
                                       .total_time = state.total_time,
                                       .frequency = frequency,
                                       .largest_displacement = largest_displacement(),
                                       .step_finished = last});
}

Outcome SteadyStateStep::run() {
  auto& state = analysis_.current;
  observer_.step_started(results_, state.step);
  observer_.log(fmt::format("step {} '{}': steady-state dynamics, {} modes, {} frequencies from {:.7g} to {:.7g} cycles/time", state.step + 1,
                            step_.name, modes_.size(), frequencies_.size(), frequencies_.front(), frequencies_.back()));
  tell_missing_modes();
  analysis_.small_strain().perturb(std::make_shared<SmallStrainOutput::Base>(base_of(analysis_)));
  bool go_on = true;
  for (std::size_t i = 0; i < frequencies_.size() && go_on; ++i)
    go_on = tell(frequencies_[i], static_cast<std::int64_t>(i) + 1, i + 1 == frequencies_.size());
  results_.put_away();
  analysis_.small_strain().perturb(nullptr);
  keeper_.restore();
  return go_on ? Outcome::finished : Outcome::stopped;
}

}  // namespace

Outcome run_steady_state_step(Analysis& analysis, const Step& step, Observer& observer) {
  if (analysis.current.increment == 0) analysis.start_step(step);
  return SteadyStateStep(analysis, step, observer).run();
}

namespace {
const RegisterProcedure<SteadyStateProcedure> steady_state_procedure(run_steady_state_step);
}  // namespace

}  // namespace balocco
