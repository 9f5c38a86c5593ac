#include "implicit_mass.hpp"

#include <algorithm>
#include <vector>

#include "constraints/rigid_body.hpp"
#include "elements/consistent_mass.hpp"
#include "elements/element_type.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

using Block = std::array<double, 9>;

double damping_of(const Analysis& analysis, const ElementGroup& group) {
  const auto material = analysis.model.sections[group.section()].material;
  return material >= 0 ? analysis.model.materials[material].damping_alpha : 0.0;
}

/// What consistent masses of this rank's elements differ from the lumped ones by.
void for_each_consistent_part(const Analysis& analysis, InertiaKind kind, const VisitInertia& visit) {
  std::vector<Inertial> freedoms;
  std::vector<double> lumped, block;
  for (const auto& group : analysis.element_groups) {
    ConsistentMass mass(analysis.model, *group);
    const double factor = kind == InertiaKind::mass ? 1.0 : damping_of(analysis, *group);
    if (!mass.exists() || factor == 0.0) continue;
    const auto count = static_cast<std::size_t>(group->nodes_per_element()), size = 3 * count;
    lumped.resize(count);
    for (std::int32_t element = 0; element < group->size(); ++element) {
      freedoms.clear();
      for (const auto node : group->nodes(element)) freedoms.push_back({node});
      group->lumped_mass(element, lumped);
      const auto products = mass.products(element);
      block.assign(size * size, 0.0);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
          for (std::size_t axis = 0; axis < 3; ++axis)
            block[size * (3 * i + axis) + 3 * j + axis] =
                factor * (group->density() * products[count * i + j] - (i == j ? lumped[i] : 0.0));
      visit(freedoms, block);
    }
  }
}

/// Tensors that turn with what they belong to, from the reference configuration.
void for_each_spin_inertia(const Analysis& analysis, InertiaKind kind, const VisitInertia& visit) {
  const auto visit_turned = [&](std::int32_t node, const Matrix3<double>& rotation, const Matrix3<double>& at_rest) {
    const Inertial freedom{node, true};
    visit(std::span(&freedom, 1), (rotation * at_rest * transpose(rotation)).component);
  };
  const auto visit_node = [&](std::int32_t node, const Matrix3<double>& at_rest) {
    const double* q = &analysis.current.orientation[4 * node];
    visit_turned(node, rotation_matrix(Quaternion<double>{q[0], q[1], q[2], q[3]}), at_rest);
  };
  std::vector<double> tensors;
  for (const auto& group : analysis.element_groups) {
    const double factor = kind == InertiaKind::mass ? 1.0 : damping_of(analysis, *group);
    if (group->freedoms_per_node() == 3 || factor == 0.0) continue;
    tensors.resize(9 * group->nodes_per_element());
    for (std::int32_t element = 0; element < group->size(); ++element) {
      group->material_rotary_inertia(element, tensors);
      for (int i = 0; i < group->nodes_per_element(); ++i) {
        Matrix3<double> at_rest;
        std::copy_n(&tensors[9 * i], 9, at_rest.component.begin());
        visit_node(group->nodes(element)[i], factor * at_rest);
      }
    }
  }
  if (kind == InertiaKind::damping) return;
  const auto& domain = analysis.domain;
  for (const auto& [node, section, own] : analysis.rotary_tensors)
    if (domain.owned[node] && analysis.reference_of(node) < 0) visit_node(node, own);
  const auto& model = analysis.model;
  for (const auto& elements : model.elements) {
    if (elements.type->section != Section::Kind::rotary_inertia) continue;
    for (std::int32_t row = 0; row < elements.size(); ++row) {
      const auto node = domain.local_node[elements.connectivity[row]];
      if (node < 0 || !domain.owned[node] || analysis.reference_of(node) < 0) continue;
      const auto& given = model.sections[elements.section[row]].inertia;
      const Matrix3<double> own{{given[0], given[3], given[4], given[3], given[1], given[5], given[4], given[5], given[2]}};
      visit_turned(node, rotation_matrix(analysis.current.rigid_bodies[analysis.reference_of(node)]), own);
    }
  }
}

}  // namespace

void for_each_inertia(const Analysis& analysis, InertiaKind kind, const VisitInertia& visit) {
  const auto& lumped = kind == InertiaKind::mass ? analysis.inertia.mass : analysis.inertia.damping;
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node) {
    if (!analysis.domain.owned[node] || lumped[node] == 0.0) continue;
    const Inertial freedom{node};
    visit(std::span(&freedom, 1), Block{lumped[node], 0.0, 0.0, 0.0, lumped[node], 0.0, 0.0, 0.0, lumped[node]});
  }
  for_each_spin_inertia(analysis, kind, visit);
  for_each_consistent_part(analysis, kind, visit);
}

NodeMotion motion_of(const Analysis& analysis, const ImplicitDofMap& map, Inertial freedom) {
  if (!freedom.spins) return map.motion(freedom.node);
  const auto body = analysis.reference_of(freedom.node);
  return body >= 0 ? map.spin(body) : map.nodal_spin(freedom.node);
}

void assemble_mass(const Analysis& analysis, const ImplicitDofMap& map, ImplicitStiffness& mass) {
  std::vector<NodeMotion> motions;
  const auto motions_of = [&](std::span<const Inertial> freedoms) {
    motions.clear();
    for (const auto freedom : freedoms) motions.push_back(motion_of(analysis, map, freedom));
    return std::span<const NodeMotion>(motions);
  };
  for_each_inertia(analysis, InertiaKind::mass, [&](auto freedoms, auto) { mass.add(motions_of(freedoms), {}); });
  mass.finish_pattern();
  mass.start({});
  for_each_inertia(analysis, InertiaKind::mass, [&](auto freedoms, auto block) { mass.add(motions_of(freedoms), block); });
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
