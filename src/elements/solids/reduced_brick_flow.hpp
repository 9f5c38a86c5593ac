// How the hourglass stresses of C3D8R flow with a metal: else they stay elastic where the centre yields, and hold back what ought
// to change its shape freely. Only HOURGLASS=ENHANCED groups whose material has *PLASTIC pay for it.
//
// The stress-free shape of an element changes: hourglass vectors become q_a = c_(3+a) - F (C_(3+a) + Q_a) with Q_a, referred to the
// material, part of the history. Linearised about the centre, the radial return of J2 flow scales the deviator of every point as it
// does the centre's, by r: q_a = r q_a(trial), Q_a += (1 - r) F^-1 q_a(trial). Affine flow, however large, strains no hourglass mode
// so, and its moduli are those of the shape that flow alone has given to the element, Fp (C_1, C_2, C_3).
#pragma once

#include <array>
#include <limits>

#include "elements/solids/reduced_brick_kernel.hpp"
#include "materials/stretch.hpp"

namespace balocco {

/// What a group needs to know of its metal. Rows are those of an element's history.
struct HourglassFlow {
  static constexpr int history_size = 13;  // Q_1 .. Q_4, then the energy dissipated per element
  int plastic_strain = -1;                 // PEEQ; -1: nothing yields
  int plastic_deformation = -1;            // Fp^-1 - 1
  int failure = -1;                        // FAILED; -1: nothing fails
  double shear = 0.0;                      // modulus G of the centre's return
  double twice_shear = 0.0, plane_ratio = 0.0, young = 0.0;  // 2 G, nu / (1 - nu) and E of the hourglass, with its scale

  static HourglassFlow of(const SolidMaterial& material, const Section& section, int own_history);
  bool active() const { return plastic_strain >= 0; }
};

/// r = mises / (mises + 3 G dp): what is left of a trial deviator after the plastic strain `dp`, from the new P and F.
template <class T>
T flow_factor(const Matrix3<T>& piola, const Matrix3<T>& f, const T& dp, double shear) {
  const Matrix3<T> kirchhoff = piola * transpose(f);
  const T trace = kirchhoff(0, 0) + kirchhoff(1, 1) + kirchhoff(2, 2);
  const T square = maximum(double_contraction(kirchhoff, kirchhoff) - (1.0 / 3.0) * (trace * trace), T(0.0));
  const T mises = square_root(1.5 * square + std::numeric_limits<double>::min());
  return mises / (mises + (3.0 * shear) * dp);
}

/// The record of an element that has flowed: map and stiffness (reduced_brick_reference.hpp) are of its new shape. `Real` is Pack or
/// double: the shape is that at the start of the increment, which has no derivative.
template <class Real, class Reference>
struct FlowedReference {
  static constexpr int first = brick_record::hourglass_map, last = brick_record::volume;
  const Reference& record;
  std::array<Real, last - first> changed;
  Real inverse_size;   // largest eigenvalue of the inverse metric: 1 / (shortest half side)^2 of a box
  Real distortion;     // |Q|^2 over the shortest reference half side squared
  Matrix3<Real> inverse_plastic;  // Fp^-1

  /// `history(k)`: component k of the element's history; `shape`: row of Q.
  FlowedReference(const Reference& reference, const HourglassFlow& flow, int shape, const auto& history) : record(reference) {
    Real square = Real(0.0);
    for (int k = 0; k < 12; ++k) {
      const Real q = history(shape + k);
      changed[k] = reference[first + k] + q;
      square = square + q * q;
    }
    distortion = square * reference[brick_record::gradient_bound];
    inverse_plastic = Matrix3<Real>::identity();
    for (int k = 0; k < 9; ++k) inverse_plastic.component[k] = inverse_plastic.component[k] + history(flow.plastic_deformation + k);
    set_moduli(flow);
  }
  Real operator[](int k) const { return k >= first && k < last ? changed[k - first] : Real(record[k]); }

 private:
  void set_moduli(const HourglassFlow& flow) {
    const Matrix3<Real> cof = cofactor(inverse_plastic);
    const Real inverse = 1.0 / determinant(inverse_plastic, cof);
    std::array<Vector3<Real>, 3> side;  // Fp C_i
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Real sum = cof(0, j) * record[brick_record::stiffness + 3 * i];
        for (int k = 1; k < 3; ++k) sum = sum + cof(k, j) * record[brick_record::stiffness + 3 * i + k];
        side[i][j] = inverse * sum;
      }
    Matrix3<Real> metric;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) metric(i, j) = dot(side[i], side[j]);
    const Matrix3<Real> metric_cofactor = cofactor(metric);
    const Real over = 1.0 / determinant(metric, metric_cofactor);
    const Real trace = metric_cofactor(0, 0) + metric_cofactor(1, 1) + metric_cofactor(2, 2);
    inverse_size = largest_eigenvalue_bound(over * trace, over * (metric(0, 0) + metric(1, 1) + metric(2, 2)));

    Real* const stiffness = &changed[brick_record::stiffness - first];
    const Real volume = record[brick_record::volume];
    set_class(flow, volume, metric(0, 0), metric(1, 1), metric(0, 1), stiffness);
    set_class(flow, volume, metric(0, 0), metric(2, 2), metric(0, 2), stiffness + 6);
    set_class(flow, volume, metric(1, 1), metric(2, 2), metric(1, 2), stiffness + 12);
    for (int i = 0; i < 3; ++i) stiffness[18 + i] = ((1.0 / 9.0) * flow.young) * volume / (metric(i, i) * metric(i, i));
  }

  /// V/3 times the plane-stress moduli 2 G (h^ac h^bd + nu / (1 - nu) h^ab h^cd) with the inverse h of a class's metric.
  static void set_class(const HourglassFlow& flow, const Real& volume, const Real& g11, const Real& g22, const Real& g12,
                        Real* stiffness) {
    const Real inverse = 1.0 / (g11 * g22 - g12 * g12), h11 = inverse * g22, h22 = inverse * g11, h12 = -(inverse * g12);
    const Real weight = ((1.0 / 3.0) * flow.twice_shear) * volume;
    const double ratio = flow.plane_ratio;
    stiffness[0] = weight * ((1.0 + ratio) * (h11 * h11));
    stiffness[1] = weight * (h12 * h12 + ratio * (h11 * h22));
    stiffness[2] = weight * ((1.0 + ratio) * (h11 * h12));
    stiffness[3] = weight * ((1.0 + ratio) * (h22 * h22));
    stiffness[4] = weight * ((1.0 + ratio) * (h22 * h12));
    stiffness[5] = weight * (0.5 * (h11 * h22 + h12 * h12) + ratio * (h12 * h12));
  }
};

/// Hourglass vectors after flow.
template <class T>
std::array<Vector3<T>, 4> flowed(const T& factor, const std::array<Vector3<T>, 4>& trial) {
  return {factor * trial[0], factor * trial[1], factor * trial[2], factor * trial[3]};
}

/// What the flow by (1 - r) of the trial strain, `strain` / r, dissipates against the stress it leaves.
template <class T>
T flow_dissipation(const T& factor, const std::array<T, 12>& strain, const auto& reference) {
  return 2.0 * (1.0 - factor) * hourglass_energy(strain, reference) / maximum(factor, T(std::numeric_limits<double>::min()));
}

/// Changes of Q by (1 - r) F^-1 q(trial), from the invariants of F.
template <class T>
std::array<T, 12> shape_change(const T& factor, const std::array<Vector3<T>, 4>& trial, const Invariants<T>& c) {
  const T weight = (1.0 - factor) / c.jacobian;
  std::array<T, 12> change;
  for (int a = 0; a < 4; ++a)
    for (int j = 0; j < 3; ++j)
      change[3 * a + j] = weight * (c.cofactor(0, j) * trial[a][0] + c.cofactor(1, j) * trial[a][1] +
                                    c.cofactor(2, j) * trial[a][2]);
  return change;
}

}  // namespace balocco
