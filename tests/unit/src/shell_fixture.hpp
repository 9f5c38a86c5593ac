// Small models of shells for unit tests, with the assembled forces and tangents of their only group.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <string>
#include <vector>

#include "elements/element_type.hpp"
#include "math/exact_sum.hpp"
#include "math/rotation.hpp"
#include "model/model.hpp"

namespace balocco::test {

/// One element table with one section and its only group; local nodes are the model's rows, the scratch node comes
/// last.
struct Shell {
  Model model;
  std::unique_ptr<ElementGroup> group;
  std::vector<double> position, orientation;  // 4 a node
  std::vector<double> history;

  Shell(const std::string& type, const std::vector<Point>& nodes, std::vector<std::int32_t> connectivity) {
    model.name = "shell";
    model.nodes.coordinates = nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) model.nodes.id.push_back(static_cast<std::int64_t>(i) + 1);
    ElementTable table;
    table.type = find_element_type(type);
    const auto count = connectivity.size() / static_cast<std::size_t>(table.type->nodes);
    for (std::size_t i = 0; i < count; ++i) table.id.push_back(static_cast<std::int64_t>(i) + 1);
    table.connectivity = std::move(connectivity);
    table.section.assign(count, 0);
    table.location.resize(count);
    model.elements.push_back(std::move(table));
    Section section;
    section.kind = Section::Kind::shell;
    section.material = 0;
    section.thickness = 0.1;
    model.sections.push_back(section);
    model.materials.emplace_back();
    model.materials[0].density = 2e-3;
    model.materials[0].law = "elastic";
    model.materials[0].parameters = {100.0, 0.3};
  }

  void build() {
    GroupInput input{.model = model, .table = 0, .section = 0, .rows = {}, .interface_count = 0, .connectivity = {}};
    for (std::int32_t row = 0; row < model.elements[0].size(); ++row) input.rows.push_back(row);
    input.connectivity = model.elements[0].connectivity;
    input.scratch_node = model.nodes.size();
    group = model.elements[0].type->make_group(input);
    position.clear();
    orientation.clear();
    for (const Point& x : model.nodes.coordinates) position.insert(position.end(), {x[0], x[1], x[2], 0.0});
    position.insert(position.end(), 4, 0.0);
    for (std::size_t i = 0; i < position.size() / 4; ++i) orientation.insert(orientation.end(), {1.0, 0.0, 0.0, 0.0});
    history = group->initial_history();
  }

  NodalMotion motion() const { return {.position = position.data(), .orientation = orientation.data()}; }
  int freedoms() const { return 6 * model.nodes.size(); }
  std::vector<double> initial_history() const {
    std::vector<double> initial(group->history_size());
    group->initialize_history(initial);
    return initial;
  }

  /// Moves every node by 6 values: translation and left spin.
  void move(const Eigen::VectorXd& step) {
    for (std::int32_t n = 0; n < model.nodes.size(); ++n) {
      for (int c = 0; c < 3; ++c) position[4 * n + c] += step[6 * n + c];
      const Quaternion<double> q =
          turned({orientation[4 * n], orientation[4 * n + 1], orientation[4 * n + 2], orientation[4 * n + 3]},
                 {{step[6 * n + 3], step[6 * n + 4], step[6 * n + 5]}});
      std::ranges::copy(q, orientation.begin() + 4 * n);
    }
  }

  /// Internal forces of all elements, 6 a node, and their derivative where `stiffness` is given.
  Eigen::VectorXd forces(Eigen::MatrixXd* stiffness = nullptr) const {
    const int nodes = group->nodes_per_element(), size = 6 * nodes;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(freedoms());
    if (stiffness != nullptr) *stiffness = Eigen::MatrixXd::Zero(freedoms(), freedoms());
    std::vector<double> old(group->history_size()), now(old), f(size), k(stiffness != nullptr ? size * size : 0);
    for (std::int32_t e = 0; e < group->size(); ++e) {
      group->gather_history(e, history, old);
      if (!group->linearize(e, motion(), old, now, f, k)) throw std::runtime_error("inverted");
      const auto node = group->nodes(e);
      for (int i = 0; i < size; ++i) {
        const int row = 6 * node[i / 6] + i % 6;
        sum[row] += f[i];
        if (stiffness != nullptr)
          for (int j = 0; j < size; ++j) (*stiffness)(row, 6 * node[j / 6] + j % 6) += k[i * size + j];
      }
    }
    return sum;
  }

  double energy() const {
    double sum = 0.0;
    for (std::int32_t e = 0; e < group->size(); ++e) {
      const auto energies = group->energies(e, motion(), initial_history());
      sum += energies.strain + energies.hourglass;
    }
    return sum;
  }

  /// External - internal forces and moments of an explicit cycle, 6 a node.
  Eigen::VectorXd explicit_forces(ExplicitCycle cycle = {}, StableIncrement* stable = nullptr) {
    std::vector<double> force(position.size(), 0.0), moment(force);
    for (std::size_t n = 0; n < force.size() / 4; ++n) force[4 * n + 3] = moment[4 * n + 3] = rounding_constant(1e6);
    cycle.motion = motion();
    cycle.forces = {force.data(), moment.data()};
    const StableIncrement found = group->add_forces(Portion::interior, cycle, history);
    if (stable != nullptr) *stable = found;
    Eigen::VectorXd sum(freedoms());
    for (int i = 0; i < freedoms(); ++i) sum[i] = (i % 6 < 3 ? force : moment)[4 * (i / 6) + i % 3];
    return sum;
  }
};

/// A quadrilateral or triangle that is neither a parallelogram nor flat.
inline Shell crooked(const std::string& type) {
  if (type.starts_with("S3")) return Shell(type, {{0.1, 0.0, 0.2}, {2.0, 0.3, -0.1}, {0.5, 1.4, 0.3}}, {0, 1, 2});
  return Shell(type, {{0.1, 0.0, 0.2}, {2.0, 0.3, -0.1}, {1.8, 1.9, 0.3}, {0.0, 1.4, -0.1}}, {0, 1, 2, 3});
}

/// Pseudo-random values in [-size, size], the same at every run.
inline Eigen::VectorXd scatter(int count, double size, unsigned seed = 1) {
  Eigen::VectorXd values(count);
  for (double& value : values) {
    seed = seed * 1664525u + 1013904223u;
    value = size * (2.0 * (seed >> 8) / 16777216.0 - 1.0);
  }
  return values;
}

}  // namespace balocco::test
