// The nearest place on the faces of a surface: for ties, and for whatever is fixed to a mesh between its nodes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Values at a place of the shape functions of a face with 3, 4, 6 or 8 nodes (corners first), and the place.
struct FacePoint {
  std::vector<std::int32_t> nodes;  // model rows of the face
  std::vector<double> weights;      // of its nodes
  Point position{};
  double distance = 0.0;
};

class FaceProjection {
 public:
  /// Of a surface of element faces.
  FaceProjection(const Model& model, const Surface& surface);

  /// The nearest place of all faces that lie within `reach` of the point, or nothing.
  std::optional<FacePoint> nearest(const Point& point, double reach) const;
  /// Mean length of the edges.
  double mean_edge() const { return mean_edge_; }

 private:
  struct Face {
    std::vector<std::int32_t> nodes;
    Point low{}, high{};
  };
  std::optional<FacePoint> project(const Face& face, const Point& point) const;

  const Model& model_;
  std::vector<Face> faces_;
  double mean_edge_ = 0.0;
};

}  // namespace balocco
