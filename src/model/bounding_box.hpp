// How large a model is.
#pragma once

#include <span>

#include "model/model.hpp"

namespace balocco {

struct BoundingBox {
  Point low{}, high{};
};

BoundingBox bounding_box(std::span<const Point> points);

/// Diagonal of the box around all nodes in the reference configuration; 1 where they lie in one place.
double model_size(const Model& model);

}  // namespace balocco
