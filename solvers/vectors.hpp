// Three numbers of the model or of the state as a vector.
#pragma once

#include "math/six.hpp"
#include "math/tensor.hpp"

namespace balocco {

inline Vector3<double> vector_of(const std::array<double, 3>& numbers) {
  return {numbers};
}
inline Vector3<double> vector_of(const double* numbers) {
  return {{numbers[0], numbers[1], numbers[2]}};
}

/// Of a pair of vectors the first one's part along a direction, and what is added to it there.
inline double along(const Vector6& six, const std::array<double, 3>& direction) {
  return six[0] * direction[0] + six[1] * direction[1] + six[2] * direction[2];
}
inline void add_along(Vector6& six, double factor, const std::array<double, 3>& direction) {
  for (std::size_t c = 0; c < 3; ++c) six[c] += factor * direction[c];
}

}  // namespace balocco
