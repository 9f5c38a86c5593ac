// Newton's method for one increment of an implicit step.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/results.hpp"
#include "implicit_linear_solver.hpp"
#include "implicit_prescribed.hpp"
#include "implicit_system.hpp"

namespace balocco {

/// What drives the equations of a step: prescribed motions, and forces out of balance when the step began (of supports,
/// contact or loads that it removed), which fade linearly over the step.
struct ImplicitDrive {
  std::vector<PrescribedMotion> motions;
  std::vector<double> fading;  // per slot: residual when the step began, zero where not free
};

struct IncrementGoal {
  double step_time = 0.0, total_time = 0.0;  // at the end of the increment
  double time_increment = 0.0;
  bool ends_step = false;              // then the residual is driven down to where the next procedure may start from it
  bool starts_step = false;            // then the stiffness is searched for mechanisms
  std::span<const double> guess = {};  // motion of the slots to start from, or empty
  double damping = 0.0;                // of stabilisation: viscous force / (mass * velocity)
};

/// Message of an analysis that cannot go on because nothing resists a motion: `where` names node and dof.
std::string mechanism_message(const Step& step, const std::string& where);

struct NewtonResult {
  bool converged = false;
  std::string reason;  // why not
  int iterations = 0;
  double largest_residual = 0.0;
};

class ImplicitNewton {
 public:
  /// `step` has implicit increments.
  ImplicitNewton(Analysis& analysis, const Step& step, ImplicitSystem& system, ImplicitLinearSolver& solver,
                 const ImplicitDrive& drive, Observer& observer);

  /// Finds equilibrium at the goal's time from the start of the increment. If the stiffness is singular at the start of
  /// the step, iterations are held back by an artificial stiffness that fades with the residual: unstressed membranes
  /// gain stiffness, rigid bodies find contact. @throws AnalysisError if a mechanism is left in equilibrium.
  /// Collective.
  NewtonResult converge(const IncrementGoal& goal);
  /// Where the stiffness was singular at the start of the step, or empty.
  const std::string& mechanism() const { return mechanism_; }

  /// Motion of each slot over the last increment.
  const std::vector<double>& increment() const { return increment_; }
  double assembly_seconds() const { return assembly_seconds_; }

 private:
  struct Norms {
    double residual = 0.0;  // 2-norm over the free slots, moments divided by the arm of their body
    double largest = 0.0;
    double reference = 0.0;  // forces that the residual is measured against
    double remaining = 0.0;  // largest prescribed motion still to be made
    double gap = 0.0;        // largest of the constraints
  };

  bool evaluate(const IncrementGoal& goal);
  void find_remaining_motion(const IncrementGoal& goal);
  Norms norms() const;
  bool accepted(const IncrementGoal& goal, const Norms& now, const NewtonResult& result) const;
  bool at_round_off(const Norms& now) const;
  bool last_factors_suffice(const IncrementGoal& goal, const Norms& now, const NewtonResult& result) const;
  void start(const IncrementGoal& goal);
  bool advance(const IncrementGoal& goal, NewtonResult& result);
  bool solve_linear_equations();
  bool solve(const IncrementGoal& goal, NewtonResult& result);
  bool solve_held_back(const IncrementGoal& goal);
  bool stands_alone(const IncrementGoal& goal);
  bool circles() const;
  bool search_line(const IncrementGoal& goal);
  bool contact_misfits(const IncrementGoal& goal, const NewtonResult& result);
  bool gives_up(const IncrementGoal& goal, const Norms& now, NewtonResult& result);
  void measure_correction(double factor);
  void log_iteration(const NewtonResult& result, const Norms& now) const;
  std::string worst_dof() const;

  Analysis& analysis_;
  const Step& step_;
  const ImplicitControls& controls_;
  ImplicitSystem& system_;
  ImplicitLinearSolver& solver_;
  const ImplicitDrive& drive_;
  Observer& observer_;

  std::vector<double> remaining_;                   // per slot: prescribed motion still to be made
  std::vector<double> out_of_balance_;              // per slot: residual less what fades
  std::vector<double> right_hand_side_, solution_;  // per owned equation
  std::vector<double> correction_, increment_;      // per slot
  double largest_correction_ = 0.0, largest_increment_ = 0.0;
  double greatest_reference_ = 0.0;  // in this step
  std::vector<double> history_;      // of residual norms in this increment
  bool keeps_factors_ = false;       // in the next correction
  bool descends_ = false;            // since the iterations circled: only corrections that lower the residual are taken
  int discontinuous_ = 0, augmentations_ = 0;
  int iterations_before_ = 0;  // the last augmentation
  double contact_length_ = 0.0;
  double assembly_seconds_ = 0.0;
  std::string mechanism_;
  double regularization_ = 0.0;
};

}  // namespace balocco
