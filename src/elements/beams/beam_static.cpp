// Beams outside the explicit loop: exact tangent, energies, output.
#include <algorithm>
#include <cmath>

#include "elements/beams/beam.hpp"
#include "elements/law_increment.hpp"
#include "materials/initial_stress.hpp"

namespace balocco {

namespace {

Vector3<double> beam_axis(std::span<const std::int32_t> node, const double* position) {
  const double *const a = position + 4 * std::ptrdiff_t{node[0]}, *const b = position + 4 * std::ptrdiff_t{node[1]};
  return {{b[0] - a[0], b[1] - a[1], b[2] - a[2]}};
}

Quaternion<double> orientation_of(std::int32_t node, const double* orientation) {
  const double* const q = orientation + 4 * std::ptrdiff_t{node};
  return {q[0], q[1], q[2], q[3]};
}

/// A quaternion with its derivatives by a spin in global axes, directions `first`, first + 1, first + 2: (0, spin / 2) q.
template <int N>
Quaternion<Dual<N>> with_spin(const Quaternion<double>& q, int first) {
  Quaternion<Dual<N>> result;
  for (int i = 0; i < 4; ++i) result[i] = Dual<N>(q[i]);
  for (int k = 0; k < 3; ++k) {
    Quaternion<double> half{};
    half[1 + k] = 0.5;
    const auto change = product(half, q);
    for (int i = 0; i < 4; ++i) result[i].derivative[first + k] = change[i];
  }
  return result;
}

}  // namespace

BeamKinematics<double> BeamGroup::kinematics_at(std::int32_t element, const NodalMotion& motion) const {
  Matrix3<double> e;
  for (int i = 0; i < 9; ++i) e.component[i] = reference(element, frame + i);
  const auto node = nodes(element);
  return beam_kinematics(beam_axis(node, motion.position), orientation_of(node[0], motion.orientation),
                         orientation_of(node[1], motion.orientation), e, 1.0 / reference(element, length));
}

namespace {

/// A stress with the derivatives that its law's tangent gives it.
double with_tangent(double stress, std::span<const double>, double, double) { return stress; }
template <int N>
Dual<N> with_tangent(double stress, std::span<const double> row, const Dual<N>& green, const Dual<N>& twist) {
  return stress + row[0] * (green - green.value) + row[1] * (twist - twist.value);
}

}  // namespace

template <class T>
BeamVector<T> BeamGroup::response(std::int32_t element, const BeamVector<T>& strain, double increment,
                                  std::span<double> history) const {
  BeamVector<T> resultant = resultants<T>(
      strain, {T(reference(element, shear)), T(reference(element, shear + 1)), T(reference(element, shear + 2))});
  if (!section_data_.law) return resultant;
  resultant[2] = resultant[3] = resultant[4] = T(0.0);
  if (section_data_.fibres[0].lever > 0.0) resultant[5] = T(0.0);
  for (std::size_t i = 0; i < section_data_.fibres.size(); ++i) {
    const BeamFibre& fibre = section_data_.fibres[i];
    const T along = fibre_strain(strain, fibre), green = along + 0.5 * along * along, twist = fibre.lever * strain[5];
    std::array<double, 2> stress{};
    std::array<double, 4> tangent{};
    section_data_.law->tangent(std::array{value_of(green), value_of(twist)}, increment,
                               history.subspan(fibre_row(static_cast<int>(i)), section_data_.law->history_size()), stress,
                               tangent);
    add_fibre<T>(fibre, along, with_tangent(stress[0], std::span(tangent).first(2), green, twist),
                 with_tangent(stress[1], std::span(tangent).last(2), green, twist), resultant);
  }
  return resultant;
}

bool BeamGroup::linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                          std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const {
  using Scalar = Dual<12>;
  Matrix3<double> e;
  for (int i = 0; i < 9; ++i) e.component[i] = reference(element, frame + i);
  const auto node = nodes(element);
  const auto axis_value = beam_axis(node, motion.position);
  Vector3<Scalar> axis;
  for (int c = 0; c < 3; ++c) {
    axis[c] = Scalar(axis_value[c]);
    axis[c].derivative[c] = -1.0;
    axis[c].derivative[6 + c] = 1.0;
  }
  const auto k = beam_kinematics(axis, with_spin<12>(orientation_of(node[0], motion.orientation), 3),
                                 with_spin<12>(orientation_of(node[1], motion.orientation), 9), e,
                                 1.0 / reference(element, length));
  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  const auto forces = beam_forces(k, response(element, k.strain, law_increment(motion), new_history), e);
  for (int i = 0; i < 6; ++i) new_history[strain_row + i] = k.strain[i].value;
  const auto put = [&](int row, const Scalar& value, double sign) {
    force[row] = sign * value.value;
    if (stiffness.empty()) return;
    for (int column = 0; column < 12; ++column) stiffness[12 * row + column] = sign * value.derivative[column];
  };
  for (int c = 0; c < 3; ++c) {
    put(c, forces.force[c], -1.0);
    put(3 + c, forces.moment_a[c], 1.0);
    put(6 + c, forces.force[c], 1.0);
    put(9 + c, forces.moment_b[c], 1.0);
  }
  return true;
}

ElementEnergies BeamGroup::energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history) const {
  const auto strain = kinematics_at(element, motion).strain;
  const auto elastic = resultants<double>(
      strain, {reference(element, shear), reference(element, shear + 1), reference(element, shear + 2)});
  const double l = reference(element, length);
  const bool twisting = section_data_.law && section_data_.fibres[0].lever > 0.0;
  ElementEnergies result;
  for (int i = 0; i < 6; ++i)
    if (!section_data_.law || i < 2 || (i == 5 && !twisting)) result.strain += 0.5 * l * strain[i] * elastic[i];
  result.viscous = history[0];
  for (std::size_t i = 0; i < section_data_.fibres.size(); ++i) {
    const BeamFibre& fibre = section_data_.fibres[i];
    const double along = fibre_strain(strain, fibre);
    const auto density = section_data_.law->energy_density(
        std::array{along + 0.5 * along * along, fibre.lever * strain[5]},
        history.subspan(fibre_row(static_cast<int>(i)), section_data_.law->history_size()));
    result.strain += l * fibre.area * density.recoverable;
    result.plastic += l * fibre.area * density.plastic;
    result.viscous += l * fibre.area * density.viscous;
    result.heat += l * fibre.area * density.heat;
  }
  return result;
}

int BeamGroup::law_field_row(std::string_view field, int point) const {
  const int row = section_data_.law ? field_row(*section_data_.law, field) : -1;
  return row < 0 ? row : fibre_row(point) + row;
}

int BeamGroup::point_components(std::string_view variable) const {
  if (variable == "S" || variable == "LE") return 6;
  if (variable == "SF" || variable == "SM") return 3;
  return variable == "MISES" || (section_data_.law && history_scalar(*section_data_.law, variable) >= 0) ? 1 : 0;
}

/// SF: axial force, shear forces along n2 and n1; SM: moments about n1, n2 and the axis. S, LE: 11 along the axis, 12 from torsion.
void BeamGroup::point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                             std::span<const double> history, std::span<double> values) const {
  const auto strain = kinematics_at(element, motion).strain;
  std::vector<double> own(history.begin(), history.end());
  const auto resultant = response(element, strain, 0.0, own);
  std::fill(values.begin(), values.end(), 0.0);
  if (variable == "SF") {
    values[0] = resultant[2];
    values[1] = resultant[1];
    values[2] = resultant[0];
    return;
  }
  if (variable == "SM") {
    std::copy_n(resultant.begin() + 3, 3, values.begin());
    return;
  }
  const BeamPoint& point = section_data_.points[integration_point];
  const double along = fibre_strain(strain, point), twist = point.lever * strain[5];
  const double poisson = 0.5 * section_data_.youngs_modulus / section_data_.shear_modulus - 1.0;
  double stress = section_data_.youngs_modulus * along, shearing = section_data_.shear_modulus * twist, thermal = 0.0;
  if (const auto& law = section_data_.law) {
    const auto of_fibre = std::span(own).subspan(fibre_row(integration_point), law->history_size());
    if (const int row = history_scalar(*law, variable); row >= 0) {
      values[0] = of_fibre[row];
      return;
    }
    if (const int row = history_scalar(*law, "THE"); row >= 0) thermal = of_fibre[row];
    std::array<double, 2> stresses{};
    law->tangent(std::array{along + 0.5 * along * along, twist}, 0.0, of_fibre, stresses, {});
    stress = stresses[0] * (1.0 + along);
    shearing = stresses[1];
  }
  if (variable == "MISES") {
    values[0] = std::sqrt(stress * stress + 3.0 * shearing * shearing);
  } else {
    const bool is_stress = variable == "S";
    values[0] = is_stress ? stress : along;
    if (!is_stress) values[1] = values[2] = thermal - poisson * (along - thermal);
    values[3] = is_stress ? shearing : 0.5 * twist;
  }
}

}  // namespace balocco
