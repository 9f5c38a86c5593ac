// PETSc objects that destroy themselves, and its error codes as exceptions.
#pragma once

#include <petscksp.h>
#include <slepceps.h>

#include <utility>

#include "model/diagnostics.hpp"

namespace balocco {

inline void petsc(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw SystemError(std::string("PETSc: ") + (text != nullptr ? text : "unknown error"));
}

template <class Handle, PetscErrorCode (*destroy)(Handle*)>
class PetscObjectOwner {
 public:
  PetscObjectOwner() = default;
  ~PetscObjectOwner() { reset(); }
  PetscObjectOwner(const PetscObjectOwner&) = delete;
  PetscObjectOwner& operator=(const PetscObjectOwner&) = delete;

  operator Handle() const { return handle_; }  // NOLINT: stands wherever PETSc wants the handle
  Handle* address() { return &handle_; }
  /// Gives up the object: others that refer to it keep it.
  void reset() {
    if (handle_ != nullptr) destroy(&handle_);
  }

 private:
  Handle handle_ = nullptr;
};

using PetscVector = PetscObjectOwner<Vec, VecDestroy>;
using PetscMatrix = PetscObjectOwner<Mat, MatDestroy>;
using PetscSolver = PetscObjectOwner<KSP, KSPDestroy>;
using PetscScatter = PetscObjectOwner<VecScatter, VecScatterDestroy>;
using PetscIndices = PetscObjectOwner<IS, ISDestroy>;
using EigenSolver = PetscObjectOwner<EPS, EPSDestroy>;
using PetscNullSpace = PetscObjectOwner<MatNullSpace, MatNullSpaceDestroy>;

}  // namespace balocco
