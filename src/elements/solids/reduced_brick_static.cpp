// C3D8R one element at a time: force, exact tangent, energies, output.
#include <algorithm>

#include "elements/solids/reduced_brick.hpp"
#include "elements/solids/reduced_brick_damping.hpp"
#include "elements/solids/solid_output.hpp"
#include "math/dual.hpp"

namespace balocco {

template <class T>
HexahedronCoefficients<T> ReducedBrick::coefficients_of(std::int32_t element, const double* position) const {
  std::array<Vector3<T>, nodes_per_brick> nodes;
  for (int node = 0; node < nodes_per_brick; ++node) {
    const double* x = position + 4 * static_cast<std::ptrdiff_t>(connectivity_[element * nodes_per_brick + node]);
    for (int i = 0; i < 3; ++i) {
      if constexpr (std::is_same_v<T, double>)
        nodes[node][i] = x[i];
      else
        nodes[node][i] = T(x[i], 3 * node + i);
    }
  }
  return coefficients(nodes);
}

template <class T>
std::array<Vector3<T>, 8> ReducedBrick::static_forces(const HexahedronCoefficients<T>& c, const Matrix3<T>& f,
                                                      const Matrix3<T>& stress, const T& plastic, const LaneReference& reference,
                                                      std::span<const double> old_history) const {
  const Matrix3<T> integrated = T(reference[brick_record::volume]) * stress;
  const auto forces = [&](const std::array<Vector3<T>, 4>& q, const auto& shape) {
    return nodal_forces(conjugates_with_stresses(c, q, hourglass_stresses(hourglass_strains(c, q), shape), integrated, shape));
  };
  if (flow_.active()) {
    const auto shape = flowed_reference(reference, old_history);
    const auto trial = hourglass_vectors(c, f, shape);
    return forces(flowed(return_of(c, trial, f, stress, plastic, shape, old_history).factor, trial), shape);
  }
  const auto q = hourglass_vectors(c, f, reference);
  if (!enhanced_)
    return nodal_forces(conjugates_with_scalar(scalar_hourglass_forces(q, reference), integrated, reference));
  return forces(q, reference);
}

void ReducedBrick::advance_shape(const HexahedronCoefficients<double>& c, const Matrix3<double>& f, const Matrix3<double>& stress,
                                 double plastic, const LaneReference& reference, std::span<const double> old_history,
                                 std::span<double> history) const {
  const auto shape = flowed_reference(reference, old_history);
  const auto trial = hourglass_vectors(c, f, shape);
  const auto [factor, hardening] = return_of(c, trial, f, stress, plastic, shape, old_history);
  const auto change = shape_change(factor, trial, invariants(f));
  for (int k = 0; k < 12; ++k) history[own_history + k] += change[k];
  const double energy = HourglassTrial<double>(c, trial, shape).energy;
  history[own_history + HourglassFlow::dissipated] += flow_dissipation(factor, energy, old_history[own_history + HourglassFlow::elastic]);
  history[own_history + HourglassFlow::elastic] = factor * factor * energy;
  history[own_history + HourglassFlow::hardening] += hardening;
}

bool ReducedBrick::linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                             std::span<double> new_history, std::span<double> force,
                             std::span<double> stiffness) const {
  using Derivative = Dual<3 * nodes_per_brick>;
  const LaneReference record = reference(element);
  const auto c = coefficients_of<double>(element, motion.position);
  const Matrix3<double> f = mean_deformation_gradient(c, record);
  const double jacobian = determinant(f, cofactor(f));
  if (!(jacobian > 0.0)) return false;

  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  new_history[0] = jacobian;
  Matrix3<double> stress;
  std::array<double, 81> tangent;
  material_.law->tangent(f.component, quasi_static, new_history.subspan(law_row_), stress.component,
                         stiffness.empty() ? std::span<double>() : tangent);
  const double plastic = flow_.active() ? new_history[flow_.plastic_strain] - old_history[flow_.plastic_strain] : 0.0;
  if (flow_.active()) advance_shape(c, f, stress, plastic, record, old_history, new_history);

  if (stiffness.empty()) {
    const auto forces = static_forces(c, f, stress, plastic, record, old_history);
    for (int i = 0; i < 3 * nodes_per_brick; ++i) force[i] = forces[i / 3][i % 3];
    return true;
  }
  const auto c_dual = coefficients_of<Derivative>(element, motion.position);
  const Matrix3<Derivative> f_dual = mean_deformation_gradient(c_dual, record);
  Matrix3<Derivative> stress_dual;
  for (int i = 0; i < 9; ++i) {
    stress_dual.component[i] = Derivative(stress.component[i]);
    for (int j = 0; j < 9; ++j)
      for (int k = 0; k < 3 * nodes_per_brick; ++k)
        stress_dual.component[i].derivative[k] += tangent[9 * i + j] * f_dual.component[j].derivative[k];
  }
  Derivative plastic_dual(plastic);
  if (flow_.active()) {
    std::array<double, 9> slope;
    material_.law->history_slope(f.component, quasi_static, old_history.subspan(law_row_), flow_.plastic_strain - law_row_, slope);
    for (int j = 0; j < 9; ++j)
      for (int k = 0; k < 3 * nodes_per_brick; ++k)
        plastic_dual.derivative[k] += slope[j] * f_dual.component[j].derivative[k];
  }
  const auto forces = static_forces(c_dual, f_dual, stress_dual, plastic_dual, record, old_history);
  for (int i = 0; i < 3 * nodes_per_brick; ++i) {
    force[i] = forces[i / 3][i % 3].value;
    for (int j = 0; j < 3 * nodes_per_brick; ++j)
      stiffness[3 * nodes_per_brick * i + j] = forces[i / 3][i % 3].derivative[j];
  }
  return true;
}

ElementEnergies ReducedBrick::energies(std::int32_t element, const NodalMotion& motion,
                                       std::span<const double> history) const {
  const LaneReference record = reference(element);
  const auto c = coefficients_of<double>(element, motion.position);
  const Matrix3<double> f = mean_deformation_gradient(c, record);
  const EnergyDensity density = material_.law->energy_density(f.component, history.subspan(law_row_));
  const double hourglass = artificial_energy(c, f, record, [&](int k) { return history[k]; });
  return element_energies(record[brick_record::volume], density, hourglass, history[1]);
}

int ReducedBrick::point_components(std::string_view variable) const {
  return solid_output_components(material_, variable);
}

void ReducedBrick::point_output(std::string_view variable, std::int32_t element, int, const NodalMotion& motion,
                                std::span<const double> history, std::span<double> values) const {
  const Matrix3<double> f = mean_deformation_gradient(coefficients_of<double>(element, motion.position), reference(element));
  solid_output(variable, material_, f, history.subspan(law_row_), values);
}

}  // namespace balocco
