#include "factorization.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace balocco {

namespace {

void set_default_option(const char* name, const char* value) {
  PetscBool is_set = PETSC_FALSE;
  petsc(PetscOptionsHasName(nullptr, nullptr, name, &is_set));
  if (is_set == PETSC_FALSE) petsc(PetscOptionsSetValue(nullptr, name, value));
}

/// Pivots that multipliers put off may need far more room than MUMPS had foreseen. @return whether it has more now.
bool makes_room(PC preconditioner) {
  constexpr PetscInt too_little_integer_room = -8, too_little_room = -9, most_room = 2000;  // per cent
  Mat factor = nullptr;
  MatSolverType package = nullptr;
  PetscBool factorises = PETSC_FALSE;
  petsc(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(preconditioner), &factorises, PCLU, PCCHOLESKY, ""));
  if (factorises == PETSC_FALSE) return false;
  petsc(PCFactorGetMatrix(preconditioner, &factor));
  petsc(PCFactorGetMatSolverType(preconditioner, &package));
  if (factor == nullptr || package == nullptr || std::string_view(package) != MATSOLVERMUMPS) return false;
  PetscInt status = 0, room = 0;
  petsc(MatMumpsGetInfog(factor, 1, &status));
  petsc(MatMumpsGetIcntl(factor, 14, &room));
  if ((status != too_little_integer_room && status != too_little_room) || room >= most_room) return false;
  const char* prefix = nullptr;
  petsc(PetscObjectGetOptionsPrefix(reinterpret_cast<PetscObject>(factor), &prefix));
  const std::string option = fmt::format("-{}mat_mumps_icntl_14", prefix != nullptr ? prefix : "");
  petsc(PetscOptionsSetValue(nullptr, option.c_str(), std::to_string(3 * room).c_str()));
  return true;
}

}  // namespace

void set_factorization_defaults() {
  set_default_option("-mat_mumps_icntl_7", "3");    // SCOTCH: half the operations of the default ordering
  set_default_option("-mat_mumps_icntl_14", "60");  // room for pivoting, per cent
  set_default_option("-mat_mumps_icntl_13", "1");   // the root front on one rank
}

bool factorize(KSP solver) {
  PC preconditioner = nullptr;
  petsc(KSPGetPC(solver, &preconditioner));
  for (;;) {
    petsc(KSPSetUp(solver));
    PCFailedReason failure = PC_NOERROR;
    petsc(PCGetFailedReason(preconditioner, &failure));
    if (failure == PC_NOERROR) return true;
    const bool again = makes_room(preconditioner);
    Mat matrix = nullptr;
    petsc(KSPGetOperators(solver, &matrix, nullptr));
    petsc(PetscObjectReference(reinterpret_cast<PetscObject>(matrix)));
    petsc(PCReset(preconditioner));  // after a factorisation that broke down PETSc's interface to MUMPS would skip the next one
    petsc(KSPSetOperators(solver, matrix, matrix));
    petsc(MatDestroy(&matrix));
    if (!again) return false;
  }
}

}  // namespace balocco
