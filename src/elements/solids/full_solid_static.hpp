// Force, exact tangent and energies of one fully integrated solid.
#pragma once

#include <algorithm>
#include <array>

#include "elements/law_increment.hpp"
#include "elements/solids/full_solid.hpp"
#include "math/dual.hpp"

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
    stiffness_of_mean(element, motion, stress, tangent, stiffness);
  else
    stiffness_of_points(record, tangent, stiffness);
  return true;
}

// The mean dilatation couples all points: duals of the whole element carry the chain rule.
template <class Shape>
void FullSolid<Shape>::stiffness_of_mean(std::int32_t element, const NodalMotion& motion, const Tensors<double>& stress,
                                         const Tangents& tangent, std::span<double> stiffness) const {
  constexpr int dofs = 3 * Shape::nodes;
  using Derivative = Dual<dofs>;
  const LaneReference record = reference(element);
  const auto k_dual = full_solid_kinematics<Shape>(coefficients_of<Derivative>(element, motion.position), record);
  Tensors<Derivative> stress_dual;
  for (int q = 0; q < Shape::points; ++q) {
    for (int i = 0; i < 9; ++i) {
      Derivative& component = stress_dual[q].component[i];
      component = Derivative(stress[q].component[i]);
      for (int j = 0; j < 9; ++j)
        for (int n = 0; n < dofs; ++n)
          component.derivative[n] += tangent[q][9 * i + j] * k_dual.modified[q].component[j].derivative[n];
    }
  }
  const auto forces = Shape::nodal(full_solid_conjugates<Shape>(k_dual, stress_dual, Derivative(0.0), record));
  for (int i = 0; i < dofs; ++i)
    for (int j = 0; j < dofs; ++j) stiffness[dofs * i + j] = forces[i / 3][i % 3].derivative[j];
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

// K = sum w grad N_I . dP/dF . grad N_J.
template <class Shape>
void FullSolid<Shape>::stiffness_of_points(const LaneReference& record, const Tangents& tangent,
                                           std::span<double> stiffness) const {
  constexpr int dofs = 3 * Shape::nodes;
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  for (int q = 0; q < Shape::points; ++q) {
    const auto gradient = reference_gradients<Shape>(q, record);
    const double weight = record[Record::point(q) + 9];
    for (int node = 0; node < Shape::nodes; ++node)
      for (int k = 0; k < 3; ++k) {
        std::array<double, 9> slope{};  // of w P by this displacement
        for (int ij = 0; ij < 9; ++ij)
          for (int l = 0; l < 3; ++l) slope[ij] += weight * tangent[q][9 * ij + 3 * k + l] * gradient[node][l];
        for (int row = 0; row < dofs; ++row) {
          const double* const p = &slope[3 * (row % 3)];
          const auto& g = gradient[row / 3];
          stiffness[dofs * row + 3 * node + k] += p[0] * g[0] + p[1] * g[1] + p[2] * g[2];
        }
      }
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
