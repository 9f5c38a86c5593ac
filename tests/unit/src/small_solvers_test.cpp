// Solvers of small systems, and pairs of vectors.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/block_solver.hpp"
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

/// Blocks of 1 to 8 rows in a ring, each coupled with the next one, and all with the last, which is negative.
TEST(SmallSolvers, BlocksAndPivotsAgree) {
  const std::vector<std::int32_t> sizes{5, 3, 8, 1, 6};
  const auto blocks = static_cast<std::int32_t>(sizes.size());
  std::vector<std::int32_t> first{0};
  for (const auto size : sizes) first.push_back(first.back() + size);
  const auto size = static_cast<std::size_t>(first.back());
  std::vector<BlockSolver::Pair> pairs;
  for (std::int32_t i = 0; i < blocks; ++i)
    for (std::int32_t j = 0; j < blocks; ++j)
      if (std::abs(i - j) < 2 || i + j == blocks - 2 || i == blocks - 1 || j == blocks - 1) pairs.push_back({i, j});
  auto matrix = definite_matrix(size);
  const auto is_coupled = [&](const BlockSolver::Pair& pair) { return std::ranges::count(pairs, pair) > 0; };
  const auto block_of = [&](std::size_t row) {
    return static_cast<std::int32_t>(std::ranges::upper_bound(first, static_cast<std::int32_t>(row)) - first.begin()) - 1;
  };
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j) {
      double& value = matrix[i * size + j];
      if (!is_coupled({block_of(i), block_of(j)})) value = 0.0;
      if (i == j) value = (block_of(i) == blocks - 1 ? -40.0 : 40.0) * value;
    }
  BlockSolver solver;
  solver.lay_out(sizes, pairs, 1);
  PivotingSolver pivoting;
  for (int repetition = 0; repetition < 2; ++repetition) {
    solver.clear();
    for (const auto& [i, j] : pairs)
      for (int r = 0; r < sizes[i] && solver.in_order(i, j); ++r)
        for (int c = 0; c < sizes[j]; ++c)
          solver.block(solver.place(i, j))[static_cast<std::size_t>(r)][c] =
              matrix[static_cast<std::size_t>(first[i] + r) * size + static_cast<std::size_t>(first[j] + c)];
    ASSERT_TRUE(solver.factorize());
    ASSERT_TRUE(pivoting.factorize(matrix, size));
    std::vector<double> one(size), other(size);
    for (std::size_t i = 0; i < size; ++i) one[i] = other[i] = std::sin(1.0 + static_cast<double>(i));
    solver.solve(one);
    pivoting.solve(other);
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(one[i], other[i], 1e-12 * (std::abs(other[i]) + 1e-8));
  }
}

TEST(SmallSolvers, SingularBlocksAreTold) {
  BlockSolver solver;
  solver.lay_out({2}, {}, 0);
  solver.clear();
  solver.block(0)[0].lane = {1.0, 2.0};
  solver.block(0)[1].lane = {2.0, 4.0};
  EXPECT_FALSE(solver.factorize());
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
