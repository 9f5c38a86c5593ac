// A surface of the faces of deformable elements: the place of it that is nearest to a point, where its nodes are now.
//
// Nearest is the foot of the normal on a face or, where the point is over no face, the nearest place of an edge or a corner that faces
// share. A surface that ends has nothing beyond its end but for a margin, a tenth of an edge, by which its outermost faces go on: so
// equal surfaces stay together while they slip.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "elements/any_face.hpp"
#include "math/tensor.hpp"
#include "model/model.hpp"

namespace balocco {

/// The nearest place of a surface.
struct FacePlace {
  std::int32_t face = -1;  // -1: none is near
  double xi = 0.0, eta = 0.0;
  int freedoms = 2;  // ways in which a foot may move there: 2 within the face, 1 along an edge, 0 at a corner
  std::array<std::array<double, 2>, 2> way{{{1.0, 0.0}, {0.0, 1.0}}};  // those, in (xi, eta)
  Vector3<double> normal{};  // unit, outward: of the face; from an edge or a corner along the arm, on it the mean of the faces there
  double distance = 0.0;     // positive outside
};

class MasterFaces {
 public:
  MasterFaces() = default;
  /// `local_node`: of each model row; all nodes of the surface are local.
  MasterFaces(const Model& model, const Surface& surface, std::span<const std::int32_t> local_node);

  std::int32_t size() const { return static_cast<std::int32_t>(faces_.size()); }
  std::span<const std::int32_t> nodes(std::int32_t face) const { return faces_[face].nodes; }  // local
  /// How deep below the surface a place may be that has not passed it by.
  double reach() const { return reach_; }
  void set_reach(double reach) { reach_ = reach; }
  /// Mean edge of the faces, undeformed.
  double edge() const { return edge_; }

  /// Sorts the faces by where they are: `position` has 4 values a node. Until the next call they, and what is near them, may move by half
  /// of the reach.
  void locate(const double* position);
  FacePlace nearest(const double* position, const Vector3<double>& place) const;
  /// Of a face and its coordinates.
  Vector3<double> at(const double* position, std::int32_t face, double xi, double eta) const;

 private:
  struct Face {
    std::vector<std::int32_t> nodes;
    std::array<std::int32_t, 4> neighbour{-1, -1, -1, -1};  // across edge i, from corner i to the next; -1: the surface ends there
  };
  using Cell = std::array<std::int32_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  struct Box {
    Vector3<double> low, high;
  };

  void join_edges(std::size_t nodes);
  Cell cell_of(const Vector3<double>& place) const;
  Box box_around(const double* position, const Face& face) const;
  /// The foot on a face, on its edges too if those do not end the surface; face -1 if there is none.
  FacePlace foot(const double* position, std::int32_t face, const Vector3<double>& place) const;
  /// Below this a place is surely not from a face.
  double least_distance(const double* position, std::int32_t face, const Vector3<double>& place) const;
  bool foot_within(const double* position, const Face& face, const Vector3<double>& place, FacePlace& foot) const;
  void foot_on_edge(const double* position, std::int32_t face, int edge, const Vector3<double>& place, FacePlace& best) const;
  Vector3<double> mean_normal(const double* position, const FacePlace& foot, int edge, int corner) const;
  Vector3<double> normal_at(const double* position, const Face& face, double xi, double eta) const;

  std::vector<Face> faces_;
  std::vector<std::vector<std::int32_t>> faces_of_corner_;  // per local node
  std::vector<bool> ends_at_;                               // per local node: a corner at which the surface ends
  double edge_ = 0.0, reach_ = 0.0;
  std::vector<double> radii_;  // about its first node, that a face surely has until it is located again
  std::vector<std::int32_t> everywhere_;  // faces that are too large for cells
  mutable std::vector<std::int32_t> candidates_;  // scratch
  mutable std::vector<double> away_;              // scratch: of candidates
  std::unordered_map<Cell, std::vector<std::int32_t>, CellHash> cells_;
};

}  // namespace balocco
