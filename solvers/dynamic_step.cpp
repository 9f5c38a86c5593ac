// An implicit dynamic step: the alpha method (alpha_method.hpp), with Newton's method in every increment or linear ones.
#include <fmt/format.h>

#include <algorithm>

#include "explicit_start.hpp"
#include "implicit_step.hpp"
#include "math/rotation.hpp"
#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

class DynamicStep : public ImplicitStep {
 public:
  using ImplicitStep::ImplicitStep;

 private:
  void find_start() override;
  NewtonResult attempt(double time_increment) override;
  std::vector<double> expected_motion(double) const override { return prediction_; }
  void conclude(const IncrementGoal& goal) override;

  void find_velocities();
  void find_accelerations();
  void keep_accelerations();
  std::vector<double> find_forces(double step_time, double total_time);
  std::vector<double> prescribed_accelerations() const;
  std::vector<double> assemble_accelerations(std::span<const double> known);
  void set_velocity(std::int32_t slot, double velocity);
  void add_convective_gaps(std::vector<double>& gaps);
  void find_reactions(std::span<const double> forces);
  std::vector<double> damping_forces();
  void add_damping_work();
  AlphaMethod& method() { return *system_.dynamics(); }

  const bool finds_initial_accelerations_ = std::get<DynamicProcedure>(step_.procedure).finds_initial_accelerations;
  std::vector<double> prediction_;
  const bool damps_ = std::ranges::any_of(analysis_.model.materials, [](const Material& material) { return material.damping_alpha > 0.0; });
  std::vector<double> damping_;  // mass-proportional, at the end of the last increment: per slot, global axes
  std::int64_t freed_increment_ = -1;  // whose accelerations are those without contact
};

/// The instant of a step before which nothing has moved in this run: one taken up goes on with the motion of the state.
void DynamicStep::find_start() {
  auto& state = analysis_.current;
  find_starts_of_motions();
  if (taken_up_) {
    system_.begin_increment();
    method().hold(system_.start_of_increment());
    find_forces(state.step_time, state.total_time);  // for the loads alone
    method().follow();
    method().find_kinetic_energy();
    find_reactions(method().old_forces());
  } else {
    find_velocities();
    state.dynamic = true;
    system_.begin_increment();
    finds_initial_accelerations_ ? find_accelerations() : keep_accelerations();
  }
  if (damps_) damping_ = damping_forces();
  find_applied_forces(state.step_time, applied_);
  system_.begin_increment();
}

/// Those of the step before, or the initial ones where it was at rest; prescribed ones hold from the start.
void DynamicStep::find_velocities() {
  auto& state = analysis_.current;
  const auto before = analysis_.model.general_step_before(state.step);
  const bool at_rest = before < 0 ? !state.dynamic : !analysis_.model.steps[before].is_dynamic();
  if (at_rest) {
    std::ranges::fill(state.velocity, 0.0);
    std::ranges::fill(state.angular_velocity, 0.0);
    for (auto& body : state.rigid_bodies) body.velocity = body.angular_velocity = {};
  }
  if (!state.dynamic) apply_initial_velocities(analysis_, step_, observer_);
  using Kind = BoundaryCondition::Kind;
  for (const auto& motion : drive_.motions) {
    if (system_.map().role(motion.slot) != ImplicitDofMap::Role::prescribed) continue;
    const auto& condition = *motion.condition;
    if (condition.kind == Kind::velocity) {
      set_velocity(motion.slot, condition.magnitude * amplitude_factor(analysis_.model, step_, condition.amplitude, 0.0, state.total_time));
    } else if (condition.kind == Kind::displacement) {
      // A curve has a slope; without one the displacement is there at once.
      const double instant = 1e-6 * increments_.initial_increment;
      const auto at = [&](double time) { return motion_law(analysis_.model, step_, condition, time, state.total_time + time).motion; };
      set_velocity(motion.slot, condition.amplitude >= 0 ? (at(instant) - at(0.0)) / instant : 0.0);
    }
  }
}

void DynamicStep::set_velocity(std::int32_t slot, double velocity) {
  auto& state = analysis_.current;
  const auto& map = system_.map();
  const auto node = map.node_of(slot);
  const auto direction = row_of(map.directions(node), slot % 3);
  const auto set = [&](double* vector) {
    double change = velocity;
    for (int i = 0; i < 3; ++i) change -= direction[i] * vector[i];
    for (int i = 0; i < 3; ++i) vector[i] += change * direction[i];
  };
  const auto body = analysis_.reference_of(node);
  if (map.is_rotation(slot))
    set(body >= 0 ? state.rigid_bodies[body].angular_velocity.data() : &state.angular_velocity[4 * node]);
  else
    set(body >= 0 ? state.rigid_bodies[body].velocity.data() : &state.velocity[4 * node]);
}

/// Internal - external forces of an instant, per slot. Collective.
std::vector<double> DynamicStep::find_forces(double step_time, double total_time) {
  const AssemblyRequest instant{.step_time = step_time, .total_time = total_time, .inertia = false, .motion = {}};
  if (!(follows_geometry() ? system_.assemble(instant) : linear_.find_residual(instant)))
    throw AnalysisError(fmt::format("step '{}' at step time {:.6g}: {}", step_.name, step_time, system_.trouble()));
  return follows_geometry() ? system_.forces() : linear_.residual();
}

/// Prescribed accelerations at the start; zero elsewhere.
std::vector<double> DynamicStep::prescribed_accelerations() const {
  std::vector<double> accelerations(static_cast<std::size_t>(system_.map().slots()), 0.0);
  for (const auto& motion : drive_.motions)
    if (motion.condition->kind == BoundaryCondition::Kind::acceleration && system_.map().role(motion.slot) == ImplicitDofMap::Role::prescribed)
      accelerations[motion.slot] = motion.condition->magnitude * amplitude_factor(analysis_.model, step_, motion.condition->amplitude, 0.0,
                                                                                  analysis_.current.total_time);
  return accelerations;
}

/// The matrix that finds accelerations, of linear steps in the reference configuration. @return its product with those known.
std::vector<double> DynamicStep::assemble_accelerations(std::span<const double> known) {
  const auto& state = analysis_.current;
  const auto here = system_.configuration();
  if (!follows_geometry()) system_.restore(system_.reference());
  const bool sound = system_.assemble({.step_time = state.step_time, .total_time = state.total_time, .motion = known});
  system_.restore(here);
  if (!sound) throw AnalysisError(fmt::format("step '{}' cannot start: {}", step_.name, system_.trouble()));
  auto& product = system_.stiffness().product();
  system_.exchange().sum(product);
  return product;
}

/// Accelerations at the start: M a = -forces there, under the constraints, whose gaps may not begin to grow.
void DynamicStep::find_accelerations() {
  const auto& state = analysis_.current;
  const auto& map = system_.map();
  method().stand(system_.start_of_increment(), increments_.initial_increment);
  const auto forces = find_forces(state.step_time, state.total_time);
  auto accelerations = prescribed_accelerations();
  auto out_of_balance = assemble_accelerations(accelerations);
  method().follow();
  const auto& inertia = system_.find_inertia();  // centripetal forces
  for (std::int32_t slot = 0; slot < map.slots(); ++slot)
    if (!map.is_multiplier(slot)) out_of_balance[slot] += forces[slot] + inertia[slot];
  add_convective_gaps(out_of_balance);

  std::vector<double> right_hand_side, solution(map.owned_free_slots().size());
  for (const auto slot : map.owned_free_slots()) {
    const auto node = map.node_of(slot);
    // A load on what has no mass does not accelerate it: it goes with what it hangs on.
    const bool moves_mass =
        map.is_multiplier(slot) || map.is_rotation(slot) || analysis_.inertia.mass[node] > 0.0 || analysis_.reference_of(node) >= 0;
    right_hand_side.push_back(moves_mass ? -out_of_balance[slot] : 0.0);
  }
  if (map.equations() > 0) {
    if (!solver_.solve(right_hand_side, solution))
      throw AnalysisError(fmt::format("step '{}' cannot start: no accelerations balance the forces; give what moves a mass", step_.name));
    system_.exchange().from_equations(solution, accelerations);
  }
  method().commit_accelerations(accelerations, forces);
  find_reactions(forces);
}

/// INITIAL=NO: those of an implicit dynamic step just before, else none.
void DynamicStep::keep_accelerations() {
  auto& state = analysis_.current;
  const auto before = analysis_.model.general_step_before(state.step);
  if (before < 0 || !std::holds_alternative<DynamicProcedure>(analysis_.model.steps[before].procedure))
    for (auto* memory : {&state.alpha_memory, &state.alpha_memory_of_spins, &state.alpha_memory_of_bodies}) std::ranges::fill(*memory, AlphaMemory{});
  method().hold(system_.start_of_increment());
  const auto forces = find_forces(state.step_time, state.total_time);
  method().follow();
  method().commit(forces);
  find_reactions(forces);
}

/// Rate of the gradient along the velocities, times them, by central differences: what a constraint's accelerations must undo.
void DynamicStep::add_convective_gaps(std::vector<double>& gaps) {
  const auto& map = system_.map();
  const double instant = 1e-4 * increments_.initial_increment, weight = method().tangent_weight();
  std::vector<NodePlace> places;
  std::vector<double> gradient;
  for (std::size_t local = 0; local < analysis_.local_constraints.size(); ++local) {
    const auto index = analysis_.local_constraints[local];
    const auto& constraint = *analysis_.constraints[index];
    if (constraint.is_linear() || !follows_geometry()) continue;
    gradient.resize(static_cast<std::size_t>(constraint.rows()) * constraint.columns());
    for (const double side : {1.0, -1.0}) {
      analysis_.find_places(index, places);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const auto node = analysis_.domain.local_node[constraint.nodes()[i]];
        Vector3<double> spin{};
        for (int k = 0; k < 3; ++k) {
          places[i].position[k] += side * instant * method().velocity(node, k);
          if (node < analysis_.domain.turning) spin[k] = side * instant * method().velocity(node, 3 + k);
        }
        places[i].rotation = rotation_matrix(exponential(spin)) * places[i].rotation;
        places[i].turn = places[i].turn + spin;
      }
      constraint.gradient(places, gradient);
      for (int row = 0; row < constraint.rows(); ++row)
        for (int column = 0; column < constraint.columns(); ++column) {
          const auto node = analysis_.domain.local_node[constraint.nodes()[column / 6]];
          if (column % 6 >= 3 && node >= analysis_.domain.turning) continue;
          gaps[map.multiplier_slot(local) + row] += weight * side / (2.0 * instant) * gradient[row * constraint.columns() + column] *
                                                    method().velocity(node, column % 6);
        }
    }
  }
}

NewtonResult DynamicStep::attempt(double time_increment) {
  const bool may_change = finds_initial_accelerations_ || analysis_.current.increment > 0;
  if (may_change && freed_increment_ != analysis_.current.increment && system_.starts_in_contact()) {
    find_accelerations();  // without those that contact causes
    freed_increment_ = analysis_.current.increment;
  }
  method().advance(system_.start_of_increment(), time_increment);
  prediction_ = method().prediction();
  return solve(goal_of(time_increment));
}

/// What holds prescribed motions in the present instant, where the forces of the method are weighted means.
void DynamicStep::find_reactions(std::span<const double> forces) {
  const auto& inertia = system_.find_inertia();
  residual_.assign(forces.begin(), forces.end());
  for (std::size_t slot = 0; slot < residual_.size(); ++slot) residual_[slot] += inertia[slot];
}

/// Of the velocities that the method found last. Collective.
std::vector<double> DynamicStep::damping_forces() {
  std::vector<double> forces(static_cast<std::size_t>(system_.map().slots()), 0.0);
  method().add_damping(nullptr, forces);
  system_.exchange().sum(forces);
  return forces;
}

/// By the trapezoidal rule, as the work of loads is counted.
void DynamicStep::add_damping_work() {
  const auto& map = system_.map();
  auto damping = damping_forces();
  for (std::int32_t slot = 0; slot < map.first_multiplier(); ++slot)
    analysis_.current.nodal_work[map.node_of(slot)].damping += 0.5 * (damping_[slot] + damping[slot]) * system_.moved(slot)[slot % 3];
  damping_ = std::move(damping);
}

void DynamicStep::conclude(const IncrementGoal& goal) {
  const auto forces = follows_geometry() ? system_.forces() : find_forces(goal.step_time, goal.total_time);
  method().follow();
  auto with_contact = forces;
  if (follows_geometry())
    for (std::size_t slot = 0; slot < forces.size(); ++slot) with_contact[slot] += system_.contact_forces()[slot];
  find_reactions(with_contact);
  add_work(goal);
  if (damps_) add_damping_work();
  store_reactions();
  method().commit(forces);
}

}  // namespace

Outcome run_dynamic_step(Analysis& analysis, const Step& step, Observer& observer) {
  if (analysis.current.step_time == 0.0 && analysis.current.increment == 0) analysis.start_step(step);
  return DynamicStep(analysis, step, observer).run();
}

namespace {
const RegisterProcedure<DynamicProcedure> dynamic_procedure(run_dynamic_step);
}  // namespace

}  // namespace balocco
