// The motions of two nodes as independent variables, for functions of their frames: dual numbers over displacement and spin of each.
#pragma once

#include <array>

#include "math/dual.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Derivatives by the 12 motions: displacement and spin (global axes) of the first node, then of the second.
using Slope = Dual<12>;
/// Virtual motions over real ones: derivative[i].derivative[j] is the change of slope i along motion j.
using Curvature = Dual<12, Slope>;

template <class T>
struct MotionSeed {
  Vector3<T> displacement;
  Matrix3<T> turn;  // of whatever turns with the node, to first order in each spin
};

template <class T>
Matrix3<T> first_order_turn(const Vector3<T>& spin) {
  return {{T(1.0), -spin[2], spin[1], spin[2], T(1.0), -spin[0], -spin[1], spin[0], T(1.0)}};
}

inline MotionSeed<Slope> slope_seed(int node) {
  const auto seed = [&](int k) { return Slope(0.0, 6 * node + k); };
  return {{{seed(0), seed(1), seed(2)}}, first_order_turn<Slope>({{seed(3), seed(4), seed(5)}})};
}

/// A virtual spin follows a real one, R <- exp(virtual) exp(real) R: the mixed derivative is that of the product.
inline MotionSeed<Curvature> curvature_seed(int node) {
  const auto real = [&](int k) { return Curvature(Slope(0.0, 6 * node + k)); };
  const auto virtual_one = [&](int k) {
    Curvature seed(Slope(0.0));
    seed.derivative[6 * node + k] = Slope(1.0);
    return seed;
  };
  MotionSeed<Curvature> result;
  for (int c = 0; c < 3; ++c) result.displacement[c] = real(c) + virtual_one(c);
  result.turn = first_order_turn<Curvature>({{virtual_one(3), virtual_one(4), virtual_one(5)}}) *
                first_order_turn<Curvature>({{real(3), real(4), real(5)}});
  return result;
}

}  // namespace balocco
