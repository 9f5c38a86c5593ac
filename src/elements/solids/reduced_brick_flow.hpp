// How the hourglass stresses of C3D8R flow in a metal: else they stay elastic where the element yields, and hold back what ought to
// change its shape freely. Only HOURGLASS=ENHANCED groups whose material has *PLASTIC pay for it.
//
// The stress-free shape of an element changes: hourglass vectors become q_a = c_(3+a) - F (C_(3+a) + Q_a) with Q_a, referred to the
// material, part of the history: q_a = r q_a(trial), Q_a += (1 - r) F^-1 q_a(trial). Hourglass stresses are measured at eight points,
// xi, eta, zeta = +- 2/3, where a layer under a linear stress gives the plastic moment of its thickness, 3/2 of that at first yield: so
// they yield in bending, in which the centre is at rest. What flows there is a plastic strain of their own, (1 - r) mises / E, by which
// that yield hardens: at 2/3 it is that of which linear hardening makes the moment H kappa h^3 / 12. What the centre carries is taken
// from it, as a normal force takes from the moment of a plate, 1 - n^2; a tenth is left where the centre flows, or nothing would resist
// hourglass motion there. The return is a projection: repeated, it changes nothing, so forces do not depend on how fine increments are.
// Affine flow, however large, strains no hourglass mode so, and its moduli are those of the shape that flow alone has given to the
// element, Fp (C_1, C_2, C_3).
#pragma once

#include <array>
#include <limits>

#include "elements/solids/reduced_brick_kernel.hpp"
#include "materials/flow_stress.hpp"
#include "materials/stretch.hpp"
#include "math/symmetric_tensor.hpp"

namespace balocco {

/// What a group needs to know of its metal. Rows are those of an element's history.
struct HourglassFlow {
  /// Rows: Q_1 .. Q_4, the energy dissipated per element, the elastic one, and the plastic strain of the hourglass.
  static constexpr int dissipated = 12, elastic = 13, hardening = 14, history_size = 15;
  /// Share of the hourglass's yield stress that a centre which flows takes.
  static constexpr double taken = 0.9;
  static constexpr int law_rows = 10;      // of the law's history: Fp^-1 - 1, and PEEQ after it
  int plastic_strain = -1;                 // PEEQ; -1: nothing yields
  int plastic_deformation = -1;            // Fp^-1 - 1
  int failure = -1;                        // FAILED; -1: nothing fails
  FlowStress yield;
  double least_yield = 0.0;                // of all plastic strains
  double twice_shear = 0.0, plane_ratio = 0.0, young = 0.0;  // 2 G, nu / (1 - nu) and E of the hourglass, with its scale

  static HourglassFlow of(const SolidMaterial& solid, const Material& material, const Section& section, int own_history);
  bool active() const { return plastic_strain >= 0; }
};

template <class T>
SymmetricTensor<T> deviator_of(const SymmetricTensor<T>& a) {
  return a.plus_identity((-1.0 / 3.0) * trace(a));
}

/// Mises' measure of Kirchhoff's stress of the centre.
template <class T>
T centre_mises(const Matrix3<T>& piola, const Matrix3<T>& f) {
  const auto deviator = deviator_of(symmetric_part(piola * transpose(f)));
  return square_root(1.5 * double_contraction(deviator, deviator) + std::numeric_limits<double>::min());
}

/// Root mean square, over the eight points, of mises' measure of the hourglass stresses. Deviators there are the linear ones of the
/// classes zeta, eta, xi and the bilinear ones of mode xi eta zeta, each with a pattern of signs orthogonal to all others.
template <class T>
T hourglass_mises(const HexahedronCoefficients<T>& c, const std::array<T, 12>& stress, const T& volume) {
  constexpr double place = 2.0 / 3.0;
  const auto dyad = [&](int a, int b) {
    const auto component = [&](int i, int j) { return 0.5 * (c[a][i] * c[b][j] + c[b][i] * c[a][j]); };
    return deviator_of(SymmetricTensor<T>{
        {component(0, 0), component(1, 1), component(2, 2), component(0, 1), component(0, 2), component(1, 2)}});
  };
  const std::array<SymmetricTensor<T>, 3> along{dyad(0, 0), dyad(1, 1), dyad(2, 2)};
  const T linear = (3.0 * place) / volume, bilinear = (9.0 * place * place) / volume;
  constexpr int axes[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  T square = T(std::numeric_limits<double>::min());
  for (int k = 0; k < 3; ++k) {
    const auto [a, b] = axes[k];
    const auto of_class = (linear * stress[3 * k]) * along[a] + (linear * stress[3 * k + 1]) * along[b] +
                          (2.0 * (linear * stress[3 * k + 2])) * dyad(a, b);
    const auto of_mode = (bilinear * stress[9 + k]) * along[k];
    square = square + double_contraction(of_class, of_class) + double_contraction(of_mode, of_mode);
  }
  return square_root(1.5 * square);
}

/// What one increment makes of the trial hourglass stresses.
template <class T>
struct HourglassReturn {
  T factor = T(1.0);          // r, what is left of them, 0 <= r <= 1
  T plastic_strain = T(0.0);  // by how much that of the hourglass grows
};

/// What of a trial hourglass stress (mises) the hourglass carries: its yield stress, that of the curve at `plastic_strain` (of the centre
/// and of the hourglass before the increment) or the centre's own; less what the centre takes of it; and what it hardens by.
template <class T>
T hourglass_limit(const T& centre, const T& plastic_strain, const T& trial, const HourglassFlow& flow) {
  const auto curve = flow.yield.static_curve(value_of(plastic_strain));
  const T yield = maximum(centre, T(curve.value) + T(curve.slope) * (plastic_strain - T(value_of(plastic_strain))));
  const T share = centre / yield, left = 1.0 - HourglassFlow::taken * (share * share);
  const T before = left * yield, slope = left * T(curve.slope);
  return before + slope / (flow.young + slope) * maximum(trial - before, T(0.0));
}

/// The return of the trial hourglass stresses to what they may be beside `centre`, the mises stress there. `plastic_strain`: of centre and
/// hourglass. `energy`: of the trial stresses.
template <class T>
HourglassReturn<T> hourglass_return(const T& centre, const T& plastic_strain, const HexahedronCoefficients<T>& c,
                                    const std::array<T, 12>& stress, const T& energy, const T& volume, const HourglassFlow& flow) {
  // Six patterns, of each of which mises^2 <= 4 E energy / volume at the points.
  const T reach = square_root((24.0 * flow.young) * energy / volume + std::numeric_limits<double>::min());
  if (!any(value_of(reach) > (1.0 - HourglassFlow::taken) * flow.least_yield)) return {};
  const T trial = hourglass_mises(c, stress, volume);
  const T kept = -maximum(-trial, -hourglass_limit(centre, plastic_strain, trial, flow));
  return {kept / trial, (1.0 / flow.young) * (trial - kept)};
}

/// The record of an element that has flowed: map and stiffness (reduced_brick_reference.hpp) are of its new shape. `Real`: Pack, double
/// or a dual.
template <class Real, class Reference>
struct FlowedReference {
  static constexpr int map = brick_record::hourglass_map, map_size = 12;
  const Reference& record;
  std::array<Real, map_size> shape;
  std::array<Real, brick_record::full_stiffness> stiffness;
  Matrix3<Real> inverse_plastic;  // Fp^-1
  Matrix3<Real> metric;           // of the sides, Fp (C_1, C_2, C_3)

  /// `history(k)`: component k of the element's history; `shape_row`: of Q.
  FlowedReference(const Reference& reference, const HourglassFlow& flow, int shape_row, const auto& history) : record(reference) {
    for (int k = 0; k < map_size; ++k) shape[k] = reference[map + k] + history(shape_row + k);
    inverse_plastic = Matrix3<Real>::identity();
    for (int k = 0; k < 9; ++k) inverse_plastic.component[k] = inverse_plastic.component[k] + history(flow.plastic_deformation + k);
    set_moduli(flow);
  }
  /// Adds a change of Q.
  void add_shape(const std::array<Real, map_size>& change) {
    for (int k = 0; k < map_size; ++k) shape[k] = shape[k] + change[k];
  }
  /// Largest eigenvalue of the inverse metric: 1 / (shortest half side)^2 of a box.
  Real inverse_size() const {
    const Matrix3<Real> cof = cofactor(metric);
    const Real over = 1.0 / determinant(metric, cof);
    return largest_eigenvalue_bound(over * (cof(0, 0) + cof(1, 1) + cof(2, 2)), over * (metric(0, 0) + metric(1, 1) + metric(2, 2)));
  }
  /// |Q|^2 over the shortest reference half side squared.
  Real distortion() const {
    Real square = Real(0.0);
    for (int k = 0; k < map_size; ++k) {
      const Real q = shape[k] - record[map + k];
      square = square + q * q;
    }
    return square * record[brick_record::gradient_bound];
  }
  Real operator[](int k) const {
    if (k >= brick_record::stiffness) return stiffness[k - brick_record::stiffness];
    return k >= map && k < map + map_size ? shape[k - map] : Real(record[k]);
  }

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
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) metric(i, j) = dot(side[i], side[j]);

    const Real volume = record[brick_record::volume];
    set_class(flow, volume, metric(0, 0), metric(1, 1), metric(0, 1), &stiffness[0]);
    set_class(flow, volume, metric(0, 0), metric(2, 2), metric(0, 2), &stiffness[6]);
    set_class(flow, volume, metric(1, 1), metric(2, 2), metric(1, 2), &stiffness[12]);
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

/// Stresses and energy of hourglass vectors before their flow.
template <class T>
struct HourglassTrial {
  std::array<T, 12> stress;
  T energy = T(0.0);

  HourglassTrial(const HexahedronCoefficients<T>& c, const std::array<Vector3<T>, 4>& q, const auto& reference) {
    const auto strain = hourglass_strains(c, q);
    stress = hourglass_stresses(strain, reference);
    for (int k = 0; k < 12; ++k) energy = energy + 0.5 * strain[k] * stress[k];
  }
};

/// Hourglass vectors after flow.
template <class T>
std::array<Vector3<T>, 4> flowed(const T& factor, const std::array<Vector3<T>, 4>& trial) {
  return {factor * trial[0], factor * trial[1], factor * trial[2], factor * trial[3]};
}

/// What the flow by (1 - r) of the trial strain dissipates against the mean of the stresses before and after the increment, those
/// before taken to be in proportion: (1 - r) (r + s) energy with s^2 = old / trial energy.
template <class T>
T flow_dissipation(const T& factor, const T& trial_energy, const T& old_energy) {
  return (1.0 - factor) * (factor * trial_energy + square_root(maximum(old_energy * trial_energy, T(0.0))));
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
