// Order along a space-filling curve: neighbours in space become neighbours in memory.
#pragma once

#include <cstdint>

#include "model/bounding_box.hpp"

namespace balocco {

/// Position of a point of the box along a three-dimensional Hilbert curve of 2^20 cells a side.
std::uint64_t hilbert_index(const Point& point, const BoundingBox& box);

}  // namespace balocco
