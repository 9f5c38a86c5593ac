#include "constraints/face_projection.hpp"

#include <algorithm>
#include <cmath>

#include "elements/any_face.hpp"
#include "elements/surface_nodes.hpp"
#include "math/tensor.hpp"

namespace balocco {

namespace {

/// Back onto the face.
void clamp(std::size_t nodes, double& r, double& s) {
  if (!is_triangle(nodes)) {
    r = std::clamp(r, -1.0, 1.0);
    s = std::clamp(s, -1.0, 1.0);
    return;
  }
  r = std::clamp(r, 0.0, 1.0);
  s = std::clamp(s, 0.0, 1.0);
  if (const double excess = r + s - 1.0; excess > 0.0) {
    r = std::clamp(r - 0.5 * excess, 0.0, 1.0);
    s = 1.0 - r;
  }
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

FaceProjection::FaceProjection(const Model& model, const Surface& surface) : model_(model) {
  double sum = 0.0;
  std::size_t edges = 0;
  for (const auto& reference : surface.faces) {
    Face face{.nodes = face_nodes(model, reference)};
    face.low = face.high = model.nodes.coordinates[face.nodes.front()];
    const std::size_t corners = corners_of_face(face.nodes.size());
    for (std::size_t i = 0; i < face.nodes.size(); ++i) {
      const auto& at = model.nodes.coordinates[face.nodes[i]];
      for (int c = 0; c < 3; ++c) {
        face.low[c] = std::min(face.low[c], at[c]);
        face.high[c] = std::max(face.high[c], at[c]);
      }
      if (i >= corners) continue;
      sum += distance(at, model.nodes.coordinates[face.nodes[(i + 1) % corners]]);
      ++edges;
    }
    faces_.push_back(std::move(face));
  }
  mean_edge_ = edges > 0 ? sum / static_cast<double>(edges) : 0.0;
}

/// Least squares by Gauss-Newton from the middle, held on the face.
std::optional<FacePoint> FaceProjection::project(const Face& face, const Point& point) const {
  constexpr int most_iterations = 30;
  const std::size_t nodes = face.nodes.size();
  double r = is_triangle(nodes) ? 1.0 / 3.0 : 0.0, s = r;
  FacePoint result{.nodes = face.nodes, .weights = {}, .position = {}, .distance = 0.0};
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto shapes = face_shapes(nodes, r, s);
    Vector3<double> place{}, along_r{}, along_s{};
    for (std::size_t i = 0; i < nodes; ++i) {
      const Vector3<double> at{model_.nodes.coordinates[face.nodes[i]]};
      place = place + shapes.value[i] * at;
      along_r = along_r + shapes.by_xi[i] * at;
      along_s = along_s + shapes.by_eta[i] * at;
    }
    result.position = place.component;
    result.weights.assign(shapes.value.begin(), shapes.value.begin() + static_cast<std::ptrdiff_t>(nodes));
    const auto apart = Vector3<double>{point} - place;
    const double rr = dot(along_r, along_r), rs = dot(along_r, along_s), ss = dot(along_s, along_s), determinant = rr * ss - rs * rs;
    if (!(determinant > 1e-14 * rr * ss)) return std::nullopt;
    const double right_r = dot(along_r, apart), right_s = dot(along_s, apart);
    const double old_r = r, old_s = s;
    r += (ss * right_r - rs * right_s) / determinant;
    s += (rr * right_s - rs * right_r) / determinant;
    clamp(nodes, r, s);
    if (std::abs(r - old_r) + std::abs(s - old_s) < 1e-13) break;
  }
  result.distance = distance(result.position, point);
  return result;
}

std::optional<FacePoint> FaceProjection::nearest(const Point& point, double reach) const {
  std::optional<FacePoint> best;
  double within = reach;
  for (const auto& face : faces_) {
    bool near = true;
    for (int c = 0; c < 3; ++c) near = near && point[c] >= face.low[c] - within && point[c] <= face.high[c] + within;
    if (!near) continue;
    auto found = project(face, point);
    if (!found || found->distance > within || (best && found->distance >= best->distance)) continue;
    within = found->distance;
    best = std::move(found);
  }
  return best;
}

}  // namespace balocco
