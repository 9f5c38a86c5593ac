// An implicit step: automatic increments (Abaqus's rules) around Newton's method, or linear increments. Procedures say where it starts
// and what more an increment brings.
#pragma once

#include <string>
#include <vector>

#include "elements/failure.hpp"
#include "implicit_linear_solver.hpp"
#include "implicit_newton.hpp"
#include "implicit_prescribed.hpp"
#include "implicit_system.hpp"
#include "linear_statics.hpp"
#include "procedures.hpp"
#include "thermal_strains.hpp"

namespace balocco {

class ImplicitStep {
 public:
  /// `step` has implicit increments. Collective.
  ImplicitStep(Analysis& analysis, const Step& step, Observer& observer);
  virtual ~ImplicitStep() = default;

  /// Advances the state to the end of the step. Collective. @throws AnalysisError when an increment does not converge at the
  /// smallest size.
  Outcome run();

 protected:
  /// Finds residual_ and what else the first increment of this run begins from.
  virtual void find_start() = 0;
  virtual void log_notes() {}
  virtual NewtonResult attempt(double time_increment) { return solve(goal_of(time_increment)); }
  /// Motion of the slots to begin iterations from; empty: none.
  virtual std::vector<double> expected_motion(double time_increment) const = 0;
  /// Viscosity of stabilisation at an instant.
  virtual double viscosity(double) const { return 0.0; }
  /// The increment has moved the state: what follows from that, once its work and its reactions are known.
  virtual void conclude(const IncrementGoal& goal) = 0;

  NewtonResult solve(IncrementGoal goal);
  IncrementGoal goal_of(double time_increment) const;
  void find_starts_of_motions();
  void find_applied_forces(double step_time, std::vector<double>& applied) const;
  void add_work(const IncrementGoal& goal);
  void store_reactions() { show_reactions(analysis_, system_.map(), residual_); }
  bool follows_geometry() const { return !analysis_.current.linear; }

  Analysis& analysis_;
  const Step& step_;
  const ImplicitIncrements& increments_;
  Observer& observer_;
  ImplicitDrive drive_;
  ImplicitSystem system_;
  ImplicitLinearSolver solver_;
  ImplicitNewton newton_;
  LinearStatics linear_;
  bool fresh_ = true;                                      // no increment of this step has been made in this run
  const bool taken_up_ = analysis_.current.increment > 0;  // from a checkpoint inside the step
  std::vector<double> residual_;  // per slot, at the end of the last increment; reactions where prescribed
  std::vector<double> applied_;   // per slot: loads, reactions and fading forces at the end of the last increment

 private:
  Outcome march();
  double next_increment(double suggested) const;
  [[noreturn]] void fail(double time_increment, const std::string& reason) const;
  void finish_increment(const IncrementGoal& goal);
  std::int64_t count_failures() const { return analysis_.communicator.sum(failures_.count(analysis_.current.element_history)); }
  void refuse_failures() const;
  double remaining_time() const { return step_.duration() - analysis_.current.step_time; }

  ThermalStrains thermal_;
  double total_start_ = 0.0;
  ElementFailures failures_;
  bool some_can_fail_ = false;
  std::int64_t failed_at_start_ = 0;          // elements of all ranks that *SHEAR FAILURE has deleted
  std::vector<double> time_points_;           // at which results are asked for: increments end there, unless they are fixed
  std::vector<std::int32_t> dependent_rows_;  // of State::multiplier
};

}  // namespace balocco
