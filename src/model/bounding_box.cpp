#include "model/bounding_box.hpp"

#include <algorithm>
#include <cmath>

namespace balocco {

BoundingBox bounding_box(std::span<const Point> points) {
  if (points.empty()) return {};
  BoundingBox box{points.front(), points.front()};
  for (const auto& point : points) {
    for (std::size_t c = 0; c < 3; ++c) {
      box.low[c] = std::min(box.low[c], point[c]);
      box.high[c] = std::max(box.high[c], point[c]);
    }
  }
  return box;
}

double model_size(const Model& model) {
  const auto [low, high] = bounding_box(model.nodes.coordinates);
  const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  return size > 0.0 ? size : 1.0;
}

}  // namespace balocco
