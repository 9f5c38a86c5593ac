// Force, exact tangent and energies of one fully integrated solid.
#pragma once

#include <algorithm>
#include <array>

#include "elements/law_increment.hpp"
#include "elements/solids/full_solid.hpp"
#include "elements/solids/mean_dilatation_slope.hpp"

namespace balocco {

template <class Shape>
bool FullSolid<Shape>::linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                                 std::span<double> new_history, std::span<double> force,
                                 std::span<double> stiffness) const {
  if constexpr (has_bubbles<Shape>)
    return linearize_with_bubbles(element, motion, old_history, new_history, force, stiffness);
  const LaneReference record = reference(element);
  const auto k = full_solid_kinematics<Shape>(coefficients_of<double>(element, motion.position), record);
  for (const double jacobian : k.jacobian)
    if (!(jacobian > 0.0)) return false;
  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  new_history[0] = k.mean_jacobian;

  Tensors<double> stress;
  Tangents tangent;
  for (int q = 0; q < Shape::points; ++q)
    material_.law->tangent(k.modified[q].component, law_increment(motion), law_history(new_history, q), stress[q].component,
                           stiffness.empty() ? std::span<double>() : tangent[q]);
  const auto nodal = Shape::nodal(full_solid_conjugates<Shape>(k, stress, 0.0, record));
  for (int i = 0; i < 3 * Shape::nodes; ++i) force[i] = nodal[i / 3][i % 3];
  if (stiffness.empty()) return true;
  if constexpr (Shape::mean_dilatation)
    stiffness_of_mean(k, record, stress, tangent, stiffness);
  else
    stiffness_of_points(record, tangent, stiffness);
  return true;
}

/// Gradients of the shape functions by the reference position, at a point.
template <class Shape>
std::array<Vector3<double>, Shape::nodes> reference_gradients(int q, const LaneReference& record) {
  static constexpr auto quadrature = Shape::quadrature();
  std::array<Vector3<double>, Shape::modes> of_modes{};
  for (int mode = 0; mode < Shape::modes; ++mode)
    for (int n = 0; n < 3; ++n)
      for (int j = 0; j < 3; ++j)
        of_modes[mode][j] += quadrature[q].derivative[mode][n] * record[FullSolidRecord<Shape>::point(q) + 3 * n + j];
  return Shape::nodal(of_modes);
}

/// Adds grad N_I . slope . grad N_J for a slope (row-major 9 x 9) of stresses by deformation gradients.
template <std::size_t nodes>
void add_point_stiffness(const std::array<Vector3<double>, nodes>& gradient, std::span<const double, 81> slope, std::span<double> stiffness) {
  constexpr std::size_t dofs = 3 * nodes;
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<std::array<double, dofs>, 3> by_dof{};  // row i of the stress
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t node = 0; node < nodes; ++node)
        for (std::size_t k = 0; k < 3; ++k) {
          const double* const of_row = &slope[9 * (3 * i + j) + 3 * k];
          by_dof[j][3 * node + k] = of_row[0] * gradient[node][0] + of_row[1] * gradient[node][1] + of_row[2] * gradient[node][2];
        }
    for (std::size_t node = 0; node < nodes; ++node) {
      double* const row = &stiffness[dofs * (3 * node + i)];
      for (std::size_t dof = 0; dof < dofs; ++dof)
        row[dof] += by_dof[0][dof] * gradient[node][0] + by_dof[1][dof] * gradient[node][1] + by_dof[2][dof] * gradient[node][2];
    }
  }
}

/// grad N . tensor, by node and direction.
template <std::size_t nodes>
std::array<double, 3 * nodes> on_nodes(const std::array<Vector3<double>, nodes>& gradient, const Matrix3<double>& tensor) {
  std::array<double, 3 * nodes> result{};
  for (std::size_t node = 0; node < nodes; ++node)
    for (int i = 0; i < 3; ++i)
      result[3 * node + i] = tensor(i, 0) * gradient[node][0] + tensor(i, 1) * gradient[node][1] + tensor(i, 2) * gradient[node][2];
  return result;
}

// The second derivative of sum_q w W(Fbar), with dF scaled by s, H = Fbar^-T, A = dPbar/dFbar, g = H : dF, pi = w Pbar : Fbar / 3,
// omega = w J / (V Jbar), Pi = sum pi and gbar = d(ln Jbar) = sum omega g:
//   dFbar = dF + Fbar (gbar - g) / 3,   dg = -tr(F^-1 dF F^-1 dF),   dgbar = sum omega (g g + dg) - gbar gbar.
// What gbar multiplies couples all points, as three products of vectors; all else is a slope at each point.
template <class Shape>
void FullSolid<Shape>::stiffness_of_mean(const FullSolidKinematics<double, Shape>& k, const LaneReference& record,
                                         const Tensors<double>& stress, const Tangents& tangent, std::span<double> stiffness) const {
  constexpr int dofs = 3 * Shape::nodes;
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  double whole_pressure = 0.0;  // Pi
  for (int q = 0; q < Shape::points; ++q)
    whole_pressure += record[Record::point(q) + 9] / 3.0 * double_contraction(stress[q], k.modified[q]);
  std::array<double, dofs> mean{}, before{}, behind{};  // gbar, and what stands before and behind it
  double squared = -whole_pressure;
  for (int q = 0; q < Shape::points; ++q) {
    const double weight = record[Record::point(q) + 9];
    const double share = weight * k.jacobian[q] / (record[Record::volume] * k.mean_jacobian);
    const MeanDilatationSlope slope(k.modified[q], stress[q], tangent[q], weight, share * whole_pressure);
    auto gradient = reference_gradients<Shape>(q, record);
    for (auto& of_node : gradient) of_node = k.scale[q] * of_node;
    add_point_stiffness(gradient, std::span<const double, 81>(slope.of_point), stiffness);
    const auto dilatation = on_nodes(gradient, slope.inverse), left = on_nodes(gradient, slope.before), right = on_nodes(gradient, slope.behind);
    for (int dof = 0; dof < dofs; ++dof) {
      mean[dof] += share * dilatation[dof];
      before[dof] += left[dof];
      behind[dof] += right[dof];
    }
    squared += slope.squared;
  }
  for (int row = 0; row < dofs; ++row)
    for (int column = 0; column < dofs; ++column)
      stiffness[dofs * row + column] += (before[row] + squared * mean[row]) * mean[column] + mean[row] * behind[column];
}

// K = sum w grad N_I . dP/dF . grad N_J.
template <class Shape>
void FullSolid<Shape>::stiffness_of_points(const LaneReference& record, const Tangents& tangent,
                                           std::span<double> stiffness) const {
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  for (int q = 0; q < Shape::points; ++q) {
    std::array<double, 81> slope;
    for (int i = 0; i < 81; ++i) slope[i] = record[Record::point(q) + 9] * tangent[q][i];
    add_point_stiffness(reference_gradients<Shape>(q, record), std::span<const double, 81>(slope), stiffness);
  }
}

template <class Shape>
ElementEnergies FullSolid<Shape>::energies(std::int32_t element, const NodalMotion& motion,
                                           std::span<const double> history) const {
  const LaneReference record = reference(element);
  const auto k = kinematics_of(element, motion, history);
  ElementEnergies energies;
  energies.viscous = history[1];
  for (int q = 0; q < Shape::points; ++q) {
    const double volume = record[Record::point(q) + 9];
    const EnergyDensity density = material_.law->energy_density(k.modified[q].component, law_history(history, q));
    energies.strain += volume * density.recoverable;
    energies.plastic += volume * density.plastic;
    energies.viscous += volume * density.viscous;
    energies.heat += volume * density.heat;
  }
  return energies;
}

}  // namespace balocco
