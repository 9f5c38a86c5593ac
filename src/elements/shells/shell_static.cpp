// Shells outside the explicit loop: exact tangent and energies.
#include <algorithm>
#include <cmath>

#include "elements/failure.hpp"
#include "elements/law_increment.hpp"
#include "elements/shells/shell.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

/// Edges x_I - x_0; as duals, direction 6 i + c is the coordinate c of corner i.
template <class T, std::size_t edges>
std::array<Vector3<T>, edges> as_edges(const std::array<Vector3<double>, edges>& edge) {
  std::array<Vector3<T>, edges> result;
  for (std::size_t i = 0; i < edges; ++i)
    for (int c = 0; c < 3; ++c) {
      result[i][c] = T(edge[i][c]);
      if constexpr (!std::is_same_v<T, double>) {
        result[i][c].derivative[6 * (i + 1) + c] = 1.0;
        result[i][c].derivative[c] = -1.0;
      }
    }
  return result;
}

/// Rotations; as duals, direction 6 i + 3 + c is the spin of corner i about axis c: dR = [e_c x] R.
template <class T, std::size_t corners>
std::array<Matrix3<T>, corners> as_rotations(const std::array<Matrix3<double>, corners>& rotation) {
  std::array<Matrix3<T>, corners> result;
  for (std::size_t i = 0; i < corners; ++i)
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) {
        result[i](row, column) = T(rotation[i](row, column));
        if constexpr (!std::is_same_v<T, double>) {
          const int next = (row + 1) % 3, last = (row + 2) % 3;
          result[i](row, column).derivative[6 * i + 3 + next] = rotation[i](last, column);
          result[i](row, column).derivative[6 * i + 3 + last] = -rotation[i](next, column);
        }
      }
  return result;
}

/// Resultants of a strain of any scalar: value from the section, derivatives by the chain rule with its stiffness.
template <class T>
std::array<T, 6> chained_resultants(const ShellSection& section, double thickness, const std::array<T, 6>& strain,
                                    double increment, std::span<double> history) {
  std::array<double, 6> strain_value, value;
  std::array<double, 36> stiffness;
  for (int i = 0; i < 6; ++i) strain_value[i] = value_of(strain[i]);
  constexpr bool differentiate = !std::is_same_v<T, double>;
  shell_resultants(section, thickness, strain_value, increment, history, value,
                   differentiate ? std::span<double>(stiffness) : std::span<double>());
  std::array<T, 6> result;
  for (int i = 0; i < 6; ++i) {
    result[i] = T(value[i]);
    if constexpr (differentiate)
      for (int j = 0; j < 6; ++j)
        for (std::size_t d = 0; d < strain[j].derivative.size(); ++d)
          result[i].derivative[d] += stiffness[6 * i + j] * strain[j].derivative[d];
  }
  return result;
}

template <int corners>
struct Configuration {
  std::array<Vector3<double>, corners - 1> edge;
  std::array<Matrix3<double>, corners> rotation;
};

template <int corners>
Configuration<corners> configuration(std::span<const std::int32_t> node, const NodalMotion& motion) {
  Configuration<corners> result;
  for (int i = 0; i < corners; ++i) {
    const double* const q = motion.orientation + 4 * std::ptrdiff_t{node[i]};
    result.rotation[i] = rotation_matrix<double>({q[0], q[1], q[2], q[3]});
    if (i > 0)
      for (int c = 0; c < 3; ++c)
        result.edge[i - 1][c] =
            motion.position[4 * std::ptrdiff_t{node[i]} + c] - motion.position[4 * std::ptrdiff_t{node[0]} + c];
  }
  return result;
}

template <class T, int corners>
ShellKernel<T, corners> make_kernel(const double* record, const Configuration<corners>& at) {
  ShellKernel<T, corners> kernel;
  kernel.set(record, as_edges<T>(at.edge), as_rotations<T>(at.rotation));
  return kernel;
}

/// The derivatives of nodal forces as a matrix, row by row; the force on corner 0 balances the others.
template <int corners>
void spread_stiffness(const ShellForces<Dual<6 * corners>, corners>& nodal, std::span<double> stiffness) {
  constexpr int size = 6 * corners;
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  for (int i = 0; i < corners; ++i)
    for (int c = 0; c < 3; ++c)
      for (int column = 0; column < size; ++column) {
        stiffness[(6 * i + 3 + c) * size + column] = nodal.moment[i][c].derivative[column];
        if (i == 0) continue;
        stiffness[(6 * i + c) * size + column] = nodal.force[i - 1][c].derivative[column];
        stiffness[c * size + column] -= nodal.force[i - 1][c].derivative[column];
      }
}

}  // namespace

template <int corners, int points>
template <class T>
bool ShellGroup<corners, points>::internal_force(const double* data, const ShellKernel<T, corners>& kernel,
                                                 double increment, std::span<double> history, ShellForces<T, corners>& nodal) const {
  const auto c = [&](const Vector3<T>& a, const Vector3<T>& b) { return value_of(dot(a, b)); };
  const double square = c(kernel.tangent1(), kernel.tangent1()) * c(kernel.tangent2(), kernel.tangent2()) -
                        std::pow(c(kernel.tangent1(), kernel.tangent2()), 2);
  if (!(square > 0.0) || !kernel.upright()) return false;  // no area, turned inside out, or not a number
  const auto strain = kernel.strains();
  ShellModes<T, corners> stress;
  kernel.add_elastic(strain, stress);
  add_hourglass<T>(data, strain, stress);
  for (int q = 0; q < points; ++q) {
    const auto here = strain_at<T>(data, q, strain);
    const double thickness = data[(Record::point + q * Record::point_size + 1) * pack_size];
    const auto resultants = chained_resultants<T>(
        section_, thickness,
        {here.membrane[0], here.membrane[1], here.membrane[2], here.curvature[0], here.curvature[1], here.curvature[2]},
        increment, history.empty() ? history : history.subspan(q * section_.history_size, section_.history_size));
    add_resultants<T>(data, q,
                      {{resultants[0], resultants[1], resultants[2]}, {resultants[3], resultants[4], resultants[5]}},
                      stress);
  }
  kernel.add_forces(stress, nodal);
  history[area_ratio_row()] = std::sqrt(square);
  if (damped())
    for (int i = 0; i < 3; ++i) {
      history[strain_row() + i] = value_of(strain.membrane[i]);
      history[strain_row() + 3 + i] = value_of(strain.curvature[i]);
    }
  return true;
}

template <int corners, int points>
bool ShellGroup<corners, points>::linearize(std::int32_t element, const NodalMotion& motion,
                                            std::span<const double> old_history, std::span<double> new_history,
                                            std::span<double> force, std::span<double> stiffness) const {
  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  const auto at = configuration<corners>(ElementGroup::nodes(element), motion);
  const auto spread = [&](const auto& nodal) {
    std::fill(force.begin(), force.end(), 0.0);
    for (int i = 0; i < corners; ++i)
      for (int c = 0; c < 3; ++c) {
        force[6 * i + 3 + c] = value_of(nodal.moment[i][c]);
        if (i == 0) continue;
        force[6 * i + c] = value_of(nodal.force[i - 1][c]);
        force[c] -= value_of(nodal.force[i - 1][c]);
      }
  };
  if (stiffness.empty()) {
    ShellForces<double, corners> nodal;
    if (!internal_force<double>(record(element), make_kernel<double>(record(element), at), law_increment(motion), new_history, nodal))
      return false;
    spread(nodal);
    return true;
  }
  ShellForces<Dual<6 * corners>, corners> nodal;
  if (!internal_force<Dual<6 * corners>>(record(element), make_kernel<Dual<6 * corners>>(record(element), at),
                                         law_increment(motion), new_history, nodal))
    return false;
  spread(nodal);
  spread_stiffness<corners>(nodal, stiffness);
  return true;
}

template <int corners, int points>
void ShellGroup<corners, points>::stiffness_at_rest(std::int32_t element, const ShellGeometry& geometry,
                                                    std::span<double> stiffness) const {
  Configuration<corners> at;
  for (int i = 1; i < corners; ++i) at.edge[i - 1] = geometry.edge[i];
  at.rotation.fill(Matrix3<double>::identity());
  std::vector<double> history(history_size());
  initialize_history(history);
  ShellForces<Dual<6 * corners>, corners> nodal;
  internal_force<Dual<6 * corners>>(record(element), make_kernel<Dual<6 * corners>>(record(element), at), quasi_static,
                                    history, nodal);
  spread_stiffness<corners>(nodal, stiffness);
}

template <int corners, int points>
ShellKernel<double, corners> ShellGroup<corners, points>::kernel_at(std::int32_t element,
                                                                    const NodalMotion& motion) const {
  return make_kernel<double>(record(element), configuration<corners>(ElementGroup::nodes(element), motion));
}

template <int corners, int points>
int ShellGroup<corners, points>::history_size() const {
  return strain_row() + (damped() ? 6 : 0);
}

template <int corners, int points>
void ShellGroup<corners, points>::initialize_history(std::span<double> history) const {
  std::fill(history.begin(), history.end(), 0.0);
  history[area_ratio_row()] = 1.0;
}

template <int corners, int points>
ElementEnergies ShellGroup<corners, points>::energies(std::int32_t element, const NodalMotion& motion,
                                                      std::span<const double> history) const {
  const double* const data = record(element);
  const auto kernel = kernel_at(element, motion);
  const auto strain = kernel.strains();
  ShellModes<double, corners> elastic, hourglass;
  kernel.add_elastic(strain, elastic);
  add_hourglass<double>(data, strain, hourglass);
  ElementEnergies result;
  const bool gone = has_failed(failed_rows_, history);
  for (int i = 0; i < corners && !gone; ++i) {
    result.strain += 0.5 * elastic.shear[i] * strain.shear[i];
    result.hourglass += 0.5 * elastic.drill[i] * strain.drill[i];
  }
  for (int a = 0; a < Record::Layout::modes && !gone; ++a)
    result.hourglass += 0.5 * (hourglass.membrane_mode[a] * strain.membrane_mode[a] +
                               hourglass.bending_mode[a] * strain.bending_mode[a]);
  for (int q = 0; q < points; ++q) {
    const auto here = strain_at<double>(data, q, strain);
    const double* const point = data + (Record::point + q * Record::point_size) * pack_size;
    const EnergyDensity density = shell_energy(
        section_, point[pack_size],
        {here.membrane[0], here.membrane[1], here.membrane[2], here.curvature[0], here.curvature[1], here.curvature[2]},
        history.subspan(q * section_.history_size, section_.history_size));
    result.strain += point[0] * density.recoverable;
    result.plastic += point[0] * density.plastic;
    result.viscous += point[0] * density.viscous;
    result.heat += point[0] * density.heat;
  }
  result.viscous += history[dissipation_row()];
  return result;
}

template class ShellGroup<3, 1>;
template class ShellGroup<4, 1>;
template class ShellGroup<4, 4>;

}  // namespace balocco
