#include "implicit_linear_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "factorization.hpp"

namespace balocco {

namespace {

/// A motion is unresisted when the forces that it calls forth are this small against those of the average dof: rounding
/// errors leave about 1e-16 of singular matrices, and the softest structures that we meet keep well above.
constexpr double smallest_resistance = 1e-14;

/// Reproducible noise in (-1, 1) that depends on the number of the equation only.
double noise(PetscInt equation) {
  auto bits = static_cast<std::uint64_t>(equation) + 0x9E3779B97F4A7C15ULL;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>(static_cast<std::int64_t>(bits ^ (bits >> 31))) * 0x1p-63;
}

void fill_with_noise(Vec vector) {
  PetscInt first = 0, end = 0;
  double* values = nullptr;
  petsc(VecGetOwnershipRange(vector, &first, &end));
  petsc(VecGetArray(vector, &values));
  for (PetscInt row = first; row < end; ++row) values[row - first] = noise(row);
  petsc(VecRestoreArray(vector, &values));
}

}  // namespace

ImplicitLinearSolver::ImplicitLinearSolver(const ImplicitStiffness& stiffness, const Analysis& analysis, const ImplicitDofMap& map)
    : stiffness_(stiffness), analysis_(analysis), map_(map) {
  petsc(MatCreateVecs(stiffness.matrix(), solution_.address(), right_hand_side_.address()));
  petsc(KSPCreate(analysis.communicator.handle(), solver_.address()));
  take_matrix();
  set_defaults();
  petsc(KSPSetFromOptions(solver_));
}

void ImplicitLinearSolver::set_defaults() {
  PC preconditioner = nullptr;
  petsc(KSPGetPC(solver_, &preconditioner));
  petsc(KSPSetType(solver_, KSPPREONLY));
  petsc(PCSetType(preconditioner, PCLU));
  petsc(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS));
  petsc(KSPSetTolerances(solver_, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT,
                         2000));                    // iterative solvers; command line overrides
  set_factorization_defaults();
}

void ImplicitLinearSolver::take_matrix() {
  if (matrix_ == stiffness_.matrix()) return;
  matrix_ = stiffness_.matrix();
  factorized_ = nullptr;
  petsc(KSPSetOperators(solver_, matrix_, matrix_));
  set_near_null_space();
}

void ImplicitLinearSolver::set_near_null_space() {
  constexpr int modes = 6;
  std::array<Vec, modes> vectors{};
  std::array<double*, modes> values{};
  for (int mode = 0; mode < modes; ++mode) {
    petsc(VecDuplicate(solution_, &vectors[mode]));
    petsc(VecGetArray(vectors[mode], &values[mode]));
  }
  for (std::size_t i = 0; i < map_.owned_free_slots().size(); ++i) {
    const auto slot = map_.owned_free_slots()[i];
    if (map_.is_multiplier(slot)) continue;
    const auto node = map_.node_of(slot);
    const auto& axes = map_.directions(node);
    const double* x = &analysis_.current.position[4 * node];
    const Point direction{axes(slot % 3, 0), axes(slot % 3, 1), axes(slot % 3, 2)};
    for (int mode = 0; mode < 3; ++mode) {
      const int next = (mode + 1) % 3, last = (mode + 2) % 3;
      values[mode][i] = map_.is_rotation(slot) ? 0.0 : direction[mode];
      values[3 + mode][i] =
          map_.is_rotation(slot) ? direction[mode] : direction[last] * x[next] - direction[next] * x[last];
    }
  }
  for (int mode = 0; mode < modes; ++mode) petsc(VecRestoreArray(vectors[mode], &values[mode]));

  // Gram-Schmidt; modes that the supports leave nothing of are dropped.
  std::vector<Vec> kept;
  for (auto* vector : vectors) {
    double before = 0.0, after = 0.0;
    petsc(VecNorm(vector, NORM_2, &before));
    for (int pass = 0; pass < 2; ++pass)
      for (auto* other : kept) {
        double projection = 0.0;
        petsc(VecDot(vector, other, &projection));
        petsc(VecAXPY(vector, -projection, other));
      }
    petsc(VecNormalize(vector, &after));
    if (after > 1e-8 * before) kept.push_back(vector);
  }
  PetscNullSpace space;
  petsc(MatNullSpaceCreate(analysis_.communicator.handle(), PETSC_FALSE, static_cast<PetscInt>(kept.size()), kept.data(),
                           space.address()));
  petsc(MatSetNearNullSpace(matrix_, space));
  for (auto& vector : vectors) petsc(VecDestroy(&vector));
}

bool ImplicitLinearSolver::solve_vectors(Mat matrix, Vec right_hand_side, Vec solution, Factors factors) {
  const double start = MPI_Wtime();
  KSPConvergedReason reason = KSP_DIVERGED_PC_FAILED;
  const bool keeps = factors == Factors::kept && factorized_ == matrix;
  petsc(KSPSetOperators(solver_, matrix, matrix));
  petsc(KSPSetReusePreconditioner(solver_, keeps ? PETSC_TRUE : PETSC_FALSE));
  if (!keeps) ++factorizations_;
  factorized_ = factorize(solver_) ? matrix : nullptr;
  if (factorized_ != nullptr) {
    petsc(KSPSolve(solver_, right_hand_side, solution));
    petsc(KSPGetConvergedReason(solver_, &reason));
  }
  seconds_ += MPI_Wtime() - start;
  double norm = 0.0;
  petsc(VecNorm(solution, NORM_INFINITY, &norm));
  return reason > 0 && std::isfinite(norm);
}

/// Compares K and its transpose by their products with noise, each row by its own largest entry.
bool ImplicitLinearSolver::is_symmetric() const {
  constexpr double tolerance = 1e-10;
  PetscVector vector, product, transposed, scale;
  for (auto* each : {&vector, &product, &transposed, &scale}) petsc(VecDuplicate(solution_, each->address()));
  fill_with_noise(vector);
  petsc(MatMult(matrix_, vector, product));
  petsc(MatMultTranspose(matrix_, vector, transposed));
  petsc(VecAXPY(product, -1.0, transposed));
  std::vector<PetscInt> columns(map_.owned_free_slots().size());  // PETSc's sequential matrices want to tell where
  petsc(MatGetRowMaxAbs(matrix_, scale, columns.data()));
  petsc(VecShift(scale, std::numeric_limits<double>::min()));  // empty rows
  petsc(VecPointwiseDivide(product, product, scale));
  double difference = 0.0;
  petsc(VecNorm(product, NORM_INFINITY, &difference));
  return difference <= tolerance;
}

void ImplicitLinearSolver::choose_factorization() {
  unsymmetric_ = unsymmetric_ || !is_symmetric();
  if (symmetric_ == !unsymmetric_) return;
  symmetric_ = !unsymmetric_;
  PC preconditioner = nullptr;
  PetscBool is_factorization = PETSC_FALSE;
  petsc(KSPGetPC(solver_, &preconditioner));
  petsc(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(preconditioner), &is_factorization, PCLU, PCCHOLESKY, ""));
  if (is_factorization == PETSC_FALSE) return;  // the command line asked for something else
  petsc(PCReset(preconditioner));
  petsc(PCSetType(preconditioner, symmetric_ ? PCCHOLESKY : PCLU));
  petsc(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS));
}

bool ImplicitLinearSolver::solve(std::span<const double> right_hand_side, std::span<double> solution, Factors factors) {
  take_matrix();
  if (factors == Factors::fresh) choose_factorization();
  double* values = nullptr;
  petsc(VecGetArray(right_hand_side_, &values));
  std::ranges::copy(right_hand_side, values);
  petsc(VecRestoreArray(right_hand_side_, &values));
  const bool solved = solve_vectors(matrix_, right_hand_side_, solution_, factors);
  const double* result = nullptr;
  petsc(VecGetArrayRead(solution_, &result));
  std::copy_n(result, solution.size(), solution.data());
  petsc(VecRestoreArrayRead(solution_, &result));
  return solved;
}

std::string ImplicitLinearSolver::largest_component(Vec vector) {
  PetscInt equation = -1;
  double largest = 0.0;
  petsc(VecAbs(vector));
  petsc(VecMax(vector, &equation, &largest));
  return map_.describe_equation(equation);
}

/// An equation whose row holds nothing but zeros.
std::string ImplicitLinearSolver::unresisted_equation() {
  PetscVector largest;
  petsc(VecDuplicate(solution_, largest.address()));
  std::vector<PetscInt> columns(map_.owned_free_slots().size());  // PETSc's sequential matrices want to tell where
  petsc(MatGetRowMaxAbs(matrix_, largest, columns.data()));
  double smallest = 0.0;
  PetscInt equation = -1;
  petsc(VecMin(largest, &equation, &smallest));
  return smallest > 0.0 ? std::string{} : map_.describe_equation(equation);
}

/// Takes out what belongs to multipliers: forces have no part in the size of a motion, nor gaps in that of a force.
void ImplicitLinearSolver::clear_multipliers(Vec vector) {
  double* values = nullptr;
  petsc(VecGetArray(vector, &values));
  for (std::size_t i = 0; i < map_.owned_free_slots().size(); ++i)
    if (map_.is_multiplier(map_.owned_free_slots()[i])) values[i] = 0.0;
  petsc(VecRestoreArray(vector, &values));
}

double ImplicitLinearSolver::average_diagonal() {
  take_matrix();
  PetscVector diagonal;
  petsc(VecDuplicate(solution_, diagonal.address()));
  petsc(MatGetDiagonal(matrix_, diagonal));
  double sum = 0.0;
  petsc(VecNorm(diagonal, NORM_1, &sum));
  return sum / static_cast<double>(map_.equations());
}

std::string ImplicitLinearSolver::mechanism() {
  if (auto found = unresisted_equation(); !found.empty()) return found;
  const double average = average_diagonal();
  PetscVector force, motion;
  petsc(VecDuplicate(right_hand_side_, force.address()));
  petsc(VecDuplicate(solution_, motion.address()));
  fill_with_noise(force);
  clear_multipliers(force);
  if (!solve_vectors(matrix_, force, motion, Factors::kept)) {
    // The factorisation broke down: a touch of stiffness everywhere lets it through, and the mechanism still stands
    // out.
    PetscMatrix stiffened;
    petsc(MatDuplicate(matrix_, MAT_COPY_VALUES, stiffened.address()));
    petsc(MatShift(stiffened, 1e-12 * average));
    if (!solve_vectors(stiffened, force, motion)) return "no dof stands out";
    clear_multipliers(motion);
    return largest_component(motion);
  }
  clear_multipliers(motion);
  double force_norm = 0.0, motion_norm = 0.0;
  petsc(VecNorm(force, NORM_2, &force_norm));
  petsc(VecNorm(motion, NORM_2, &motion_norm));
  force_norm /= std::sqrt(static_cast<double>(map_.equations()));  // the share of one motion among as many as there are
  return force_norm < smallest_resistance * average * motion_norm ? largest_component(motion) : std::string{};
}

}  // namespace balocco
