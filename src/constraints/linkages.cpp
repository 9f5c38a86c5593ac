#include "constraints/linkages.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "elements/element_type.hpp"

namespace balocco {

namespace {

/// Nodes joined into classes.
class Classes {
 public:
  explicit Classes(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

struct NodesOf {
  std::vector<std::int32_t> operator()(const LinearEquation& kind) const {
    std::vector<std::int32_t> nodes;
    for (const auto& term : kind.terms) nodes.push_back(term.node);
    return nodes;
  }
  std::vector<std::int32_t> operator()(const Alignment& kind) const { return kind.nodes; }
  std::vector<std::int32_t> operator()(const GreatestDistance& kind) const { return {kind.nodes.begin(), kind.nodes.end()}; }
  std::vector<std::int32_t> operator()(const MeanRotation& kind) const {
    auto nodes = kind.nodes;
    nodes.push_back(kind.angle_node);
    return nodes;
  }
  std::vector<std::int32_t> operator()(const Joint& kind) const { return {kind.nodes.begin(), kind.nodes.end()}; }
  std::vector<std::int32_t> operator()(const Guide& kind) const {
    std::vector<std::int32_t> nodes(kind.nodes.begin(), kind.nodes.end());
    for (const auto& row : kind.rows)
      if (row.angle_node >= 0) nodes.push_back(row.angle_node);  // its owner tells the angle
    return nodes;
  }
  std::vector<std::int32_t> operator()(const Tie& kind) const {
    std::vector<std::int32_t> nodes = kind.others;
    nodes.push_back(kind.node);
    return nodes;
  }
  std::vector<std::int32_t> operator()(const DistributingCoupling& kind) const {
    std::vector<std::int32_t> nodes = kind.nodes;
    nodes.push_back(kind.reference);
    return nodes;
  }
};

/// Calls visit(body, node) for every node that a rigid body carries at some time, and for its reference node.
template <class Visit>
void for_each_rigid_node(const Model& model, Visit visit) {
  for (std::size_t index = 0; index < model.rigid_bodies.size(); ++index) {
    const auto& body = model.rigid_bodies[index];
    visit(index, body.reference_node);
    for (const auto* nodes : {&body.tie_nodes, &body.pin_nodes})
      for (const auto node : *nodes) visit(index, node);
    for (const auto element : body.elements) {
      const auto& table = model.elements[element.table];
      for (int i = 0; i < table.type->nodes; ++i) visit(index, table.connectivity[element.row * table.type->nodes + i]);
    }
  }
  for (const auto& step : model.steps)
    for (const auto& attachment : step.attachments)
      for (const auto node : attachment.nodes) visit(attachment.rigid_body, node);
}

/// Rows each of which has a column that no other of those left has are independent of the rest: they go, one after another.
std::vector<std::size_t> entangled_rows(const std::vector<SparseRow>& rows) {
  std::unordered_map<std::int64_t, std::vector<std::size_t>> rows_of;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const auto& [column, value] : rows[i])
      if (value != 0.0) rows_of[column].push_back(i);
  std::unordered_map<std::int64_t, std::size_t> left;
  std::vector<std::size_t> ready;
  std::vector<bool> gone(rows.size(), false);
  for (const auto& [column, list] : rows_of) {
    left[column] = list.size();
    if (list.size() == 1) ready.push_back(list[0]);
  }
  while (!ready.empty()) {
    const auto row = ready.back();
    ready.pop_back();
    if (gone[row]) continue;
    gone[row] = true;
    for (const auto& [column, value] : rows[row]) {
      if (value == 0.0 || --left[column] != 1) continue;
      for (const auto other : rows_of[column])
        if (!gone[other]) ready.push_back(other);
    }
  }
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!gone[i]) rest.push_back(i);
  return rest;
}

/// The same rows in parts that share no columns, each in order.
std::vector<std::vector<std::size_t>> parts_of(const std::vector<SparseRow>& rows, const std::vector<std::size_t>& chosen) {
  Classes classes(chosen.size());
  std::unordered_map<std::int64_t, std::int32_t> first_with;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (const auto& [column, value] : rows[chosen[i]])
      if (value != 0.0)
        classes.join(first_with.try_emplace(column, static_cast<std::int32_t>(i)).first->second, static_cast<std::int32_t>(i));
  std::unordered_map<std::int32_t, std::size_t> part_of;
  std::vector<std::vector<std::size_t>> parts;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto part = part_of.try_emplace(classes.find(static_cast<std::int32_t>(i)), parts.size()).first->second;
    parts.resize(std::max(parts.size(), part + 1));
    parts[part].push_back(chosen[i]);
  }
  return parts;
}

/// By Gram and Schmidt, twice, as rows may be nearly alike.
void find_dependent(const std::vector<SparseRow>& rows, const std::vector<std::size_t>& together, std::vector<bool>& dependent) {
  constexpr double tolerance = 1e-9;
  std::unordered_map<std::int64_t, std::size_t> place;
  for (const auto i : together)
    for (const auto& [column, value] : rows[i]) place.try_emplace(column, place.size());
  std::vector<std::vector<double>> basis;  // orthonormal
  for (const auto i : together) {
    std::vector<double> row(place.size(), 0.0);
    for (const auto& [column, value] : rows[i]) row[place[column]] += value;
    const auto norm = [&] { return std::sqrt(std::inner_product(row.begin(), row.end(), row.begin(), 0.0)); };
    const double before = norm();
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& other : basis) {
        const double product = std::inner_product(row.begin(), row.end(), other.begin(), 0.0);
        for (std::size_t k = 0; k < row.size(); ++k) row[k] -= product * other[k];
      }
    const double after = norm();
    dependent[i] = !(after > tolerance * before);
    if (dependent[i]) continue;
    for (double& value : row) value /= after;
    basis.push_back(std::move(row));
  }
}

}  // namespace

std::vector<std::int32_t> constrained_nodes(const ConstraintKind& kind) { return std::visit(NodesOf{}, kind); }

std::vector<Linkage> find_linkages(const Model& model) {
  if (model.constraints.empty()) return {};
  Classes classes(static_cast<std::size_t>(model.nodes.size()));
  std::vector<std::vector<std::int32_t>> nodes_of;
  for (const auto& definition : model.constraints) {
    nodes_of.push_back(constrained_nodes(definition.kind));
    for (const auto node : nodes_of.back()) classes.join(nodes_of.back().front(), node);
  }
  for_each_rigid_node(model, [&](std::size_t body, std::int32_t node) { classes.join(model.rigid_bodies[body].reference_node, node); });
  std::map<std::int32_t, Linkage> linkage_of;  // by class
  for (std::size_t i = 0; i < nodes_of.size(); ++i) {
    auto& linkage = linkage_of[classes.find(nodes_of[i].front())];
    linkage.constraints.push_back(static_cast<std::int32_t>(i));
    linkage.nodes.insert(linkage.nodes.end(), nodes_of[i].begin(), nodes_of[i].end());
  }
  for (const auto& body : model.rigid_bodies)
    if (const auto entry = linkage_of.find(classes.find(body.reference_node)); entry != linkage_of.end()) entry->second.has_bodies = true;
  std::vector<Linkage> linkages;
  for (auto& [first, linkage] : linkage_of) {
    std::ranges::sort(linkage.nodes);
    linkage.nodes.erase(std::unique(linkage.nodes.begin(), linkage.nodes.end()), linkage.nodes.end());
    linkages.push_back(std::move(linkage));
  }
  return linkages;
}

std::vector<bool> dependent_rows(const std::vector<SparseRow>& rows) {
  std::vector<bool> dependent(rows.size(), false);
  for (const auto& together : parts_of(rows, entangled_rows(rows))) find_dependent(rows, together, dependent);
  return dependent;
}

}  // namespace balocco
