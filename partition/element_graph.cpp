#include "element_graph.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "elements/element_type.hpp"
#include "materials/material_option.hpp"
#include "model/rigid_constraints.hpp"

namespace balocco {

namespace {

std::span<const std::int32_t> nodes_of(const Model& model, ElementRef element) {
  const auto& table = model.elements[element.table];
  const auto count = static_cast<std::size_t>(table.type->nodes);
  return {table.connectivity.data() + count * static_cast<std::size_t>(element.row), count};
}

/// Nodes that two elements must share to be neighbours; of a mixed pair the lower count decides.
int nodes_of_an_edge(Shape shape) {
  switch (shape) {
    case Shape::hexahedron:
      return 4;
    case Shape::wedge:
    case Shape::tetrahedron:
      return 3;
    case Shape::quadratic_hexahedron:
      return 8;
    case Shape::quadratic_tetrahedron:
    case Shape::quadratic_wedge:
      return 6;
    case Shape::quadrilateral:
    case Shape::triangle:
      return 2;
    default:
      return 1;
  }
}

/// Elements around each node, in compressed rows.
struct NodeElements {
  std::vector<std::int64_t> first;
  std::vector<std::int32_t> element;
};

NodeElements elements_around_nodes(const Model& model, const std::vector<ElementRef>& elements) {
  NodeElements around;
  around.first.assign(static_cast<std::size_t>(model.nodes.size()) + 1, 0);
  for (const auto& element : elements)
    for (const std::int32_t node : nodes_of(model, element)) ++around.first[node + 1];
  for (std::size_t i = 1; i < around.first.size(); ++i) around.first[i] += around.first[i - 1];
  around.element.resize(static_cast<std::size_t>(around.first.back()));
  auto next = around.first;
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const std::int32_t node : nodes_of(model, elements[e]))
      around.element[next[node]++] = static_cast<std::int32_t>(e);
  return around;
}

/// How much longer an element of a section takes than one of an elastic law: metal that may yield twice, as balocco_bench measures shells
/// (521 and 288 ns) and bricks.
double yield_factor(const Model& model, const Section& section) {
  constexpr double yielding = 2.0;
  const auto yields = [&](std::int32_t material) { return material >= 0 && find_option(model.materials[material], "plastic") != nullptr; };
  return yields(section.material) || std::ranges::any_of(section.plies, [&](const Ply& ply) { return yields(ply.material); }) ? yielding : 1.0;
}

}  // namespace

std::vector<ElementRef> graph_elements(const Model& model) {
  std::vector<ElementRef> elements;
  for (std::size_t t = 0; t < model.elements.size(); ++t) {
    if (model.elements[t].type->make_group == nullptr) continue;
    for (std::int32_t row = 0; row < model.elements[t].size(); ++row)
      elements.push_back({static_cast<std::int32_t>(t), row});
  }
  return elements;
}

Graph element_graph(const Model& model, const std::vector<ElementRef>& elements) {
  const NodeElements around = elements_around_nodes(model, elements);
  const auto body_of = lasting_bodies(model);
  std::vector<double> factor;
  for (const auto& section : model.sections) factor.push_back(yield_factor(model, section));
  Graph graph;
  graph.first.push_back(0);
  graph.weight.reserve(elements.size());
  std::vector<std::int8_t> shared(elements.size(), 0);
  std::vector<std::int32_t> touched;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    touched.clear();
    for (const std::int32_t node : nodes_of(model, elements[e]))
      for (std::int64_t k = around.first[node]; k < around.first[node + 1]; ++k)
        if (shared[around.element[k]]++ == 0) touched.push_back(around.element[k]);
    std::sort(touched.begin(), touched.end());
    const auto& type = *model.elements[elements[e].table].type;
    for (const std::int32_t other : touched) {
      const auto other_shape = model.elements[elements[other].table].type->shape;
      const int wanted = std::min(nodes_of_an_edge(type.shape), nodes_of_an_edge(other_shape));
      if (static_cast<std::size_t>(other) != e && shared[other] >= wanted) graph.neighbour.push_back(other);
      shared[other] = 0;
    }
    graph.first.push_back(static_cast<std::int64_t>(graph.neighbour.size()));
    const auto section = model.elements[elements[e].table].section[elements[e].row];
    const double cost = rests_for_good(nodes_of(model, elements[e]), body_of) ? 0.0 : type.cycle_cost * factor[section];
    graph.weight.push_back(std::max<std::int64_t>(1, std::llround(cost)));
  }
  return graph;
}

}  // namespace balocco
