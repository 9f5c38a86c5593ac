// The stable increment of a one-point brick from its current state: never above 2 / omega_max of the free element.
#pragma once

#include "elements/bulk_viscosity.hpp"
#include "elements/solids/reduced_brick_kernel.hpp"
#include "materials/law_of.hpp"
#include "materials/stretch.hpp"

namespace balocco {

/// Nodal masses are rho V / 8, and sum_I |v_I|^2 = 8 sum_k |dc_k|^2, so omega^2 <= max d2E / (rho V sum |dc_k|^2). With
/// dF = sum dc_k (x) beta_k:
///   uniform strain: (F^-T : dF)^2 <= sum |F^-T beta_k|^2 = C^-1 : B,  dF : dF <= largest eigenvalue of B = sum beta_k
///   (x) beta_k; hourglass:      largest reference eigenvalue h times (|F| + Q)^2 with Q = |q| / (shortest half side),
///   including its geometric
///                   part; (|F| + Q)^2 <= 5/4 |F|^2 + 5 Q^2, which never governs an undeformed brick.
/// The two act on subspaces that a parallelepiped keeps orthogonal; else the sum of two projections at cos^2 = overlap
/// bounds them:
///   (a + b)/2 + sqrt((a - b)^2 / 4 + a b cos^2).
/// So a free cube gets omega^2 = 4 (3 lambda + 2 mu) / (rho L^2), its dilatation: L / c_d would be unsafe.
template <class T>
struct BrickStability {
  double density;
  T damping_beta;

  T increment(const Invariants<T>& c, const TangentBound<T>& bound, const std::array<Vector3<T>, 4>& q,
              const T& viscous_slope, const auto& reference) const {
    const T gradient_bound = reference[brick_record::gradient_bound];
    const T size = dot(q[0], q[0]) + dot(q[1], q[1]) + dot(q[2], q[2]) + dot(q[3], q[3]);
    const T stretch = largest_eigenvalue_bound(c.first, c.second);
    const T hourglass = reference[brick_record::hourglass_bound] * (1.25 * stretch + 5.0 * (gradient_bound * size));
    return increment(c, bound, Hourglass{hourglass, reference[brick_record::overlap]}, viscous_slope, reference);
  }

  /// The same of an element whose shape has flowed: F there is the elastic one, Fe = F Fp^-1, sides are those of the new shape, and
  /// an hourglass row h_a becomes h_a - sum_k (beta_k . Q_a) e_k, whose last term, at most |Q| = u / (shortest half side), lies
  /// among the uniform strains: |h|^2 <= (cos + u)^2 + 1 - cos^2, of which (cos + u)^2 is common to both.
  T increment(const Invariants<T>& c, const Matrix3<T>& f, const TangentBound<T>& bound, const std::array<Vector3<T>, 4>& q,
              const T& viscous_slope, const auto& flowed) const {
    const Matrix3<T> elastic = f * flowed.inverse_plastic, cofactor_of_elastic = cofactor(elastic);
    const T stretch = largest_eigenvalue_bound(double_contraction(elastic, elastic),
                                               double_contraction(cofactor_of_elastic, cofactor_of_elastic));
    const T size = dot(q[0], q[0]) + dot(q[1], q[1]) + dot(q[2], q[2]) + dot(q[3], q[3]);
    const T overlap = flowed[brick_record::overlap], cosine = square_root(overlap) + square_root(flowed.distortion());
    const T square = cosine * cosine + (1.0 - overlap);
    const T inverse_size = flowed.inverse_size(), modulus = flowed[brick_record::hourglass_bound] * inverse_size;
    const T hourglass = modulus * square * (1.25 * stretch + 5.0 * (inverse_size * size));
    return increment(c, bound, Hourglass{hourglass, cosine * cosine / square}, viscous_slope, flowed);
  }

 private:
  /// Largest stiffness of the hourglass modes per volume, and how much of them is uniform strain.
  struct Hourglass {
    T stiffness, overlap;
  };
  T increment(const Invariants<T>& c, const TangentBound<T>& bound, const Hourglass& hourglass, const T& viscous_slope,
              const auto& reference) const {
    const T gradient_bound = reference[brick_record::gradient_bound];
    const T dilatation = inverse_stretch_metric(c.cofactor, reference) / (c.jacobian * c.jacobian);
    const T uniform = bound.volumetric * dilatation + (2.0 * gradient_bound) * bound.shear;
    const T half_difference = 0.5 * (uniform - hourglass.stiffness);
    const T product = uniform * hourglass.stiffness * hourglass.overlap;
    const T stiffness = 0.5 * (uniform + hourglass.stiffness) + square_root(half_difference * half_difference + product);

    const double inverse_density = density > 0.0 ? 1.0 / density : 0.0;
    const T omega_square = inverse_density * stiffness;
    const T rate = inverse_density * (viscous_slope * (c.jacobian * dilatation)) + damping_beta * omega_square;
    const T increment = neutral_increment(omega_square, rate);
    return select(c.jacobian > 0.0 && increment > 0.0, increment, T(0.0));  // inverted or not a number: 0
  }

  /// cof(F)^T cof(F) : B = sum_k |cof(F) beta_k|^2.
  static T inverse_stretch_metric(const Matrix3<T>& cofactor, const auto& reference) {
    T sum = T(0.0);
    for (int k = 0; k < 7; ++k) {
      const int b = brick_record::mean_gradient + 3 * k;
      const T x = reference[b], y = reference[b + 1], z = reference[b + 2];
      for (int i = 0; i < 3; ++i) {
        const T component = cofactor(i, 0) * x + cofactor(i, 1) * y + cofactor(i, 2) * z;
        sum = sum + component * component;
      }
    }
    return sum;
  }
};

}  // namespace balocco
