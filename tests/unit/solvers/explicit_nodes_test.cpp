// Passes over nodes: the fused one does what the separate ones do, bit for bit, and leaves the forces of a run that has blown up.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "explicit_nodes.hpp"
#include "math/exact_sum.hpp"

namespace balocco::test {

namespace {

constexpr std::size_t count = 1000;  // several blocks and a part of one

struct Nodes {
  std::vector<double> position, velocity, force, inverse_mass;

  Nodes() {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> real(-1.0, 1.0);
    for (std::size_t node = 0; node < count; ++node) {
      for (auto* vector : {&position, &velocity, &force}) {
        for (int c = 0; c < 3; ++c) vector->push_back(real(random));
        vector->push_back(vector == &force ? rounding_constant(64.0) : 0.0);
      }
      inverse_mass.push_back(node % 7 == 0 ? 0.0 : 1.0 + real(random));
    }
  }
  NodalPass pass() { return {position, velocity, force, inverse_mass}; }
};

TEST(ExplicitNodes, FusedPassDoesWhatTheSeparateOnesDo) {
  Nodes fused, separate;
  EXPECT_TRUE(kick_and_drift(fused.pass(), 0.3, 0.2));
  EXPECT_TRUE(kick(separate.velocity, separate.force, separate.inverse_mass, 0.3));
  drift(separate.position, separate.velocity, 0.2);
  clear_vectors(separate.force);
  EXPECT_EQ(fused.velocity, separate.velocity);
  EXPECT_EQ(fused.position, separate.position);
  EXPECT_EQ(fused.force, separate.force);
  EXPECT_NE(fused.position, Nodes().position);
}

TEST(ExplicitNodes, FusedPassLeavesTheForcesOfARunThatHasBlownUp) {
  Nodes nodes;
  constexpr std::size_t bad = 700;
  nodes.force[4 * bad + 1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(kick_and_drift(nodes.pass(), 0.3, 0.2));
  std::size_t found = 0;
  while (found < count && !has_outgrown(&nodes.force[4 * found])) ++found;
  EXPECT_EQ(found, bad);
  EXPECT_EQ(nodes.position[4 * (count - 1)], Nodes().position[4 * (count - 1)] + 0.2 * nodes.velocity[4 * (count - 1)]);
}

TEST(ExplicitNodes, RunsAreOfNeighboursAndLeaveTheOthersAlone) {
  const auto runs = find_runs(10, [](std::int32_t node) { return node < 2 || (node > 3 && node != 7); });
  ASSERT_EQ(runs.size(), 3u);
  std::vector<double> nodal(40, 1.0);
  for (const auto run : runs) clear_vectors(run.of(nodal));
  for (std::size_t node = 0; node < 10; ++node) {
    const bool left_alone = node == 2 || node == 3 || node == 7;
    EXPECT_EQ(nodal[4 * node], left_alone ? 1.0 : 0.0) << node;
    EXPECT_EQ(nodal[4 * node + 3], 1.0) << node;
  }
}

TEST(ExplicitNodes, OnlyTheNodesNamedAreClearedAndAdded) {
  Nodes nodes;
  const std::vector<std::int32_t> some{3, 17};
  std::vector<double> sum = nodes.velocity, rest = nodes.velocity;
  add_vectors(sum, nodes.force, some);
  for (const auto node : some)
    for (int c = 0; c < 3; ++c) rest[4 * node + c] += nodes.force[4 * node + c];
  EXPECT_EQ(sum, rest);
  clear_vectors(sum, some);
  for (const auto node : some)
    for (int c = 0; c < 3; ++c) rest[4 * node + c] = 0.0;
  EXPECT_EQ(sum, rest);
}

}  // namespace

}  // namespace balocco::test
