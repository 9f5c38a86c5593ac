#include "rigid_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace balocco {

namespace {

double norm(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

Vector3<double> unit(const Vector3<double>& v) {
  const double length = norm(v);
  return length > 0.0 ? (1.0 / length) * v : v;
}

double angle_between(const Vector3<double>& a, const Vector3<double>& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

/// Distance below which the direction from an edge or vertex is round-off, of the bucket size.
constexpr double touching = 1e-9;
// How far beyond a free edge its facet reaches, as a share of the spacing.
constexpr double margin = 1e-6;

}  // namespace

RigidMesh::RigidMesh(std::vector<Vector3<double>> vertices, std::span<const std::vector<std::int32_t>> facets)
    : vertices_(std::move(vertices)) {
  for (const auto& facet : facets) add_facet(facet);
  if (triangles_.empty()) return;
  join_edges();
  weigh_vertices();
  fill_buckets();
}

void RigidMesh::add_facet(std::span<const std::int32_t> v) {
  if (v.size() == 3) return add_triangle({v[0], v[1], v[2]});
  const auto first = vertices_[v[2]] - vertices_[v[0]], second = vertices_[v[3]] - vertices_[v[1]];
  if (dot(first, first) <= dot(second, second)) {
    add_triangle({v[0], v[1], v[2]});
    add_triangle({v[0], v[2], v[3]});
  } else {
    add_triangle({v[1], v[2], v[3]});
    add_triangle({v[1], v[3], v[0]});
  }
}

/// A triangle without area bounds nothing that its neighbours do not.
void RigidMesh::add_triangle(const std::array<std::int32_t, 3>& vertex) {
  const auto &a = vertices_[vertex[0]], &b = vertices_[vertex[1]], &c = vertices_[vertex[2]];
  const auto normal = unit(cross(b - a, c - a));
  if (!(dot(normal, normal) > 0.0)) return;
  const auto centre = (1.0 / 3.0) * (a + b + c);
  triangles_.push_back({vertex, {}, normal, centre, std::max({norm(a - centre), norm(b - centre), norm(c - centre)})});
}

void RigidMesh::join_edges() {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
  double length = 0.0;
  for (auto& triangle : triangles_)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = triangle.vertex[i], b = triangle.vertex[(i + 1) % 3];
      const auto [place, fresh] = known.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(edges_.size()));
      if (fresh) {
        edges_.emplace_back();
        length += norm(vertices_[b] - vertices_[a]);
      }
      triangle.edge[i] = place->second;
      edges_[place->second].normal_sum = edges_[place->second].normal_sum + triangle.normal;
      ++edges_[place->second].facets;
    }
  spacing_ = length / static_cast<double>(edges_.size());
}

void RigidMesh::weigh_vertices() {
  vertex_normals_.resize(vertices_.size());
  free_vertex_.resize(vertices_.size());
  for (const auto& triangle : triangles_)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t at = triangle.vertex[i], next = triangle.vertex[(i + 1) % 3], last = triangle.vertex[(i + 2) % 3];
      const double angle = angle_between(vertices_[next] - vertices_[at], vertices_[last] - vertices_[at]);
      vertex_normals_[at] = vertex_normals_[at] + angle * triangle.normal;
      if (edges_[triangle.edge[i]].facets == 1) free_vertex_[at] = free_vertex_[next] = true;
    }
}

RigidMesh::Bucket RigidMesh::bucket_of(const Vector3<double>& place) const {
  Bucket bucket{};
  for (int i = 0; i < 3; ++i) {
    // Far away every place is as far from all facets as any other.
    constexpr double far = 1e9;
    bucket[i] = static_cast<std::int32_t>(std::floor(std::clamp(place[i] / spacing_, -far, far)));
  }
  return bucket;
}

std::size_t RigidMesh::BucketHash::operator()(const Bucket& bucket) const {
  std::uint64_t hash = 0;
  for (const auto index : bucket) hash = (hash ^ static_cast<std::uint32_t>(index)) * 0x9E3779B97F4A7C15U;
  return hash ^ hash >> 32;
}

void RigidMesh::fill_buckets() {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    Bucket low, high;
    for (int i = 0; i < 3; ++i) {
      const auto [least, most] = std::minmax({vertices_[triangles_[t].vertex[0]][i], vertices_[triangles_[t].vertex[1]][i],
                                              vertices_[triangles_[t].vertex[2]][i]});
      low[i] = static_cast<std::int32_t>(std::floor(least / spacing_)) - 1;
      high[i] = static_cast<std::int32_t>(std::floor(most / spacing_)) + 1;
    }
    for (std::int32_t x = low[0]; x <= high[0]; ++x)
      for (std::int32_t y = low[1]; y <= high[1]; ++y)
        for (std::int32_t z = low[2]; z <= high[2]; ++z) buckets_[{x, y, z}].push_back(static_cast<std::int32_t>(t));
  }
}

std::span<const std::int32_t> RigidMesh::near(const Vector3<double>& place) const {
  const auto found = buckets_.find(bucket_of(place));
  if (found == buckets_.end()) return {};
  return found->second;
}

/// The nearest point of a triangle by the regions of its edges and vertices.
RigidMesh::Foot RigidMesh::foot(const Triangle& triangle, const Vector3<double>& place) const {
  Foot nearest{.square = -1.0};
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    const auto& a = vertices_[triangle.vertex[i]];
    const auto side = vertices_[triangle.vertex[(i + 1) % 3]] - a, arm = place - a;
    // On the inner side of this edge; a free one a little further, or rounding would decide where nodes along it belong.
    const double reach = edges_[triangle.edge[i]].facets == 1 ? margin * spacing_ * norm(side) : 0.0;
    if (dot(cross(side, arm), triangle.normal) >= -reach) continue;
    inside = false;
    const double along = dot(arm, side) / dot(side, side);
    Foot here{.edge = i};
    if (along <= 0.0) here.vertex = i;
    if (along >= 1.0) here.vertex = (i + 1) % 3;
    here.at = here.vertex >= 0 ? vertices_[triangle.vertex[here.vertex]] : a + along * side;
    const auto across = place - here.at;
    here.square = dot(across, across);
    if (nearest.square < 0.0 || here.square < nearest.square) nearest = here;
  }
  if (!inside) return nearest;
  const double height = dot(place - vertices_[triangle.vertex[0]], triangle.normal);
  return {.square = height * height, .at = vertices_[triangle.vertex[0]]};
}

RigidMesh::Feature RigidMesh::find(const Vector3<double>& place) const {
  const Triangle* triangle = nullptr;
  Foot best{.square = std::numeric_limits<double>::max()};
  const auto compare = [&](const Triangle& other) {
    const Foot here = foot(other, place);
    if (here.square >= best.square) return;
    triangle = &other;
    best = here;
  };
  for (const auto candidate : near(place)) compare(triangles_[candidate]);
  // Facets further off than a bucket need not be among the candidates.
  if (!(best.square <= spacing_ * spacing_)) {
    triangle = nullptr;
    best.square = std::numeric_limits<double>::max();
    for (const auto& other : triangles_)
      if (triangle == nullptr || reaches(other, place, best.square)) compare(other);
  }
  return feature_of(*triangle, best, place);
}

bool RigidMesh::reaches(const Triangle& triangle, const Vector3<double>& place, double square) const {
  const auto away = place - triangle.centre;
  const double reach = triangle.radius + std::sqrt(square);
  return dot(away, away) <= reach * reach * (1.0 + 1e-12);
}

RigidMesh::Feature RigidMesh::feature_of(const Triangle& triangle, const Foot& foot, const Vector3<double>& place) const {
  if (foot.edge < 0) return {.at = foot.at, .normal = triangle.normal};
  Feature feature{.flat = false, .at = foot.at};
  bool free = false;
  if (foot.vertex >= 0) {
    const auto vertex = triangle.vertex[foot.vertex];
    feature.normal = unit(vertex_normals_[vertex]);
    free = free_vertex_[vertex];
  } else {
    const Edge& edge = edges_[triangle.edge[foot.edge]];
    feature.normal = unit(edge.normal_sum);
    feature.direction = unit(vertices_[triangle.vertex[(foot.edge + 1) % 3]] - vertices_[triangle.vertex[foot.edge]]);
    free = edge.facets == 1;
  }
  feature.side = free || dot(place - foot.at, feature.normal) >= 0.0 ? 1.0 : -1.0;
  feature.flat = foot.square <= touching * touching * spacing_ * spacing_;
  return feature;
}

}  // namespace balocco
