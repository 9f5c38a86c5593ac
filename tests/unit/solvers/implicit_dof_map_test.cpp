// Degrees of freedom of static steps: which there are, how they are numbered over the ranks, and how nodes move with
// them. These tests hold on any number of ranks.
#include "implicit_dof_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "implicit_fixture.hpp"

namespace balocco {
namespace {

using namespace test;
using Role = ImplicitDofMap::Role;

/// PETSc and SLEPc for the life of the program; MPI is the main function's.
struct Petsc : testing::Environment {
  void SetUp() override { petsc(SlepcInitializeNoArguments()); }
  void TearDown() override { petsc(SlepcFinalize()); }
};
const auto* const environment = testing::AddGlobalTestEnvironment(new Petsc);

struct StaticDofs : testing::Test {
  const Model model = beam();
  const Communicator communicator;
  Equations beam_{model, communicator};
  const ImplicitDofMap& map = beam_.map();
};

TEST_F(StaticDofs, CarriedNodesHaveNoneAndBodiesHaveSix) {
  std::vector<Role> expected(beam_.table_size(), Role::free);
  for (const auto row : carried_rows()) std::fill_n(expected.begin() + 3 * row, 3, Role::absent);
  for (const auto row : root_rows()) std::fill_n(expected.begin() + 3 * row, 3, Role::prescribed);
  std::fill_n(expected.begin() + 3 * road, 3, Role::prescribed);
  expected[3 * model.nodes.size() + 2] = Role::prescribed;
  for (std::int32_t slot = 0; slot < map.slots(); ++slot)
    EXPECT_EQ(map.role(slot), expected[beam_.place(slot)]) << map.describe(slot);
  EXPECT_EQ(map.equations(), std::count(expected.begin(), expected.end(), Role::free));
}

TEST_F(StaticDofs, EquationsAreContiguousOnEachRankAndCopiesKnowThem) {
  EXPECT_EQ(map.owned_free_slots().empty() ? map.first_equation() : map.equation(map.owned_free_slots()[0]),
            map.first_equation());
  for (std::size_t i = 0; i < map.owned_free_slots().size(); ++i)
    EXPECT_EQ(map.equation(map.owned_free_slots()[i]), map.first_equation() + static_cast<PetscInt>(i));
  for (std::size_t i = 1; i < map.owned_slots().size(); ++i)
    EXPECT_EQ(map.global_slot(map.owned_slots()[i]), map.global_slot(map.owned_slots()[0]) + static_cast<PetscInt>(i));

  // Owners' numbers by place in the model, as doubles so that they can be summed.
  std::vector<double> equation(map.slots()), slot_number(map.slots());
  for (std::int32_t slot = 0; slot < map.slots(); ++slot) {
    equation[slot] = static_cast<double>(map.equation(slot));
    slot_number[slot] = static_cast<double>(map.global_slot(slot));
  }
  auto equations = beam_.gathered(equation), numbers = beam_.gathered(slot_number);
  for (std::int32_t slot = 0; slot < map.slots(); ++slot) {
    EXPECT_EQ(equations[beam_.place(slot)], equation[slot]) << map.describe(slot);
    EXPECT_EQ(numbers[beam_.place(slot)], slot_number[slot]) << map.describe(slot);
    EXPECT_EQ(map.equation(slot) >= 0, map.role(slot) == Role::free);
  }
  std::erase(equations, -1.0);
  std::sort(equations.begin(), equations.end());
  std::sort(numbers.begin(), numbers.end());
  ASSERT_EQ(equations.size(), static_cast<std::size_t>(map.equations()));
  for (std::size_t i = 0; i < equations.size(); ++i) EXPECT_EQ(equations[i], static_cast<double>(i));
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], static_cast<double>(i));
}

TEST_F(StaticDofs, NamesAreThoseOfTheDeckOnAnyRank) {
  const auto node = beam_.analysis.domain.local_node[road];
  EXPECT_EQ(map.describe(map.slot(node, 1)), "node 122, dof 2");
  EXPECT_EQ(map.describe(map.rotation_slot(1, 2)), "node 122, dof 6");
  EXPECT_EQ(map.describe_equation(map.equation(map.rotation_slot(1, 2))), "node 122, dof 6");
  EXPECT_EQ(map.describe_equation(map.equation(map.slot(beam_.analysis.domain.local_node[hub], 0))), "node 121, dof 1");
}

TEST_F(StaticDofs, SumsReachEveryCopyAndSolutionsTheirSlots) {
  std::vector<double> ones(map.slots(), 1.0);
  beam_.system.exchange().sum(ones);
  std::vector<double> copies(model.nodes.size(), 0.0);
  for (const auto row : beam_.analysis.domain.node_row) copies[row] += 1.0;
  communicator.sum(std::span<double>(copies));
  for (std::int32_t slot = 0; slot < map.slots(); ++slot)
    EXPECT_EQ(ones[slot], copies[beam_.analysis.domain.node_row[map.node_of(slot)]]) << map.describe(slot);

  std::vector<double> solution;
  for (std::size_t i = 0; i < map.owned_free_slots().size(); ++i)
    solution.push_back(0.5 + static_cast<double>(map.first_equation()) + static_cast<double>(i));
  std::vector<double> values(map.slots(), -7.0);
  beam_.system.exchange().from_equations(solution, values);
  for (std::int32_t slot = 0; slot < map.slots(); ++slot)
    EXPECT_EQ(values[slot], map.role(slot) == Role::free ? 0.5 + static_cast<double>(map.equation(slot)) : -7.0)
        << map.describe(slot);
}

/// Largest difference between a node's motion by its slots and the central difference of step `h` of where it goes.
double motion_error(Equations& beam, double h) {
  const auto& map = beam.map();
  const auto direction = beam.noise(0.3);
  const auto start = beam.system.configuration();
  std::vector<NodeMotion> motions;
  for (std::int32_t node = 0; node < beam.analysis.domain.size(); ++node) motions.push_back(map.motion(node));
  std::array<std::vector<double>, 2> moved;
  for (const int side : {0, 1}) {
    beam.system.restore(start);
    beam.system.move(direction, side == 0 ? -h : h);
    moved[side] = beam.analysis.current.position;
  }
  beam.system.restore(start);
  double error = 0.0;
  for (std::size_t node = 0; node < motions.size(); ++node)
    for (int i = 0; i < 3; ++i) {
      double velocity = 0.0;
      for (int k = 0; k < motions[node].count; ++k)
        velocity += motions[node].direction[k][i] * direction[motions[node].slots[k]];
      error = std::max(error, std::abs((moved[1][4 * node + i] - moved[0][4 * node + i]) / (2 * h) - velocity));
    }
  return beam.analysis.communicator.maximum(error);
}

TEST_F(StaticDofs, NodesMoveWithTheirSlotsToSecondOrder) {
  beam_.system.move(beam_.noise(1.0), 0.3);  // bodies are turned already
  const double coarse = motion_error(beam_, 4e-2), fine = motion_error(beam_, 2e-2);
  EXPECT_GT(coarse, 1e-6);  // the hub turns
  EXPECT_LT(fine, 1e-2);
  EXPECT_LT(fine, 0.27 * coarse);
}

TEST_F(StaticDofs, CarriedNodesKeepTheirDistances) {
  beam_.system.move(beam_.noise(1.0), 0.3);
  beam_.system.move(beam_.noise(2.0), 0.3);
  const auto& analysis = beam_.analysis;
  const auto distance = [&](std::int32_t a, std::int32_t b, const auto& at) {
    double square = 0.0;
    for (int i = 0; i < 3; ++i) square += (at(a)[i] - at(b)[i]) * (at(a)[i] - at(b)[i]);
    return std::sqrt(square);
  };
  for (const auto row : carried_rows()) {
    if (analysis.domain.local_node[row] < 0) continue;
    const auto place = [&](auto r) { return &analysis.current.position[4 * analysis.domain.local_node[r]]; };
    const auto reference = [&](auto r) { return model.nodes.coordinates[r].data(); };
    EXPECT_NEAR(distance(row, hub, place), distance(row, hub, reference), 1e-14);
  }
}

}  // namespace
}  // namespace balocco
