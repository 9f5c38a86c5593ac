#include "loads/pressure_faces.hpp"

#include "elements/element_type.hpp"
#include "elements/face_shapes.hpp"
#include "elements/nodal_packs.hpp"
#include "math/dual.hpp"

namespace balocco {

namespace {

template <class T>
Vector3<T> weighted(double weight, const Vector3<T>& v) {
  return {{weight * v[0], weight * v[1], weight * v[2]}};
}

/// What the face has to resist: pressure * integral of N_I (x,xi cross x,eta). `edge`: nodes relative to the first one.
template <class Shape, class T>
std::array<Vector3<T>, Shape::nodes> pressure_resistance(double pressure, const std::array<Vector3<T>, Shape::nodes>& edge) {
  static constexpr auto points = integration_points<Shape>();
  std::array<Vector3<T>, Shape::nodes> force{};
  for (const auto& point : points) {
    Vector3<T> by_xi{}, by_eta{};
    for (int i = 1; i < Shape::nodes; ++i) {
      by_xi = by_xi + weighted(point.by_xi[i], edge[i]);
      by_eta = by_eta + weighted(point.by_eta[i], edge[i]);
    }
    const Vector3<T> area = cross(by_xi, by_eta);
    for (int i = 0; i < Shape::nodes; ++i) force[i] = force[i] + weighted(pressure * point.value[i], area);
  }
  return force;
}

template <class Shape>
void add_forces_of(std::span<const std::int32_t> gather_nodes, std::span<const std::int32_t> scatter_nodes, double pressure,
                   const double* position, double* force) {
  for (std::size_t first = 0; first < gather_nodes.size(); first += pack_size * Shape::nodes) {
    const std::int32_t* const node = gather_nodes.data() + first;
    const Vector3<Pack> origin = gather(position, node, Shape::nodes);
    std::array<Vector3<Pack>, Shape::nodes> edge{};
    for (int i = 1; i < Shape::nodes; ++i) edge[i] = gather(position, node + i, Shape::nodes) - origin;
    const auto resistance = pressure_resistance<Shape>(pressure, edge);
    for (int i = 0; i < Shape::nodes; ++i)
      scatter_subtract(resistance[i], scatter_nodes.data() + first + i, Shape::nodes, force);
  }
}

template <class Shape>
void linearize_of(std::span<const std::int32_t> node, double pressure, const double* position, std::span<double> force,
                  std::span<double> stiffness) {
  constexpr int dofs = 3 * Shape::nodes;
  using Scalar = Dual<dofs>;
  std::array<Vector3<Scalar>, Shape::nodes> edge;
  for (int i = 1; i < Shape::nodes; ++i)
    for (int c = 0; c < 3; ++c) {
      edge[i][c] = Scalar(position[4 * std::ptrdiff_t{node[i]} + c] - position[4 * std::ptrdiff_t{node[0]} + c], 3 * i + c);
      edge[i][c].derivative[c] = -1.0;
    }
  const auto resistance = pressure_resistance<Shape>(pressure, edge);
  for (int i = 0; i < dofs; ++i) {
    force[i] = -resistance[i / 3][i % 3].value;
    for (int j = 0; j < dofs; ++j) stiffness[dofs * i + j] = -resistance[i / 3][i % 3].derivative[j];
  }
}

}  // namespace

PressureFaces::PressureFaces(const Model& model, const Surface& surface, std::span<const std::int32_t> local_node,
                             const std::vector<std::vector<bool>>& element_is_local, std::int32_t scratch_node) {
  std::vector<std::int32_t> nodes;
  for (const FaceRef& face : surface.faces) {
    const auto [table, row] = face.element;
    if (!element_is_local[table][row]) continue;
    const ElementType& type = *model.elements[table].type;
    const std::int32_t* const of_element = model.elements[table].connectivity.data() + static_cast<std::size_t>(row) * type.nodes;
    nodes.clear();
    for (const int local : nodes_of_face(type, face.face)) nodes.push_back(local_node[of_element[local]]);
    if (nodes.size() == 3) nodes.push_back(nodes.back());
    for (Family& family : families_)
      if (family.nodes == static_cast<int>(nodes.size())) add(family, nodes);
  }
  for (Family& family : families_) {
    family.scatter = family.gather;
    const std::int32_t padded = (family.size + pack_size - 1) / pack_size * pack_size;
    for (std::int32_t face = family.size; face < padded; ++face)
      for (int i = 0; i < family.nodes; ++i) {
        family.gather.push_back(family.gather[(family.size - 1) * family.nodes + i]);
        family.scatter.push_back(scratch_node);
      }
  }
}

void PressureFaces::add(Family& family, const std::vector<std::int32_t>& nodes) {
  family.gather.insert(family.gather.end(), nodes.begin(), nodes.end());
  ++family.size;
}

std::span<const std::int32_t> PressureFaces::nodes(std::int32_t face) const {
  const Family* family = families_.data();
  for (; face >= family->size; ++family) face -= family->size;
  return std::span(family->gather).subspan(face * family->nodes, family->nodes);
}

void PressureFaces::add_forces(double pressure, const double* position, double* force) const {
  add_forces_of<BilinearFace>(families_[0].gather, families_[0].scatter, pressure, position, force);
  add_forces_of<SerendipityFace>(families_[1].gather, families_[1].scatter, pressure, position, force);
  add_forces_of<QuadraticTriangleFace>(families_[2].gather, families_[2].scatter, pressure, position, force);
}

void PressureFaces::linearize(std::int32_t face, double pressure, const double* position, std::span<double> force,
                              std::span<double> stiffness) const {
  const auto node = nodes(face);
  if (node.size() == 4) linearize_of<BilinearFace>(node, pressure, position, force, stiffness);
  if (node.size() == 8) linearize_of<SerendipityFace>(node, pressure, position, force, stiffness);
  if (node.size() == 6) linearize_of<QuadraticTriangleFace>(node, pressure, position, force, stiffness);
}

}  // namespace balocco
