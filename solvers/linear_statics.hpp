// Equilibrium of geometrically linear steps. Stiffness and loads are those of the reference configuration, and displacements
// are counted from it, so that steps superpose exactly.
#pragma once

#include <vector>

#include "implicit_linear_solver.hpp"
#include "implicit_newton.hpp"
#include "implicit_system.hpp"

namespace balocco {

class LinearStatics {
 public:
  LinearStatics(Analysis& analysis, const Step& step, ImplicitSystem& system, ImplicitLinearSolver& solver,
                const ImplicitDrive& drive);

  /// Forces out of balance where the state stands, for the loads at the given time. @return false where a force is not
  /// finite. Collective.
  bool find_residual(const AssemblyRequest& loads);
  /// Per slot: out of balance where free, reactions where prescribed.
  const std::vector<double>& residual() const { return residual_; }

  /// Displaces the state to equilibrium. Collective. @throws AnalysisError if nothing resists a motion.
  NewtonResult solve(const IncrementGoal& goal);

 private:
  bool assemble(AssemblyRequest request, std::span<const double> displacement);

  Analysis& analysis_;
  const Step& step_;
  ImplicitSystem& system_;
  ImplicitLinearSolver& solver_;
  const ImplicitDrive& drive_;
  const Configuration reference_;
  std::vector<double> residual_;
};

}  // namespace balocco
