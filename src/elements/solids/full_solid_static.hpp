// Force, exact tangent and energies of one fully integrated solid.
#pragma once

#include <algorithm>
#include <array>

#include "elements/solids/full_solid.hpp"
#include "math/dual.hpp"

namespace balocco {

template <class Shape>
bool FullSolid<Shape>::linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                                 std::span<double> new_history, std::span<double> force,
                                 std::span<double> stiffness) const {
  constexpr int dofs = 3 * Shape::nodes;
  using Derivative = Dual<dofs>;
  const LaneReference record = reference(element);
  const auto k = full_solid_kinematics<Shape>(coefficients_of<double>(element, motion.position), record);
  for (const double jacobian : k.jacobian)
    if (!(jacobian > 0.0)) return false;
  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  new_history[0] = k.mean_jacobian;

  Tensors<double> stress;
  std::array<std::array<double, 81>, Shape::points> tangent;
  for (int q = 0; q < Shape::points; ++q)
    material_.law->tangent(k.modified[q].component, quasi_static, law_history(new_history, q), stress[q].component,
                           stiffness.empty() ? std::span<double>() : tangent[q]);
  if (stiffness.empty()) {
    const auto forces = Shape::nodal(full_solid_conjugates<Shape>(k, stress, 0.0, record));
    for (int i = 0; i < dofs; ++i) force[i] = forces[i / 3][i % 3];
    return true;
  }
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
  for (int i = 0; i < dofs; ++i) {
    force[i] = forces[i / 3][i % 3].value;
    for (int j = 0; j < dofs; ++j) stiffness[dofs * i + j] = forces[i / 3][i % 3].derivative[j];
  }
  return true;
}

template <class Shape>
ElementEnergies FullSolid<Shape>::energies(std::int32_t element, const NodalMotion& motion,
                                           std::span<const double> history) const {
  const LaneReference record = reference(element);
  const auto k = full_solid_kinematics<Shape>(coefficients_of<double>(element, motion.position), record);
  ElementEnergies energies;
  energies.viscous = history[1];
  for (int q = 0; q < Shape::points; ++q) {
    const double volume = record[Record::point(q) + 9];
    const EnergyDensity density = material_.law->energy_density(k.modified[q].component, law_history(history, q));
    energies.strain += volume * density.recoverable;
    energies.plastic += volume * density.plastic;
    energies.viscous += volume * density.viscous;
  }
  return energies;
}

}  // namespace balocco
