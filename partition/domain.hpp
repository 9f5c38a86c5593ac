// The part of the model that one rank computes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "communicator.hpp"
#include "elements/element_group.hpp"
#include "halo.hpp"
#include "model/model.hpp"

namespace balocco {

/// An undirected graph in compressed rows, with a weight for each vertex.
struct Graph {
  std::vector<std::int64_t> first;      // vertices + 1
  std::vector<std::int64_t> neighbour;
  std::vector<std::int64_t> weight;
};

/// Assigns each vertex of a graph to one of `parts`. Deterministic: every rank computes the same. Tests inject their own.
using Partitioner = std::function<std::vector<std::int32_t>(const Graph&, int parts)>;
std::vector<std::int32_t> metis_partition(const Graph& graph, int parts);

/// Local nodes: those of the rank's elements, the reference node of every rigid body (on every rank), and all nodes of the linkages
/// (constraints/linkages.hpp) that a node of the rank belongs to, and of the contact pairs with deformable masters. Elements follow a Hilbert curve; nodes are numbered as the elements come to them, those that turn first.
struct Domain {
  std::vector<std::int32_t> node_row;   // local node -> model row
  std::vector<std::int32_t> local_node;  // model row -> local node, -1: not on this rank
  std::vector<bool> owned;              // per local node: exactly one copy of each node is owned
  std::vector<bool> computed;           // per local node: this rank computes forces there, or may; others are here for their linkage's sake
  std::int32_t turning = 0;             // local nodes [0, turning) rotate (elements/turning_nodes.hpp)
  std::vector<GroupInput> groups;       // elements of this rank by table and section, in table order (no MASS, ROTARYI); an Analysis
                                        // makes its element groups of them and leaves none
  std::unique_ptr<Halo> halo;
  std::vector<SharedNodes> computed_by_both;  // of the halo's nodes, likewise: those that both ranks compute

  std::int32_t size() const { return static_cast<std::int32_t>(node_row.size()); }
  std::int32_t scratch_node() const { return size(); }
};

Domain make_domain(const Model& model, const Communicator& communicator, const Partitioner& partitioner = metis_partition);

}  // namespace balocco
