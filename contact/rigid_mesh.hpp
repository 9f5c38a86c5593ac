// A rigid surface of facets (R3D3, R3D4) in the frame of its body: signed distance and outward normal in space.
//
// Quadrilaterals are two triangles along their shorter diagonal. The nearest feature (facet, edge or vertex) is found by values, ties
// go to the lower index; the distance is then one formula in T, so that dual numbers carry its exact derivative. Which side a point
// is on is told by the angle-weighted normal of the feature (Baerentzen and Aanaes, Signed distance computation using the angle
// weighted pseudonormal, IEEE TVCG 11, 2005). Beyond the free edge of an open surface there is no body.
//
// The grid is built once, since the mesh never moves in its own frame: each bucket lists the facets within one bucket of it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "math/dual.hpp"
#include "math/scalar.hpp"
#include "math/tensor.hpp"
#include "model/model.hpp"
#include "surface_point.hpp"

namespace balocco {

class RigidMesh {
 public:
  RigidMesh() = default;
  /// Facets counter-clockwise seen from outside, three or four vertices each.
  RigidMesh(std::vector<Vector3<double>> vertices, std::span<const std::vector<std::int32_t>> facets);

  bool empty() const { return triangles_.empty(); }

  /// True where no facet is near: a node so deep behind an open surface is not in its body but has passed it by.
  bool surely_outside(const Vector3<double>& place) const { return near(place).empty(); }

  /// `place` in the body frame. T: double or Dual.
  template <class T>
  SurfacePoint<T> nearest(const Vector3<T>& place) const {
    const Feature feature = find({value_of(place[0]), value_of(place[1]), value_of(place[2])});
    const Vector3<T> arm{place[0] - feature.at[0], place[1] - feature.at[1], place[2] - feature.at[2]};
    const Vector3<T> normal{T(feature.normal[0]), T(feature.normal[1]), T(feature.normal[2])};
    if (feature.flat) return {dot(arm, normal), normal};
    // An edge turns only the part of the arm that is across it; its direction vanishes for a vertex.
    const Vector3<T> edge{T(feature.direction[0]), T(feature.direction[1]), T(feature.direction[2])};
    const Vector3<T> across = arm - dot(arm, edge) * edge;
    const T distance = square_root(dot(across, across));
    const T sign_over_distance = feature.side / distance;
    return {feature.side * distance, sign_over_distance * across};
  }

 private:
  struct Triangle {
    std::array<std::int32_t, 3> vertex{}, edge{};  // edge i runs from vertex i to the next
    Vector3<double> normal{}, centre{};
    double radius = 0.0;  // about the centre
  };
  struct Edge {
    Vector3<double> normal_sum{};  // of the facets that meet there
    int facets = 0;
  };
  struct Feature {
    bool flat = true;  // a facet, or an edge or vertex so near that only the mean normal is defined
    Vector3<double> at{}, normal{}, direction{};
    double side = 1.0;  // +1 outside
  };
  /// Where on a triangle the nearest point lies: inside (edge and vertex -1), on an edge, or at a vertex.
  struct Foot {
    double square = 0.0;  // of the distance
    int edge = -1, vertex = -1;
    Vector3<double> at{};
  };
  using Bucket = std::array<std::int32_t, 3>;
  struct BucketHash {
    std::size_t operator()(const Bucket& bucket) const;
  };

  void add_facet(std::span<const std::int32_t> vertices);
  void add_triangle(const std::array<std::int32_t, 3>& vertex);
  void join_edges();
  void weigh_vertices();
  void fill_buckets();
  Bucket bucket_of(const Vector3<double>& place) const;
  std::span<const std::int32_t> near(const Vector3<double>& place) const;
  Foot foot(const Triangle& triangle, const Vector3<double>& place) const;
  Feature find(const Vector3<double>& place) const;
  /// True unless every point of the triangle is surely further off than that square of a distance.
  bool reaches(const Triangle& triangle, const Vector3<double>& place, double square) const;
  Feature feature_of(const Triangle& triangle, const Foot& foot, const Vector3<double>& place) const;

  std::vector<Vector3<double>> vertices_, vertex_normals_;
  std::vector<bool> free_vertex_;  // at the rim of an open surface
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  double spacing_ = 1.0;  // of the buckets: the mean length of the edges
  std::unordered_map<Bucket, std::vector<std::int32_t>, BucketHash> buckets_;
};

}  // namespace balocco
