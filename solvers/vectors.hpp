// Three numbers of the model or of the state as a vector.
#pragma once

#include "math/tensor.hpp"

namespace balocco {

inline Vector3<double> vector_of(const std::array<double, 3>& numbers) {
  return {numbers};
}
inline Vector3<double> vector_of(const double* numbers) {
  return {{numbers[0], numbers[1], numbers[2]}};
}

}  // namespace balocco
