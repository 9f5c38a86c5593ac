// A beam of four bricks on any number of ranks: one end and a node of the middle are carried by a rigid body with a hub
// as reference node, the lower side touches a road on another rigid body, the upper side is under pressure; some nodes
// have own directions.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "elements/element_type.hpp"
#include "implicit_system.hpp"

namespace balocco::test {

constexpr int bricks = 4;
constexpr std::int32_t hub = 4 * (bricks + 1), road = hub + 1;  // rows of reference nodes; bodies 0 and 1
inline std::int32_t row(int i, int j, int k) {
  return 4 * i + 2 * j + k;
}
/// What the hub carries, the end and a node in the middle (which two ranks share), and the end whose motion is
/// prescribed.
inline std::vector<std::int32_t> carried_rows() {
  return {row(bricks, 0, 0), row(bricks, 0, 1), row(bricks, 1, 0), row(bricks, 1, 1), row(2, 0, 1)};
}
inline std::vector<std::int32_t> root_rows() {
  return {row(0, 0, 0), row(0, 0, 1), row(0, 1, 0), row(0, 1, 1)};
}

inline void add_bricks(Model& model) {
  for (int i = 0; i <= bricks; ++i)
    for (int j : {0, 1})
      for (int k : {0, 1}) model.nodes.coordinates.push_back({1.0 * i, 1.0 * j, 1.0 * k});
  model.nodes.coordinates.push_back({bricks + 0.5, 0.3, 0.6});
  model.nodes.coordinates.push_back({1.0, 2.0, -3.0});
  for (std::size_t n = 0; n < model.nodes.coordinates.size(); ++n) model.nodes.id.push_back(101 + n);
  ElementTable table;
  table.type = find_element_type("C3D8R");
  for (int i = 0; i < bricks; ++i) {
    table.id.push_back(i + 1);
    table.section.push_back(0);
    for (const int k : {0, 1})
      for (const auto node : {row(i, 0, k), row(i + 1, 0, k), row(i + 1, 1, k), row(i, 1, k)})
        table.connectivity.push_back(node);
  }
  model.elements.push_back(table);
  Material material;
  material.law = "elastic";
  material.parameters = {100.0, 0.3};
  material.density = 1.0;
  model.materials.push_back(material);
  model.sections.resize(1);
  model.sections[0].material = 0;
}

inline void add_bodies(Model& model) {
  model.rigid_bodies.resize(2);
  model.rigid_bodies[0].reference_node = hub;
  model.rigid_bodies[0].tie_nodes = {row(bricks, 0, 0), row(bricks, 0, 1), row(bricks, 1, 0), row(2, 0, 1)};
  model.rigid_bodies[0].pin_nodes = {row(bricks, 1, 1)};
  model.rigid_bodies[1].reference_node = road;
  model.rigid_bodies[1].analytical_surface = 2;
  const double c = 0.8, s = 0.6;
  model.transforms.push_back({{row(2, 1, 1), hub, road}, {}});
  model.transforms[0].directions.axes = {{{c, s, 0}, {-s * c, c * c, s}, {s * s, -s * c, c}}};
}

inline void add_loads(Model& model) {
  model.surfaces.resize(3);
  for (int i = 0; i < bricks; ++i) {
    model.surfaces[0].faces.push_back({{0, i}, 0});
    model.surfaces[1].faces.push_back({{0, i}, 1});
  }
  model.surfaces[2].kind = Surface::Kind::analytical;
  AnalyticalSurface plane;  // the beam's lower side dips 0.03 into it
  plane.axes = {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
  plane.profile = {{ProfileSegment::Kind::line, {-300, 0.03}, {300, 0.03}, {}, false}};
  model.surfaces[2].analytical = plane;
  model.interactions.resize(1);
  model.interactions[0].friction = 0.5;
  model.contact_pairs.resize(1);
  model.contact_pairs[0] = {.slave = 0, .master = 2, .interaction = 0, .first_step = 0, .location = {}};
  model.steps.resize(1);
  Step& step = model.steps[0];
  step.active_contact_pairs = {0};
  step.surface_loads.push_back({.surface = 1, .magnitude = 3.0});
  step.concentrated_loads.push_back({.node = hub, .dof = 4, .magnitude = 2.0});
  step.concentrated_loads.push_back({.node = row(2, 1, 1), .dof = 1, .magnitude = 5.0});
  step.concentrated_loads.push_back({.node = hub, .dof = 0, .magnitude = 7.0, .follower = true});
  step.concentrated_loads.push_back({.node = hub, .dof = 4, .magnitude = -3.0, .follower = true});
}

inline Model beam() {
  Model model;
  add_bricks(model);
  add_bodies(model);
  add_loads(model);
  return model;
}

/// Consecutive elements go to one rank.
inline std::vector<std::int32_t> in_pieces(const Graph& graph, int parts) {
  std::vector<std::int32_t> part(graph.weight.size());
  for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<std::int32_t>(i * parts / part.size());
  return part;
}

/// The equations of a step over the beam.
struct Equations {
  const Model& model;
  Analysis analysis;
  ImplicitSystem system;

  Equations(const Model& the_model, const Communicator& communicator)
      : model(the_model),
        analysis(the_model, communicator, in_pieces),
        system(started(analysis), the_model.steps[0], prescribed(analysis)) {}

  static Analysis& started(Analysis& analysis) {
    analysis.start_step(analysis.model.steps[0]);
    return analysis;
  }

  /// The root, the hub's third rotation, the road's translations; and a carried node, which has nothing to prescribe.
  static std::vector<std::int32_t> prescribed(const Analysis& analysis) {
    std::vector<std::int32_t> slots;
    for (const auto row : root_rows())
      if (const auto node = analysis.domain.local_node[row]; node >= 0)
        for (int axis = 0; axis < 3; ++axis) slots.push_back(3 * node + axis);
    if (const auto node = analysis.domain.local_node[carried_rows()[0]]; node >= 0) slots.push_back(3 * node);
    for (int axis = 0; axis < 3; ++axis) slots.push_back(3 * analysis.domain.local_node[road] + axis);
    slots.push_back(3 * analysis.domain.size() + 2);
    return slots;
  }

  const ImplicitDofMap& map() const { return system.map(); }

  /// Place of a slot in a table of the whole model: 3 a node, then 3 a body.
  std::size_t place(std::int32_t slot) const {
    if (map().is_rotation(slot)) return 3 * model.nodes.size() + (slot - map().rotation_slot(0, 0));
    return 3 * analysis.domain.node_row[slot / 3] + slot % 3;
  }
  std::size_t table_size() const { return 3 * (model.nodes.size() + model.rigid_bodies.size()); }

  /// A motion of all slots that exist, the same on any number of ranks, of size one.
  std::vector<double> noise(double seed) const {
    std::vector<double> motion(map().slots(), 0.0);
    for (std::int32_t slot = 0; slot < map().slots(); ++slot)
      if (map().role(slot) != ImplicitDofMap::Role::absent)
        motion[slot] = std::sin(seed + 37.7 * static_cast<double>(place(slot) + 1));
    return motion;
  }

  /// Values of the owned slots of all ranks, as a table of the whole model.
  std::vector<double> gathered(const std::vector<double>& values) const {
    std::vector<double> table(table_size(), 0.0);
    for (const auto slot : map().owned_slots()) table[place(slot)] = values[slot];
    analysis.communicator.sum(std::span<double>(table));
    return table;
  }

  /// Residual at the present positions; stiffness * motion for the motion given.
  std::vector<double> residual(std::span<const double> motion) {
    if (!system.assemble({.step_time = 1.0, .total_time = 1.0, .motion = motion})) return {};
    return system.residual();
  }
  std::vector<double> product() {
    system.exchange().sum(system.stiffness().product());
    return system.stiffness().product();
  }
};

}  // namespace balocco::test
