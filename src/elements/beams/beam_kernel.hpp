// Kinematics and forces of a two-node beam, one text for T = double, Pack and Dual.
//
// Geometrically exact (Simo and Vu-Quoc, Comput. Methods Appl. Mech. Eng. 58 (1986) 79-116) with one integration point. The section
// of the middle has the rotation halfway between those of the nodes, so that strains are objective and do not depend on the path
// (Crisfield and Jelenic, Proc. R. Soc. A 455 (1999) 1125-1147): with unit quaternions qa, qb on one side, q = (qa + qb) / |qa + qb|.
//   stretch and shear   g = E^T R(q)^T (xb - xa) / L - e3      curvature   k = E^T psi / L
// where the columns of E are n1, n2 and the axis in the reference configuration and psi is the rotation vector from a to b in the
// frame of the middle.
#pragma once

#include <array>

#include "math/dual.hpp"
#include "math/pack.hpp"
#include "math/rotation.hpp"

namespace balocco {

/// Six numbers along n1, n2 and the axis: shear, shear, stretch; curvatures about n1 and n2, twist. Or what is conjugate to them.
template <class T>
using BeamVector = std::array<T, 6>;

template <class T>
struct BeamKinematics {
  Vector3<T> axis;             // from the first node to the second
  Vector3<T> relative;         // vector part of the rotation from a to b, in the frame of the middle
  Quaternion<T> a, b;          // of the nodes, on one side
  Quaternion<T> sum;           // a + b
  T inverse_square;            // 1 / |sum|^2
  Vector3<T> half_turn;        // tangent of a quarter of the relative rotation times its axis; global directions
  T arc, arc_slope;            // of the rotation vector by `relative`, see below
  BeamVector<T> strain;
};

/// asin(s) / s by x = s^2, and its derivative: exact to 1e-11 where an element bends by half a radian, smooth anywhere.
template <class T>
void arc_factors(const T& x, T& arc, T& slope) {
  constexpr double c[] = {1.0, 1.0 / 6, 3.0 / 40, 5.0 / 112, 35.0 / 1152, 63.0 / 2816, 231.0 / 13312, 143.0 / 10240};
  arc = T(c[7]);
  slope = T(7.0 * c[7]);
  for (int k = 6; k >= 1; --k) {
    arc = arc * x + c[k];
    slope = slope * x + k * c[k];
  }
  arc = arc * x + c[0];
}

template <class T>
Vector3<T> vector_part(const Quaternion<T>& q) {
  return {{q[1], q[2], q[3]}};
}

template <class T>
Quaternion<T> conjugate(const Quaternion<T>& q) {
  return {q[0], -q[1], -q[2], -q[3]};
}

/// `frame`: E, its columns n1, n2, axis (row-major).
template <class T, class C>
BeamKinematics<T> beam_kinematics(const Vector3<T>& axis, const Quaternion<T>& a, const Quaternion<T>& other,
                                  const Matrix3<C>& frame, const C& inverse_length) {
  BeamKinematics<T> k;
  k.axis = axis;
  k.a = a;
  T cosine = a[0] * other[0] + a[1] * other[1] + a[2] * other[2] + a[3] * other[3];
  const T side = select(cosine < T(0.0), T(-1.0), T(1.0));
  cosine = side * cosine;
  for (int i = 0; i < 4; ++i) {
    k.b[i] = side * other[i];
    k.sum[i] = k.a[i] + k.b[i];
  }
  k.inverse_square = 0.5 / (1.0 + cosine);
  k.relative = vector_part(product(conjugate(k.a), k.b));
  k.half_turn = (2.0 * k.inverse_square) * vector_part(product(k.b, conjugate(k.a)));
  arc_factors(dot(k.relative, k.relative), k.arc, k.arc_slope);

  // R(q)^T v = v + 2 / |sum|^2 (u x (u x v) - w u x v)
  const Vector3<T> u = vector_part(k.sum), across = cross(u, axis);
  const Vector3<T> back = axis + (2.0 * k.inverse_square) * (cross(u, across) - k.sum[0] * across);
  for (int i = 0; i < 3; ++i) {
    const T along = frame(0, i) * back[0] + frame(1, i) * back[1] + frame(2, i) * back[2];
    const T turn = frame(0, i) * k.relative[0] + frame(1, i) * k.relative[1] + frame(2, i) * k.relative[2];
    k.strain[i] = inverse_length * along - (i == 2 ? 1.0 : 0.0);
    k.strain[3 + i] = (2.0 * inverse_length) * (k.arc * turn);
  }
  return k;
}

/// Internal forces: on the second node, the first node gets the opposite; and moments on both, conjugate to spins in global axes.
template <class T>
struct BeamForces {
  Vector3<T> force, moment_a, moment_b;
};

/// `resultant`: forces along n1, n2 and the axis of the middle's section, moments about them.
template <class T, class C>
BeamForces<T> beam_forces(const BeamKinematics<T>& k, const BeamVector<T>& resultant, const Matrix3<C>& frame) {
  Vector3<T> force, moment;
  for (int i = 0; i < 3; ++i) {
    force[i] = frame(i, 0) * resultant[0] + frame(i, 1) * resultant[1] + frame(i, 2) * resultant[2];
    moment[i] = frame(i, 0) * resultant[3] + frame(i, 1) * resultant[4] + frame(i, 2) * resultant[5];
  }
  BeamForces<T> f;
  const Vector3<T> u = vector_part(k.sum), across = cross(u, force);
  f.force = force + (2.0 * k.inverse_square) * (cross(u, across) + k.sum[0] * across);
  // Work of the moments: moment . d(2 arc relative), and d relative = vector part of (a* db + da* b).
  const Vector3<T> w = k.arc * moment + (2.0 * (k.arc_slope * dot(moment, k.relative))) * k.relative;
  const Vector3<T> bending = vector_part(product(product(k.a, Quaternion<T>{T(0.0), w[0], w[1], w[2]}), conjugate(k.b)));
  // The force turns the middle, whose spin is that of both nodes, half each, and a part across the relative rotation.
  const Vector3<T> couple = cross(f.force, k.axis), skew = cross(couple, k.half_turn);
  f.moment_a = 0.5 * (couple + skew) - bending;
  f.moment_b = 0.5 * (couple - skew) + bending;
  return f;
}

}  // namespace balocco
