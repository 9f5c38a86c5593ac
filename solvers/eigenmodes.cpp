#include "eigenmodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "factorization.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

void use_symmetric_factorization(KSP solver) {
  PC preconditioner = nullptr;
  petsc(KSPSetType(solver, KSPPREONLY));
  petsc(KSPGetPC(solver, &preconditioner));
  petsc(PCSetType(preconditioner, PCCHOLESKY));
  petsc(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS));
}

}  // namespace

Eigenmodes::Eigenmodes(Mat stiffness, Mat mass, int multipliers, const Communicator& communicator)
    : stiffness_(stiffness), mass_(mass), multipliers_(multipliers), communicator_(communicator) {
  set_factorization_defaults();
}

double Eigenmodes::small_shift() const {
  PetscVector stiffness, mass;
  petsc(MatCreateVecs(stiffness_, stiffness.address(), mass.address()));
  petsc(MatGetDiagonal(stiffness_, stiffness));
  petsc(MatGetDiagonal(mass_, mass));
  double sum_of_stiffness = 0.0, sum_of_mass = 0.0;
  petsc(VecNorm(stiffness, NORM_1, &sum_of_stiffness));
  petsc(VecNorm(mass, NORM_1, &sum_of_mass));
  if (sum_of_mass == 0.0) throw AnalysisError("nothing that is free to move has mass: there are no natural modes");
  return -1e-9 * sum_of_stiffness / sum_of_mass;
}

/// Leaves in `solver` the factors of K - value * M.
void Eigenmodes::factorize_shifted(double value, KSP solver) {
  PetscMatrix shifted;
  petsc(MatDuplicate(stiffness_, MAT_COPY_VALUES, shifted.address()));
  petsc(MatAXPY(shifted, -value, mass_, DIFFERENT_NONZERO_PATTERN));
  petsc(MatSetOption(shifted, MAT_SYMMETRIC, PETSC_TRUE));
  petsc(KSPSetOperators(solver, shifted, shifted));
  use_symmetric_factorization(solver);
  if (!factorize(solver))
    throw AnalysisError(fmt::format("the stiffness shifted by {:.6g} cannot be factorised; choose another shift or bound", value));
}

int Eigenmodes::count_below(double value) {
  PetscSolver solver;
  petsc(KSPCreate(communicator_.handle(), solver.address()));
  factorize_shifted(value, solver);
  PC preconditioner = nullptr;
  Mat factor = nullptr;
  PetscInt negative = 0;
  petsc(KSPGetPC(solver, &preconditioner));
  petsc(PCFactorGetMatrix(preconditioner, &factor));
  petsc(MatGetInertia(factor, &negative, nullptr, nullptr));
  return static_cast<int>(negative) - multipliers_;  // each independent constraint turns one eigenvalue into a pair of both signs
}

std::vector<EigenPair> Eigenmodes::nearest(double shift, int number, EPSProblemType type) {
  EigenSolver solver;
  petsc(EPSCreate(communicator_.handle(), solver.address()));
  petsc(EPSSetOperators(solver, stiffness_, mass_));
  petsc(EPSSetProblemType(solver, type));
  petsc(EPSSetWhichEigenpairs(solver, EPS_TARGET_MAGNITUDE));
  petsc(EPSSetTarget(solver, shift));
  petsc(EPSSetDimensions(solver, number, PETSC_DEFAULT, PETSC_DEFAULT));
  petsc(EPSSetTolerances(solver, 1e-12, 1000));
  ST transform = nullptr;
  KSP linear = nullptr;
  petsc(EPSGetST(solver, &transform));
  petsc(STSetType(transform, STSINVERT));
  petsc(STSetMatStructure(transform, DIFFERENT_NONZERO_PATTERN));
  petsc(STGetKSP(transform, &linear));
  // Factors made here: SLEPc's own factorisation gives up where MUMPS only wants more room.
  PetscSolver factorized;
  PC factors = nullptr;
  petsc(KSPCreate(communicator_.handle(), factorized.address()));
  factorize_shifted(shift, factorized);
  petsc(KSPGetPC(factorized, &factors));
  petsc(PCSetReusePreconditioner(factors, PETSC_TRUE));
  petsc(KSPSetType(linear, KSPPREONLY));
  petsc(KSPSetPC(linear, factors));
  petsc(EPSSetFromOptions(solver));
  petsc(EPSSolve(solver));

  PetscInt converged = 0;
  petsc(EPSGetConverged(solver, &converged));
  PetscVector shape;
  petsc(MatCreateVecs(stiffness_, shape.address(), nullptr));
  std::vector<EigenPair> pairs(converged);
  for (PetscInt i = 0; i < converged; ++i) {
    petsc(EPSGetEigenpair(solver, i, &pairs[i].value, nullptr, shape, nullptr));
    PetscInt size = 0;
    const double* values = nullptr;
    petsc(VecGetLocalSize(shape, &size));
    petsc(VecGetArrayRead(shape, &values));
    pairs[i].vector.assign(values, values + size);
    petsc(VecRestoreArrayRead(shape, &values));
  }
  std::ranges::sort(pairs, {}, &EigenPair::value);
  return pairs;
}

std::vector<EigenPair> Eigenmodes::least_positive(int number) {
  PetscInt equations = 0;
  petsc(MatGetSize(stiffness_, &equations, nullptr));
  for (int asked = std::min<PetscInt>(2 * number + 8, equations);; asked = std::min<PetscInt>(2 * asked, equations)) {
    auto pairs = nearest(0.0, asked, EPS_GNHEP);  // no norm comes from a matrix that is not definite
    std::erase_if(pairs, [](const auto& pair) { return !(pair.value > 0.0); });
    if (static_cast<int>(pairs.size()) >= number || asked == equations || asked > 16 * number + 64) {
      if (pairs.empty()) throw AnalysisError("no load factor above zero was found: these loads do not make the structure buckle");
      if (static_cast<int>(pairs.size()) > number) pairs.resize(number);
      return pairs;
    }
  }
}

/// Rigid motions, right beside a small shift, dwarf the others in the inverse and cost them digits: then once more from a shift
/// that lies well below all of them, but not far in comparison with the first that deforms.
std::vector<EigenPair> Eigenmodes::find(EigenRange range) {
  auto pairs = search(range);
  const double rigid = 10.0 * std::abs(range.shift);
  const auto first = std::ranges::find_if(pairs, [&](const auto& pair) { return pair.value > 1e3 * rigid; });
  const bool has_rigid = std::ranges::any_of(pairs, [&](const auto& pair) { return std::abs(pair.value) < rigid; });
  if (!has_rigid || first == pairs.end()) return pairs;
  range.shift = -0.1 * first->value;
  return search(range);
}

/// The nearest pairs on both sides of the shift are found; more of them until those wanted are among them.
std::vector<EigenPair> Eigenmodes::search(const EigenRange& range) {
  PetscInt equations = 0;
  petsc(MatGetSize(stiffness_, &equations, nullptr));
  const int below = count_below(range.shift);
  const int below_wanted = range.lowest < range.shift ? below : 0;
  for (int asked = std::min<PetscInt>(range.number + below_wanted, equations);; asked = std::min<PetscInt>(2 * asked, equations)) {
    auto pairs = nearest(range.shift, asked);
    auto found_below = std::ranges::count_if(pairs, [&](const auto& pair) { return pair.value < range.shift; });
    if (found_below > below) {  // the farthest are infinite but for rounding: directions without mass
      pairs.erase(pairs.begin(), pairs.begin() + (found_below - below));
      found_below = below;
    }
    const bool past_lowest = !pairs.empty() && pairs.front().value < range.lowest;
    const bool past_highest = !pairs.empty() && pairs.back().value > range.highest;
    std::erase_if(pairs, [&](const auto& pair) { return pair.value < range.lowest || pair.value > range.highest; });
    const bool enough = static_cast<int>(pairs.size()) >= range.number || past_highest || asked == equations;
    const bool far_below = asked > 4 * range.number + 64;  // what is missing there, no number of pairs around the shift would find
    if (enough && (found_below == below || past_lowest || far_below || asked == equations)) {
      if (static_cast<int>(pairs.size()) > range.number) pairs.resize(range.number);
      return pairs;
    }
    if (static_cast<int>(pairs.size()) < std::min(asked, range.number) && asked > 4 * range.number + 64)
      throw AnalysisError(fmt::format("only {} of {} modes were found; ask for fewer, or choose another shift", pairs.size(),
                                      range.number));
  }
}

}  // namespace balocco
