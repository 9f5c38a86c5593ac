// A frequency step: natural modes of the structure about its present state, which it leaves as it is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "eigenmodes.hpp"
#include "implicit_mass.hpp"
#include "implicit_prescribed.hpp"
#include "implicit_system.hpp"
#include "model/diagnostics.hpp"
#include "procedures.hpp"

namespace balocco {

namespace {

constexpr double square(double value) { return value * value; }

class FrequencyStep {
 public:
  FrequencyStep(Analysis& analysis, const Step& step, Observer& observer)
      : analysis_(analysis),
        step_(step),
        procedure_(std::get<FrequencyProcedure>(step.procedure)),
        observer_(observer),
        system_(analysis, step, slots_of(prescribed_motions(analysis, step))),
        mass_(system_.map(), analysis.communicator) {}

  void run();

 private:
  void assemble();
  void symmetrize();
  [[noreturn]] void refuse_stillness() const;
  EigenRange range(Eigenmodes& modes) const;
  Mode mode_of(const EigenPair& pair, std::int32_t number);
  void normalize(Mode& mode) const;
  void find_participation(Mode& mode, std::span<const double> equations);
  void log_table(const std::vector<Mode>& modes);
  void log_stability(const std::vector<Mode>& modes, int negative, double least);
  std::string largest_motion(const Mode& mode) const;

  Analysis& analysis_;
  const Step& step_;
  const FrequencyProcedure& procedure_;
  Observer& observer_;
  ImplicitSystem system_;
  ImplicitStiffness mass_;
};

/// Stiffness and mass where the state stands, under the loads that the last general step left; linear steps: those of the
/// reference configuration.
void FrequencyStep::assemble() {
  const std::vector<double> still(system_.map().slots(), 0.0);
  const auto& state = analysis_.current;
  const bool sound = system_.assemble({.step_time = 0.0,
                                       .total_time = state.total_time,
                                       .initial_loads = true,
                                       .load_stiffness = !state.linear,
                                       .arms_turn = !state.linear,
                                       .contact_sticks = true,
                                       .motion = still});
  if (!sound) throw AnalysisError(fmt::format("step '{}' cannot start: {}", step_.name, system_.trouble()));
  assemble_mass(analysis_, system_.map(), mass_);
  symmetrize();
}

/// Follower loads may leave a tangent without symmetry, and friction on a body that turns; modes are those of its symmetric part.
void FrequencyStep::symmetrize() {
  Mat stiffness = system_.stiffness().matrix();
  PetscMatrix transposed;
  petsc(MatTranspose(stiffness, MAT_INITIAL_MATRIX, transposed.address()));
  double whole = 0.0, skew = 0.0;
  petsc(MatNorm(stiffness, NORM_FROBENIUS, &whole));
  petsc(MatAXPY(transposed, -1.0, stiffness, DIFFERENT_NONZERO_PATTERN));
  petsc(MatNorm(transposed, NORM_FROBENIUS, &skew));
  petsc(MatAXPY(stiffness, 0.5, transposed, DIFFERENT_NONZERO_PATTERN));
  petsc(MatSetOption(stiffness, MAT_SYMMETRIC, PETSC_TRUE));
  if (skew > 1e-10 * whole)
    observer_.log(fmt::format("  warning: the stiffness is not symmetric (a load that follows, or friction on a body that turns): modes of its "
                              "symmetric part, {:.1e} of it left out",
                              skew / whole));
}

void FrequencyStep::refuse_stillness() const {
  throw AnalysisError(
      fmt::format("step '{}': every freedom of the model is held, by *BOUNDARY{}: nothing can vibrate; free what shall vibrate", step_.name,
                  system_.map().multipliers() > 0 ? ", equations, ties or connectors" : ""));
}

EigenRange FrequencyStep::range(Eigenmodes& modes) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto eigenvalue = [](double frequency) { return square(2.0 * std::numbers::pi * frequency); };
  EigenRange range;
  range.lowest = procedure_.lower && *procedure_.lower > 0.0 ? eigenvalue(*procedure_.lower) : -infinite;
  range.highest = procedure_.upper ? eigenvalue(*procedure_.upper) : infinite;
  range.shift = range.lowest > 0.0 ? range.lowest : modes.small_shift();
  if (procedure_.shift != 0.0) range.shift = square(2.0 * std::numbers::pi) * procedure_.shift;
  range.number = procedure_.number.value_or(std::numeric_limits<int>::max());
  if (procedure_.upper) {
    const int there = modes.count_below(range.highest) - (range.lowest > 0.0 ? modes.count_below(range.lowest) : 0);
    range.number = std::min(range.number, there);
  }
  return range;
}

/// Largest displacement 1 (rotation, where nothing is displaced), or generalised mass 1; the largest component is positive.
void FrequencyStep::normalize(Mode& mode) const {
  const auto largest_of = [&](const std::vector<double>& values) {
    std::array<double, 2> largest{};  // positive, negative
    for (const double value : values) {
      largest[0] = std::max(largest[0], value);
      largest[1] = std::max(largest[1], -value);
    }
    analysis_.communicator.maximum(std::span<double>(largest));
    // Of two that are equal but for rounding the positive one counts, on any number of ranks.
    return largest[1] > (1.0 + 1e-6) * largest[0] ? -largest[1] : largest[0];
  };
  double size = largest_of(mode.displacement);
  const double turn = largest_of(mode.rotation);
  if (std::abs(size) < 1e-10 * system_.model_size() * std::abs(turn)) size = turn;
  if (procedure_.normalization == FrequencyProcedure::Normalization::mass)
    size = std::copysign(std::sqrt(mode.generalized_mass), size);
  for (auto* shape : {&mode.displacement, &mode.rotation, &mode.slots})
    for (double& value : *shape) value /= size;
  mode.generalized_mass /= square(size);
  for (double& value : mode.participation) value *= size;
}

void FrequencyStep::find_participation(Mode& mode, std::span<const double> equations) {
  const auto& map = system_.map();
  PetscVector shape, momentum;
  petsc(MatCreateVecs(mass_.matrix(), shape.address(), momentum.address()));
  const auto copy = [&](std::span<const double> values) {
    double* array = nullptr;
    petsc(VecGetArray(shape, &array));
    std::ranges::copy(values, array);
    petsc(VecRestoreArray(shape, &array));
  };
  copy(equations);
  petsc(MatMult(mass_.matrix(), shape, momentum));
  petsc(VecDot(shape, momentum, &mode.generalized_mass));
  std::vector<double> motion(equations.size());
  for (int direction = 0; direction < 6; ++direction) {
    for (std::size_t i = 0; i < motion.size(); ++i)
      motion[i] = rigid_motion(analysis_, map, map.owned_free_slots()[i], direction);
    copy(motion);
    double product = 0.0;
    petsc(VecDot(shape, momentum, &product));
    mode.participation[direction] = product / mode.generalized_mass;
    mode.effective_mass[direction] = square(product) / mode.generalized_mass;
  }
}

Mode FrequencyStep::mode_of(const EigenPair& pair, std::int32_t number) {
  const auto& map = system_.map();
  Mode mode{.number = number, .eigenvalue = pair.value};
  mode.frequency = pair.value > 0.0 ? std::sqrt(pair.value) / (2.0 * std::numbers::pi) : 0.0;
  find_participation(mode, pair.vector);
  auto& slots = mode.slots;
  slots.assign(map.slots(), 0.0);
  system_.exchange().from_equations(pair.vector, slots);
  mode.displacement.assign(3 * analysis_.domain.size(), 0.0);
  mode.rotation.assign(3 * analysis_.domain.size(), 0.0);
  const auto add = [&](const NodeMotion& motion, double* sum) {
    for (int k = 0; k < motion.count; ++k)
      for (int i = 0; i < 3; ++i) sum[i] += motion.direction[k][i] * slots[motion.slots[k]];
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    add(map.motion(node), &mode.displacement[3 * node]);
    if (node < analysis_.domain.turning)
      add(map.nodal_spin(node), &mode.rotation[3 * node]);
    else if (const auto body = analysis_.reference_of(node); body >= 0)
      add(map.spin(body), &mode.rotation[3 * node]);
  }
  normalize(mode);
  return mode;
}

std::string FrequencyStep::largest_motion(const Mode& mode) const {
  Communicator::Located largest{0.0, -1};
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    const double* u = &mode.displacement[3 * node];
    const double size = std::hypot(u[0], u[1], u[2]);
    if (analysis_.domain.owned[node] && -size < largest.value)
      largest = {-size, analysis_.model.nodes.id[analysis_.domain.node_row[node]]};
  }
  return fmt::format("node {}", analysis_.communicator.minimum(largest).payload);
}

void FrequencyStep::log_table(const std::vector<Mode>& modes) {
  observer_.log(fmt::format("{:>6} {:>14} {:>14} {:>14} {:>14}", "MODE", "EIGENVALUE", "RAD/TIME", "CYCLES/TIME",
                            "GENERAL. MASS"));
  for (const auto& mode : modes)
    observer_.log(fmt::format("{:>6} {:>14.7g} {:>14.7g} {:>14.7g} {:>14.7g}", mode.number, mode.eigenvalue,
                              2.0 * std::numbers::pi * mode.frequency, mode.frequency, mode.generalized_mass));
  for (const auto& [title, values] : {std::pair{"PARTICIPATION", &Mode::participation}, std::pair{"EFFECTIVE MASS", &Mode::effective_mass}}) {
    observer_.log(fmt::format("{:>6} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12}   {}", "MODE", "X", "Y", "Z", "ABOUT X", "ABOUT Y",
                              "ABOUT Z", title));
    std::array<double, 6> sums{};
    for (const auto& mode : modes) {
      std::string line = fmt::format("{:>6}", mode.number);
      for (int i = 0; i < 6; ++i) line += fmt::format(" {:>12.5g}", (mode.*values)[i]);
      observer_.log(line);
      for (int i = 0; i < 6; ++i) sums[i] += (mode.*values)[i];
    }
    if (values != &Mode::effective_mass) continue;
    std::string line = "   ALL";
    for (const double sum : sums) line += fmt::format(" {:>12.5g}", sum);
    observer_.log(line);
  }
}

/// `negative`: how many eigenvalues are, listed among the modes or not.
void FrequencyStep::log_stability(const std::vector<Mode>& modes, int negative, double least) {
  const auto listed = std::ranges::count_if(modes, [](const Mode& mode) { return mode.eigenvalue < 0.0; });
  if (negative == 0) {
    observer_.log(fmt::format("  the state is stable: no eigenvalue lies below {:.3g}", least));
  } else {
    observer_.log(fmt::format(
        "  warning: the state is unstable: {} of its eigenvalues {} negative{}", negative, negative == 1 ? "is" : "are",
        listed > 0 ? fmt::format("; mode 1 grows by a factor e in a time of {:.4g}, most at {}",
                                 1.0 / std::sqrt(-modes.front().eigenvalue), largest_motion(modes.front()))
                   : ""));
  }
}

void FrequencyStep::run() {
  const double begin = MPI_Wtime();
  const auto here = system_.configuration();
  if (analysis_.current.linear) system_.restore(system_.reference());
  observer_.log(fmt::format("step {} '{}': frequency, about {}, {} equations", analysis_.current.step + 1, step_.name,
                            analysis_.current.linear ? "the reference configuration" : "the present state",
                            system_.map().equations()));
  if (system_.map().equations() == 0) refuse_stillness();
  assemble();
  Eigenmodes solver(system_.stiffness().matrix(), mass_.matrix(), system_.map().multipliers(), analysis_.communicator);
  // Constraints may hold all that boundary conditions leave; stops that are open count among them but hold nothing.
  if (system_.map().equations() <= 2 * system_.map().multipliers() && solver.count_below(solver.great_shift()) <= 0) refuse_stillness();
  const auto wanted = range(solver);
  const int negative = solver.count_below(solver.small_shift());
  std::vector<Mode> modes;
  if (wanted.number > 0)
    for (const auto& pair : solver.find(wanted)) modes.push_back(mode_of(pair, static_cast<std::int32_t>(modes.size()) + 1));
  system_.restore(here);
  for (const auto& mode : modes) observer_.mode_found(mode);
  analysis_.modes = modes;
  analysis_.step_of_modes = analysis_.current.step;
  log_table(modes);
  log_stability(modes, negative, solver.small_shift());
  observer_.log(fmt::format("  {:.2f} s", MPI_Wtime() - begin));
}

}  // namespace

Outcome run_frequency_step(Analysis& analysis, const Step& step, Observer& observer) {
  auto& state = analysis.current;
  if (state.increment == 0) analysis.start_step(step);
  observer.step_started(analysis, state.step);
  FrequencyStep(analysis, step, observer).run();
  state.increment = 1;
  const bool go_on = observer.advanced(analysis, {.increment = 1,
                                                  .step_time = state.step_time,
                                                  .total_time = state.total_time,
                                                  .iterations = 1,
                                                  .step_finished = true});
  return go_on ? Outcome::finished : Outcome::stopped;
}

namespace {
const RegisterProcedure<FrequencyProcedure> frequency_procedure(run_frequency_step);
}  // namespace

}  // namespace balocco
