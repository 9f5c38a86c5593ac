#include "loads/pressure_faces.hpp"

#include <algorithm>
#include <array>

#include "elements/element_type.hpp"
#include "elements/nodal_packs.hpp"
#include "math/dual.hpp"

namespace balocco {

namespace {

constexpr int nodes_per_face = PressureFaces::nodes_per_face;
constexpr double gauss = 0.57735026918962576451;  // 1 / sqrt(3)

/// Shape functions of the bilinear face and their derivatives at the 2 x 2 Gauss points: exact for the cubic integrand.
struct FacePoint {
  std::array<double, nodes_per_face> value, by_xi, by_eta;
};

constexpr std::array<FacePoint, 4> face_points() {
  constexpr double xi[4] = {-1.0, 1.0, 1.0, -1.0}, eta[4] = {-1.0, -1.0, 1.0, 1.0};
  std::array<FacePoint, 4> points{};
  for (int q = 0; q < 4; ++q)
    for (int i = 0; i < nodes_per_face; ++i) {
      const double along_xi = 1.0 + xi[i] * gauss * xi[q], along_eta = 1.0 + eta[i] * gauss * eta[q];
      points[q].value[i] = 0.25 * along_xi * along_eta;
      points[q].by_xi[i] = 0.25 * xi[i] * along_eta;
      points[q].by_eta[i] = 0.25 * eta[i] * along_xi;
    }
  return points;
}

template <class T>
using Face = std::array<Vector3<T>, nodes_per_face>;

template <class T>
Vector3<T> weighted(double weight, const Vector3<T>& v) {
  return {{weight * v[0], weight * v[1], weight * v[2]}};
}

/// What the face has to resist: pressure * integral of N_I (x,xi cross x,eta). `edge`: nodes relative to the first one.
template <class T>
Face<T> pressure_resistance(double pressure, const Face<T>& edge) {
  static constexpr auto points = face_points();
  Face<T> force{};
  for (const FacePoint& point : points) {
    Vector3<T> by_xi{}, by_eta{};
    for (int i = 1; i < nodes_per_face; ++i) {
      by_xi = by_xi + weighted(point.by_xi[i], edge[i]);
      by_eta = by_eta + weighted(point.by_eta[i], edge[i]);
    }
    const Vector3<T> area = cross(by_xi, by_eta);
    for (int i = 0; i < nodes_per_face; ++i) force[i] = force[i] + weighted(pressure * point.value[i], area);
  }
  return force;
}

}  // namespace

PressureFaces::PressureFaces(const Model& model, const Surface& surface, std::span<const std::int32_t> local_node,
                             const std::vector<std::vector<bool>>& element_is_local, std::int32_t scratch_node) {
  for (const FaceRef& face : surface.faces) {
    const auto [table, row] = face.element;
    if (!element_is_local[table][row]) continue;
    const ElementType& type = *model.elements[table].type;
    const std::vector<int>& corners = type.faces[face.face];
    const std::int32_t* const nodes = model.elements[table].connectivity.data() + static_cast<std::size_t>(row) * type.nodes;
    for (std::size_t i = 0; i < nodes_per_face; ++i)
      gather_.push_back(local_node[nodes[corners[std::min(i, corners.size() - 1)]]]);
    ++size_;
  }
  scatter_ = gather_;
  padded_size_ = (size_ + pack_size - 1) / pack_size * pack_size;
  for (std::int32_t face = size_; face < padded_size_; ++face)
    for (int i = 0; i < nodes_per_face; ++i) {
      gather_.push_back(gather_[(size_ - 1) * nodes_per_face + i]);
      scatter_.push_back(scratch_node);
    }
}

std::span<const std::int32_t, PressureFaces::nodes_per_face> PressureFaces::nodes(std::int32_t face) const {
  return std::span<const std::int32_t, nodes_per_face>(gather_.data() + face * nodes_per_face, nodes_per_face);
}

void PressureFaces::add_forces(double pressure, const double* position, double* force) const {
  for (std::int32_t first = 0; first < padded_size_; first += pack_size) {
    const std::int32_t* const node = gather_.data() + first * nodes_per_face;
    const Vector3<Pack> origin = gather(position, node, nodes_per_face);
    Face<Pack> edge{};
    for (int i = 1; i < nodes_per_face; ++i) edge[i] = gather(position, node + i, nodes_per_face) - origin;
    const Face<Pack> resistance = pressure_resistance(pressure, edge);
    for (int i = 0; i < nodes_per_face; ++i)
      scatter_subtract(resistance[i], scatter_.data() + first * nodes_per_face + i, nodes_per_face, force);
  }
}

void PressureFaces::linearize(std::int32_t face, double pressure, const double* position, std::span<double, 12> force,
                              std::span<double, 144> stiffness) const {
  using Scalar = Dual<12>;
  const auto node = nodes(face);
  Face<Scalar> edge;
  for (int i = 1; i < nodes_per_face; ++i)
    for (int c = 0; c < 3; ++c) {
      edge[i][c] = Scalar(position[4 * std::ptrdiff_t{node[i]} + c] - position[4 * std::ptrdiff_t{node[0]} + c], 3 * i + c);
      edge[i][c].derivative[c] = -1.0;
    }
  const Face<Scalar> resistance = pressure_resistance(pressure, edge);
  for (int i = 0; i < 12; ++i) {
    force[i] = -resistance[i / 3][i % 3].value;
    for (int j = 0; j < 12; ++j) stiffness[12 * i + j] = -resistance[i / 3][i % 3].derivative[j];
  }
}

}  // namespace balocco
