#include "implicit_mass.hpp"

#include <algorithm>
#include <vector>

#include "consistent_mass.hpp"
#include "constraints/rigid_body.hpp"
#include "elements/element_type.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

using Block = std::array<double, 9>;

/// Calls `visit(motions, block)` for what consistent masses of this rank's elements differ from the lumped ones by.
template <class Visit>
void for_each_consistent_part(const Analysis& analysis, const ImplicitDofMap& map, Visit visit) {
  std::vector<NodeMotion> motions;
  std::vector<double> lumped, block;
  for (const auto& group : analysis.element_groups) {
    ConsistentMass mass(analysis.model, *group);
    if (!mass.exists()) continue;
    const auto count = static_cast<std::size_t>(group->nodes_per_element()), size = 3 * count;
    lumped.resize(count);
    for (std::int32_t element = 0; element < group->size(); ++element) {
      motions.clear();
      for (const auto node : group->nodes(element)) motions.push_back(map.motion(node));
      group->lumped_mass(element, lumped);
      const auto products = mass.products(element);
      block.assign(size * size, 0.0);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
          for (std::size_t axis = 0; axis < 3; ++axis)
            block[size * (3 * i + axis) + 3 * j + axis] = group->density() * products[count * i + j] - (i == j ? lumped[i] : 0.0);
      visit(motions, block);
    }
  }
}

/// Calls `visit(motion, block)` for every inertia of this rank's nodes and elements: 3 x 3, of a displacement or a spin. Rotations
/// have the inertia of the material, not that which the explicit loop gives them for its increment's sake.
template <class Visit>
void for_each_inertia(const Analysis& analysis, const ImplicitDofMap& map, Visit visit) {
  const auto& domain = analysis.domain;
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    const double mass = analysis.nodal_mass[node];
    if (domain.owned[node] && mass > 0.0) visit(map.motion(node), Block{mass, 0.0, 0.0, 0.0, mass, 0.0, 0.0, 0.0, mass});
  }
  const auto visit_spin = [&](std::int32_t node, const Matrix3<double>& at_rest) {
    const double* q = &analysis.current.orientation[4 * node];
    const auto rotation = rotation_matrix(Quaternion<double>{q[0], q[1], q[2], q[3]});
    visit(map.nodal_spin(node), (rotation * at_rest * transpose(rotation)).component);
  };
  std::vector<double> tensors;
  for (const auto& group : analysis.element_groups) {
    if (group->freedoms_per_node() == 3) continue;
    tensors.resize(9 * group->nodes_per_element());
    for (std::int32_t element = 0; element < group->size(); ++element) {
      group->material_rotary_inertia(element, tensors);
      for (int i = 0; i < group->nodes_per_element(); ++i) {
        Matrix3<double> at_rest;
        std::copy_n(&tensors[9 * i], 9, at_rest.component.begin());
        visit_spin(group->nodes(element)[i], at_rest);
      }
    }
  }
  for (const auto& [node, section, own] : analysis.rotary_tensors)
    if (domain.owned[node]) visit_spin(node, own);
  const auto& model = analysis.model;
  for (const auto& elements : model.elements) {
    if (elements.type->section != Section::Kind::rotary_inertia) continue;
    for (std::int32_t row = 0; row < elements.size(); ++row) {
      const auto node = domain.local_node[elements.connectivity[row]];
      if (node < 0 || !domain.owned[node] || analysis.reference_of(node) < 0) continue;
      const auto body = analysis.reference_of(node);
      const auto& given = model.sections[elements.section[row]].inertia;
      const Matrix3<double> own{{given[0], given[3], given[4], given[3], given[1], given[5], given[4], given[5], given[2]}};
      const auto rotation = rotation_matrix(analysis.current.rigid_bodies[body]);
      visit(map.spin(body), (rotation * own * transpose(rotation)).component);
    }
  }
}

}  // namespace

void assemble_mass(const Analysis& analysis, const ImplicitDofMap& map, ImplicitStiffness& mass) {
  for_each_inertia(analysis, map, [&](const NodeMotion& motion, const Block&) { mass.add(std::span(&motion, 1), {}); });
  for_each_consistent_part(analysis, map, [&](const auto& motions, const auto&) { mass.add(motions, {}); });
  mass.finish_pattern();
  mass.start({});
  for_each_inertia(analysis, map,
                   [&](const NodeMotion& motion, const Block& block) { mass.add(std::span(&motion, 1), block); });
  for_each_consistent_part(analysis, map, [&](const auto& motions, const auto& block) { mass.add(motions, block); });
  mass.finish();
}

double rigid_motion(const Analysis& analysis, const ImplicitDofMap& map, std::int32_t slot, int mode) {
  if (map.is_multiplier(slot)) return 0.0;
  const auto node = map.node_of(slot);
  const auto& axes = map.directions(node);
  const Point direction{axes(slot % 3, 0), axes(slot % 3, 1), axes(slot % 3, 2)};
  if (map.is_rotation(slot)) return mode < 3 ? 0.0 : direction[mode - 3];
  if (mode < 3) return direction[mode];
  const double* x = &analysis.current.position[4 * node];
  const int axis = mode - 3, next = (axis + 1) % 3, last = (axis + 2) % 3;
  return direction[last] * x[next] - direction[next] * x[last];
}

}  // namespace balocco
