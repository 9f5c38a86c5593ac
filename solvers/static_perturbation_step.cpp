// A static perturbation: the response of first order, about the state, to loads and prescribed motions beside those of
// the state, with the stiffness that it has there (initial stress, loads that follow, contact as it is). The state
// stays as it is; what is shown is the response.
#include <fmt/format.h>

#include <algorithm>

#include "constraints/rigid_body.hpp"
#include "implicit_linear_solver.hpp"
#include "implicit_newton.hpp"
#include "implicit_prescribed.hpp"
#include "implicit_system.hpp"
#include "kept_state.hpp"
#include "materials/flow_stress.hpp"
#include "math/rotation.hpp"
#include "model/diagnostics.hpp"
#include "model/rigid_constraints.hpp"
#include "procedures.hpp"

namespace balocco {

namespace {

class StaticPerturbationStep {
 public:
  StaticPerturbationStep(Analysis& analysis, const Step& step, Observer& observer)
      : analysis_(analysis),
        step_(step),
        observer_(observer),
        motions_(prescribed_motions(analysis, step)),
        system_(analysis, step, slots_of(motions_)),
        motion_(static_cast<std::size_t>(system_.map().slots()), 0.0) {}

  Outcome run();

 private:
  void refuse_yielding() const;
  void respond();
  const std::vector<double>& assemble(bool with_perturbation);
  void show();
  void show_bodies(std::span<const double> turned);
  void show_work(std::span<const double> forces);

  Analysis& analysis_;
  const Step& step_;
  Observer& observer_;
  const std::vector<PrescribedMotion> motions_;
  ImplicitSystem system_;
  std::vector<double> motion_, loads_, reactions_;  // per slot
};

/// What yields would do so on one side of the state, and respond as an elastic body on the other.
void StaticPerturbationStep::refuse_yielding() const {
  if (analysis_.current.linear) return;
  for (const auto& material : analysis_.model.materials)
    if (std::ranges::any_of(material.options, [](const auto& option) { return option.name.starts_with("plastic"); }))
      throw AnalysisError(
          fmt::format("step '{}': material {} yields, which has no response of first order about a state; give a step "
                      "with NLGEOM and "
                      "small loads in place of PERTURBATION",
                      step_.name, material.name));
}

/// The stiffness where the state stands, and the forces out of balance there; of linear steps those of the reference
/// configuration.
const std::vector<double>& StaticPerturbationStep::assemble(bool with_perturbation) {
  const auto& state = analysis_.current;
  const bool sound = system_.assemble({.total_time = state.total_time,
                                       .initial_loads = !with_perturbation,
                                       .load_stiffness = !state.linear,
                                       .arms_turn = !state.linear,
                                       .contact_sticks = true,
                                       .motion = motion_});
  if (!sound) throw AnalysisError(fmt::format("step '{}' cannot start: {}", step_.name, system_.trouble()));
  return system_.residual();
}

/// K * motion = loads, with the reactions where motions are prescribed.
void StaticPerturbationStep::respond() {
  const auto& map = system_.map();
  for (const auto& prescribed : motions_)
    if (map.role(prescribed.slot) == ImplicitDofMap::Role::prescribed && !prescribed.condition->propagated)
      motion_[prescribed.slot] = prescribed.condition->magnitude;
  loads_ = assemble(true);
  const auto& before = assemble(false);
  for (std::size_t slot = 0; slot < loads_.size(); ++slot) loads_[slot] = before[slot] - loads_[slot];
  const auto resist = [&] {
    auto& product = system_.stiffness().product();
    system_.exchange().sum(product);
    return product;
  };
  reactions_ = resist();
  std::vector<double> right_hand_side, solution(map.owned_free_slots().size());
  for (const auto slot : map.owned_free_slots()) right_hand_side.push_back(loads_[slot] - reactions_[slot]);
  if (map.equations() > 0) {
    ImplicitLinearSolver solver(system_.stiffness(), analysis_, map);
    const bool solved = solver.solve(right_hand_side, solution);
    if (const auto where = solver.mechanism(); !where.empty()) throw AnalysisError(mechanism_message(step_, where));
    if (!solved) throw AnalysisError(fmt::format("step '{}': the linear solver did not converge", step_.name));
    system_.exchange().from_equations(solution, motion_);
    assemble(false);
    reactions_ = resist();
  }
  for (std::size_t slot = 0; slot < loads_.size(); ++slot) reactions_[slot] -= loads_[slot];
}

/// The response as displacements of the reference configuration, for whoever writes results.
void StaticPerturbationStep::show() {
  auto& state = analysis_.current;
  const auto& map = system_.map();
  const auto nodes = static_cast<std::size_t>(analysis_.domain.size());
  std::vector<double> moved(3 * nodes, 0.0), turned(3 * nodes, 0.0);
  const auto add = [&](const NodeMotion& motion, double* sum) {
    for (int k = 0; k < motion.count; ++k)
      for (int i = 0; i < 3; ++i) sum[i] += motion.direction[k][i] * motion_[motion.slots[k]];
  };
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    add(map.motion(node), &moved[3 * node]);
    if (const auto body = analysis_.reference_of(node); body >= 0)
      add(map.spin(body), &turned[3 * node]);
    else if (node < analysis_.domain.turning)
      add(map.nodal_spin(node), &turned[3 * node]);
  }
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node)
    for (int i = 0; i < 3; ++i)
      state.position[4 * node + i] =
          analysis_.model.nodes.coordinates[analysis_.domain.node_row[node]][i] + moved[3 * node + i];
  for (std::int32_t node = 0; node < analysis_.domain.turning; ++node) {
    const double* const turn = &turned[3 * node];
    std::copy_n(turn, 3, &state.rotation[4 * node]);
    std::ranges::copy(exponential(Vector3<double>{{turn[0], turn[1], turn[2]}}), &state.orientation[4 * node]);
  }
  show_bodies(turned);
  // Contact has no pressures of first order to show.
  for (std::size_t pair = 0; pair < analysis_.contacts.size(); ++pair) {
    const auto& contact = analysis_.contacts[pair];
    contact.start_step(state.position.data(), state.rigid_bodies[contact.master_body()], false, state.contact[pair]);
  }
  for (auto slot = map.first_multiplier(); slot < map.slots(); ++slot)
    state.multiplier[map.constraint_row(slot)] = motion_[slot];
  for (auto* rates : {&state.velocity, &state.angular_velocity}) std::ranges::fill(*rates, 0.0);
  show_work(loads_);
  show_reactions(analysis_, map, reactions_);
}

void StaticPerturbationStep::show_bodies(std::span<const double> turned) {
  auto& bodies = analysis_.current.rigid_bodies;
  const auto at_rest = initial_rigid_bodies(analysis_.model);
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    const auto node =
        static_cast<std::size_t>(analysis_.domain.local_node[analysis_.model.rigid_bodies[body].reference_node]);
    bodies[body].orientation = at_rest[body].orientation;
    bodies[body].rotation = {};
    bodies[body].velocity = bodies[body].angular_velocity = {};
    rotate(bodies[body], {turned[3 * node], turned[3 * node + 1], turned[3 * node + 2]});
    std::copy_n(&analysis_.current.position[4 * node], 3, bodies[body].position.begin());
  }
}

/// Half of what the loads and the reactions do along the response, and nothing of what was before.
void StaticPerturbationStep::show_work(std::span<const double> loads) {
  const auto& map = system_.map();
  std::ranges::fill(analysis_.current.nodal_work, NodalWork{});
  for (const auto slot : map.owned_slots()) {
    if (map.role(slot) == ImplicitDofMap::Role::absent || map.is_multiplier(slot)) continue;
    const double held = map.role(slot) == ImplicitDofMap::Role::prescribed ? reactions_[slot] : 0.0;
    analysis_.current.nodal_work[map.node_of(slot)].external += 0.5 * (loads[slot] + held) * motion_[slot];
  }
}

Outcome StaticPerturbationStep::run() {
  auto& state = analysis_.current;
  refuse_yielding();
  KeptState keeper(analysis_);
  observer_.step_started(analysis_, state.step);
  observer_.log(fmt::format("step {} '{}': {}, about {}, {} equations", state.step + 1, step_.name,
                            step_.procedure_name(), state.linear ? "the reference configuration" : "the present state",
                            system_.map().equations()));
  if (state.linear) system_.restore(system_.reference());
  respond();
  SmallStrainOutput::Base base{state.position, state.orientation, state.rotation, state.linear};
  analysis_.small_strain().perturb(std::make_shared<SmallStrainOutput::Base>(std::move(base)));
  state.linear = true;
  state.increment = 1;
  state.step_time = step_.duration();
  state.total_time = keeper.state().total_time + state.step_time;
  analysis_.kinetic_energy = 0.0;
  show();
  const bool go_on = observer_.advanced(analysis_, {.increment = 1,
                                                    .step_time = state.step_time,
                                                    .total_time = state.total_time,
                                                    .time_increment = state.step_time,
                                                    .iterations = 1,
                                                    .step_finished = true});
  analysis_.small_strain().perturb(nullptr);
  keeper.restore();
  return go_on ? Outcome::finished : Outcome::stopped;
}

}  // namespace

Outcome run_static_perturbation_step(Analysis& analysis, const Step& step, Observer& observer) {
  if (analysis.current.increment == 0) analysis.start_step(step);
  return StaticPerturbationStep(analysis, step, observer).run();
}

namespace {
const RegisterProcedure<StaticPerturbationProcedure> static_perturbation_procedure(run_static_perturbation_step);
}  // namespace

}  // namespace balocco
