// Kinematics and nodal forces of membranes, one text for T = double, Pack (explicit loop) and Dual (exact tangent).
//
// Total Lagrangian on the reference mid-surface: tangents F_a = sum x_I B_aI (a = 1, 2), Green strain E_ab = (F_a . F_b - 1) / 2,
// forces f_I = sum over points of V S_ab B_aI F_b. Nodes enter as edges x_I - x_0, so that forces do not depend on where the
// element is and the force on node 0 balances the others.
#pragma once

#include <array>

#include "elements/record_reference.hpp"
#include "math/dual.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Where a kernel finds its reference data: component c of an element lies at base[c * pack_size + lane].
template <int nodes, int points>
struct MembraneLayout {
  static constexpr int edges = nodes - 1;
  static constexpr bool quadrilateral = nodes == 4;
  static constexpr bool one_point_quadrilateral = nodes == 4 && points == 1;
  // Each point: gradients along direction 1 and 2 of nodes 1.., then the reference volume.
  static constexpr int point_size = 2 * edges + 1;
  static constexpr int gamma = points * point_size;             // quadrilaterals: 3
  static constexpr int mean_gg = gamma + (quadrilateral ? 3 : 0);   // quadrilaterals: 11, 22, 12
  static constexpr int hourglass_stiffness = mean_gg + (quadrilateral ? 3 : 0);  // one point: 11, 22, 12, normal, warp
  static constexpr int mass_gradient = hourglass_stiffness + (one_point_quadrilateral ? 5 : 0);  // V sum B_a B_b / m: 11, 22, 12
  static constexpr int viscosity = mass_gradient + 3;           // density * wave speed * length
  static constexpr int mass_gamma = viscosity + 1;              // quadrilaterals: V sum gamma^2 / m, coupling, max |g|, residual
  static constexpr int size = mass_gamma + (quadrilateral ? 4 : 0);
};

template <class T>
struct SurfaceTangents {
  Vector3<T> first, second;
};

/// C_ab = F_a . F_b.
template <class T>
struct Metric {
  T c11, c22, c12;
};

template <class T>
Metric<T> metric(const SurfaceTangents<T>& tangents) {
  return {dot(tangents.first, tangents.first), dot(tangents.second, tangents.second), dot(tangents.first, tangents.second)};
}

template <class T>
T metric_determinant(const Metric<T>& c) {
  return c.c11 * c.c22 - c.c12 * c.c12;
}

/// E11, E22, 2 E12.
template <class T>
std::array<T, 3> green_strain(const Metric<T>& c) {
  return {0.5 * (c.c11 - 1.0), 0.5 * (c.c22 - 1.0), c.c12};
}

template <class T, int nodes, int points>
struct MembraneKernel {
  using Layout = MembraneLayout<nodes, points>;
  using Edges = std::array<Vector3<T>, Layout::edges>;

  static SurfaceTangents<T> tangents(const double* reference, int point, const Edges& edge) {
    const int offset = point * Layout::point_size;
    SurfaceTangents<T> result;
    for (int i = 0; i < Layout::edges; ++i) {
      result.first = result.first + scaled(reference_value<T>(reference, offset + i), edge[i]);
      result.second = result.second + scaled(reference_value<T>(reference, offset + Layout::edges + i), edge[i]);
    }
    return result;
  }

  static Coefficient<T> volume(const double* reference, int point) {
    return reference_value<T>(reference, point * Layout::point_size + 2 * Layout::edges);
  }

  /// q = sum gamma_I x_I: what the affine part of the motion leaves of the hourglass mode.
  static Vector3<T> hourglass_vector(const double* reference, const Edges& edge) {
    Vector3<T> result;
    for (int i = 0; i < Layout::edges; ++i)
      result = result + scaled(reference_value<T>(reference, Layout::gamma + i), edge[i]);
    return result;
  }

  /// One-point quadrilaterals: the element mean of the Green strain holds q . q (g (x) g) / 2 beside that of the mean gradients;
  /// with it the mean stress stiffens the hourglass mode as it does in the fully integrated element.
  static void add_mean_hourglass_strain(const double* reference, const Vector3<T>& q, std::array<T, 3>& strain) {
    const auto warp = reference_value<T>(reference, Layout::hourglass_stiffness + 4);
    const T growth = dot(q, q) - warp * warp;
    strain[0] = strain[0] + 0.5 * (reference_value<T>(reference, Layout::mean_gg) * growth);
    strain[1] = strain[1] + 0.5 * (reference_value<T>(reference, Layout::mean_gg + 1) * growth);
    strain[2] = strain[2] + reference_value<T>(reference, Layout::mean_gg + 2) * growth;
  }

  /// Green strain of a point, with the hourglass part where there is one.
  static std::array<T, 3> strain(const double* reference, const SurfaceTangents<T>& f, const Edges& edge) {
    std::array<T, 3> result = green_strain(metric(f));
    if constexpr (Layout::one_point_quadrilateral)
      add_mean_hourglass_strain(reference, hourglass_vector(reference, edge), result);
    return result;
  }

  /// Adds the internal forces of a point on nodes 1.. (stress S11 S22 S12).
  static void add_forces(const double* reference, int point, const SurfaceTangents<T>& f, const std::array<T, 3>& stress,
                         Edges& force) {
    const auto v = volume(reference, point);
    const T s11 = v * stress[0], s22 = v * stress[1], s12 = v * stress[2];
    add_tangent_forces(reference, point, scaled(s11, f.first) + scaled(s12, f.second),
                       scaled(s12, f.first) + scaled(s22, f.second), force);
  }

  /// Adds the forces that work on the hourglass mode of a one-point quadrilateral: of the mean stress, of the in-plane stiffness
  /// acting on s_a = F_a . q, and of the stiffness against w = n . q, n the current normal (q = warp * n in the reference state).
  static void add_hourglass_forces(const double* reference, const SurfaceTangents<T>& f, const std::array<T, 3>& stress,
                                   const Edges& edge, Edges& force) {
    const auto stiffness = [&](int i) { return reference_value<T>(reference, Layout::hourglass_stiffness + i); };
    const Vector3<T> q = hourglass_vector(reference, edge);
    const T s1 = dot(f.first, q), s2 = dot(f.second, q);
    const T t1 = stiffness(0) * s1 + stiffness(2) * s2, t2 = stiffness(2) * s1 + stiffness(1) * s2;

    const Vector3<T> area = cross(f.first, f.second);
    const T inverse_size = 1.0 / square_root(dot(area, area));
    const Vector3<T> normal = scaled(inverse_size, area);
    const T along_normal = dot(normal, q);
    const T pull = stiffness(3) * (along_normal - stiffness(4));
    const Vector3<T> arm = scaled(pull * inverse_size, q - scaled(along_normal, normal));  // dw = n . dq + arm . d(F1 x F2)

    const T membrane = volume(reference, 0) * (reference_value<T>(reference, Layout::mean_gg) * stress[0] +
                                               reference_value<T>(reference, Layout::mean_gg + 1) * stress[1] +
                                               2.0 * (reference_value<T>(reference, Layout::mean_gg + 2) * stress[2]));
    const Vector3<T> on_mode =
        scaled(t1, f.first) + scaled(t2, f.second) + scaled(membrane, q) + scaled(pull, normal);
    for (int i = 0; i < Layout::edges; ++i)
      force[i] = force[i] + scaled(reference_value<T>(reference, Layout::gamma + i), on_mode);
    add_tangent_forces(reference, 0, scaled(t1, q) + cross(f.second, arm), scaled(t2, q) + cross(arm, f.first), force);
  }

  /// Energy that the hourglass stiffness stores (without the part of the mean stress, which is strain energy).
  static T hourglass_energy(const double* reference, const SurfaceTangents<T>& f, const Edges& edge) {
    const auto stiffness = [&](int i) { return reference_value<T>(reference, Layout::hourglass_stiffness + i); };
    const Vector3<T> q = hourglass_vector(reference, edge);
    const Vector3<T> area = cross(f.first, f.second);
    const T s1 = dot(f.first, q), s2 = dot(f.second, q);
    const T w = dot(area, q) / square_root(dot(area, area)) - stiffness(4);
    return 0.5 * (stiffness(0) * s1 * s1 + stiffness(1) * s2 * s2 + 2.0 * (stiffness(2) * s1 * s2) + stiffness(3) * w * w);
  }

 private:
  /// Forces that do the work first . dF_1 + second . dF_2.
  static void add_tangent_forces(const double* reference, int point, const Vector3<T>& first, const Vector3<T>& second,
                                 Edges& force) {
    const int offset = point * Layout::point_size;
    for (int i = 0; i < Layout::edges; ++i)
      force[i] = force[i] + scaled(reference_value<T>(reference, offset + i), first) +
                 scaled(reference_value<T>(reference, offset + Layout::edges + i), second);
  }
};

}  // namespace balocco
