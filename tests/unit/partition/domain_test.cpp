// Domains and their halos; these tests hold on any number of ranks, also when the program runs as one process.
#include "domain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "element_graph.hpp"
#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

std::unique_ptr<ElementGroup> no_group(const GroupInput&) {
  return nullptr;
}

const ElementType brick{.name = "C3D8R", .shape = Shape::hexahedron, .nodes = 8, .faces = {}, .make_group = no_group};
const ElementType membrane{
    .name = "M3D4R", .shape = Shape::quadrilateral, .nodes = 4, .faces = {}, .make_group = no_group};

/// A block of n x n x n bricks in two sections, a membrane skin on its floor, an orphan node and a rigid body whose
/// reference node no element touches.
Model block(std::int32_t n) {
  Model model;
  const auto node = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) model.nodes.coordinates.push_back({1.0 * i, 1.0 * j, 1.0 * k});
  model.nodes.coordinates.push_back({-1.0, 0.0, 0.0});
  model.nodes.coordinates.push_back({0.0, 0.0, -1.0});
  for (std::size_t row = 0; row < model.nodes.coordinates.size(); ++row)
    model.nodes.id.push_back(static_cast<std::int64_t>(row) + 1);
  ElementTable bricks{.type = &brick, .id = {}, .connectivity = {}, .section = {}, .location = {}};
  ElementTable skin{.type = &membrane, .id = {}, .connectivity = {}, .section = {}, .location = {}};
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        bricks.id.push_back(bricks.size() + 1);
        bricks.section.push_back(k < n / 2 ? 0 : 1);
        for (const auto& [a, b, c] :
             {std::array{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
          bricks.connectivity.push_back(node(i + a, j + b, k + c));
        if (k > 0) continue;
        skin.id.push_back(100000 + skin.size());
        skin.section.push_back(2);
        for (const auto& [a, b] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}})
          skin.connectivity.push_back(node(i + a, j + b, 0));
      }
    }
  }
  model.elements = {bricks, skin};
  model.sections.resize(3);
  RigidBody body;
  body.reference_node = model.nodes.size() - 1;
  model.rigid_bodies.push_back(body);
  return model;
}

/// Deals elements out like cards: almost every node is shared.
std::vector<std::int32_t> round_robin(const Graph& graph, int parts) {
  std::vector<std::int32_t> part(graph.weight.size());
  for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<std::int32_t>(i) % parts;
  return part;
}

std::vector<std::int32_t> all_on_last(const Graph& graph, int parts) {
  return std::vector<std::int32_t>(graph.weight.size(), parts - 1);
}

/// Force of an element on its node `corner`: any number that fills the whole mantissa.
double contribution(std::int32_t table, std::int32_t row, int corner, int component) {
  return std::sin(1.0 + 7.0 * table + 3.1 * row + 0.7 * corner + 0.3 * component);
}

struct Case {
  const char* name;
  Partitioner partitioner;
};

class DomainOf : public testing::TestWithParam<Case> {
 protected:
  Communicator communicator;
  Model model = block(6);
  Domain domain = make_domain(model, communicator, GetParam().partitioner);
  std::size_t rows() const { return static_cast<std::size_t>(model.nodes.size()); }
};

TEST_P(DomainOf, HasEveryElementOnceAndOwnsEveryNodeOnce) {
  for (std::size_t t = 0; t < model.elements.size(); ++t) {
    std::vector<double> count(static_cast<std::size_t>(model.elements[t].size()), 0.0);
    for (const auto& group : domain.groups) {
      if (group.table != static_cast<std::int32_t>(t)) continue;
      for (const std::int32_t row : group.rows) {
        count[row] += 1.0;
        EXPECT_EQ(model.elements[t].section[row], group.section);
      }
    }
    communicator.sum(count);
    EXPECT_EQ(count, std::vector<double>(count.size(), 1.0));
  }
  std::vector<double> owners(rows(), 0.0);
  for (std::int32_t node = 0; node < domain.size(); ++node)
    owners[domain.node_row[node]] += domain.owned[node] ? 1.0 : 0.0;
  communicator.sum(owners);
  EXPECT_EQ(owners, std::vector<double>(rows(), 1.0));
  EXPECT_GE(domain.local_node[model.rigid_bodies[0].reference_node], 0) << "every rank holds reference nodes";
  EXPECT_EQ(domain.node_row.back(), model.rigid_bodies[0].reference_node) << "reference nodes come last";
}

TEST_P(DomainOf, ConnectivityIsTheModels) {
  for (const auto& group : domain.groups) {
    const auto& table = model.elements[group.table];
    const auto count = static_cast<std::size_t>(table.type->nodes);
    for (std::size_t i = 0; i < group.rows.size(); ++i)
      for (std::size_t corner = 0; corner < count; ++corner)
        EXPECT_EQ(domain.node_row[group.connectivity[i * count + corner]],
                  table.connectivity[group.rows[i] * count + corner]);
  }
}

TEST_P(DomainOf, InteriorElementsTouchNoSharedNode) {
  std::set<std::int32_t> shared;
  for (const auto& neighbour : domain.halo->neighbours()) shared.insert(neighbour.nodes.begin(), neighbour.nodes.end());
  for (const auto& group : domain.groups) {
    const auto count = static_cast<std::size_t>(model.elements[group.table].type->nodes);
    for (std::size_t i = 0; i < group.rows.size(); ++i) {
      const auto begin = group.connectivity.begin() + static_cast<std::ptrdiff_t>(i * count);
      const bool touches = std::any_of(begin, begin + static_cast<std::ptrdiff_t>(count),
                                       [&](std::int32_t node) { return shared.contains(node); });
      EXPECT_EQ(touches, static_cast<std::int32_t>(i) < group.interface_count);
    }
  }
}

TEST_P(DomainOf, SumOfOnesIsTheMultiplicity) {
  std::vector<double> multiplicity(rows(), 0.0);
  for (const std::int32_t row : domain.node_row) multiplicity[row] = 1.0;
  communicator.sum(multiplicity);
  std::vector<double> values(4 * static_cast<std::size_t>(domain.size()), 1.0);
  for (int cycle = 0; cycle < 2; ++cycle) {  // the second cycle shows that requests start again
    std::fill(values.begin(), values.end(), 1.0);
    domain.halo->begin_sum(values.data());
    domain.halo->finish_sum(values.data());
  }
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(values[4 * node + c], multiplicity[domain.node_row[node]]);
    EXPECT_EQ(values[4 * node + 3], 1.0) << "the fourth slot does not travel";
  }
}

TEST_P(DomainOf, SeveralFieldsTravelTogether) {
  const auto size = 4 * static_cast<std::size_t>(domain.size());
  std::vector<double> multiplicity(size, 1.0), twice(size, 2.0), moments(size, 3.0), rest(size, 4.0);
  domain.halo->begin_sum(multiplicity.data());
  domain.halo->finish_sum(multiplicity.data());
  Halo halo(communicator, domain.halo->neighbours(), domain.size(), Halo::Tag::step, 2);
  std::vector<double> once(size, 1.0);
  const std::array<NodalForces, 2> fields{{{once.data(), moments.data()}, {twice.data(), rest.data()}}};
  halo.begin_sum(fields);
  halo.finish_sum(fields);
  EXPECT_EQ(once, multiplicity);
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    EXPECT_EQ(twice[4 * node], 2.0 * multiplicity[4 * node]);
    EXPECT_EQ(moments[4 * node + 2], 3.0 * multiplicity[4 * node]);
    EXPECT_EQ(rest[4 * node + 2], 4.0 * multiplicity[4 * node]);
  }
}

TEST_P(DomainOf, RoundedSumsAreThoseOfOneRankBitForBit) {
  const double constant = rounding_constant(64.0);
  std::vector<double> values(4 * static_cast<std::size_t>(domain.size()), 0.0);
  for (const auto& group : domain.groups) {
    const auto count = static_cast<std::size_t>(model.elements[group.table].type->nodes);
    for (std::size_t i = 0; i < group.connectivity.size(); ++i)
      for (int c = 0; c < 3; ++c)
        values[4 * group.connectivity[i] + c] +=
            rounded(contribution(group.table, group.rows[i / count], static_cast<int>(i % count), c), constant);
  }
  domain.halo->begin_sum(values.data());
  domain.halo->finish_sum(values.data());

  std::vector<double> whole(3 * rows(), 0.0);
  for (std::size_t t = 0; t < model.elements.size(); ++t) {
    const auto& table = model.elements[t];
    const auto count = static_cast<std::size_t>(table.type->nodes);
    for (std::size_t i = 0; i < table.connectivity.size(); ++i)
      for (int c = 0; c < 3; ++c)
        whole[3 * table.connectivity[i] + c] +=
            rounded(contribution(static_cast<std::int32_t>(t), static_cast<std::int32_t>(i / count),
                                 static_cast<int>(i % count), c),
                    constant);
  }
  for (std::int32_t node = 0; node < domain.size(); ++node)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(values[4 * node + c], whole[3 * domain.node_row[node] + c]);
}
TEST_P(DomainOf, CopiesTakeTheValuesOfTheirOwners) {
  const auto value = [&](std::int32_t node, int c) { return std::sin(1.0 + domain.node_row[node] + 0.3 * c); };
  const auto nodes = domain.size() - 1;  // as of nodes that turn: fewer than there are
  std::vector<double> values(4 * static_cast<std::size_t>(nodes), -1.0);
  for (std::int32_t node = 0; node < nodes; ++node)
    for (int c = 0; c < 4 && domain.owned[node]; ++c) values[4 * node + c] = value(node, c);
  copy_from_owners(communicator, domain.halo->neighbours(), domain.owned, values);
  for (std::int32_t node = 0; node < nodes; ++node)
    for (int c = 0; c < 4; ++c) EXPECT_EQ(values[4 * node + c], value(node, c));
}

/// Every rank knows all nodes of a coupling across the block, but computes those of its elements and what it owns alone.
TEST_P(DomainOf, TellsNodesItComputesFromThoseItOnlyKnows) {
  DistributingCoupling coupling;
  coupling.reference = 0;
  for (std::int32_t node = 1; node < model.nodes.size() - 2; ++node) coupling.nodes.push_back(node);
  coupling.weights.assign(coupling.nodes.size(), 1.0);
  model.constraints.push_back({.kind = coupling, .keyword = "*COUPLING"});
  domain = make_domain(model, communicator, GetParam().partitioner);
  std::set<std::int32_t> needed;
  for (const auto& group : domain.groups) needed.insert(group.connectivity.begin(), group.connectivity.end());
  std::vector<double> computing(rows(), 0.0), ones(4 * static_cast<std::size_t>(domain.size()), 1.0);
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    const bool is_reference = domain.node_row[node] == model.rigid_bodies.front().reference_node;
    EXPECT_EQ(domain.computed[node], needed.contains(node) || domain.owned[node] || is_reference);
    if (domain.computed[node]) computing[domain.node_row[node]] += 1.0;
  }
  communicator.sum(computing);
  Halo halo(communicator, domain.computed_by_both, domain.turning, Halo::Tag::step);
  halo.begin_sum(ones.data());
  halo.finish_sum(ones.data());
  for (std::int32_t node = 0; node < domain.size(); ++node)
    if (domain.computed[node]) EXPECT_EQ(ones[4 * node], computing[domain.node_row[node]]);
}

INSTANTIATE_TEST_SUITE_P(Partitioners, DomainOf,
                         testing::Values(Case{"metis", metis_partition}, Case{"round_robin", round_robin},
                                         Case{"all_on_last", all_on_last}),
                         [](const auto& test) { return test.param.name; });

TEST(MetisPartition, IsBalancedDeterministicAndConnectsFaces) {
  const Model model = block(12);
  const Graph graph = element_graph(model, graph_elements(model));
  ASSERT_EQ(graph.weight.size(), 12u * 12 * 12 + 144);
  // A brick inside the block has six neighbours, one for each face.
  const std::size_t inside = (6 * 12 + 6) * 12 + 6;
  EXPECT_EQ(graph.first[inside + 1] - graph.first[inside], 6);
  for (const int parts : {2, 3, 7, 16}) {
    const auto part = metis_partition(graph, parts);
    EXPECT_EQ(part, metis_partition(graph, parts));
    std::vector<std::int64_t> load(static_cast<std::size_t>(parts), 0);
    std::int64_t total = 0;
    for (std::size_t v = 0; v < part.size(); ++v) {
      load[part[v]] += graph.weight[v];
      total += graph.weight[v];
    }
    // METIS promises 3 % (k-way) and an element is 1 % of the smallest part here.
    EXPECT_LE(*std::max_element(load.begin(), load.end()) * parts, total + total / 20) << parts << " parts";
  }
}

TEST(ElementGraph, WhatARigidBodyCarriesForGoodHardlyWeighs) {
  Model model = block(4);
  auto& body = model.rigid_bodies.front();
  for (std::int32_t node = 0; node < 3 * 25; ++node) body.tie_nodes.push_back(node);  // the floor, two layers of bricks
  const auto weights = [&] { return element_graph(model, graph_elements(model)).weight; };
  const auto carried = weights();
  for (std::size_t brick = 0; brick < 64; ++brick) EXPECT_EQ(carried[brick] > 1, brick >= 32) << brick;
  EXPECT_EQ(carried.back(), 1);  // the skin
  model.steps.resize(1);
  model.steps.front().attachments.push_back({.rigid_body = 0, .nodes = {0}, .release = true});
  const auto released = weights();
  for (std::size_t brick = 0; brick < 64; ++brick) EXPECT_EQ(released[brick] > 1, brick >= 32 || brick == 0) << brick;
}

TEST(ElementGraph, JoinsWhatJointsJoin) {
  Model model = block(2);
  const auto neighbours = [&] { return element_graph(model, graph_elements(model)).neighbour.size(); };
  const auto before = neighbours();
  model.constraints.push_back({.kind = Joint{.nodes = {0, 26}}, .keyword = "*MPC"});  // opposite corners
  EXPECT_EQ(neighbours(), before + 4);  // brick to brick and the skin's corner to the other brick, both ways
  DistributingCoupling wide{.reference = 0};
  for (std::int32_t node = 1; node < 27; ++node) wide.nodes.push_back(node);
  model.constraints.push_back({.kind = wide, .keyword = "*COUPLING"});
  EXPECT_EQ(neighbours(), before + 4) << "clouds join nobody";
}

TEST(MetisPartition, FewerElementsThanParts) {
  const Model model = block(1);
  const Graph graph = element_graph(model, graph_elements(model));
  EXPECT_EQ(metis_partition(graph, 5), (std::vector<std::int32_t>{0, 1}));
}

TEST(Domain, PartitionerThatLosesAnElementIsRefusedOnEveryRank) {
  const Communicator communicator;
  if (communicator.size() == 1) GTEST_SKIP() << "one rank asks no partitioner";
  const auto lost = [](const Graph& graph, int) { return std::vector<std::int32_t>(graph.weight.size(), -1); };
  EXPECT_THROW(make_domain(block(2), communicator, lost), SystemError);
}

}  // namespace
}  // namespace balocco
