// Directions in which the degrees of freedom of a node count: global unless *TRANSFORM says otherwise.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "math/tensor.hpp"
#include "model/model.hpp"

namespace balocco {

/// Local axes (rows: unit vectors of directions 1, 2, 3) of an orientation at a point.
Matrix3<double> local_axes(const Orientation& orientation, const Point& point);

class NodalDirections {
 public:
  explicit NodalDirections(const Model& model);

  /// The node's directions (rows), or nullptr where they are the global ones.
  const Matrix3<double>* find(std::int32_t node_row) const {
    const auto entry = directions_.find(node_row);
    return entry == directions_.end() ? nullptr : &entry->second;
  }
  /// Unit vector of translation or rotation `axis` (0-2) of a node.
  Point direction(std::int32_t node_row, int axis) const;

 private:
  std::unordered_map<std::int32_t, Matrix3<double>> directions_;
};

}  // namespace balocco
