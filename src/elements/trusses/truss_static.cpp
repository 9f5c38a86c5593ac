// Trusses outside the explicit loop: exact tangent, energies, output.
#include <algorithm>
#include <cmath>

#include "elements/law_increment.hpp"
#include "elements/trusses/truss.hpp"
#include "elements/trusses/truss_kernel.hpp"

namespace balocco {

namespace {

Vector3<double> truss_axis(std::span<const std::int32_t> node, const double* position) {
  const double *const a = position + 4 * std::ptrdiff_t{node[0]}, *const b = position + 4 * std::ptrdiff_t{node[1]};
  return {{b[0] - a[0], b[1] - a[1], b[2] - a[2]}};
}

}  // namespace

double TrussGroup::strain_at(std::int32_t element, const double* position) const {
  const double length = reference_length(element);
  return truss_strain(truss_axis(nodes(element), position), 1.0 / (length * length));
}

bool TrussGroup::linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                           std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const {
  using Scalar = Dual<3>;
  const double length = reference_length(element);
  const Vector3<double> axis_value = truss_axis(nodes(element), motion.position);
  Vector3<Scalar> axis;
  for (int c = 0; c < 3; ++c) axis[c] = Scalar(axis_value[c], c);
  const Scalar strain = truss_strain(axis, 1.0 / (length * length));
  if (!(1.0 + 2.0 * strain.value > 0.0)) return false;

  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  new_history[stretch_row()] = std::sqrt(1.0 + 2.0 * strain.value);
  if (damped()) new_history[strain_row()] = strain.value;
  const std::array<double, 1> strain_value{strain.value};
  std::array<double, 1> stress, tangent;
  law_->tangent(strain_value, law_increment(motion), new_history.first(law_->history_size()), stress, tangent);
  const Vector3<Scalar> pull = truss_force(axis, Scalar::chain(stress[0], tangent[0], strain), area_ / length);
  for (int c = 0; c < 3; ++c) {
    force[3 + c] = pull[c].value;
    force[c] = -pull[c].value;
  }
  if (stiffness.empty()) return true;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const double sign = row / 3 == column / 3 ? 1.0 : -1.0;
      stiffness[6 * row + column] = sign * pull[row % 3].derivative[column % 3];
    }
  return true;
}

ElementEnergies TrussGroup::energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history) const {
  const std::array<double, 1> strain{strain_at(element, motion.position)};
  ElementEnergies result;
  const double volume = area_ * reference_length(element);
  const EnergyDensity density = law_->energy_density(strain, history.first(law_->history_size()));
  result.strain = volume * density.recoverable;
  result.plastic = volume * density.plastic;
  result.viscous = history[dissipation_row()] + volume * density.viscous;
  result.heat = volume * density.heat;
  return result;
}

int TrussGroup::point_components(std::string_view variable) const {
  if (variable == "S" || variable == "LE") return 6;
  return variable == "MISES" || variable == "SENER" || history_scalar(*law_, variable) >= 0 ? 1 : 0;
}

void TrussGroup::point_output(std::string_view variable, std::int32_t element, int, const NodalMotion& motion,
                              std::span<const double> history, std::span<double> values) const {
  const std::array<double, 1> strain{strain_at(element, motion.position)};
  std::vector<double> law_history(history.begin(), history.begin() + law_->history_size());
  const double square = 1.0 + 2.0 * strain[0], area_ratio = law_->transverse_stretch(strain, law_history);
  if (const int row = history_scalar(*law_, variable); row >= 0) {
    values[0] = law_history[row];
    return;
  }
  if (variable == "LE") {
    const double transverse = 0.5 * std::log(area_ratio);
    const double components[6] = {0.5 * std::log1p(2.0 * strain[0]), transverse, transverse, 0.0, 0.0, 0.0};
    std::ranges::copy(components, values.begin());
    return;
  }
  if (variable == "SENER") {
    values[0] = law_->energy_density(strain, law_history).recoverable;
    return;
  }
  std::array<double, 1> stress;
  law_->tangent(strain, 0.0, law_history, stress, {});
  const double cauchy = stress[0] * std::sqrt(square) / area_ratio;  // axial force S A l / L over the current area
  std::fill(values.begin(), values.end(), 0.0);
  values[0] = variable == "MISES" ? std::fabs(cauchy) : cauchy;
}

}  // namespace balocco
