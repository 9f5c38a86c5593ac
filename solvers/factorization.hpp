// Factorisations by MUMPS through PETSc, for all that solves or counts with one.
#pragma once

#include "implicit_petsc.hpp"

namespace balocco {

/// MUMPS's options where the command line does not say them: a good ordering, room for pivoting, and the root front on one rank,
/// so that singular matrices and numbers of negative pivots are told.
void set_factorization_defaults();

/// Sets a solver up for its matrix, once more with more room as long as MUMPS finds that it has too little.
/// @return false if the factorisation failed. Collective.
bool factorize(KSP solver);

}  // namespace balocco
