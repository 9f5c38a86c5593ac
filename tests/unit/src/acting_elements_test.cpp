// Elements that rest: they push nothing, bound no increment and keep their history to the bit.
#include <gtest/gtest.h>

#include <algorithm>

#include "elements/element_type.hpp"
#include "math/exact_sum.hpp"

namespace balocco {
namespace {

constexpr int bricks = 19;  // two whole packs and a part of one

/// A row of bricks along x, of which the one in the middle is thin, so that it governs the increment.
struct Row {
  Model model;
  std::unique_ptr<ElementGroup> group;
  std::vector<double> position, velocity, history;

  Row() {
    double x = 0.0;
    for (int i = 0; i <= bricks; ++i) {
      for (const double y : {0.0, 1.0})
        for (const double z : {0.0, 1.0}) {
          model.nodes.coordinates.push_back({x, y, z});
          model.nodes.id.push_back(model.nodes.size() + 1);
        }
      x += i == bricks / 2 ? 0.3 : 1.0;
    }
    ElementTable table;
    table.type = find_element_type("C3D8R");
    for (int i = 0; i < bricks; ++i) {
      const int a = 4 * i, b = 4 * (i + 1);
      for (const int node : {a, b, b + 2, a + 2, a + 1, b + 1, b + 3, a + 3}) table.connectivity.push_back(node);
      table.id.push_back(i + 1);
      table.section.push_back(0);
    }
    model.elements.push_back(table);
    Material material;
    material.law = "elastic";
    material.parameters = {100.0, 0.3};
    material.density = 1.0;
    model.materials.push_back(material);
    model.sections.resize(1);
    model.sections[0].material = 0;
    GroupInput input{model, 0, 0, {}, 5, table.connectivity, model.nodes.size()};
    for (int i = 0; i < bricks; ++i) input.rows.push_back(i);
    group = table.type->make_group(input);
    history = group->initial_history();
    for (std::size_t node = 0; node <= model.nodes.coordinates.size(); ++node)
      for (int c = 0; c < 4; ++c)
        position.push_back(node < model.nodes.coordinates.size() && c < 3
                               ? model.nodes.coordinates[node][c] + 0.01 * ((5 * node + 3 * c) % 7)
                               : 0.0);
    velocity.assign(position.size(), 0.0);
  }

  std::vector<double> forces(StableIncrement& smallest) {
    std::vector<double> force(position.size(), 0.0);
    for (std::size_t i = 3; i < force.size(); i += 4) force[i] = rounding_constant(1e4);
    const ExplicitCycle cycle{{position.data(), velocity.data()}, {force.data()}, 10.0, 0.06, 1.2};  // so long that viscosity bounds nothing
    smallest = group->add_forces(Portion::interface, cycle, history);
    smallest.merge(group->add_forces(Portion::interior, cycle, history));
    return force;
  }
  std::vector<double> own_history(int element) const {
    std::vector<double> own(group->history_size());
    group->gather_history(element, history, own);
    return own;
  }
};

TEST(ActingElements, TheRestPushNothingBoundNothingAndKeepTheirHistory) {
  // All that acts, and alone: brick 3, in a pack with resting ones; bricks 16 to 18, with padded lanes; no pack in between.
  Row all, some;
  std::vector<bool> acting(bricks, false);
  acting[3] = acting[16] = acting[17] = acting[18] = true;
  some.group->set_acting(acting);
  EXPECT_EQ(some.group->acting_count(), 4);
  StableIncrement of_all, of_some;
  const auto before = some.own_history(bricks / 2);
  const auto force_of_all = all.forces(of_all), force = some.forces(of_some);
  EXPECT_EQ(of_all.element, bricks / 2);
  EXPECT_TRUE(acting[std::min(of_some.element, bricks - 1)]);
  EXPECT_GT(of_some.increment, of_all.increment);
  for (int brick = 0; brick < bricks; ++brick) {
    if (acting[brick])
      EXPECT_EQ(some.own_history(brick), all.own_history(brick)) << brick;
    else
      EXPECT_EQ(some.own_history(brick), before) << brick;
  }
  // The far end belongs to brick 18 alone; nodes between resting bricks get nothing.
  for (int i = 4 * 4 * bricks; i < 4 * 4 * (bricks + 1); ++i) EXPECT_EQ(force[i], force_of_all[i]);
  for (int i = 4 * 4 * 6; i < 4 * 4 * 15; ++i)
    if (i % 4 < 3) EXPECT_EQ(force[i], 0.0);
}

TEST(ActingElements, WhoActsAgainGoesOnAsIfItHadNeverRested) {
  Row rested, other;
  StableIncrement smallest;
  std::vector<bool> acting(bricks, true);
  acting[2] = false;
  rested.group->set_acting(acting);
  rested.forces(smallest);
  rested.group->set_acting({});
  EXPECT_EQ(rested.group->acting_count(), bricks);
  rested.history = other.history;
  EXPECT_EQ(rested.forces(smallest), other.forces(smallest));
  EXPECT_EQ(rested.history, other.history);
}

}  // namespace
}  // namespace balocco
