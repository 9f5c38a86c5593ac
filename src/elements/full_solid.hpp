// C3D8 and C3D6: fully integrated solids with mean dilatation, one template over shape and quadrature.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "elements/aligned_vector.hpp"
#include "elements/bulk_viscosity.hpp"
#include "elements/element_group.hpp"
#include "elements/element_type.hpp"
#include "elements/full_solid_kernel.hpp"
#include "elements/full_solid_stability.hpp"
#include "elements/nodal_packs.hpp"
#include "elements/record_reference.hpp"
#include "elements/solid_damping.hpp"
#include "elements/solid_output.hpp"
#include "elements/solid_reference.hpp"
#include "math/dual.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

template <class Shape>
std::array<double, FullSolidRecord<Shape>::size> full_solid_record(
    const std::array<Vector3<double>, Shape::nodes>& nodes) {
  using Record = FullSolidRecord<Shape>;
  static constexpr auto quadrature = Shape::quadrature();
  std::array<double, Record::size> record{};
  const auto c = Shape::coefficients(nodes);
  Eigen::Matrix<double, Shape::nodes, Shape::nodes> laplacian =
      Eigen::Matrix<double, Shape::nodes, Shape::nodes>::Zero();
  Eigen::Matrix<double, 3, Shape::nodes> mean = Eigen::Matrix<double, 3, Shape::nodes>::Zero();
  double volume = 0.0;
  for (int q = 0; q < Shape::points; ++q) {
    Matrix3<double> jacobian{};
    for (int k = 0; k < Shape::modes; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) jacobian(i, j) += c[k][i] * quadrature[q].derivative[k][j];
    const Matrix3<double> cof = cofactor(jacobian);
    const double det = determinant(jacobian, cof);
    double* point = &record[Record::point(q)];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) point[3 * i + j] = cof(j, i) / det;
    point[9] = det * quadrature[q].weight;
    volume += point[9];
    Eigen::Matrix<double, 3, Shape::nodes>
        gradient;  // B_I, one direction at a time through the transpose of the coefficients
    for (int j = 0; j < 3; ++j) {
      std::array<Vector3<double>, Shape::modes> conjugate{};
      for (int k = 0; k < Shape::modes; ++k)
        for (int n = 0; n < 3; ++n) conjugate[k][0] += quadrature[q].derivative[k][n] * point[3 * n + j];
      const auto nodal = Shape::nodal(conjugate);
      for (int node = 0; node < Shape::nodes; ++node) gradient(j, node) = nodal[node][0];
    }
    laplacian += point[9] * gradient.transpose() * gradient;
    mean += point[9] * gradient;
  }
  mean /= volume;
  record[Record::volume] = volume;
  record[Record::laplacian_bound] =
      Eigen::SelfAdjointEigenSolver<decltype(laplacian)>(laplacian, Eigen::EigenvaluesOnly)
          .eigenvalues()(Shape::nodes - 1);
  const Eigen::Matrix3d metric = mean * mean.transpose();
  const double largest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(metric, Eigen::EigenvaluesOnly).eigenvalues()(2);
  record[Record::length] = 2.0 / std::sqrt(Shape::nodes * largest);
  return record;
}

template <class Shape>
class FullSolid final : public ElementGroup {
 public:
  explicit FullSolid(const GroupInput& input);

  int history_size() const override { return 2; }  // Jbar after the last increment, viscous dissipation
  void initialize_history(std::span<double> history) const override {
    std::fill(history.begin(), history.end(), 0.0);
    history[0] = 1.0;
  }
  void lumped_mass(std::int32_t element, std::span<double> mass) const override {
    std::fill(mass.begin(), mass.end(), material_.density * reference(element)[Record::volume] / Shape::nodes);
  }
  StableIncrement add_forces(Portion portion, const ExplicitCycle& cycle, std::span<double> history) const override;
  bool linearize(std::int32_t element, const double* position, std::span<const double> old_history,
                 std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const override;
  ElementEnergies energies(std::int32_t element, const double* position,
                           std::span<const double> history) const override;
  int output_components(std::string_view variable) const override { return solid_output_components(variable); }
  void output(std::string_view variable, std::int32_t element, int integration_point, const double* position,
              std::span<const double>, std::span<double> values) const override {
    const auto k = full_solid_kinematics<Shape>(coefficients_of<double>(element, position), reference(element));
    solid_output(variable, material_, k.modified[integration_point], {}, values);
  }
  int integration_points() const override { return Shape::points; }
  std::size_t bytes_per_element() const override {
    return sizeof(double) * (Record::size + history_size()) + sizeof(std::int32_t) * (2 * Shape::nodes + 1);
  }

 private:
  using Record = FullSolidRecord<Shape>;
  static_assert(Shape::points * pack_size <= PointBatch<PointKind::solid>::capacity);
  template <class T>
  using Coefficients = std::array<Vector3<T>, Shape::modes>;
  template <class T>
  using Tensors = std::array<Matrix3<T>, Shape::points>;

  Coefficients<Pack> gather_coefficients(std::int32_t element, const double* nodal) const;
  Pack add_pack(std::int32_t element, const ExplicitCycle& cycle, PointBatch<PointKind::solid>& points,
                std::span<double> history) const;
  /// Adds beta * (initial stiffness : rate) to the stresses; returns the power.
  Pack add_damping(std::int32_t element, const ExplicitCycle& cycle, const FullSolidKinematics<Pack, Shape>& k,
                   Tensors<Pack>& stress) const;
  Pack stable_increment(const FullSolidKinematics<Pack, Shape>& k, const Tensors<Pack>& stress,
                        const PointBatch<PointKind::solid>& points, const Pack& viscous_slope, bool damped,
                        const PackReference& reference) const;
  template <class T>
  Coefficients<T> coefficients_of(std::int32_t element, const double* position) const;

  PackReference pack_reference(std::int32_t element) const {
    return {records_.data() + static_cast<std::size_t>(element) * Record::size};
  }
  LaneReference reference(std::int32_t element) const {
    return {records_.data() + static_cast<std::size_t>(element / pack_size) * pack_size * Record::size +
            element % pack_size};
  }

  SolidMaterial material_;
  AlignedVector<double> records_;  // [pack][component][lane]
};

template <class Shape>
FullSolid<Shape>::FullSolid(const GroupInput& input)
    : ElementGroup(input),
      material_(SolidMaterial::of_section(input.model, input.model.sections.at(input.section))),
      records_(static_cast<std::size_t>(padded_size_) * Record::size) {
  const Section& section = input.model.sections[input.section];
  if (material_.law->history_size() != 0)
    throw InputError(input.model.where(section.location) +
                     ": error: *SOLID SECTION: C3D8 and C3D6 take elastic and hyperelastic materials only; use C3D8R");
  std::array<Vector3<double>, Shape::nodes> nodes;
  for (std::int32_t lane = 0; lane < padded_size_; ++lane) {
    reference_nodes(input.model, section, input.model.elements[input.table], rows_[lane], nodes);
    const auto record = full_solid_record<Shape>(nodes);
    double* data =
        records_.data() + static_cast<std::size_t>(lane / pack_size) * pack_size * Record::size + lane % pack_size;
    for (int k = 0; k < Record::size; ++k) data[pack_size * k] = record[k];
  }
}

template <class Shape>
StableIncrement FullSolid<Shape>::add_forces(Portion portion, const ExplicitCycle& cycle,
                                             std::span<double> history) const {
  const std::int32_t first = portion == Portion::interface ? 0 : interface_padded_;
  const std::int32_t last = portion == Portion::interface ? interface_padded_ : padded_size_;
  StableIncrement smallest;
  PointBatch<PointKind::solid> points;
  points.count = Shape::points * pack_size;
  for (std::int32_t element = first; element < last; element += pack_size) {
    const Pack increment = add_pack(element, cycle, points, history);
    if (std::experimental::all_of(increment >= smallest.increment)) continue;
    for (int i = 0; i < pack_size; ++i) smallest.merge({increment[i], element + i});
  }
  return smallest;
}

template <class Shape>
auto FullSolid<Shape>::gather_coefficients(std::int32_t element, const double* nodal) const -> Coefficients<Pack> {
  const std::int32_t* nodes = connectivity_.data() + static_cast<std::size_t>(element) * Shape::nodes;
  std::array<Vector3<Pack>, Shape::nodes> x;
  for (int node = 0; node < Shape::nodes; ++node) x[node] = gather(nodal, nodes + node, Shape::nodes);
  return Shape::coefficients(x);
}

template <class Shape>
Pack FullSolid<Shape>::add_pack(std::int32_t element, const ExplicitCycle& cycle, PointBatch<PointKind::solid>& points,
                                std::span<double> history) const {
  const PackReference reference = pack_reference(element);
  const auto k = full_solid_kinematics<Shape>(gather_coefficients(element, cycle.position), reference);
  for (int q = 0; q < Shape::points; ++q)
    for (int i = 0; i < 9; ++i) store(k.modified[q].component[i], &points.strain[i][pack_size * q]);
  material_.law->stress(points);
  Tensors<Pack> stress;
  for (int q = 0; q < Shape::points; ++q)
    for (int i = 0; i < 9; ++i) stress[q].component[i] = load(&points.stress[i][pack_size * q]);

  Pack old_jacobian(&history[element], std::experimental::element_aligned);
  Pack dissipation(&history[padded_size_ + element], std::experimental::element_aligned);
  const BulkViscosity viscosity(cycle.linear_bulk_viscosity, cycle.quadratic_bulk_viscosity, material_.density,
                                material_.wave_speed);
  const double inverse_increment = cycle.increment > 0.0 ? 1.0 / cycle.increment : 0.0;
  const Pack rate = volume_rate(k.mean_jacobian, old_jacobian, inverse_increment);
  const Pack length = reference[Record::length], mean_stress = viscosity.stress(length, rate);
  dissipation += cycle.increment * (reference[Record::volume] * (mean_stress * (k.mean_jacobian * rate)));
  const bool damped = material_.damping_beta > 0.0 && cycle.increment > 0.0;
  if (damped) dissipation += cycle.increment * add_damping(element, cycle, k, stress);

  const auto forces = Shape::nodal(full_solid_conjugates<Shape>(k, stress, mean_stress, reference));
  const std::int32_t* targets = scatter_.data() + static_cast<std::size_t>(element) * Shape::nodes;
  for (int node = 0; node < Shape::nodes; ++node)
    scatter_subtract(forces[node], targets + node, Shape::nodes, cycle.force);
  k.mean_jacobian.copy_to(&history[element], std::experimental::element_aligned);
  dissipation.copy_to(&history[padded_size_ + element], std::experimental::element_aligned);
  return stable_increment(k, stress, points, viscosity.slope(length, rate), damped, reference);
}

template <class Shape>
Pack FullSolid<Shape>::add_damping(std::int32_t element, const ExplicitCycle& cycle,
                                   const FullSolidKinematics<Pack, Shape>& k, Tensors<Pack>& stress) const {
  const PackReference reference = pack_reference(element);
  const auto c_rate = gather_coefficients(element, cycle.velocity);
  Tensors<Pack> rate;                          // s dF/dt, then dFbar/dt
  std::array<Pack, Shape::points> dilatation;  // d(ln J)/dt
  const Pack inverse = 1.0 / k.mean_jacobian;
  Pack mean = 0.0;
  for (int q = 0; q < Shape::points; ++q) {
    rate[q] = k.scale[q] * deformation_gradient<Shape>(c_rate, q, reference);
    dilatation[q] = inverse * double_contraction(cofactor(k.modified[q]), rate[q]);
    mean += reference[Record::point(q) + 9] * (k.jacobian[q] * dilatation[q]);
  }
  mean = mean * inverse / reference[Record::volume];
  Pack power = 0.0;
  for (int q = 0; q < Shape::points; ++q) {
    rate[q] = rate[q] + ((1.0 / 3.0) * (mean - dilatation[q])) * k.modified[q];
    Pack density;
    const Matrix3<Pack> viscous = k.modified[q] * rate_stress(material_.stiffness, k.modified[q], rate[q], density);
    stress[q] = stress[q] + Pack(material_.damping_beta) * viscous;
    power += material_.damping_beta * (reference[Record::point(q) + 9] * density);
  }
  return power;
}

template <class Shape>
Pack FullSolid<Shape>::stable_increment(const FullSolidKinematics<Pack, Shape>& k, const Tensors<Pack>& stress,
                                        const PointBatch<PointKind::solid>& points, const Pack& viscous_slope,
                                        bool damped, const PackReference& reference) const {
  const Pack volume = reference[Record::volume], inverse_volume = 1.0 / volume, inverse = 1.0 / k.mean_jacobian;
  FullSolidBound<Pack> bound;
  for (int q = 0; q < Shape::points; ++q) {
    const TangentBound<Pack> tangent{load(&points.volumetric_modulus[pack_size * q]),
                                     load(&points.shear_modulus[pack_size * q])};
    bound.add_point(k.modified[q], stress[q], tangent, k.scale[q], k.jacobian[q] * inverse,
                    inverse_volume * reference[Record::point(q) + 9]);
  }
  // d(ln Jbar)/dx is the nodal force of a unit mean stress, over V Jbar.
  const auto gradient = Shape::nodal(full_solid_conjugates<Shape>(k, Tensors<Pack>{}, Pack(1.0), reference));
  Pack square = 0.0;
  for (const auto& node : gradient) square += dot(node, node);
  const Pack dilatation = square * ((inverse * inverse) * inverse_volume);  // V |d(ln Jbar)/dx|^2

  const Pack stiffness = bound.volumetric() * dilatation + bound.distortion * reference[Record::laplacian_bound];
  const Pack inverse_mass = material_.density > 0.0 ? (Shape::nodes / material_.density) * inverse_volume : Pack(0.0);
  const Pack omega_square = inverse_mass * stiffness;
  const Pack damping = inverse_mass * (viscous_slope * (k.mean_jacobian * dilatation)) +
                       (damped ? material_.damping_beta : 0.0) * omega_square;
  Pack smallest_jacobian = k.jacobian[0];
  for (int q = 1; q < Shape::points; ++q) smallest_jacobian = -maximum(-smallest_jacobian, -k.jacobian[q]);
  const Pack increment = neutral_increment(omega_square, damping);
  return select(smallest_jacobian > 0.0 && increment > 0.0, increment, Pack(0.0));  // inverted or not a number: 0
}

template <class Shape>
template <class T>
auto FullSolid<Shape>::coefficients_of(std::int32_t element, const double* position) const -> Coefficients<T> {
  std::array<Vector3<T>, Shape::nodes> nodes;
  for (int node = 0; node < Shape::nodes; ++node) {
    const double* x = position + 4 * static_cast<std::ptrdiff_t>(connectivity_[element * Shape::nodes + node]);
    for (int i = 0; i < 3; ++i) {
      if constexpr (std::is_same_v<T, double>)
        nodes[node][i] = x[i];
      else
        nodes[node][i] = T(x[i], 3 * node + i);
    }
  }
  return Shape::coefficients(nodes);
}

template <class Shape>
bool FullSolid<Shape>::linearize(std::int32_t element, const double* position, std::span<const double> old_history,
                                 std::span<double> new_history, std::span<double> force,
                                 std::span<double> stiffness) const {
  constexpr int dofs = 3 * Shape::nodes;
  using Derivative = Dual<dofs>;
  const LaneReference record = reference(element);
  const auto k = full_solid_kinematics<Shape>(coefficients_of<double>(element, position), record);
  for (const double jacobian : k.jacobian)
    if (!(jacobian > 0.0)) return false;
  std::copy(old_history.begin(), old_history.end(), new_history.begin());
  new_history[0] = k.mean_jacobian;

  Tensors<double> stress;
  std::array<std::array<double, 81>, Shape::points> tangent;
  for (int q = 0; q < Shape::points; ++q)
    material_.law->tangent(k.modified[q].component, {}, stress[q].component, tangent[q]);
  if (stiffness.empty()) {
    const auto forces = Shape::nodal(full_solid_conjugates<Shape>(k, stress, 0.0, record));
    for (int i = 0; i < dofs; ++i) force[i] = forces[i / 3][i % 3];
    return true;
  }
  const auto k_dual = full_solid_kinematics<Shape>(coefficients_of<Derivative>(element, position), record);
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
ElementEnergies FullSolid<Shape>::energies(std::int32_t element, const double* position,
                                           std::span<const double> history) const {
  const LaneReference record = reference(element);
  const auto k = full_solid_kinematics<Shape>(coefficients_of<double>(element, position), record);
  ElementEnergies energies;
  for (int q = 0; q < Shape::points; ++q)
    energies.strain += record[Record::point(q) + 9] * material_.law->energy_density(k.modified[q].component, {});
  energies.viscous = history[1];
  return energies;
}

}  // namespace balocco
