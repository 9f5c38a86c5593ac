// Small models of membranes and trusses for unit tests, and the dense matrices of one element.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "elements/element_type.hpp"
#include "materials/material_law.hpp"
#include "math/exact_sum.hpp"
#include "model/model.hpp"
#include "symmetric_eigenvalues.hpp"

namespace balocco::test {

/// One element table with one section and its only group; local nodes are the model's rows, the scratch node comes last.
struct Sheet {
  Model model;
  std::unique_ptr<ElementGroup> group;
  std::vector<double> position;  // 4 a node
  std::vector<double> history;

  Sheet(const std::string& type, const std::vector<Point>& nodes, std::vector<std::int32_t> connectivity) {
    model.name = "sheet";
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
    section.kind = model.elements[0].type->section;
    section.material = 0;
    section.thickness = 0.5;
    section.area = 2.0;
    model.sections.push_back(section);
    model.materials.emplace_back();
    model.materials[0].density = 2e-3;
    set_law("elastic", {100.0, 0.3});
  }

  void set_law(const std::string& law, std::vector<double> parameters) {
    model.materials[0].law = law;
    model.materials[0].parameters = std::move(parameters);
  }

  void build(std::int32_t interface_count = 0) {
    GroupInput input{.model = model, .table = 0, .section = 0, .rows = {}, .interface_count = interface_count, .connectivity = {}};
    for (std::int32_t row = 0; row < model.elements[0].size(); ++row) input.rows.push_back(row);
    input.connectivity = model.elements[0].connectivity;
    input.scratch_node = model.nodes.size();
    group = model.elements[0].type->make_group(input);
    position = positions([](const Point& x) { return x; });
    history = group->initial_history();
  }

  /// Nodal array of the motion x = map(X), with a scratch node at the end.
  template <class Map>
  std::vector<double> positions(const Map& map) const {
    std::vector<double> result;
    for (const Point& reference : model.nodes.coordinates) {
      const Point x = map(reference);
      result.insert(result.end(), {x[0], x[1], x[2], 0.0});
    }
    result.insert(result.end(), 4, 0.0);
    return result;
  }

  int dofs() const { return 3 * group->nodes_per_element(); }

  std::vector<double> initial_history() const {
    std::vector<double> initial(group->history_size());
    group->initialize_history(initial);
    return initial;
  }

  Eigen::VectorXd force(std::int32_t element = 0) const {
    const auto old = initial_history();
    std::vector<double> now(old.size()), f(dofs());
    if (!group->linearize(element, {position.data()}, old, now, f, {})) throw std::runtime_error("inverted");
    return Eigen::Map<Eigen::VectorXd>(f.data(), dofs());
  }

  Eigen::MatrixXd stiffness(std::int32_t element = 0) const {
    const auto old = initial_history();
    std::vector<double> now(old.size()), f(dofs()), k(static_cast<std::size_t>(dofs() * dofs()));
    if (!group->linearize(element, {position.data()}, old, now, f, k)) throw std::runtime_error("inverted");
    return Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(k.data(), dofs(), dofs());
  }

  ElementEnergies energies(std::int32_t element = 0) const {
    return group->energies(element, {position.data()}, initial_history());
  }

  /// 2 / omega_max of one free element with lumped masses, from its exact tangent.
  double exact_increment(std::int32_t element = 0) const {
    std::vector<double> mass(group->nodes_per_element());
    group->lumped_mass(element, mass);
    Eigen::VectorXd scale(dofs());
    for (int i = 0; i < dofs(); ++i) scale[i] = 1.0 / std::sqrt(mass[i / 3]);
    const Eigen::MatrixXd k = stiffness(element);
    const Eigen::MatrixXd scaled = scale.asDiagonal() * (0.5 * (k + k.transpose())) * scale.asDiagonal();
    return 2.0 / std::sqrt(symmetric_eigenvalues(scaled).maxCoeff());
  }

  /// External - internal forces of all elements (4 a node), rounded with one constant for every node.
  std::vector<double> explicit_forces(ExplicitCycle cycle, StableIncrement* stable = nullptr, double largest = 1e6) {
    std::vector<double> force(position.size(), 0.0);
    for (std::size_t n = 0; n < force.size() / 4; ++n) force[4 * n + 3] = rounding_constant(largest);
    cycle.motion.position = position.data();
    cycle.forces.force = force.data();
    StableIncrement found = group->add_forces(Portion::interface, cycle, history);
    found.merge(group->add_forces(Portion::interior, cycle, history));
    if (stable != nullptr) *stable = found;
    return force;
  }

  void disturb(double amplitude, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-amplitude, amplitude);
    for (std::size_t i = 0; i + 4 < position.size(); ++i)
      if (i % 4 != 3) position[i] += any(random);
  }
};

/// A 4 x 4 patch of skewed quadrilaterals (or twice as many triangles) in a tilted plane.
inline Sheet skewed_patch(const std::string& type, double out_of_plane = 0.0) {
  std::vector<Point> nodes;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.2, 0.2);
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i) {
      const bool inside = i % 4 != 0 && j % 4 != 0;
      const double x = i + (inside ? any(random) : 0.0), y = 0.8 * j + (inside ? any(random) : 0.0);
      nodes.push_back({10.0 + x, 0.8 * y + 0.6 * out_of_plane * std::sin(x * y), 0.6 * y - 0.8 * out_of_plane * std::sin(x * y)});
    }
  std::vector<std::int32_t> connectivity;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const std::int32_t a = 5 * j + i;
      if (type == "M3D3")
        connectivity.insert(connectivity.end(), {a, a + 1, a + 6, a, a + 6, a + 5});
      else
        connectivity.insert(connectivity.end(), {a, a + 1, a + 6, a + 5});
    }
  return Sheet(type, nodes, connectivity);
}

inline Sheet rectangle(const std::string& type, double a, double b) {
  if (type == "M3D3") return Sheet(type, {{0, 0, 0}, {a, 0, 0}, {0, b, 0}}, {0, 1, 2});
  return Sheet(type, {{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}}, {0, 1, 2, 3});
}

}  // namespace balocco::test
