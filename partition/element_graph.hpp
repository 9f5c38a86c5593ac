// The graph that is partitioned: a vertex for every element that computes forces, an edge between elements that share a
// face (solids), an edge line (membranes) or a node (trusses), or that constraints of few nodes join.
#pragma once

#include <cstdint>
#include <vector>

#include "domain.hpp"
#include "model/model.hpp"

namespace balocco {

/// Elements with a force kernel, in table order: the vertices. MASS and ROTARYI live where their node lives.
std::vector<ElementRef> graph_elements(const Model& model);

Graph element_graph(const Model& model, const std::vector<ElementRef>& elements);

}  // namespace balocco
