// A buckle step: load factors at which the structure, linearised about its undeformed shape, has a second equilibrium beside. Its stiffness
// under the step's loads times a factor is K + factor * G; G holds what the stresses of the linear response to these loads resist, without
// the change of shape before.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eigenmodes.hpp"
#include "elements/initial_stress_rows.hpp"
#include "implicit_linear_solver.hpp"
#include "implicit_prescribed.hpp"
#include "implicit_system.hpp"
#include "model/diagnostics.hpp"
#include "procedures.hpp"

namespace balocco {

namespace {

class BuckleStep {
 public:
  BuckleStep(Analysis& analysis, const Step& step, Observer& observer)
      : analysis_(analysis), step_(step), observer_(observer), system_(analysis, step, slots_of(prescribed_motions(analysis, step))) {}

  void run();

 private:
  void assemble(bool with_loads);
  std::vector<double> response();
  void add_stresses(std::span<const double> response);
  Mode mode_of(const EigenPair& pair, std::int32_t number);

  Analysis& analysis_;
  const Step& step_;
  Observer& observer_;
  ImplicitSystem system_;
};

void BuckleStep::assemble(bool with_loads) {
  const bool sound = system_.assemble(
      {.total_time = analysis_.current.total_time, .initial_loads = !with_loads, .load_stiffness = false, .contact_sticks = true, .motion = {}});
  if (!sound) throw AnalysisError(fmt::format("step '{}' cannot start: {}", step_.name, system_.trouble()));
}

/// Motion of the slots that the step's loads cause, to first order. Leaves the stiffness without loads.
std::vector<double> BuckleStep::response() {
  const auto& map = system_.map();
  assemble(true);
  std::vector<double> right_hand_side, solution(map.owned_free_slots().size());
  for (const auto slot : map.owned_free_slots()) right_hand_side.push_back(-system_.residual()[slot]);
  assemble(false);
  for (std::size_t i = 0; i < right_hand_side.size(); ++i) right_hand_side[i] += system_.residual()[map.owned_free_slots()[i]];
  ImplicitLinearSolver solver(system_.stiffness(), analysis_, map);
  if (!solver.solve(right_hand_side, solution) || !solver.mechanism().empty())
    throw AnalysisError(fmt::format("step '{}': nothing resists a motion of {}; hold it with *BOUNDARY", step_.name, solver.mechanism()));
  std::vector<double> slots(static_cast<std::size_t>(map.slots()), 0.0);
  system_.exchange().from_equations(solution, slots);
  return slots;
}

/// Makes the stresses under the response, with those that the elements had before, the ones of the reference configuration ("S0").
void BuckleStep::add_stresses(std::span<const double> response) {
  auto& state = analysis_.current;
  const auto here = system_.configuration();
  system_.displace(response);
  auto histories = state.element_history;
  for (std::size_t index = 0; index < analysis_.element_groups.size(); ++index) {
    const auto& group = *analysis_.element_groups[index];
    std::vector<double> stress(static_cast<std::size_t>(group.output_components("S")));
    const auto components = initial_stress_components(analysis_.model, group);
    for (int point = 0; point < group.integration_points(); ++point) {
      const int row = group.law_field_row("S0", point);
      if (row < 0) continue;
      for (std::int32_t element = 0; element < group.size(); ++element) {
        analysis_.element(index, "S", element, point, stress);
        for (std::size_t k = 0; k < components.size(); ++k)
          histories[index][(static_cast<std::size_t>(row) + k) * group.padded_size() + element] = stress[components[k]];
      }
    }
    repeat_in_padded_lanes(group, histories[index]);
  }
  state.element_history = std::move(histories);
  system_.restore(here);
}

/// Largest displacement 1 (rotation, where nothing is displaced), positive.
Mode BuckleStep::mode_of(const EigenPair& pair, std::int32_t number) {
  const auto& map = system_.map();
  std::vector<double> slots(static_cast<std::size_t>(map.slots()), 0.0);
  system_.exchange().from_equations(pair.vector, slots);
  Mode mode{.number = number, .eigenvalue = pair.value, .generalized_mass = 1.0};
  mode.displacement.assign(3 * static_cast<std::size_t>(analysis_.domain.size()), 0.0);
  mode.rotation = mode.displacement;
  const auto add = [&](const NodeMotion& motion, double* sum) {
    for (int k = 0; k < motion.count; ++k)
      for (int i = 0; i < 3; ++i) sum[i] += motion.direction[k][i] * slots[motion.slots[k]];
  };
  std::array<double, 2> largest{};
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    add(map.motion(node), &mode.displacement[3 * node]);
    if (node < analysis_.domain.turning) add(map.nodal_spin(node), &mode.rotation[3 * node]);
    for (int i = 0; i < 3; ++i) {
      largest[0] = std::max(largest[0], mode.displacement[3 * node + i]);
      largest[1] = std::max(largest[1], -mode.displacement[3 * node + i]);
    }
  }
  analysis_.communicator.maximum(std::span<double>(largest));
  // Of two that are equal but for rounding the positive one counts, on any number of ranks.
  const double size = largest[1] > (1.0 + 1e-6) * largest[0] ? -largest[1] : largest[0];
  for (auto* shape : {&mode.displacement, &mode.rotation})
    for (double& value : *shape) value /= size != 0.0 ? size : 1.0;
  return mode;
}

void BuckleStep::run() {
  const auto here = system_.configuration();
  const auto histories = analysis_.current.element_history;
  if (!analysis_.current.linear)
    throw AnalysisError(fmt::format("step '{}': load factors are found about the undeformed structure; leave NLGEOM out of the steps before", step_.name));
  system_.restore(system_.reference());
  observer_.log(fmt::format("step {} '{}': buckling, {} equations", analysis_.current.step + 1, step_.name, system_.map().equations()));
  const auto moved = response();
  PetscMatrix stiffness, geometric;
  petsc(MatDuplicate(system_.stiffness().matrix(), MAT_COPY_VALUES, stiffness.address()));
  add_stresses(moved);
  assemble(false);
  petsc(MatDuplicate(stiffness, MAT_COPY_VALUES, geometric.address()));
  petsc(MatAXPY(geometric, -1.0, system_.stiffness().matrix(), SAME_NONZERO_PATTERN));
  for (Mat matrix : {static_cast<Mat>(stiffness), static_cast<Mat>(geometric)}) petsc(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  Eigenmodes solver(stiffness, geometric, system_.map().multipliers(), analysis_.communicator);
  std::vector<Mode> modes;
  for (const auto& pair : solver.least_positive(std::get<BuckleProcedure>(step_.procedure).number))
    modes.push_back(mode_of(pair, static_cast<std::int32_t>(modes.size()) + 1));
  analysis_.current.element_history = histories;
  system_.restore(here);
  observer_.log(fmt::format("{:>6} {:>14}", "MODE", "LOAD FACTOR"));
  for (const auto& mode : modes) {
    observer_.mode_found(mode);
    observer_.log(fmt::format("{:>6} {:>14.7g}", mode.number, mode.eigenvalue));
  }
}

}  // namespace

Outcome run_buckle_step(Analysis& analysis, const Step& step, Observer& observer) {
  auto& state = analysis.current;
  if (state.increment == 0) analysis.start_step(step);
  observer.step_started(analysis, state.step);
  BuckleStep(analysis, step, observer).run();
  state.increment = 1;
  const bool go_on = observer.advanced(
      analysis, {.increment = 1, .step_time = state.step_time, .total_time = state.total_time, .iterations = 1, .step_finished = true});
  return go_on ? Outcome::finished : Outcome::stopped;
}

namespace {
const RegisterProcedure<BuckleProcedure> buckle_procedure(run_buckle_step);
}  // namespace

}  // namespace balocco
