// C3D8R one element at a time: force, exact tangent, energies, output.
#include <algorithm>

#include "elements/law_increment.hpp"
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
                                                      const Matrix3<T>& stress, const LaneReference& reference,
                                                      const auto& history) const {
  const Matrix3<T> integrated = T(reference[brick_record::volume]) * stress;
  const auto forces = [&](const std::array<Vector3<T>, 4>& q, const auto& shape) {
    return nodal_forces(conjugates_with_stresses(c, q, hourglass_stresses(hourglass_strains(c, q), shape), integrated, shape));
  };
  if (flow_.active()) {
    FlowedReference<T, LaneReference> shape(reference, flow_, own_history, history);
    const auto q = hourglass_vectors(c, f, shape);
    const T factor = return_of(c, f, stress, HourglassTrial<T>(c, q, shape), reference, history).factor;
    shape.add_shape(shape_change(factor, q, invariants(f)));
    return forces(flowed(factor, q), shape);
  }
  const auto q = hourglass_vectors(c, f, reference);
  if (hourglass_ == Hourglass::scalar)
    return nodal_forces(conjugates_with_scalar(scalar_hourglass_forces(q, reference), integrated, reference));
  return with_moduli(reference, [&](const auto& shape) { return forces(q, shape); });
}

void ReducedBrick::advance_shape(const HexahedronCoefficients<double>& c, const Matrix3<double>& f, const Matrix3<double>& stress,
                                 const LaneReference& reference, std::span<double> history) const {
  const auto component = [&](int k) { return history[k]; };
  const FlowedReference<double, LaneReference> shape(reference, flow_, own_history, component);
  const auto q = hourglass_vectors(c, f, shape);
  const HourglassTrial<double> trial(c, q, shape);
  const auto [factor, hardening] = return_of(c, f, stress, trial, reference, component);
  const auto change = shape_change(factor, q, invariants(f));
  const auto own = history.subspan(own_history);
  for (int k = 0; k < 12; ++k) own[k] += change[k];
  own[HourglassFlow::dissipated] += flow_dissipation(factor, trial.energy, own[HourglassFlow::elastic]);
  own[HourglassFlow::elastic] = factor * factor * trial.energy;
  own[HourglassFlow::hardening] += hardening;
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
  material_.law->tangent(f.component, law_increment(motion), new_history.subspan(law_row_), stress.component,
                         stiffness.empty() ? std::span<double>() : tangent);
  const std::vector<double> before_flow(new_history.begin(), new_history.end());
  if (flow_.active()) advance_shape(c, f, stress, record, new_history);

  if (stiffness.empty()) {
    const auto forces = static_forces(c, f, stress, record, [&](int k) { return before_flow[k]; });
    for (int i = 0; i < 3 * nodes_per_brick; ++i) force[i] = forces[i / 3][i % 3];
    return true;
  }
  const auto c_dual = coefficients_of<Derivative>(element, motion.position);
  const Matrix3<Derivative> f_dual = mean_deformation_gradient(c_dual, record);
  const auto chained = [&](double value, std::span<const double> slopes) {
    Derivative result(value);
    for (int j = 0; j < 9; ++j)
      for (int k = 0; k < 3 * nodes_per_brick; ++k) result.derivative[k] += slopes[j] * f_dual.component[j].derivative[k];
    return result;
  };
  Matrix3<Derivative> stress_dual;
  for (int i = 0; i < 9; ++i) stress_dual.component[i] = chained(stress.component[i], std::span(tangent).subspan(9 * i, 9));
  std::array<Derivative, HourglassFlow::law_rows> of_law;  // plastic deformation and strain
  if (flow_.active()) {
    std::array<double, 9 * HourglassFlow::law_rows> slopes;
    material_.law->history_slopes(f.component, law_increment(motion), old_history.subspan(law_row_), flow_.plastic_deformation - law_row_, slopes);
    for (int i = 0; i < HourglassFlow::law_rows; ++i)
      of_law[i] = chained(before_flow[flow_.plastic_deformation + i], std::span(slopes).subspan(9 * i, 9));
  }
  const auto forces = static_forces(c_dual, f_dual, stress_dual, record, [&](int k) {
    const int row = k - flow_.plastic_deformation;
    return row >= 0 && row < HourglassFlow::law_rows ? of_law[row] : Derivative(before_flow[k]);
  });
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
