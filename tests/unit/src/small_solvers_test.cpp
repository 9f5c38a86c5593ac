// Solvers of small systems, and pairs of vectors.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/definite_solver.hpp"
#include "math/dense.hpp"
#include "math/pivoting_solver.hpp"
#include "math/rotation.hpp"
#include "math/six.hpp"

namespace balocco {
namespace {

/// A A^T + 1, with rows and columns in units far apart.
std::vector<double> definite_matrix(std::size_t size) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> a(size * size), product(size * size, 0.0);
  for (double& value : a) value = uniform(random);
  const auto unit = [](std::size_t i) { return i % 2 == 0 ? 1.0 : 1e4; };
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j) {
      for (std::size_t k = 0; k < size; ++k) product[i * size + j] += a[i * size + k] * a[j * size + k];
      product[i * size + j] = (product[i * size + j] + (i == j ? 1.0 : 0.0)) * unit(i) * unit(j);
    }
  return product;
}

TEST(SmallSolvers, DefiniteAndPivotingOnesAgree) {
  for (const std::size_t size : {1, 5, 12, 40}) {
    const auto matrix = definite_matrix(size);
    DefiniteSystem definite;
    PivotingSolver pivoting;
    ASSERT_TRUE(definite.factorize(matrix, size));
    ASSERT_TRUE(pivoting.factorize(matrix, size));
    std::vector<double> first(size), second(size), right(size);
    for (std::size_t i = 0; i < size; ++i) first[i] = second[i] = right[i] = std::sin(1.0 + static_cast<double>(i));
    definite.solve(first);
    pivoting.solve(second);
    for (std::size_t i = 0; i < size; ++i) {
      EXPECT_NEAR(first[i], second[i], 1e-10 * (std::abs(second[i]) + 1e-8));
      double product = 0.0, scale = 0.0;
      for (std::size_t j = 0; j < size; ++j) {
        product += matrix[i * size + j] * first[j];
        scale += std::abs(matrix[i * size + j] * first[j]);
      }
      EXPECT_NEAR(product, right[i], 1e-12 * scale);
    }
  }
}

TEST(SmallSolvers, SingularMatricesAreTold) {
  const std::vector<double> rank_one{1.0, 2.0, 2.0, 4.0}, indefinite{1.0, 0.0, 0.0, -1.0}, zero{0.0};
  DefiniteSystem system;
  EXPECT_FALSE(system.factorize(rank_one, 2));
  EXPECT_FALSE(system.factorize(indefinite, 2));
  EXPECT_FALSE(system.factorize(zero, 1));
  EXPECT_TRUE(system.factorize(std::vector<double>{2.0}, 1));
}

TEST(Six, TurnedMatrixTurnsPairs) {
  const auto values = definite_matrix(6);
  Matrix6 matrix;
  std::ranges::copy(values, matrix.component.begin());
  const auto q = rotation_matrix(exponential({{0.3, -0.7, 1.1}}));
  const Vector6 pair{1.0, -2.0, 0.5, 3.0, 0.25, -1.5};
  const auto back = pair_of(transpose(q) * pair.translation(), transpose(q) * pair.rotation());
  const auto product = matrix * back;
  const auto expected = pair_of(q * product.translation(), q * product.rotation()), got = turned(q, matrix) * pair;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(got[i], expected[i], 1e-14 * 6e8);
}

TEST(Six, FactorsOfAMatrixGiveItBackHeldOrFree) {
  const auto values = definite_matrix(6);
  Matrix6 matrix;
  std::ranges::copy(values, matrix.component.begin());
  const auto q = rotation_matrix(exponential({{0.3, -0.7, 1.1}}));
  for (const bool held : {false, true}) {
    if (held)  // two directions answer to nothing, on axes that no coordinate follows
      for (std::size_t i = 0; i < 6; ++i) matrix(1, i) = matrix(i, 1) = matrix(5, i) = matrix(i, 5) = 0.0;
    const auto whole = held ? turned(q, matrix) : matrix;
    const auto [lower, diagonal] = factored(whole);
    EXPECT_EQ(std::ranges::count(diagonal.component, 0.0), held ? 2 : 0);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 6; ++k) sum += lower(i, k) * diagonal[k] * lower(j, k);
        EXPECT_NEAR(sum, whole(i, j), 1e-12 * (1.0 + std::abs(whole(i, i)) + std::abs(whole(j, j))));
      }
  }
}

TEST(Dense, ProductsInversesAndEigenvaluesAgree) {
  Dense<3, 8> g;
  for (int i = 0; i < 24; ++i) g.component[i] = std::sin(1.0 + 3.0 * i + 0.1 * i * i);
  const auto product = transpose(g) * g;
  double trace = 0.0, sum = 0.0;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const double expected = g(0, i) * g(0, j) + g(1, i) * g(1, j) + g(2, i) * g(2, j);
      EXPECT_NEAR(product(i, j), expected, 1e-15);
      if (i == j) trace += expected;
    }
  for (const double value : symmetric_eigenvalues(product.component, 8)) sum += value;
  EXPECT_NEAR(sum, trace, 1e-13);
  EXPECT_NEAR(largest_eigenvalue(product), largest_eigenvalue(g * transpose(g)), 1e-13);
  const auto small = g * transpose(g), one = small * inverse(small);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(one(i, j), i == j ? 1.0 : 0.0, 1e-12);
}

}  // namespace
}  // namespace balocco
