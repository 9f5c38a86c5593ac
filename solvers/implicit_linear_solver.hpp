// Solves the linear systems of Newton's method through PETSc: MUMPS unless the command line says otherwise.
#pragma once

#include <string>
#include <vector>

#include "implicit_dof_map.hpp"
#include "implicit_petsc.hpp"
#include "implicit_stiffness.hpp"

namespace balocco {

/// Whether a solution is found with factors of the matrix as it stands, or with those of the solution before.
enum class Factors { fresh, kept };

class ImplicitLinearSolver {
 public:
  /// The symbolic factorisation is made once for each pattern of `stiffness`. A matrix that is symmetric to round-off
  /// (followers, friction and laws decide that as they act) is factorised as such, at half the cost. Collective.
  ImplicitLinearSolver(const ImplicitStiffness& stiffness, const Analysis& analysis, const ImplicitDofMap& map);

  /// Solves for the values of the equations this rank owns; kept factors serve where there are some of this pattern.
  /// @return false if the factorisation failed, the iteration did not converge or the solution is not finite.
  /// Collective.
  bool solve(std::span<const double> right_hand_side, std::span<double> solution, Factors factors = Factors::fresh);

  /// What makes the matrix singular: "node N, dof D" of the largest component of a motion that meets no resistance, or
  /// empty where every motion meets some. Costs one back substitution after solve(). Collective.
  std::string mechanism();

  /// Mean magnitude of the diagonal entries. Collective.
  double average_diagonal();

  /// Whether the last factorisation took the matrix for symmetric.
  bool symmetric() const { return symmetric_; }

  double seconds() const { return seconds_; }
  int factorizations() const { return factorizations_; }

 private:
  void set_defaults();
  void choose_factorization();
  bool is_symmetric() const;
  void take_matrix();
  void set_near_null_space();
  bool solve_vectors(Mat matrix, Vec right_hand_side, Vec solution, Factors factors = Factors::fresh);
  void clear_multipliers(Vec vector);
  std::string unresisted_equation();
  std::string largest_component(Vec vector);

  const ImplicitStiffness& stiffness_;
  const Analysis& analysis_;
  const ImplicitDofMap& map_;
  Mat matrix_ = nullptr;
  Mat factorized_ = nullptr;  // the matrix that the factors were found of; null: there are none
  PetscSolver solver_;
  PetscVector right_hand_side_, solution_;
  bool symmetric_ = false, unsymmetric_ = false;  // once found unsymmetric, the matrix stays so
  double seconds_ = 0.0;
  int factorizations_ = 0;
};

}  // namespace balocco
