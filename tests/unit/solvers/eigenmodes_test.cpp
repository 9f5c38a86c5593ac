#include "eigenmodes.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace balocco {

namespace {

/// A diagonal matrix.
template <class Value>
void fill_diagonal(Mat* matrix, PetscInt size, Value value) {
  petsc(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, size, size, 1, nullptr, 0, nullptr, matrix));
  PetscInt first = 0, last = 0;
  petsc(MatGetOwnershipRange(*matrix, &first, &last));
  for (PetscInt i = first; i < last; ++i) petsc(MatSetValue(*matrix, i, i, value(i), INSERT_VALUES));
  petsc(MatAssemblyBegin(*matrix, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(*matrix, MAT_FINAL_ASSEMBLY));
  petsc(MatSetOption(*matrix, MAT_SYMMETRIC, PETSC_TRUE));
}

// As sliding friction leaves them: counted, but neither looked for without end nor listed before the modes.
TEST(Eigenmodes, EigenvaluesFarBelowAreNotListed) {
  constexpr PetscInt size = 400, far = 20;
  PetscMatrix stiffness, mass;
  fill_diagonal(stiffness.address(), size, [](PetscInt i) { return i < far ? -1e9 - i : static_cast<double>(i - far + 1); });
  fill_diagonal(mass.address(), size, [](PetscInt) { return 1.0; });
  const Communicator communicator;
  Eigenmodes solver(stiffness, mass, 0, communicator);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(solver.count_below(-1e-3), far);
  const auto pairs = solver.find({.shift = -1e-3, .lowest = -infinite, .highest = infinite, .number = 4});
  ASSERT_EQ(pairs.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(pairs[i].value, 1.0 + i, 1e-9);
}

// Near the modes they say that the state is unstable.
TEST(Eigenmodes, NegativeEigenvaluesNearTheModesAreListed) {
  constexpr PetscInt size = 60;
  PetscMatrix stiffness, mass;
  fill_diagonal(stiffness.address(), size, [](PetscInt i) { return i < 2 ? -3.0 - i : static_cast<double>(i - 1); });
  fill_diagonal(mass.address(), size, [](PetscInt) { return 1.0; });
  const Communicator communicator;
  Eigenmodes solver(stiffness, mass, 0, communicator);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto pairs = solver.find({.shift = -1e-3, .lowest = -infinite, .highest = infinite, .number = 3});
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_NEAR(pairs[0].value, -4.0, 1e-9);
  EXPECT_NEAR(pairs[1].value, -3.0, 1e-9);
  EXPECT_NEAR(pairs[2].value, 1.0, 1e-9);
}

}  // namespace

}  // namespace balocco
