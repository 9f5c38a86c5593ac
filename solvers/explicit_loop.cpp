// The explicit loop: half-step central difference.
//
//   x(n+1) = x(n) + dt v(n+1/2),   a = (f_ext - f_int + f_contact) / m at n,   v(n+1/2) = v(n-1/2) + dt_average a(n)
//
// Each cycle moves the nodes over the increment, computes the forces where they arrive, agrees on the next increment
// and brings the velocities to its middle. Elements at the interface between ranks come first, so that messages travel
// while the interior is computed; every sum is exact, so results do not depend on the number of ranks.
#include "explicit_step.hpp"
#include "procedures.hpp"

namespace balocco {

namespace {

void compute_forces(ExplicitStep& cycle) {
  cycle.begin_external_loads();
  cycle.add_interface_elements();
  cycle.add_mesh_contact();
  cycle.begin_halo();
  cycle.add_interior_elements();
  cycle.rest_failed_elements();
  cycle.add_soft_contact();
  cycle.finish_halo();
}

/// Forces at the very start act where the steps before left the nodes: nothing moves yet.
void start(ExplicitStep& cycle) {
  cycle.prepare_start();
  cycle.log_resting_elements();
  cycle.log_dependent_constraints();
  cycle.log_mass_scaling();
  compute_forces(cycle);
  cycle.add_stiff_contact();
  cycle.sum_body_forces();
  cycle.log_balance();
  cycle.add_damping();
  cycle.sum_body_forces();
  cycle.choose_increment();
  cycle.satisfy_constraints();
  cycle.update_velocities();
  cycle.fill_output();
  cycle.start_energy_balance();
}

}  // namespace

Outcome run_explicit_step(Analysis& analysis, const Step& step, Observer& observer) {
  ExplicitStep cycle(analysis, step, observer);
  if (cycle.starts_afresh()) start(cycle);
  observer.step_started(analysis, analysis.current.step);
  while (!cycle.finished()) {
    cycle.advance_positions();
    compute_forces(cycle);
    cycle.scale_masses();
    cycle.add_damping();
    cycle.choose_increment();
    cycle.add_stiff_contact();
    cycle.sum_body_forces();
    cycle.satisfy_constraints();
    cycle.update_velocities();
    if (!cycle.observe()) return Outcome::stopped;
  }
  cycle.bring_idle_copies();
  cycle.log_deleted_elements();
  if (!cycle.fixed_masses()) cycle.log_mass_scaling();
  cycle.log_timers();
  return Outcome::finished;
}

namespace {
const RegisterProcedure<ExplicitProcedure> explicit_procedure(run_explicit_step);
}  // namespace

}  // namespace balocco
