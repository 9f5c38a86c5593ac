#include "element_graph.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "constraints/linkages.hpp"
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

  std::span<const std::int32_t> of(std::int32_t node) const {
    return std::span(element).subspan(static_cast<std::size_t>(first[node]), static_cast<std::size_t>(first[node + 1] - first[node]));
  }
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

/// By node: others that constraints of few nodes, as welds and joints are, join with it. A rank that computes one must know them all.
std::vector<std::vector<std::int32_t>> joined_nodes(const Model& model) {
  constexpr std::size_t few = 8;
  std::vector<std::vector<std::int32_t>> joined(static_cast<std::size_t>(model.nodes.size()));
  for (const auto& definition : model.constraints) {
    const auto nodes = constrained_nodes(definition.kind);
    if (nodes.size() > few) continue;
    for (const auto node : nodes)
      for (const auto other : nodes)
        if (other != node) joined[node].push_back(other);
  }
  return joined;
}

/// How much longer an element of a section takes than one of an elastic law: metal that may yield but mostly does not, and a law with
/// damping by stiffness, which wants rates too, as measured in a car.
double factor_of_law(const Model& model, const Section& section) {
  constexpr double yielding = 1.6, damped = 1.7;
  const auto any = [&](auto holds) {
    return (section.material >= 0 && holds(model.materials[section.material])) ||
           std::ranges::any_of(section.plies, [&](const Ply& ply) { return ply.material >= 0 && holds(model.materials[ply.material]); });
  };
  return (any([](const Material& material) { return find_option(material, "plastic") != nullptr; }) ? yielding : 1.0) *
         (any([](const Material& material) { return material.damping_beta > 0.0; }) ? damped : 1.0);
}

/// Nanoseconds of a cycle, those of nodes shared by the elements around.
std::vector<std::int64_t> costs(const Model& model, const std::vector<ElementRef>& elements, const NodeElements& around,
                                const std::vector<std::vector<std::int32_t>>& joined) {
  constexpr double of_node = 40.0, of_joined_node = 250.0;  // as measured in a car
  const auto body_of = lasting_bodies(model);
  std::vector<double> factor;
  for (const auto& section : model.sections) factor.push_back(factor_of_law(model, section));
  std::vector<std::int64_t> costs;
  costs.reserve(elements.size());
  for (const auto& element : elements) {
    const auto& table = model.elements[element.table];
    const auto nodes = nodes_of(model, element);
    double cost = table.type->cycle_cost * factor[table.section[element.row]];
    for (const std::int32_t node : nodes)
      cost += (joined[node].empty() ? of_node : of_joined_node) / static_cast<double>(around.of(node).size());
    costs.push_back(rests_for_good(nodes, body_of) ? 1 : std::max<std::int64_t>(1, std::llround(cost)));
  }
  return costs;
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
  constexpr std::int8_t enough = 16;  // more nodes than any two elements need to share
  const NodeElements around = elements_around_nodes(model, elements);
  const auto joined = joined_nodes(model);
  Graph graph{.first = {0}, .neighbour = {}, .weight = costs(model, elements, around, joined)};
  std::vector<std::int8_t> shared(elements.size(), 0);
  std::vector<std::int32_t> touched;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    touched.clear();
    const auto nodes = nodes_of(model, elements[e]);
    for (const std::int32_t node : nodes)
      for (const auto other : around.of(node))
        if (shared[other]++ == 0) touched.push_back(other);
    for (const std::int32_t node : nodes)
      for (const std::int32_t end : joined[node])
        for (const auto other : around.of(end))
          if (std::exchange(shared[other], enough) == 0) touched.push_back(other);
    std::sort(touched.begin(), touched.end());
    const auto shape = model.elements[elements[e].table].type->shape;
    for (const std::int32_t other : touched) {
      const auto other_shape = model.elements[elements[other].table].type->shape;
      const int wanted = std::min(nodes_of_an_edge(shape), nodes_of_an_edge(other_shape));
      if (static_cast<std::size_t>(other) != e && shared[other] >= wanted) graph.neighbour.push_back(other);
      shared[other] = 0;
    }
    graph.first.push_back(static_cast<std::int64_t>(graph.neighbour.size()));
  }
  return graph;
}

}  // namespace balocco
