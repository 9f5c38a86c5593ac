// Kinematics and nodal forces of shells, one text for T = double, Pack (explicit loop) and Dual (exact tangent).
//
// A geometrically exact shell with one director a corner, d_I = R_I D_I (Simo & Fox, Comp. Meth. Appl. Mech. Eng. 72,
// 1989), whose strains are as many as its modes of deformation, freedoms less rigid motions: 18 for quadrilaterals, 12
// for triangles.
//   membrane   E_ab = (F_a . F_b - 1) / 2 of the mean tangents F_a = sum B_aI x_I, with the mean of (q . q) (g (x) g) / 2
//   curvature  sym(K + K H C / 2) - reference: K_ab = sym(F_a . D_b), D_a = sum B_aI d_I, and C_ab = D_a . D_b, which makes the
//              turn of the directors along an edge of the chord between their tips, 2 sin(turn / 2), with H_ab = sum of
//              e_a e_b / 24 over the edges; the strain of a layer is E + zeta curvature
//   modes      s_a = F_a . q and t_a = F_a . p + D_a . q, in-plane bending and bending of the quadrilateral's linear part:
//              q = sum gamma_I x_I, p = sum gamma_I d_I, nothing for affine motions (Flanagan & Belytschko 1981)
//   shear      c_i = e_i . (d_i + d_j) - reference along each edge e_i = x_j - x_i: the tying points of MITC4 (Dvorkin & Bathe,
//              Eng. Comput. 1, 1984) and MITC3 (Lee & Bathe, Comput. Struct. 82, 2004)
//   drill      w_I = (F_1 . R_I E_2 - F_2 . R_I E_1) / 2, rotation of the node beside the spin of the surface (Hughes & Brezzi 1989)
// All are products of vectors that turn with the element: rigid motions strain nothing. Nodes enter as edges x_I - x_0.
#pragma once

#include <array>

#include "elements/record_reference.hpp"
#include "math/dual.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {

/// Where the kernel finds its reference data: component c of an element lies at base[c * pack_size + lane].
template <int corners>
struct ShellLayout {
  static constexpr bool quadrilateral = corners == 4;
  static constexpr int edges = corners - 1;
  static constexpr int modes = quadrilateral ? 2 : 0;
  static constexpr int gradient = 0;                               // along direction 1, then 2, of corners 1..
  static constexpr int gamma = gradient + 2 * edges;               // quadrilaterals: of corners 1..
  static constexpr int mean_gg = gamma + (quadrilateral ? 3 : 0);  // quadrilaterals: 11, 22, 12, then warp^2
  static constexpr int director = mean_gg + (quadrilateral ? 4 : 0);
  static constexpr int axes = director + 3 * corners;  // E_1, E_2
  static constexpr int curvature = axes + 6;           // 11, 22, 2x12
  static constexpr int bending_mode = curvature + 3;
  static constexpr int spread = bending_mode + modes;  // H: 11, 22, 12
  static constexpr int shear = spread + 3;
  static constexpr int shear_stiffness = shear + corners;  // upper triangle, row by row
  static constexpr int drill_stiffness =
      shear_stiffness + corners * (corners + 1) / 2;  // of the mean, of what differs from it
  static constexpr int size = drill_stiffness + 2;
};

/// The strains of an element, or the forces that do work on them.
template <class T, int corners>
struct ShellModes {
  std::array<T, 3> membrane{}, curvature{};  // 11, 22, 2x12
  std::array<T, ShellLayout<corners>::modes> membrane_mode{}, bending_mode{};
  std::array<T, corners> shear{}, drill{};
};

/// Forces on corners 1.. (that on corner 0 balances them) and moments on all.
template <class T, int corners>
struct ShellForces {
  std::array<Vector3<T>, corners - 1> force{};
  std::array<Vector3<T>, corners> moment{};
};

template <class T, int corners>
class ShellKernel {
 public:
  using Layout = ShellLayout<corners>;
  using Edges = std::array<Vector3<T>, Layout::edges>;
  using Modes = ShellModes<T, corners>;
  using Forces = ShellForces<T, corners>;

  /// Looks at an element: `edge` are x_I - x_0 of corners 1.., `rotation` those of all corners.
  void set(const double* reference, const Edges& edge, const std::array<Matrix3<T>, corners>& rotation) {
    reference_ = reference;
    edge_ = edge;
    tangent1_ = tangent2_ = bend1_ = bend2_ = twist_ = turn_ = {};
    const Vector3<Coefficient<T>> axis1 = vector(Layout::axes), axis2 = vector(Layout::axes + 3);
    for (int i = 0; i < corners; ++i) {
      director_[i] = rotated(rotation[i], vector(Layout::director + 3 * i));
      axis1_[i] = rotated(rotation[i], axis1);
      axis2_[i] = rotated(rotation[i], axis2);
    }
    for (int i = 0; i < Layout::edges; ++i) {
      const Vector3<T> turn = director_[i + 1] - director_[0];
      tangent1_ = tangent1_ + scaled(value(i), edge[i]);
      tangent2_ = tangent2_ + scaled(value(Layout::edges + i), edge[i]);
      bend1_ = bend1_ + scaled(value(i), turn);
      bend2_ = bend2_ + scaled(value(Layout::edges + i), turn);
      if constexpr (Layout::quadrilateral) {
        twist_ = twist_ + scaled(value(Layout::gamma + i), edge[i]);
        turn_ = turn_ + scaled(value(Layout::gamma + i), turn);
      }
    }
    curvature_ = {dot(tangent1_, bend1_), dot(tangent2_, bend2_),
                  0.5 * (dot(tangent1_, bend2_) + dot(tangent2_, bend1_))};
    bend_square_ = {dot(bend1_, bend1_), dot(bend2_, bend2_), dot(bend1_, bend2_)};
  }

  Modes strains() const {
    Modes strain;
    strain.membrane = {0.5 * (dot(tangent1_, tangent1_) - 1.0), 0.5 * (dot(tangent2_, tangent2_) - 1.0),
                       dot(tangent1_, tangent2_)};
    const Square arc = times(times(as_square(curvature_), spread()), bend_square_);  // K H C
    strain.curvature = {curvature_[0] + 0.5 * arc[0] - value(Layout::curvature),
                        curvature_[1] + 0.5 * arc[3] - value(Layout::curvature + 1),
                        2.0 * curvature_[2] + 0.5 * (arc[1] + arc[2]) - value(Layout::curvature + 2)};
    if constexpr (Layout::quadrilateral) {
      const T growth = dot(twist_, twist_) - value(Layout::mean_gg + 3);
      strain.membrane[0] = strain.membrane[0] + 0.5 * (value(Layout::mean_gg) * growth);
      strain.membrane[1] = strain.membrane[1] + 0.5 * (value(Layout::mean_gg + 1) * growth);
      strain.membrane[2] = strain.membrane[2] + value(Layout::mean_gg + 2) * growth;
      strain.membrane_mode = {dot(tangent1_, twist_), dot(tangent2_, twist_)};
      strain.bending_mode = {dot(tangent1_, turn_) + dot(bend1_, twist_) - value(Layout::bending_mode),
                             dot(tangent2_, turn_) + dot(bend2_, twist_) - value(Layout::bending_mode + 1)};
    }
    for (int i = 0; i < corners; ++i) {
      strain.shear[i] = dot(side(i), director_[i] + director_[next(i)]) - value(Layout::shear + i);
      strain.drill[i] = 0.5 * (dot(tangent1_, axis2_[i]) - dot(tangent2_, axis1_[i]));
    }
    return strain;
  }

  /// Adds the forces of transverse shear and of drilling, which are elastic in every section.
  void add_elastic(const Modes& strain, Modes& stress) const {
    T mean = strain.drill[0];
    for (int i = 1; i < corners; ++i) mean = mean + strain.drill[i];
    const T pull = (value(Layout::drill_stiffness) - value(Layout::drill_stiffness + 1)) * ((1.0 / corners) * mean);
    for (int i = 0; i < corners; ++i) {
      for (int j = 0; j < corners; ++j)
        stress.shear[i] = stress.shear[i] + value(shear_stiffness(i, j)) * strain.shear[j];
      stress.drill[i] = stress.drill[i] + pull + value(Layout::drill_stiffness + 1) * strain.drill[i];
    }
  }

  /// Adds the nodal forces that do the work of `stress`.
  void add_forces(const Modes& stress, Forces& nodal) const {
    const auto& n = stress.membrane;
    // M on the curvature does work on K, M + sym(M C H) / 2, and on C, sym(M K H) / 2.
    const Square on_curvature = times(times(as_square(stress.curvature), bend_square_), spread());
    const Square on_square = times(times(as_square(stress.curvature), curvature_), spread());
    const Symmetric m{stress.curvature[0] + 0.5 * on_curvature[0], stress.curvature[1] + 0.5 * on_curvature[3],
                             stress.curvature[2] + 0.25 * (on_curvature[1] + on_curvature[2])};
    const T on_both = 0.5 * (on_square[1] + on_square[2]);
    Vector3<T> on_tangent1 =
        scaled(n[0], tangent1_) + scaled(n[2], tangent2_) + scaled(m[0], bend1_) + scaled(m[2], bend2_);
    Vector3<T> on_tangent2 =
        scaled(n[2], tangent1_) + scaled(n[1], tangent2_) + scaled(m[2], bend1_) + scaled(m[1], bend2_);
    Vector3<T> on_bend1 =
        scaled(m[0], tangent1_) + scaled(m[2], tangent2_) + scaled(on_square[0], bend1_) + scaled(on_both, bend2_);
    Vector3<T> on_bend2 =
        scaled(m[2], tangent1_) + scaled(m[1], tangent2_) + scaled(on_both, bend1_) + scaled(on_square[3], bend2_);
    Vector3<T> on_twist, on_turn;
    if constexpr (Layout::quadrilateral) {
      const auto &s = stress.membrane_mode, &t = stress.bending_mode;
      const T mean =
          value(Layout::mean_gg) * n[0] + value(Layout::mean_gg + 1) * n[1] + 2.0 * (value(Layout::mean_gg + 2) * n[2]);
      on_tangent1 = on_tangent1 + scaled(s[0], twist_) + scaled(t[0], turn_);
      on_tangent2 = on_tangent2 + scaled(s[1], twist_) + scaled(t[1], turn_);
      on_bend1 = on_bend1 + scaled(t[0], twist_);
      on_bend2 = on_bend2 + scaled(t[1], twist_);
      on_twist = scaled(mean, twist_) + scaled(s[0], tangent1_) + scaled(s[1], tangent2_) + scaled(t[0], bend1_) +
                 scaled(t[1], bend2_);
      on_turn = scaled(t[0], tangent1_) + scaled(t[1], tangent2_);
    }
    for (int i = 0; i < corners; ++i) {
      const T half = 0.5 * stress.drill[i];
      nodal.moment[i] = nodal.moment[i] + scaled(half, cross(axis2_[i], tangent1_) - cross(axis1_[i], tangent2_));
      on_tangent1 = on_tangent1 + scaled(half, axis2_[i]);
      on_tangent2 = on_tangent2 - scaled(half, axis1_[i]);
    }

    std::array<Vector3<T>, corners> on_director;
    for (int i = 0; i < Layout::edges; ++i) {
      const auto b1 = value(i), b2 = value(Layout::edges + i);
      nodal.force[i] = nodal.force[i] + scaled(b1, on_tangent1) + scaled(b2, on_tangent2);
      on_director[i + 1] = scaled(b1, on_bend1) + scaled(b2, on_bend2);
      if constexpr (Layout::quadrilateral) {
        nodal.force[i] = nodal.force[i] + scaled(value(Layout::gamma + i), on_twist);
        on_director[i + 1] = on_director[i + 1] + scaled(value(Layout::gamma + i), on_turn);
      }
      on_director[0] = on_director[0] - on_director[i + 1];
    }
    for (int i = 0; i < corners; ++i) {
      const Vector3<T> on_side = scaled(stress.shear[i], director_[i] + director_[next(i)]);
      const Vector3<T> on_ends = scaled(stress.shear[i], side(i));
      if (i > 0) nodal.force[i - 1] = nodal.force[i - 1] - on_side;
      if (next(i) > 0) nodal.force[next(i) - 1] = nodal.force[next(i) - 1] + on_side;
      on_director[i] = on_director[i] + on_ends;
      on_director[next(i)] = on_director[next(i)] + on_ends;
    }
    for (int i = 0; i < corners; ++i) nodal.moment[i] = nodal.moment[i] + cross(director_[i], on_director[i]);
  }

  /// Whether every corner's director still points to the positive side of the surface.
  bool upright() const {
    const Vector3<T> area = cross(tangent1_, tangent2_);
    for (const Vector3<T>& director : director_)
      if (!(value_of(dot(area, director)) > 0.0)) return false;
    return true;
  }

  const Vector3<T>& tangent1() const { return tangent1_; }
  const Vector3<T>& tangent2() const { return tangent2_; }

  static constexpr int shear_stiffness(int i, int j) {
    const int row = i < j ? i : j, column = i < j ? j : i;
    return Layout::shear_stiffness + row * corners - row * (row - 1) / 2 + column - row;
  }

 private:
  using Symmetric = std::array<T, 3>;  // 11, 22, 12
  using Square = std::array<T, 4>;     // 11, 12, 21, 22

  static Square as_square(const Symmetric& a) { return {a[0], a[2], a[2], a[1]}; }
  template <class Entry>
  static Square times(const Square& a, const std::array<Entry, 3>& b) {
    return {a[0] * b[0] + a[1] * b[2], a[0] * b[2] + a[1] * b[1], a[2] * b[0] + a[3] * b[2], a[2] * b[2] + a[3] * b[1]};
  }
  std::array<Coefficient<T>, 3> spread() const {
    return {value(Layout::spread), value(Layout::spread + 1), value(Layout::spread + 2)};
  }

  static constexpr int next(int i) { return i + 1 == corners ? 0 : i + 1; }
  Coefficient<T> value(int component) const { return reference_value<T>(reference_, component); }
  Vector3<Coefficient<T>> vector(int component) const {
    return {{value(component), value(component + 1), value(component + 2)}};
  }
  Vector3<T> side(int i) const {
    if (i == 0) return edge_[0];
    return next(i) == 0 ? Vector3<T>{} - edge_[i - 1] : edge_[next(i) - 1] - edge_[i - 1];
  }
  static Vector3<T> rotated(const Matrix3<T>& r, const Vector3<Coefficient<T>>& v) {
    Vector3<T> result;
    for (int i = 0; i < 3; ++i) result[i] = v[0] * r(i, 0) + v[1] * r(i, 1) + v[2] * r(i, 2);
    return result;
  }

  const double* reference_ = nullptr;
  Edges edge_;
  std::array<Vector3<T>, corners> director_, axis1_, axis2_;
  Vector3<T> tangent1_, tangent2_, bend1_, bend2_, twist_, turn_;
  Symmetric curvature_, bend_square_;  // K and C
};

}  // namespace balocco
