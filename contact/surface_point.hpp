// What a contact master answers about a place in its frame.
#pragma once

#include "math/tensor.hpp"

namespace balocco {

template <class T>
struct SurfacePoint {
  T distance;         // positive outside
  Vector3<T> normal;  // unit, outward, body frame
};

}  // namespace balocco
