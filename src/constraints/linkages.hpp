// Which constraints hang together, and which of their rows say nothing new.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Constraints that share nodes, directly or through rigid bodies. They are solved together, so every rank that computes one of the
/// nodes knows all of them: all ranks, where rigid bodies take part.
struct Linkage {
  std::vector<std::int32_t> constraints;  // rows of Model::constraints, rising
  std::vector<std::int32_t> nodes;        // model rows, sorted
  bool has_bodies = false;
};

/// Nodes that a constraint joins, with repetitions.
std::vector<std::int32_t> constrained_nodes(const ConstraintKind& kind);

std::vector<Linkage> find_linkages(const Model& model);

/// Coefficients of a row by column, in any order.
using SparseRow = std::vector<std::pair<std::int64_t, double>>;

/// Rows that are combinations of rows before them (to 1e-9 of their own size), or zero.
std::vector<bool> dependent_rows(const std::vector<SparseRow>& rows);

}  // namespace balocco
