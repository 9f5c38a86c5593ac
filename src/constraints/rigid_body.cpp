#include "constraints/rigid_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "elements/element_group.hpp"
#include "elements/element_type.hpp"
#include "math/rotation.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

/// Mass and first moment of mass, summed in deck order.
struct MassMoment {
  double mass = 0.0;
  Point moment{};

  void add(double nodal_mass, const Point& at) {
    mass += nodal_mass;
    for (int i = 0; i < 3; ++i) moment[i] += nodal_mass * at[i];
  }
};

/// Adds what the elements `rows` of one table and section weigh, node by node.
void add_mass(const Model& model, std::int32_t table, std::int32_t section, const std::vector<std::int32_t>& rows,
              MassMoment& sum) {
  const ElementTable& elements = model.elements[table];
  const int n = elements.type->nodes;
  if (elements.type->section == Section::Kind::mass) {
    for (const auto row : rows)
      sum.add(model.sections[section].mass, model.nodes.coordinates[elements.connectivity[row]]);
    return;
  }
  if (elements.type->make_group == nullptr) return;  // rotary inertia weighs nothing
  GroupInput input{.model = model, .table = table, .section = section, .rows = rows, .connectivity = {}};
  input.scratch_node = model.nodes.size();
  for (const auto row : rows)
    for (int i = 0; i < n; ++i) input.connectivity.push_back(elements.connectivity[row * n + i]);
  const auto group = elements.type->make_group(input);
  std::vector<double> mass(n);
  for (std::int32_t element = 0; element < group->size(); ++element) {
    group->lumped_mass(element, mass);
    for (int i = 0; i < n; ++i) sum.add(mass[i], model.nodes.coordinates[group->nodes(element)[i]]);
  }
}

Point center_of_mass(const Model& model, const RigidBody& body) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> rows;  // (table, section) -> element rows
  for (const auto& element : body.elements)
    rows[{element.table, model.elements[element.table].section[element.row]}].push_back(element.row);
  MassMoment sum;
  for (const auto& [key, list] : rows) add_mass(model, key.first, key.second, list, sum);
  if (!(sum.mass > 0.0))
    throw InputError(
        fmt::format("{}: error: *RIGID BODY: POSITION=CENTER OF MASS needs elements with mass in the body; "
                    "name their set with ELSET= and give their material a *DENSITY, or leave POSITION out",
                    model.where(body.location)));
  return {sum.moment[0] / sum.mass, sum.moment[1] / sum.mass, sum.moment[2] / sum.mass};
}

/// Nodes that the body carries from the start, and whether they are tied: a pin set overrides what sets of elements
/// say.
std::map<std::int32_t, bool> carried_nodes(const Model& model, const RigidBody& body) {
  std::map<std::int32_t, bool> tie_of_row;
  for (const auto& element : body.elements) {
    const ElementTable& table = model.elements[element.table];
    const int n = table.type->nodes;
    for (int i = 0; i < n; ++i) tie_of_row[table.connectivity[element.row * n + i]] = true;
  }
  for (const auto row : body.tie_nodes) tie_of_row[row] = true;
  for (const auto row : body.pin_nodes) tie_of_row[row] = false;
  tie_of_row.erase(body.reference_node);
  return tie_of_row;
}

auto find_node(RigidBodyState& body, std::int32_t row) {
  return std::lower_bound(body.nodes.begin(), body.nodes.end(), row,
                          [](const RigidNode& node, std::int32_t r) { return node.node < r; });
}

}  // namespace

Matrix3<double> rotation_matrix(const RigidBodyState& body) { return rotation_matrix(body.orientation); }

Point rigid_arm(const Matrix3<double>& rotation, const RigidNode& node) {
  const Vector3<double> arm = rotation * Vector3<double>{node.offset};
  return arm.component;
}

void rotate(RigidBodyState& body, const Point& spin) {
  body.orientation = turned(body.orientation, {spin});
  for (int i = 0; i < 3; ++i) body.rotation[i] += spin[i];
}

void place_reference_nodes(Model& model) {
  for (const RigidBody& body : model.rigid_bodies)
    if (body.at_center_of_mass) model.nodes.coordinates[body.reference_node] = center_of_mass(model, body);
}

std::vector<RigidBodyState> initial_rigid_bodies(const Model& model) {
  std::vector<RigidBodyState> states;
  for (const RigidBody& body : model.rigid_bodies) {
    RigidBodyState state;
    state.position = model.nodes.coordinates[body.reference_node];
    for (const auto& [row, tie] : carried_nodes(model, body)) attach(state, row, tie, model.nodes.coordinates[row]);
    states.push_back(std::move(state));
  }
  return states;
}

void attach(RigidBodyState& body, std::int32_t row, bool tie, const Point& position) {
  const Vector3<double> arm = Vector3<double>{position} - Vector3<double>{body.position};
  const RigidNode node{row, tie, (transpose(rotation_matrix(body)) * arm).component};
  const auto place = find_node(body, row);
  if (place != body.nodes.end() && place->node == row) {
    *place = node;
  } else {
    body.nodes.insert(place, node);
  }
}

void release(RigidBodyState& body, std::int32_t row) {
  const auto place = find_node(body, row);
  if (place != body.nodes.end() && place->node == row) body.nodes.erase(place);
}

}  // namespace balocco
