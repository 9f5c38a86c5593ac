// Membranes outside the explicit loop: exact tangent, energies, output.
#include <algorithm>
#include <cmath>

#include "elements/law_increment.hpp"
#include "elements/membranes/membrane.hpp"
#include "elements/membranes/membrane_output.hpp"

namespace balocco {

namespace {

/// Node positions relative to the first node; as duals, direction 3 i + c is the coordinate c of node i.
template <class T, std::size_t edges>
std::array<Vector3<T>, edges> element_edges(std::span<const std::int32_t> node, const double* position) {
  std::array<Vector3<T>, edges> edge;
  for (std::size_t i = 0; i < edges; ++i)
    for (int c = 0; c < 3; ++c) {
      edge[i][c] = T(position[4 * std::ptrdiff_t{node[i + 1]} + c] - position[4 * std::ptrdiff_t{node[0]} + c]);
      if constexpr (!std::is_same_v<T, double>) {
        edge[i][c].derivative[3 * (i + 1) + c] = 1.0;
        edge[i][c].derivative[c] = -1.0;
      }
    }
  return edge;
}

/// Stress of a strain of any scalar: value from the law, derivatives by the chain rule with the law's tangent.
template <class T>
std::array<T, 3> chained_stress(const Law<PointKind::plane>& law, const std::array<T, 3>& strain, double increment,
                                std::span<double> history) {
  std::array<double, 3> strain_value, stress_value;
  PlaneStiffness tangent;
  for (int i = 0; i < 3; ++i) strain_value[i] = value_of(strain[i]);
  law.tangent(strain_value, increment, history, stress_value,
              std::is_same_v<T, double> ? std::span<double>() : tangent);
  std::array<T, 3> stress;
  for (int i = 0; i < 3; ++i) {
    stress[i] = T(stress_value[i]);
    if constexpr (!std::is_same_v<T, double>)
      for (int j = 0; j < 3; ++j)
        for (std::size_t d = 0; d < strain[j].derivative.size(); ++d)
          stress[i].derivative[d] += tangent[3 * i + j] * strain[j].derivative[d];
  }
  return stress;
}

Vector3<double> area_vector(const SurfaceTangents<double>& tangents) { return cross(tangents.first, tangents.second); }

template <class T>
SurfaceTangents<double> values(const SurfaceTangents<T>& tangents) {
  SurfaceTangents<double> result;
  for (int i = 0; i < 3; ++i) {
    result.first[i] = value_of(tangents.first[i]);
    result.second[i] = value_of(tangents.second[i]);
  }
  return result;
}

}  // namespace

template <int corners, int points>
template <class T>
bool MembraneGroup<corners, points>::internal_force(std::int32_t element, double increment,
                                                  const typename MembraneKernel<T, corners, points>::Edges& edge,
                                                  std::span<double> history,
                                                  typename MembraneKernel<T, corners, points>::Edges& force) const {
  using Kernel = MembraneKernel<T, corners, points>;
  const double* const data = reference(element);
  const int law_size = section_data_.law->history_size();
  Vector3<double> first_area;
  for (int q = 0; q < points; ++q) {
    const SurfaceTangents<T> tangents = Kernel::tangents(data, q, edge);
    const Vector3<double> area = area_vector(values(tangents));
    if (q == 0) first_area = area;
    if (!(dot(area, first_area) > 0.0)) return false;  // no area, folded, or not a number
    const std::array<T, 3> strain = Kernel::strain(data, tangents, edge);
    const auto stress = chained_stress(*section_data_.law, strain, increment, history.subspan(q * law_size, law_size));
    Kernel::add_forces(data, q, tangents, stress, force);
    if constexpr (Layout::one_point_quadrilateral) Kernel::add_hourglass_forces(data, tangents, stress, edge, force);
    history[area_ratio_row(q)] = std::sqrt(metric_determinant(metric(values(tangents))));
    if (damped())
      for (int i = 0; i < 3; ++i) history[strain_row(q) + i] = value_of(strain[i]);
  }
  return true;
}

template <int corners, int points>
bool MembraneGroup<corners, points>::linearize(std::int32_t element, const NodalMotion& motion,
                                             std::span<const double> old_history, std::span<double> new_history,
                                             std::span<double> force, std::span<double> stiffness) const {
  constexpr int size = 3 * corners;
  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  const auto spread = [&](const auto& on_edges) {
    std::fill(force.begin(), force.end(), 0.0);
    for (int i = 0; i < Layout::edges; ++i)
      for (int c = 0; c < 3; ++c) {
        force[3 * (i + 1) + c] = value_of(on_edges[i][c]);
        force[c] -= value_of(on_edges[i][c]);
      }
  };
  if (stiffness.empty()) {
    typename MembraneKernel<double, corners, points>::Edges on_edges{};
    const auto edge = element_edges<double, Layout::edges>(ElementGroup::nodes(element), motion.position);
    if (!internal_force<double>(element, law_increment(motion), edge, new_history, on_edges)) return false;
    spread(on_edges);
    return true;
  }
  using Scalar = Dual<size>;
  typename MembraneKernel<Scalar, corners, points>::Edges on_edges{};
  const auto edge = element_edges<Scalar, Layout::edges>(ElementGroup::nodes(element), motion.position);
  if (!internal_force<Scalar>(element, law_increment(motion), edge, new_history, on_edges)) return false;
  spread(on_edges);
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  for (int row = 3; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double derivative = on_edges[row / 3 - 1][row % 3].derivative[column];
      stiffness[row * size + column] = derivative;
      stiffness[(row % 3) * size + column] -= derivative;
    }
  return true;
}

template <int corners, int points>
int MembraneGroup<corners, points>::history_size() const {
  return strain_row(damped() ? points : 0);
}

template <int corners, int points>
void MembraneGroup<corners, points>::initialize_history(std::span<double> history) const {
  std::fill(history.begin(), history.end(), 0.0);
  for (int q = 0; q < points; ++q) history[area_ratio_row(q)] = 1.0;
}

template <int corners, int points>
void MembraneGroup<corners, points>::lumped_volume(std::int32_t element, std::span<double> volume) const {
  for (int i = 0; i < corners; ++i)
    volume[i] = section_data_.thickness * nodal_area_[element * corners + i];
}

template <int corners, int points>
ElementEnergies MembraneGroup<corners, points>::energies(std::int32_t element, const NodalMotion& motion,
                                                       std::span<const double> history) const {
  using Kernel = MembraneKernel<double, corners, points>;
  const double* const data = reference(element);
  const int law_size = section_data_.law->history_size();
  const auto edge = element_edges<double, Layout::edges>(ElementGroup::nodes(element), motion.position);
  ElementEnergies result;
  for (int q = 0; q < points; ++q) {
    const auto tangents = Kernel::tangents(data, q, edge);
    const auto strain = Kernel::strain(data, tangents, edge);
    const EnergyDensity density =
        section_data_.law->energy_density(strain, history.subspan(q * law_size, law_size));
    result.strain += Kernel::volume(data, q) * density.recoverable;
    result.plastic += Kernel::volume(data, q) * density.plastic;
    result.viscous += Kernel::volume(data, q) * density.viscous;
    result.heat += Kernel::volume(data, q) * density.heat;
    if constexpr (Layout::one_point_quadrilateral) result.hourglass += Kernel::hourglass_energy(data, tangents, edge);
  }
  result.viscous += history[dissipation_row()];
  return result;
}

template <int corners, int points>
int MembraneGroup<corners, points>::point_components(std::string_view variable) const {
  if (variable == "S" || variable == "LE") return 6;
  if (variable == "MISES" || variable == "SENER" || variable == "STH") return 1;
  return history_scalar(*section_data_.law, variable) >= 0 ? 1 : 0;
}

template <int corners, int points>
void MembraneGroup<corners, points>::point_output(std::string_view variable, std::int32_t element, int integration_point,
                                                  const NodalMotion& motion, std::span<const double> history,
                                                  std::span<double> values) const {
  using Kernel = MembraneKernel<double, corners, points>;
  const Law<PointKind::plane>& law = *section_data_.law;
  const double* const data = reference(element);
  const auto edge = element_edges<double, Layout::edges>(ElementGroup::nodes(element), motion.position);
  const auto strain = Kernel::strain(data, Kernel::tangents(data, integration_point, edge), edge);
  const auto law_history = history.subspan(integration_point * law.history_size(), law.history_size());
  const double thickness_ratio = law.transverse_stretch(strain, law_history);
  if (variable == "LE") {
    std::ranges::copy(plane_logarithmic_strain(strain, thickness_ratio), values.begin());
  } else if (variable == "STH") {
    values[0] = section_data_.thickness * thickness_ratio;
  } else if (variable == "SENER") {
    values[0] = law.energy_density(strain, law_history).recoverable;
  } else if (const int row = history_scalar(law, variable); row >= 0) {
    values[0] = law_history[row];
  } else {
    std::vector<double> scratch(law_history.begin(), law_history.end());
    const auto stress = plane_cauchy_stress(strain, chained_stress(law, strain, 0.0, scratch), thickness_ratio);
    if (variable == "S") std::ranges::copy(stress, values.begin());
    if (variable == "MISES") values[0] = mises_stress(stress);
  }
}

template class MembraneGroup<3, 1>;
template class MembraneGroup<4, 1>;
template class MembraneGroup<4, 4>;

}  // namespace balocco
