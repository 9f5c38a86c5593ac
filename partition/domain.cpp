#include "domain.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "constraints/linkages.hpp"
#include "element_graph.hpp"
#include "elements/element_type.hpp"
#include "elements/turning_nodes.hpp"
#include "hilbert.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

/// Everything that the pieces of a domain are derived from, the same on every rank.
struct Partition {
  const Model& model;
  std::vector<ElementRef> elements;
  std::vector<std::int32_t> part;  // of each element
  std::vector<bool> reference;     // per model node: reference node of a rigid body
  std::vector<bool> turns;         // per model node
  std::vector<std::int32_t> owner; // of each model node: lowest rank whose elements touch it, rank 0 where none does
  /// Nodes of each linkage, all of which are on all of its ranks.
  struct Shared {
    std::vector<std::int32_t> nodes;
    std::set<std::int32_t> ranks;
  };
  std::vector<Shared> linkages;

  std::span<const std::int32_t> nodes(std::size_t element) const {
    const auto& table = model.elements[elements[element].table];
    const auto count = static_cast<std::size_t>(table.type->nodes);
    return {table.connectivity.data() + count * static_cast<std::size_t>(elements[element].row), count};
  }
};

/// The root partitions and tells the others, so that machines with different arithmetic cannot disagree.
std::vector<std::int32_t> partition_elements(const Graph& graph, const Communicator& communicator,
                                             const Partitioner& partitioner) {
  const std::size_t vertices = graph.weight.size();
  std::vector<std::int32_t> part(vertices);
  communicator.together([&] {
    if (!communicator.is_root()) return;
    part = partitioner(graph, communicator.size());
    const auto outside = [&](std::int32_t p) { return p < 0 || p >= communicator.size(); };
    if (part.size() != vertices || std::any_of(part.begin(), part.end(), outside))
      throw SystemError("the partitioner left an element without a rank");
  });
  MPI_Bcast(part.data(), static_cast<int>(vertices), MPI_INT32_T, 0, communicator.handle());
  return part;
}

std::vector<std::int32_t> node_owners(const Partition& partition) {
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  std::vector<std::int32_t> owner(static_cast<std::size_t>(partition.model.nodes.size()), none);
  for (std::size_t e = 0; e < partition.elements.size(); ++e)
    for (const std::int32_t node : partition.nodes(e)) owner[node] = std::min(owner[node], partition.part[e]);
  for (auto& rank : owner)
    if (rank == none) rank = 0;
  return owner;
}

/// Every rank that computes a node of a linkage, or all of them where bodies take part, as bodies move on every rank.
std::vector<Partition::Shared> shared_linkages(const Partition& partition, int ranks) {
  std::vector<Partition::Shared> shared;
  std::vector<std::vector<std::size_t>> linkages_of(static_cast<std::size_t>(partition.model.nodes.size()));
  for (auto& linkage : find_linkages(partition.model)) {
    auto& entry = shared.emplace_back(Partition::Shared{std::move(linkage.nodes), {}});
    for (const auto node : entry.nodes) {
      linkages_of[node].push_back(shared.size() - 1);
      entry.ranks.insert(partition.owner[node]);
    }
    for (int rank = 0; rank < ranks && linkage.has_bodies; ++rank) entry.ranks.insert(rank);
  }
  if (shared.empty()) return shared;
  for (std::size_t e = 0; e < partition.elements.size(); ++e)
    for (const std::int32_t node : partition.nodes(e))
      for (const auto index : linkages_of[node]) shared[index].ranks.insert(partition.part[e]);
  return shared;
}

Partition make_partition(const Model& model, const Communicator& communicator, const Partitioner& partitioner) {
  Partition partition{model,
                      graph_elements(model),
                      {},
                      std::vector<bool>(static_cast<std::size_t>(model.nodes.size())),
                      turning_nodes(model),
                      {},
                      {}};
  if (communicator.size() == 1)
    partition.part.assign(partition.elements.size(), 0);
  else
    partition.part = partition_elements(element_graph(model, partition.elements), communicator, partitioner);
  for (const auto& body : model.rigid_bodies) partition.reference[body.reference_node] = true;
  partition.owner = node_owners(partition);
  partition.linkages = shared_linkages(partition, communicator.size());
  return partition;
}

/// Fills node_row, local_node, owned and turning: nodes that turn first, along the Hilbert curve, reference nodes last.
void number_nodes(const Partition& partition, int rank, Domain& domain) {
  const auto& nodes = partition.model.nodes;
  const auto& owner = partition.owner;
  std::vector<bool> present = partition.reference;
  for (std::size_t e = 0; e < partition.elements.size(); ++e)
    if (partition.part[e] == rank)
      for (const std::int32_t node : partition.nodes(e)) present[node] = true;
  for (const auto& linkage : partition.linkages)
    if (linkage.ranks.contains(rank))
      for (const auto node : linkage.nodes) present[node] = true;

  struct Place {
    bool stays_upright, reference;
    std::uint64_t curve;
    std::int32_t row;
    auto operator<=>(const Place&) const = default;
  };
  const BoundingBox box = bounding_box(nodes.coordinates);
  std::vector<Place> places;
  for (std::int32_t row = 0; row < nodes.size(); ++row)
    if (present[row] || owner[row] == rank)
      places.push_back({!partition.turns[row], partition.reference[row], hilbert_index(nodes.coordinates[row], box), row});
  std::sort(places.begin(), places.end());

  domain.local_node.assign(static_cast<std::size_t>(nodes.size()), -1);
  for (const auto& place : places) {
    domain.local_node[place.row] = domain.size();
    domain.node_row.push_back(place.row);
    domain.owned.push_back(owner[place.row] == rank);
    if (!place.stays_upright) ++domain.turning;
  }
}

/// Nodes shared with each other rank, by model row on both sides.
std::vector<SharedNodes> shared_nodes(const Partition& partition, const Communicator& communicator,
                                      const Domain& domain) {
  std::map<int, std::vector<std::int32_t>> rows;  // other rank -> model rows
  for (std::size_t e = 0; e < partition.elements.size(); ++e) {
    if (partition.part[e] == communicator.rank()) continue;
    for (const std::int32_t node : partition.nodes(e))
      if (domain.local_node[node] >= 0 && !partition.reference[node]) rows[partition.part[e]].push_back(node);
  }
  for (int other = 0; other < communicator.size(); ++other)
    if (other != communicator.rank())
      for (const auto& body : partition.model.rigid_bodies) rows[other].push_back(body.reference_node);
  for (const auto& linkage : partition.linkages) {
    if (!linkage.ranks.contains(communicator.rank())) continue;
    for (const auto other : linkage.ranks)
      if (other != communicator.rank()) rows[other].insert(rows[other].end(), linkage.nodes.begin(), linkage.nodes.end());
  }

  std::vector<SharedNodes> neighbours;
  for (auto& [rank, list] : rows) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    for (auto& node : list) node = domain.local_node[node];
    neighbours.push_back({rank, std::move(list)});
  }
  return neighbours;
}

Point centroid(const Model& model, std::span<const std::int32_t> nodes) {
  Point center{};
  for (const std::int32_t node : nodes)
    for (std::size_t c = 0; c < 3; ++c)
      center[c] += model.nodes.coordinates[node][c] / static_cast<double>(nodes.size());
  return center;
}

/// One element of this rank with its place in the order in which elements are computed.
struct Placed {
  std::int32_t table, section;
  bool interior;
  std::uint64_t curve;
  std::int32_t row;
  std::size_t element;
  auto operator<=>(const Placed&) const = default;
};

std::vector<Placed> ordered_elements(const Partition& partition, int rank, const std::vector<bool>& is_shared) {
  const BoundingBox box = bounding_box(partition.model.nodes.coordinates);
  std::vector<Placed> order;
  for (std::size_t e = 0; e < partition.elements.size(); ++e) {
    if (partition.part[e] != rank) continue;
    const auto nodes = partition.nodes(e);
    const auto [table, row] = partition.elements[e];
    const bool interior = std::none_of(nodes.begin(), nodes.end(), [&](std::int32_t node) { return is_shared[node]; });
    const std::uint64_t curve = hilbert_index(centroid(partition.model, nodes), box);
    order.push_back({table, partition.model.elements[table].section[row], interior, curve, row, e});
  }
  std::sort(order.begin(), order.end());
  return order;
}

void make_groups(const Partition& partition, int rank, const std::vector<SharedNodes>& neighbours, Domain& domain) {
  std::vector<bool> is_shared(static_cast<std::size_t>(partition.model.nodes.size()), false);
  for (const auto& neighbour : neighbours)
    for (const std::int32_t node : neighbour.nodes) is_shared[domain.node_row[node]] = true;
  for (const auto& placed : ordered_elements(partition, rank, is_shared)) {
    auto& groups = domain.groups;
    if (groups.empty() || groups.back().table != placed.table || groups.back().section != placed.section)
      groups.push_back({.model = partition.model,
                        .table = placed.table,
                        .section = placed.section,
                        .rows = {},
                        .interface_count = 0,
                        .connectivity = {},
                        .scratch_node = domain.scratch_node()});
    auto& group = groups.back();
    group.rows.push_back(placed.row);
    if (!placed.interior) ++group.interface_count;
    for (const std::int32_t node : partition.nodes(placed.element))
      group.connectivity.push_back(domain.local_node[node]);
  }
}

}  // namespace

Domain make_domain(const Model& model, const Communicator& communicator, const Partitioner& partitioner) {
  const Partition partition = make_partition(model, communicator, partitioner);
  Domain domain;
  number_nodes(partition, communicator.rank(), domain);
  auto neighbours = shared_nodes(partition, communicator, domain);
  make_groups(partition, communicator.rank(), neighbours, domain);
  domain.halo = std::make_unique<Halo>(communicator, std::move(neighbours), domain.turning, Halo::Tag::domain);
  return domain;
}

}  // namespace balocco
