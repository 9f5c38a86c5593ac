// The incompatible modes of full solids: how their amplitudes find the least energy, in packs and exactly.
#pragma once

#include <algorithm>

#include "elements/law_increment.hpp"
#include "elements/nodal_packs.hpp"
#include "elements/solids/full_solid.hpp"
#include "materials/stretch.hpp"

namespace balocco {

/// Forces on the amplitudes: sum w (F0^T P) . G_m, G_m the gradient of bubble m.
template <class Shape, class T, class Reference>
BubbleAmplitudes<T> bubble_forces(const Matrix3<T>& centre, const std::array<Matrix3<T>, Shape::points>& stress,
                                  const Reference& reference) {
  BubbleAmplitudes<T> sum{};
  for (int q = 0; q < Shape::points; ++q) {
    const Matrix3<T> turned = transpose(centre) * stress[q];  // the weight cancels that in the gradient
    for (int m = 0; m < 3; ++m)
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
          sum[m][k] =
              sum[m][k] + (Shape::place(q, m) * reference[FullSolidRecord<Shape>::bubble + 3 * m + j]) * turned(k, j);
  }
  return sum;
}

/// G_m at a point.
template <class Shape, class Reference>
std::array<Vector3<double>, 3> bubble_gradients(int q, const Reference& reference) {
  using Record = FullSolidRecord<Shape>;
  std::array<Vector3<double>, 3> gradient;
  for (int m = 0; m < 3; ++m)
    for (int j = 0; j < 3; ++j)
      gradient[m][j] = Shape::place(q, m) * reference[Record::bubble + 3 * m + j] / reference[Record::point(q) + 9];
  return gradient;
}

/// Columns of dF (row-major 9) by the amplitudes: dF = F0 dH.
template <class Shape, class Reference>
Dense<9, 9> bubble_columns(const Matrix3<double>& centre, int q, const Reference& reference) {
  const auto gradient = bubble_gradients<Shape>(q, reference);
  Dense<9, 9> columns;
  for (int m = 0; m < 3; ++m)
    for (int k = 0; k < 3; ++k)
      for (int p = 0; p < 3; ++p)
        for (int j = 0; j < 3; ++j) columns(3 * p + j, 3 * m + k) = centre(p, k) * gradient[m][j];
  return columns;
}

template <class Shape>
void FullSolid<Shape>::store_flexibility(std::int32_t lane) {
  static constexpr int voigt[9] = {0, 3, 4, 3, 1, 5, 4, 5, 2};  // row-major -> 11 22 33 12 13 23
  Dense<9, 9> tangent, stiffness;
  for (int a = 0; a < 9; ++a)
    for (int b = 0; b < 9; ++b) tangent(a, b) = material_.stiffness[6 * voigt[a] + voigt[b]];
  const LaneReference record = reference(lane);
  for (int q = 0; q < Shape::points; ++q) {
    const auto columns = bubble_columns<Shape>(Matrix3<double>::identity(), q, record);
    stiffness += record[Record::point(q) + 9] * (transpose(columns) * tangent * columns);
  }
  const auto flexibility = inverse(stiffness);
  double* const data =
      records_.data() + static_cast<std::size_t>(lane / pack_size) * pack_size * Record::size + lane % pack_size;
  for (int i = 0; i < 81; ++i) data[pack_size * (Record::bubble_flexibility + i)] = flexibility.component[i];
}

// One step of Newton's method with the stiffness of the reference configuration, raised where the moduli have grown, so
// that it never goes too far: exact for small strains, and else a few cycles behind the motion of the nodes. Three
// steps where a law remembers: metals soften as they flow. The law's history stays as it is.
template <class Shape>
void FullSolid<Shape>::settle_bubbles(std::int32_t element, const Coefficients<Pack>& c, double increment,
                                      PointBatch<PointKind::solid>& points, std::span<double> history) const {
  const PackReference reference = pack_reference(element);
  const int passes = material_.law->history_size() > 0 ? 3 : 1;
  for (int pass = 0; pass < passes; ++pass) {
    const auto k = pack_kinematics(element, c, history);
    for (int q = 0; q < Shape::points; ++q)
      for (int i = 0; i < 9; ++i) store(k.modified[q].component[i], &points.strain[i][pack_size * q]);
    const auto row = [&](std::size_t component) {
      return history.begin() + static_cast<std::ptrdiff_t>(own_history + component) * padded_size_ + element;
    };
    for (std::size_t i = 0; i < kept_history_.size(); i += pack_size)
      std::copy_n(row(i / pack_size), pack_size, kept_history_.begin() + i);
    respond(element, increment, points, history);
    for (std::size_t i = 0; i < kept_history_.size(); i += pack_size)
      std::copy_n(kept_history_.begin() + i, pack_size, row(i / pack_size));
    Tensors<Pack> stress;
    for (int q = 0; q < Shape::points; ++q)
      for (int i = 0; i < 9; ++i) stress[q].component[i] = load(&points.stress[i][pack_size * q]);
    const auto force = bubble_forces<Shape>(k.centre, stress, reference);
    const auto c0 = invariants(k.centre);
    const Pack stretch = largest_eigenvalue_bound(c0.first, c0.second);
    Pack growth = 1.0;  // of the stiffness
    for (int q = 0; q < Shape::points; ++q) {
      growth =
          maximum(growth, (1.0 / material_.shear_modulus) * (stretch * load(&points.shear_modulus[pack_size * q])));
      if (material_.volumetric_modulus > 0.0)
        growth =
            maximum(growth, (1.0 / material_.volumetric_modulus) * load(&points.volumetric_modulus[pack_size * q]));
    }
    const Pack step = 1.0 / growth;
    for (int a = 0; a < 9; ++a) {
      double* const amplitude = &history[(first_bubble + a) * static_cast<std::ptrdiff_t>(padded_size_) + element];
      Pack settled(amplitude, std::experimental::element_aligned);
      for (int b = 0; b < 9; ++b)
        settled -= step * (reference[Record::bubble_flexibility + 9 * a + b] * force[b / 3][b % 3]);
      settled.copy_to(amplitude, std::experimental::element_aligned);
    }
  }
}

// The amplitudes are found by Newton's method to round-off and condensed: K = Kuu - Kua Kaa^-1 Kau.
template <class Shape>
bool FullSolid<Shape>::linearize_with_bubbles(std::int32_t element, const NodalMotion& motion,
                                              std::span<const double> old_history, std::span<double> new_history,
                                              std::span<double> force, std::span<double> stiffness) const {
  constexpr int dofs = 3 * Shape::nodes, most_iterations = 30;
  const LaneReference record = reference(element);
  const double size = std::cbrt(record[Record::volume]);
  const auto c = coefficients_of<double>(element, motion.position);
  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  Tensors<double> stress;
  Tangents tangent;
  FullSolidKinematics<double, Shape> k;
  Dense<9, 9> inner;
  bool settled = false;
  for (int iteration = 0; iteration < most_iterations && !settled; ++iteration) {
    k = kinematics_of(element, motion, new_history);
    for (const double jacobian : k.jacobian)
      if (!(jacobian > 0.0)) return false;
    std::copy(old_history.begin() + own_history, old_history.end(), new_history.begin() + own_history);
    inner = {};
    for (int q = 0; q < Shape::points; ++q) {
      material_.law->tangent(k.modified[q].component, law_increment(motion), law_history(new_history, q), stress[q].component,
                             tangent[q]);
      const auto columns = bubble_columns<Shape>(k.centre, q, record);
      inner += record[Record::point(q) + 9] * (transpose(columns) * Dense<9, 9>{tangent[q]} * columns);
    }
    const auto on_bubbles = bubble_forces<Shape>(k.centre, stress, record);
    Dense<9, 1> residual;
    for (int i = 0; i < 9; ++i) residual(i, 0) = on_bubbles[i / 3][i % 3];
    const auto change = solution(inner, residual).component;
    settled = std::ranges::all_of(change, [&](double value) { return std::abs(value) <= 1e-13 * size; });
    for (int i = 0; i < 9 && !settled; ++i) new_history[first_bubble + i] -= change[i];
  }
  if (!settled) return false;
  new_history[0] = k.mean_jacobian;
  const auto nodal = Shape::nodal(full_solid_conjugates<Shape>(k, stress, 0.0, record));
  for (int i = 0; i < dofs; ++i) force[i] = nodal[i / 3][i % 3];
  if (stiffness.empty()) return true;

  std::array<Vector3<double>, Shape::modes> of_modes{};
  for (int n = 0; n < 3; ++n)
    for (int j = 0; j < 3; ++j) of_modes[n][j] = record[Record::centre + 3 * n + j];
  const auto at_centre = Shape::nodal(of_modes);  // gradients of the shape functions there
  Dense<dofs, dofs> outer;
  Dense<dofs, 9> mixed;
  for (int q = 0; q < Shape::points; ++q) {
    const double weight = record[Record::point(q) + 9];
    const auto gradient = reference_gradients<Shape>(q, record);
    const auto of_bubbles = bubble_gradients<Shape>(q, record);
    Dense<9, dofs> columns;
    for (int node = 0; node < Shape::nodes; ++node) {
      const auto whole = gradient[node] + transpose(k.bubble[q]) * at_centre[node];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) columns(3 * i + j, 3 * node + i) = whole[j];
    }
    const auto loaded = weight * (transpose(columns) * Dense<9, 9>{tangent[q]});
    outer += loaded * columns;
    mixed += loaded * bubble_columns<Shape>(k.centre, q, record);
    for (int m = 0; m < 3; ++m) {  // P : dF0 dH
      const Vector3<double> traction = stress[q] * of_bubbles[m];
      for (int a = 0; a < dofs; ++a)
        for (int l = 0; l < 3; ++l) mixed(a, 3 * m + l) += weight * traction[a % 3] * at_centre[a / 3][l];
    }
  }
  outer -= mixed * solution(inner, transpose(mixed));
  std::ranges::copy(outer.component, stiffness.begin());
  return true;
}

}  // namespace balocco
