// A cloud against the coupling's own gaps and gradient, node by node.
#include "explicit_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/rotation.hpp"

namespace balocco {
namespace {

constexpr int count = 7;

struct Coupled {
  Model model;
  DistributingCoupling coupling;
  std::vector<double> position, velocity, force, inverse_mass;

  Coupled() {
    coupling.reference = 0;
    for (int i = 0; i <= count; ++i) {
      const double a = 0.9 * i;
      model.nodes.coordinates.push_back({std::cos(a) + 0.1 * i, std::sin(1.3 * a), 0.4 * std::cos(2.0 * a) + 5.0});
      model.nodes.id.push_back(i + 1);
      const auto& x = model.nodes.coordinates.back();
      position.insert(position.end(), {x[0] + 0.02 * std::sin(a), x[1] - 0.03 * std::cos(a), x[2] + 0.01 * i, 0.0});
      velocity.insert(velocity.end(), {0.3 * std::cos(a), 0.2 * i, -0.1 + 0.05 * a, 0.0});
      force.insert(force.end(), {1.0 + a, -0.5 * i, 0.7 * std::sin(a), 0.0});
      inverse_mass.push_back(0.5 + 0.1 * i);
      if (i == 0) continue;
      coupling.nodes.push_back(i);
      coupling.weights.push_back(1.0 + 0.2 * i);
    }
    coupling.freedoms.fill(true);
  }

  std::vector<NodePlace> places(const Matrix3<double>& rotation) const {
    std::vector<NodePlace> places(count + 1);
    for (int i = 0; i <= count; ++i)
      for (int c = 0; c < 3; ++c) places[i].position[c] = position[4 * i + c];
    places[0].rotation = rotation;
    return places;
  }
};

const std::vector<std::int32_t> nodes{1, 2, 3, 4, 5, 6, 7};

/// Of a rank that owns every node that `is_owned` says and computes all.
template <class IsOwned>
Domain domain_with(IsOwned is_owned) {
  Domain domain;
  for (int node = 0; node <= count; ++node) domain.owned.push_back(is_owned(node));
  domain.computed.assign(count + 1, true);
  return domain;
}

class Cloud : public testing::Test {
 protected:
  Coupled coupled;
  DistributingConstraint constraint{coupled.model, coupled.coupling};
  ExplicitCloud cloud{constraint, nodes, domain_with([](int) { return true; }), coupled.inverse_mass};
  const ExplicitCloud::Motion motion{coupled.position.data(), coupled.velocity.data(), coupled.force.data(), 0.02};
  const ExplicitCloud::Largest largest{.place = 100.0, .rate = 1000.0};
  Matrix3<double> rotation = rotation_matrix(exponential(Vector3<double>{0.1, -0.2, 0.15}));
  std::vector<NodePlace> places = coupled.places(rotation);
  Vector6 multipliers{3.0, -2.0, 1.0, 0.5, 4.0, -1.5};

  void SetUp() override {
    cloud.sum(ExplicitCloud::Share::owned, motion, places[0].position, largest);
    cloud.take_sums(places[0].position);
  }
  std::vector<double> gradient() const {
    std::vector<double> gradient(6 * constraint.columns());
    constraint.gradient(places, gradient);
    return gradient;
  }
};

TEST_F(Cloud, AnswersAsItsNodesDo) {
  const auto g = gradient();
  const auto response = cloud.response(rotation);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      double sum = 0.0;
      for (int node = 1; node <= count; ++node)
        for (int c = 0; c < 3; ++c)
          sum += g[i * constraint.columns() + 6 * node + c] * coupled.inverse_mass[node] * g[j * constraint.columns() + 6 * node + c];
      EXPECT_NEAR(response(i, j), sum, 1e-14);
    }
}

TEST_F(Cloud, EndsWhereItsNodesEnd) {
  const double next = 0.03, average = 0.02;
  cloud.find_changes(coupled.force.data(), average, rotation, multipliers);
  auto velocity = coupled.velocity;
  cloud.add_changes(velocity.data());
  const auto g = gradient();
  auto after = places;
  for (int node = 1; node <= count; ++node)
    for (int c = 0; c < 3; ++c) {
      double force = coupled.force[4 * node + c];
      for (int row = 0; row < 6; ++row) force += multipliers[row] * g[row * constraint.columns() + 6 * node + c];
      EXPECT_NEAR(velocity[4 * node + c], coupled.velocity[4 * node + c] + average * coupled.inverse_mass[node] * force, 1e-14);
      after[node].position[c] += next * velocity[4 * node + c];
    }
  std::array<double, 6> by_nodes{}, by_moments{};
  constraint.gaps(after, by_nodes);
  constraint.gaps_of(cloud.places_after(next, average, rotation, multipliers), after[0], by_moments);
  for (int row = 0; row < 6; ++row) EXPECT_NEAR(by_moments[row], by_nodes[row], 1e-14);
}

TEST_F(Cloud, RatesAreThoseOfItsVelocities) {
  const double average = 0.02;
  cloud.find_changes(coupled.force.data(), average, rotation, multipliers);
  auto velocity = coupled.velocity;
  cloud.add_changes(velocity.data());
  const auto g = gradient();
  const auto rates = cloud.rates(average, rotation, multipliers);
  for (int row = 0; row < 6; ++row) {
    double sum = 0.0;
    for (int node = 1; node <= count; ++node)
      for (int c = 0; c < 3; ++c) sum += g[row * constraint.columns() + 6 * node + c] * velocity[4 * node + c];
    EXPECT_NEAR(rates[row], sum, 1e-14);
  }
}

// However ranks share its nodes, sums have the same bits, and those over all nodes in one order have them too.
TEST_F(Cloud, IsSummedByManyRanksAsByOne) {
  for (int ranks = 2; ranks <= count; ++ranks) {
    std::array<double, ExplicitCloud::sum_count> together{};
    for (int rank = 0; rank < ranks; ++rank) {
      ExplicitCloud part{constraint, nodes, domain_with([&](int node) { return node % ranks == rank; }), coupled.inverse_mass};
      part.sum(ExplicitCloud::Share::owned, motion, places[0].position, largest);
      for (std::size_t i = 0; i < together.size(); ++i) together[i] += part.sums()[i];
    }
    for (std::size_t i = 0; i < together.size(); ++i)
      if (i % 4 != 3) EXPECT_EQ(together[i], cloud.sums()[i]) << i << " on " << ranks;  // vectors of four, the last of which is nothing
  }
  const std::vector<double> before(cloud.sums().begin(), cloud.sums().end());
  cloud.sum(ExplicitCloud::Share::whole, motion, places[0].position, largest);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (i % 4 != 3) EXPECT_EQ(before[i], cloud.sums()[i]) << i;
}

// The gradient that a cloud leaves to the reference node, against differences of the gaps.
TEST_F(Cloud, LeavesTheReferenceItsGradient) {
  std::array<double, 36> of_reference{};
  constraint.reference_gradient(cloud.places(), rotation, of_reference);
  const double step = 1e-6;
  for (int column = 0; column < 6; ++column) {
    std::array<double, 6> up{}, down{};
    for (auto* gaps : {&up, &down}) {
      auto moved = places;
      const double sign = gaps == &up ? step : -step;
      Vector3<double> spin{};
      (column < 3 ? moved[0].position : spin)[column % 3] += sign;
      moved[0].rotation = rotation_matrix(exponential(spin)) * moved[0].rotation;
      constraint.gaps(moved, *gaps);
    }
    for (int row = 0; row < 6; ++row) EXPECT_NEAR(of_reference[6 * row + column], (up[row] - down[row]) / (2.0 * step), 1e-8);
  }
}

}  // namespace
}  // namespace balocco
