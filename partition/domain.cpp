#include "domain.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "constraints/linkages.hpp"
#include "element_graph.hpp"
#include "elements/element_type.hpp"
#include "elements/surface_nodes.hpp"
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
  std::vector<std::int32_t> owner;  // of each model node: lowest rank whose elements touch it, rank 0 where none does
  /// Nodes of a linkage or a contact pair, all of which are on all of its ranks.
  struct Shared {
    std::vector<std::int32_t> nodes;
    std::set<std::int32_t> ranks;
  };
  std::vector<Shared> shared;

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

/// Both surfaces of each contact pair whose master deforms: any of its places may come upon any of its faces.
std::vector<Partition::Shared> shared_contacts(const Model& model) {
  std::vector<Partition::Shared> shared;
  for (const auto& pair : model.contact_pairs) {
    if (!deforms(model, model.surfaces[pair.master])) continue;
    auto& nodes = shared.emplace_back().nodes;
    for (const auto surface : {pair.slave, pair.master}) std::ranges::copy(surface_nodes(model, model.surfaces[surface]), std::back_inserter(nodes));
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return shared;
}

/// Fills in the ranks: those that compute one of the nodes.
void find_ranks(const Partition& partition, std::vector<Partition::Shared>& shared) {
  std::vector<std::vector<std::size_t>> shared_of(static_cast<std::size_t>(partition.model.nodes.size()));
  for (std::size_t i = 0; i < shared.size(); ++i)
    for (const auto node : shared[i].nodes) {
      shared_of[node].push_back(i);
      shared[i].ranks.insert(partition.owner[node]);
    }
  for (std::size_t e = 0; e < partition.elements.size() && !shared.empty(); ++e)
    for (const std::int32_t node : partition.nodes(e))
      for (const auto index : shared_of[node]) shared[index].ranks.insert(partition.part[e]);
}

/// Linkages are on every rank that computes one of their nodes or knows it from contact, or on all of them where bodies take part, as
/// bodies move on every rank.
std::vector<Partition::Shared> find_shared(const Partition& partition, int ranks) {
  auto contacts = shared_contacts(partition.model);
  find_ranks(partition, contacts);
  std::vector<Partition::Shared> shared;
  std::vector<bool> has_bodies;
  for (auto& linkage : find_linkages(partition.model)) {
    shared.push_back({std::move(linkage.nodes), {}});
    has_bodies.push_back(linkage.has_bodies);
  }
  find_ranks(partition, shared);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    for (int rank = 0; rank < ranks && has_bodies[i]; ++rank) shared[i].ranks.insert(rank);
    for (const auto& contact : contacts)
      if (std::ranges::any_of(shared[i].nodes, [&](auto node) { return std::ranges::binary_search(contact.nodes, node); }))
        shared[i].ranks.insert(contact.ranks.begin(), contact.ranks.end());
  }
  std::ranges::move(contacts, std::back_inserter(shared));
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
  partition.shared = find_shared(partition, communicator.size());
  return partition;
}

/// Per model node: whether an element of this rank touches it.
std::vector<bool> touched_nodes(const Partition& partition, int rank) {
  std::vector<bool> touched(static_cast<std::size_t>(partition.model.nodes.size()), false);
  for (std::size_t e = 0; e < partition.elements.size(); ++e)
    if (partition.part[e] == rank)
      for (const std::int32_t node : partition.nodes(e)) touched[node] = true;
  return touched;
}

/// Model rows of nodes by another rank, sorted, so that they are in the same order on both sides.
using SharedRows = std::map<int, std::vector<std::int32_t>>;

SharedRows shared_rows(const Partition& partition, const Communicator& communicator) {
  const auto touched = touched_nodes(partition, communicator.rank());
  SharedRows shared;
  for (std::size_t e = 0; e < partition.elements.size(); ++e) {
    if (partition.part[e] == communicator.rank()) continue;
    for (const std::int32_t node : partition.nodes(e))
      if (touched[node] && !partition.reference[node]) shared[partition.part[e]].push_back(node);
  }
  for (int other = 0; other < communicator.size(); ++other)
    if (other != communicator.rank())
      for (const auto& body : partition.model.rigid_bodies) shared[other].push_back(body.reference_node);
  for (const auto& together : partition.shared) {
    if (!together.ranks.contains(communicator.rank())) continue;
    for (const auto other : together.ranks)
      if (other != communicator.rank()) shared[other].insert(shared[other].end(), together.nodes.begin(), together.nodes.end());
  }
  for (auto& [rank, rows] : shared) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  }
  return shared;
}

/// Per model node: whether a rank that knows it computes forces there, as those of its elements, of what it owns, of reference nodes and
/// of all that may touch something.
std::vector<bool> computed_nodes(const Partition& partition, int rank) {
  auto computed = touched_nodes(partition, rank);
  for (std::size_t row = 0; row < computed.size(); ++row)
    if (partition.reference[row] || partition.owner[row] == rank) computed[row] = true;
  for (const auto& pair : partition.model.contact_pairs)
    for (const auto surface : {pair.slave, pair.master})
      for (const auto row : surface_nodes(partition.model, partition.model.surfaces[surface])) computed[row] = true;
  return computed;
}

SharedRows rows_computed_by_both(const Partition& partition, int rank, SharedRows shared) {
  const auto here = computed_nodes(partition, rank);
  for (auto& [other, rows] : shared) {
    const auto there = computed_nodes(partition, other);
    std::erase_if(rows, [&](std::int32_t row) { return !here[row] || !there[row]; });
  }
  return shared;
}

std::vector<SharedNodes> local_nodes_of(const SharedRows& shared, const Domain& domain) {
  std::vector<SharedNodes> neighbours;
  for (const auto& [rank, rows] : shared) {
    neighbours.push_back({rank, {}});
    for (const std::int32_t row : rows) neighbours.back().nodes.push_back(domain.local_node[row]);
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

/// Fills node_row, local_node, owned, computed and turning: nodes that turn first, reference nodes last, each kind in the order in which the
/// elements come to them, so that a pass over the elements meets new nodes one after the other in memory.
void number_nodes(const Partition& partition, int rank, std::span<const Placed> order, Domain& domain) {
  const auto count = partition.model.nodes.size();
  std::vector<bool> present(static_cast<std::size_t>(count), false);
  const auto add = [&](std::int32_t row) {
    if (!present[row]) domain.node_row.push_back(row);
    present[row] = true;
  };
  for (const auto& placed : order)
    for (const std::int32_t node : partition.nodes(placed.element)) add(node);
  const auto& owner = partition.owner;
  for (const auto& together : partition.shared)
    if (together.ranks.contains(rank))
      for (const auto row : together.nodes) add(row);
  for (std::int32_t row = 0; row < count; ++row)
    if (partition.reference[row] || owner[row] == rank) add(row);
  std::ranges::stable_sort(domain.node_row, {}, [&](std::int32_t row) {
    return std::pair<bool, bool>(!partition.turns[row], partition.reference[row]);
  });

  const auto computed = computed_nodes(partition, rank);
  domain.local_node.assign(static_cast<std::size_t>(count), -1);
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    const auto row = domain.node_row[node];
    domain.local_node[row] = node;
    domain.owned.push_back(owner[row] == rank);
    domain.computed.push_back(computed[row]);
    if (partition.turns[row]) ++domain.turning;
  }
}

void make_groups(const Partition& partition, std::span<const Placed> order, Domain& domain) {
  for (const auto& placed : order) {
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
  const auto shared = shared_rows(partition, communicator);
  std::vector<bool> is_shared(static_cast<std::size_t>(model.nodes.size()), false);
  for (const auto& [rank, rows] : shared)
    for (const std::int32_t row : rows) is_shared[row] = true;
  const auto order = ordered_elements(partition, communicator.rank(), is_shared);

  Domain domain;
  number_nodes(partition, communicator.rank(), order, domain);
  make_groups(partition, order, domain);
  domain.halo = std::make_unique<Halo>(communicator, local_nodes_of(shared, domain), domain.turning, Halo::Tag::domain);
  domain.computed_by_both = local_nodes_of(rows_computed_by_both(partition, communicator.rank(), shared), domain);
  return domain;
}

}  // namespace balocco
