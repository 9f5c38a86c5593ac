// Reference data and explicit kernel of the fully integrated solids.
#pragma once

#include <algorithm>
#include <cmath>

#include "elements/bulk_viscosity.hpp"
#include "elements/element_type.hpp"
#include "elements/solids/full_solid.hpp"
#include "elements/solids/full_solid_stability.hpp"
#include "elements/nodal_packs.hpp"
#include "elements/solids/solid_damping.hpp"
#include "math/dense.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

/// Mean of a free element's nodal masses over that of a node.
template <class Shape>
constexpr double inverse_mass_ratio(int node) {
  return 1.0 / (Shape::nodes * Shape::mass_share[node]);
}

template <class Shape>
std::array<double, FullSolidRecord<Shape>::size> full_solid_record(
    const std::array<Vector3<double>, Shape::nodes>& nodes) {
  using Record = FullSolidRecord<Shape>;
  static constexpr auto quadrature = Shape::quadrature();
  std::array<double, Record::size> record{};
  const auto c = Shape::coefficients(nodes);
  Dense<Shape::nodes, Shape::nodes> laplacian;
  Dense<3, Shape::nodes> mean;
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
    Dense<3, Shape::nodes> gradient;  // B_I, one direction at a time through the transpose of the coefficients
    for (int j = 0; j < 3; ++j) {
      std::array<Vector3<double>, Shape::modes> conjugate{};
      for (int k = 0; k < Shape::modes; ++k)
        for (int n = 0; n < 3; ++n) conjugate[k][0] += quadrature[q].derivative[k][n] * point[3 * n + j];
      const auto nodal = Shape::nodal(conjugate);
      for (int node = 0; node < Shape::nodes; ++node) gradient(j, node) = nodal[node][0];
    }
    mean += point[9] * gradient;
    for (int node = 0; node < Shape::nodes; ++node)
      for (int j = 0; j < 3; ++j) gradient(j, node) *= std::sqrt(inverse_mass_ratio<Shape>(node));
    laplacian += point[9] * (transpose(gradient) * gradient);
  }
  record[Record::volume] = volume;
  if constexpr (has_bubbles<Shape>) {
    Matrix3<double> jacobian;  // at the centre
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) jacobian(i, j) = c[j][i];
    const Matrix3<double> cof = cofactor(jacobian);
    const double det = determinant(jacobian, cof);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        record[Record::centre + 3 * i + j] = cof(j, i) / det;
        record[Record::bubble + 3 * i + j] = -2.0 * cof(j, i);
      }
  }
  record[Record::laplacian_bound] = largest_eigenvalue(laplacian);
  record[Record::length] = 2.0 * volume / std::sqrt(Shape::nodes * largest_eigenvalue(mean * transpose(mean)));
  return record;
}

/// Largest eigenvalue of sum_q dN_I/dxi . dN_J/dxi, each over the root of its node's mass by the mean one.
template <class Shape>
double natural_laplacian() {
  static constexpr auto quadrature = Shape::quadrature();
  Dense<Shape::nodes, Shape::nodes> laplacian;
  for (int q = 0; q < Shape::points; ++q)
    for (int j = 0; j < 3; ++j) {
      std::array<Vector3<double>, Shape::modes> derivative{};
      for (int k = 0; k < Shape::modes; ++k) derivative[k][0] = quadrature[q].derivative[k][j];
      const auto nodal = Shape::nodal(derivative);
      Dense<Shape::nodes, 1> gradient;
      for (int node = 0; node < Shape::nodes; ++node) gradient(node, 0) = std::sqrt(inverse_mass_ratio<Shape>(node)) * nodal[node][0];
      laplacian += gradient * transpose(gradient);
    }
  return largest_eigenvalue(laplacian);
}

template <class Shape>
FullSolid<Shape>::FullSolid(const GroupInput& input)
    : ElementGroup(input),
      material_(SolidMaterial::of_section(input.model, input.model.sections.at(input.section))),
      natural_laplacian_(natural_laplacian<Shape>()),
      records_(static_cast<std::size_t>(padded_size_) * Record::size) {
  const Section& section = input.model.sections[input.section];
  std::array<Vector3<double>, Shape::nodes> nodes;
  for (std::int32_t lane = 0; lane < padded_size_; ++lane) {
    reference_nodes(input.model, section, input.model.elements[input.table], rows_[lane], nodes);
    const auto record = full_solid_record<Shape>(nodes);
    double* data =
        records_.data() + static_cast<std::size_t>(lane / pack_size) * pack_size * Record::size + lane % pack_size;
    for (int k = 0; k < Record::size; ++k) data[pack_size * k] = record[k];
    if constexpr (has_bubbles<Shape>) store_flexibility(lane);
  }
  if constexpr (has_bubbles<Shape>)
    kept_history_.resize(static_cast<std::size_t>(Shape::points) * material_.law->history_size() * pack_size);
}

template <class Shape>
StableIncrement FullSolid<Shape>::add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                             std::span<double> history) const {
  StableIncrement smallest;
  if constexpr (Shape::explicit_steps) {  // of the others there are none in explicit steps (model/check.cpp)
    PointBatch<PointKind::solid> points;
    for (const auto& run : runs)
      for (std::int32_t element = run.first; element < run.last; element += pack_size)
        merge(add_pack(element, cycle, points, history), element, smallest);
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

// A law without memory takes all points at once; with it, point after point, each with its own rows of history.
template <class Shape>
void FullSolid<Shape>::respond(std::int32_t element, double increment, PointBatch<PointKind::solid>& points,
                               std::span<double> history) const {
  points.increment = increment;
  points.first = 0;
  points.count = Shape::points * pack_size;
  if (material_.law->history_size() == 0) return material_.law->stress(points);
  points.count = pack_size;
  points.history_stride = padded_size_;
  for (int q = 0; q < Shape::points; ++q) {
    points.first = q * pack_size;
    points.history = history.data() + law_row(q) * static_cast<std::ptrdiff_t>(padded_size_) + element;
    material_.law->stress(points);
  }
}

template <class Shape>
[[gnu::flatten]] Pack FullSolid<Shape>::add_pack(std::int32_t element, const ExplicitCycle& cycle,
                                                 PointBatch<PointKind::solid>& points,
                                                 std::span<double> history) const {
  const PackReference reference = pack_reference(element);
  prefetch_record(reference.data + pack_size * Record::size, Record::size);
  const auto c = gather_coefficients(element, cycle.motion.position);
  if constexpr (has_bubbles<Shape>) settle_bubbles(element, c, cycle.increment, points, history);
  const auto k = pack_kinematics(element, c, history);
  for (int q = 0; q < Shape::points; ++q)
    for (int i = 0; i < 9; ++i) store(k.modified[q].component[i], &points.strain[i][pack_size * q]);
  respond(element, cycle.increment, points, history);
  Tensors<Pack> stress;
  for (int q = 0; q < Shape::points; ++q)
    for (int i = 0; i < 9; ++i) stress[q].component[i] = load(&points.stress[i][pack_size * q]);

  Pack old_jacobian(&history[element], std::experimental::element_aligned);
  Pack dissipation(&history[padded_size_ + element], std::experimental::element_aligned);
  const BulkViscosity viscosity(cycle.linear_bulk_viscosity, cycle.quadratic_bulk_viscosity, material_.density,
                                material_.wave_speed);
  const double inverse_increment = cycle.increment > 0.0 ? 1.0 / cycle.increment : 0.0;
  const Pack time_scale(this->time_scale(element), std::experimental::element_aligned);
  const Pack rate = time_scale * volume_rate(k.mean_jacobian, old_jacobian, inverse_increment);
  const Pack length = reference[Record::length], mean_stress = viscosity.stress(length, rate);
  const Pack old_stress(&history[2 * padded_size_ + element], std::experimental::element_aligned);
  dissipation += reference[Record::volume] * viscous_work(old_stress, mean_stress, k.mean_jacobian - old_jacobian);
  const bool damped = material_.damping_beta > 0.0 && cycle.increment > 0.0;
  if (damped) dissipation += cycle.increment * add_damping(element, cycle, k, stress);

  const auto forces = Shape::nodal(full_solid_conjugates<Shape>(k, stress, mean_stress, reference));
  const std::int32_t* targets = scatter_.data() + static_cast<std::size_t>(element) * Shape::nodes;
  for (int node = 0; node < Shape::nodes; ++node)
    scatter_subtract(forces[node], targets + node, Shape::nodes, cycle.forces.force);
  k.mean_jacobian.copy_to(&history[element], std::experimental::element_aligned);
  dissipation.copy_to(&history[padded_size_ + element], std::experimental::element_aligned);
  mean_stress.copy_to(&history[2 * padded_size_ + element], std::experimental::element_aligned);
  const Pack beta = damped ? Pack(material_.damping_beta / time_scale) : Pack(0.0);
  return stable_increment(c, k, stress, points, viscosity.slope(length, rate), beta, reference);
}

template <class Shape>
[[gnu::flatten]] void FullSolid<Shape>::pack_energies(std::int32_t element, const NodalMotion& motion,
                                                      std::span<const double> history,
                                                      std::span<ElementEnergies, pack_size> of_lanes) const {
  const PackReference reference = pack_reference(element);
  prefetch_record(reference.data + pack_size * Record::size, Record::size);
  const auto k = pack_kinematics(element, gather_coefficients(element, motion.position), history);
  for (int lane = 0; lane < pack_size; ++lane) of_lanes[lane] = {.viscous = history[padded_size_ + element + lane]};
  PointBatch<PointKind::solid> points;
  points.count = pack_size;
  std::array<EnergyDensity, pack_size> density;
  for (int q = 0; q < Shape::points; ++q) {
    for (int i = 0; i < 9; ++i) store(k.modified[q].component[i], points.strain[i]);
    material_.law->energy_densities(points, history.data() + law_row(q) * static_cast<std::ptrdiff_t>(padded_size_) + element,
                                    padded_size_, density);
    const Pack volume = reference[Record::point(q) + 9];
    for (int lane = 0; lane < pack_size; ++lane) {
      of_lanes[lane].strain += volume[lane] * density[lane].recoverable;
      of_lanes[lane].plastic += volume[lane] * density[lane].plastic;
      of_lanes[lane].viscous += volume[lane] * density[lane].viscous;
      of_lanes[lane].heat += volume[lane] * density[lane].heat;
    }
  }
}

template <class Shape>
Pack FullSolid<Shape>::add_damping(std::int32_t element, const ExplicitCycle& cycle,
                                   const FullSolidKinematics<Pack, Shape>& k, Tensors<Pack>& stress) const {
  const PackReference reference = pack_reference(element);
  const auto c_rate = gather_coefficients(element, cycle.motion.velocity);
  Tensors<Pack> rate;                          // s dF/dt, then dFbar/dt
  std::array<Pack, Shape::points> dilatation;  // d(ln J)/dt
  const Pack inverse = 1.0 / k.mean_jacobian;
  Pack mean = 0.0;
  for (int q = 0; q < Shape::points; ++q) {
    rate[q] = k.scale[q] * deformation_gradient<Shape>(c_rate, q, reference);
    if constexpr (has_bubbles<Shape>) rate[q] = rate[q] + centre_gradient<Shape>(c_rate, reference) * k.bubble[q];
    dilatation[q] = inverse * double_contraction(cofactor(k.modified[q]), rate[q]);
    mean += reference[Record::point(q) + 9] * (k.jacobian[q] * dilatation[q]);
  }
  mean = mean * inverse / reference[Record::volume];
  Pack power = 0.0;
  for (int q = 0; q < Shape::points; ++q) {
    if constexpr (Shape::mean_dilatation) rate[q] = rate[q] + ((1.0 / 3.0) * (mean - dilatation[q])) * k.modified[q];
    Pack density;
    const Matrix3<Pack> viscous = k.modified[q] * rate_stress(material_.stiffness, k.modified[q], rate[q], density);
    stress[q] = stress[q] + Pack(material_.damping_beta) * viscous;
    power += material_.damping_beta * (reference[Record::point(q) + 9] * density);
  }
  return power;
}

// sum_q w g_q (x) g_q, g_q the gradients of ln J by the nodes over the roots of their relative masses, has the eigenvalues of
// the small matrix of sqrt(w_p w_q) g_p . g_q; of those the largest is at most the fourth root of the sum of fourth powers.
template <class Shape>
[[gnu::noinline]] Pack FullSolid<Shape>::dilatation_bound(const FullSolidKinematics<Pack, Shape>& k, const Pack& of_mean,
                                        const PackReference& reference) const {
  if constexpr (Shape::points == 1) return of_mean;
  std::array<std::array<Vector3<Pack>, Shape::nodes>, Shape::points> gradient;
  for (int q = 0; q < Shape::points; ++q) {
    Coefficients<Pack> conjugates{};
    add_conjugates<Shape>(cofactor(k.modified[q]), q, reference, conjugates);
    gradient[q] = Shape::nodal(conjugates);
    const Pack scale = square_root(reference[Record::point(q) + 9]) / k.jacobian[q];
    for (int node = 0; node < Shape::nodes; ++node)
      gradient[q][node] = (std::sqrt(inverse_mass_ratio<Shape>(node)) * scale) * gradient[q][node];
  }
  std::array<std::array<Pack, Shape::points>, Shape::points> product;
  for (int p = 0; p < Shape::points; ++p)
    for (int q = 0; q <= p; ++q) {
      Pack sum = 0.0;
      for (int node = 0; node < Shape::nodes; ++node) sum += dot(gradient[p][node], gradient[q][node]);
      product[p][q] = product[q][p] = sum;
    }
  Pack fourth = 0.0;
  for (int p = 0; p < Shape::points; ++p)
    for (int q = 0; q < Shape::points; ++q) {
      Pack square = 0.0;
      for (int r = 0; r < Shape::points; ++r) square += product[p][r] * product[r][q];
      fourth += square * square;
    }
  return square_root(square_root(fourth));
}

template <class Shape>
Pack FullSolid<Shape>::stiffness_bound(const Coefficients<Pack>& c, const FullSolidKinematics<Pack, Shape>& k,
                                       const Tensors<Pack>& stress, const PointBatch<PointKind::solid>& points,
                                       const Pack& dilatation, const PackReference& reference) const {
  const Pack inverse_volume = 1.0 / reference[Record::volume], inverse = 1.0 / k.mean_jacobian;
  const auto tangent = [&](int q) {
    return TangentBound<Pack>{load(&points.volumetric_modulus[pack_size * q]), load(&points.shear_modulus[pack_size * q])};
  };
  if constexpr (!Shape::mean_dilatation) {
    TangentBound<Pack> bound = tangent(0);
    for (int q = 1; q < Shape::points; ++q) {
      bound.volumetric = maximum(bound.volumetric, tangent(q).volumetric);
      bound.shear = maximum(bound.shear, tangent(q).shear);
    }
    const Pack stiffness =
        bound.volumetric * dilatation_bound(k, dilatation, reference) + 2.0 * bound.shear * reference[Record::laplacian_bound];
    if constexpr (!has_bubbles<Shape>) return stiffness;
    Pack bubble = 0.0;  // |dF0 H| adds to |dF|; that the amplitudes follow only softens
    for (const auto& h : k.bubble) bubble = maximum(bubble, double_contraction(h, h));
    const Pack factor = 1.0 + square_root(bubble);
    return stiffness * (factor * factor);
  }
  std::array<InitialStress<Pack>, Shape::points> initial;
  Pack mean_pressure = 0.0;
  for (int q = 0; q < Shape::points; ++q) {
    initial[q] = {k.modified[q], stress[q]};
    mean_pressure += (inverse_volume * reference[Record::point(q) + 9]) * initial[q].pressure;
  }
  if (material_.law->bounds_spatial_gradient()) {
    SpatialSolidBound<Pack> bound{mean_pressure};
    for (int q = 0; q < Shape::points; ++q) {
      const Pack weight = reference[Record::point(q) + 9];
      bound.add_point(k.modified[q], natural_gradient<Shape>(c, q), initial[q], tangent(q), k.scale[q], k.jacobian[q] * inverse,
                      weight, inverse_volume * weight);
    }
    return bound.volumetric() * dilatation + bound.distortional(reference[Record::laplacian_bound], natural_laplacian_);
  }
  FullSolidBound<Pack> bound{mean_pressure};
  for (int q = 0; q < Shape::points; ++q)
    bound.add_point(k.modified[q], initial[q], tangent(q), k.scale[q], k.jacobian[q] * inverse,
                    inverse_volume * reference[Record::point(q) + 9]);
  return bound.volumetric() * dilatation + bound.distortion * reference[Record::laplacian_bound];
}

template <class Shape>
Pack FullSolid<Shape>::stable_increment(const Coefficients<Pack>& c, const FullSolidKinematics<Pack, Shape>& k,
                                        const Tensors<Pack>& stress, const PointBatch<PointKind::solid>& points,
                                        const Pack& viscous_slope, const Pack& damping_beta, const PackReference& reference) const {
  const Pack volume = reference[Record::volume], inverse_volume = 1.0 / volume, inverse = 1.0 / k.mean_jacobian;
  // d(ln Jbar)/dx is the nodal force of a unit mean stress, over V Jbar.
  const auto gradient = Shape::nodal(full_solid_conjugates<Shape>(k, Tensors<Pack>{}, Pack(1.0), reference));
  Pack square = 0.0;
  for (int node = 0; node < Shape::nodes; ++node) square += inverse_mass_ratio<Shape>(node) * dot(gradient[node], gradient[node]);
  const Pack dilatation = square * ((inverse * inverse) * inverse_volume);  // V |d(ln Jbar)/dx|^2

  const Pack stiffness = stiffness_bound(c, k, stress, points, dilatation, reference);
  const Pack inverse_mass = material_.density > 0.0 ? (Shape::nodes / material_.density) * inverse_volume : Pack(0.0);
  const Pack omega_square = inverse_mass * stiffness;
  const Pack damping = inverse_mass * (viscous_slope * (k.mean_jacobian * dilatation)) + damping_beta * omega_square;
  Pack smallest_jacobian = k.jacobian[0];
  for (int q = 1; q < Shape::points; ++q) smallest_jacobian = -maximum(-smallest_jacobian, -k.jacobian[q]);
  const Pack increment = neutral_increment(omega_square, damping);
  return select(smallest_jacobian > 0.0 && increment > 0.0, increment, Pack(0.0));  // inverted or not a number: 0
}

}  // namespace balocco
