#include "elements/beams/beam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/bulk_viscosity.hpp"
#include "elements/element_type.hpp"
#include "elements/history_pack.hpp"
#include "elements/nodal_packs.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

BeamGroup::BeamGroup(const GroupInput& input)
    : ElementGroup(input),
      section_data_(beam_section(input.model, input.model.sections[input.section])),
      records_(static_cast<std::size_t>(padded_size_) * rows) {
  for (std::int32_t element = 0; element < padded_size_; ++element) set_reference(input.model, element);
}

void BeamGroup::set_reference(const Model& model, std::int32_t element) {
  const ElementTable& table = model.elements[table_];
  const auto row = static_cast<std::size_t>(rows_[element]);
  const Point& a = model.nodes.coordinates[table.connectivity[2 * row]];
  const Point& b = model.nodes.coordinates[table.connectivity[2 * row + 1]];
  const double l = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  if (!(l > 0.0))
    throw InputError(fmt::format("{}: error: *ELEMENT: beam {} has no length; correct its nodes",
                                 model.where(table.location[row]), table.id[row]));
  const Section& section = model.sections[section_];
  std::array<Point, 3> directions;
  if (!beam_frame(a, b, section.beam.n1, directions))
    throw InputError(fmt::format(
        "{}: error: *BEAM SECTION: direction n1 ({:g}, {:g}, {:g}) runs along the axis of element {}; give another one on the "
        "second data line",
        model.where(section.location), section.beam.n1[0], section.beam.n1[1], section.beam.n1[2], table.id[row]));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) reference(element, frame + 3 * i + k) = directions[k][i];
  reference(element, length) = l;
  const auto stiffness = element_shear_stiffness(l);
  for (int k = 0; k < 3; ++k) reference(element, shear + k) = stiffness[k];
  set_inertia(element, stiffness);
}

/// Shear stiffness 11, 22, 12: the inverse of the flexibility of the section's shear and of the residual bending.
std::array<double, 3> BeamGroup::element_shear_stiffness(double l) const {
  const BeamArea& s = section_data_.shape;
  const double residual = l * l / (12.0 * section_data_.youngs_modulus * (s.i11 * s.i22 - s.i12 * s.i12));
  const double f11 = 1.0 / section_data_.shear_stiffness[0] + residual * s.i11;
  const double f22 = 1.0 / section_data_.shear_stiffness[1] + residual * s.i22;
  const double f12 = -residual * s.i12, determinant = f11 * f22 - f12 * f12;
  return {f22 / determinant, f11 / determinant, -f12 / determinant};
}

/// With masses m = rho A L / 2 and inertias J the free element oscillates in shear with omega^2 = K (2 / (m L) + L / (2 J)), in
/// bending with 2 E I / (L J), in torsion with 2 G Jt / (L J) and along its axis with 4 E / (rho L^2), which J makes the largest
/// unless the shear stiffness was given nearly as large as that of stretch.
void BeamGroup::set_inertia(std::int32_t element, const std::array<double, 3>& k) {
  const BeamArea& s = section_data_.shape;
  const double e = section_data_.youngs_modulus, rho = section_data_.density, l = reference(element, length);
  const double half = 0.5 * (k[0] + k[1]), largest = half + std::hypot(0.5 * (k[0] - k[1]), k[2]);
  const double in_shear = largest * rho * l * l * l / (8.0 * std::max(e - largest / s.area, 0.1 * e));
  const double in_torsion = 0.5 * rho * l * section_data_.shear_modulus * s.torsion / e;
  const double j = std::max({0.5 * rho * l * (s.i11 + s.i22), in_shear, in_torsion});
  reference(element, inertia) = j;
  reference(element, frequency) = std::max(4.0 * e / (rho * l * l), largest * (4.0 / (rho * s.area * l * l) + 0.5 * l / j));
}

void BeamGroup::initialize_history(std::span<double> history) const { std::fill(history.begin(), history.end(), 0.0); }

void BeamGroup::lumped_volume(std::int32_t element, std::span<double> volume) const {
  volume[0] = volume[1] = 0.5 * section_data_.shape.area * reference(element, length);
}

void BeamGroup::lumped_rotary_inertia(std::int32_t element, std::span<double> share) const {
  share[0] = share[1] = reference(element, inertia);
}

void BeamGroup::material_rotary_inertia(std::int32_t element, std::span<double> tensors) const {
  const BeamArea& s = section_data_.shape;
  const double own[3][3] = {{s.i11, -s.i12, 0.0}, {-s.i12, s.i22, 0.0}, {0.0, 0.0, s.i11 + s.i22}};
  const double half = 0.5 * section_data_.density * reference(element, length);
  std::fill(tensors.begin(), tensors.end(), 0.0);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      double& sum = tensors[3 * row + column];
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          sum += half * own[i][k] * reference(element, frame + 3 * row + i) * reference(element, frame + 3 * column + k);
      tensors[9 + 3 * row + column] = sum;
    }
}

/// Stiffness-proportional damping and linear bulk viscosity b1 rho c L along the axis; books what they dissipate.
/// @return damping coefficient of the fastest oscillation (damping / mass), for the stable increment
Pack BeamGroup::add_viscosity(std::int32_t first, const BeamVector<Pack>& strain, const ExplicitCycle& cycle,
                              std::span<double> history, BeamVector<Pack>& resultant) const {
  const auto row = [&](int component) { return history.data() + component * std::ptrdiff_t{padded_size_} + first; };
  const double* const data = record(first);
  const Pack l = load(data + length * pack_size);
  const double inverse_increment = cycle.increment > 0.0 ? 1.0 / cycle.increment : 0.0;
  const double wave = std::sqrt(section_data_.youngs_modulus / section_data_.density);
  BeamVector<Pack> change, rate;
  for (int i = 0; i < 6; ++i) {
    change[i] = strain[i] - load_unaligned(row(strain_row + i));
    rate[i] = inverse_increment * change[i];
    store_unaligned(strain[i], row(strain_row + i));
  }
  BeamVector<Pack> viscous{};
  if (section_data_.damping_beta > 0.0) {
    viscous = resultants(rate, {load(data + shear * pack_size), load(data + (shear + 1) * pack_size),
                                load(data + (shear + 2) * pack_size)});
    for (auto& component : viscous) component = section_data_.damping_beta * component;
  }
  const Pack time_scale = load_unaligned(this->time_scale(first));
  viscous[2] += (cycle.linear_bulk_viscosity * section_data_.density * wave * section_data_.shape.area) * l *
                (time_scale * rate[2]);
  Pack work = 0.0;
  for (int i = 0; i < 6; ++i) {
    work = work + viscous_work(load_unaligned(row(viscous_row + i)), viscous[i], change[i]);
    store_unaligned(viscous[i], row(viscous_row + i));
    resultant[i] = resultant[i] + viscous[i];
  }
  store_unaligned(load_unaligned(row(0)) + l * work, row(0));
  const Pack axial = wave / l;
  const Pack of_bulk_viscosity = (4.0 * cycle.linear_bulk_viscosity) * axial;
  if (section_data_.damping_beta == 0.0) return of_bulk_viscosity;
  return (4.0 * section_data_.damping_beta / time_scale) * axial * axial + of_bulk_viscosity;
}

/// The fibres take the place of the elastic section in stretch and bending, and of round profiles in torsion.
void BeamGroup::add_fibres(std::int32_t first, const BeamVector<Pack>& strain, double increment, std::span<double> history,
                           BeamVector<Pack>& resultant) const {
  resultant[2] = resultant[3] = resultant[4] = Pack(0.0);
  if (section_data_.fibres[0].lever > 0.0) resultant[5] = Pack(0.0);
  PointBatch<PointKind::fibre> batch;
  batch.count = pack_size;
  batch.increment = increment;
  batch.history_stride = padded_size_;
  for (std::size_t i = 0; i < section_data_.fibres.size(); ++i) {
    const BeamFibre& fibre = section_data_.fibres[i];
    const Pack along = fibre_strain(strain, fibre);
    store(along + 0.5 * along * along, batch.strain[0]);
    store(fibre.lever * strain[5], batch.strain[1]);
    batch.history = history.data() + fibre_row(static_cast<int>(i)) * std::ptrdiff_t{padded_size_} + first;
    section_data_.law->stress(batch);
    add_fibre(fibre, along, load(batch.stress[0]), load(batch.stress[1]), resultant);
  }
}

[[gnu::flatten]] void BeamGroup::add_pack(std::int32_t first, const ExplicitCycle& cycle, std::span<double> history,
                         StableIncrement& stable) const {
  const double* const data = record(first);
  const std::int32_t *const node = connectivity_.data() + 2 * first, *const target = scatter_.data() + 2 * first;
  Matrix3<Pack> e;
  for (int i = 0; i < 9; ++i) e.component[i] = load(data + (frame + i) * pack_size);
  const Pack l = load(data + length * pack_size);
  const auto k = beam_kinematics(gather(cycle.motion.position, node + 1, 2) - gather(cycle.motion.position, node, 2),
                                 gather_four(cycle.motion.orientation, node, 2),
                                 gather_four(cycle.motion.orientation, node + 1, 2), e, Pack(1.0 / l));
  BeamVector<Pack> resultant = resultants(k.strain, {load(data + shear * pack_size), load(data + (shear + 1) * pack_size),
                                                     load(data + (shear + 2) * pack_size)});
  if (section_data_.law) add_fibres(first, k.strain, cycle.increment, history, resultant);
  const Pack damping = add_viscosity(first, k.strain, cycle, history, resultant);
  const auto forces = beam_forces(k, resultant, e);
  scatter_subtract(Vector3<Pack>() - forces.force, target, 2, cycle.forces.force);
  scatter_subtract(forces.force, target + 1, 2, cycle.forces.force);
  scatter_subtract(forces.moment_a, target, 2, cycle.forces.moment);
  scatter_subtract(forces.moment_b, target + 1, 2, cycle.forces.moment);

  // What forces and moments add by turning with the element, and the stretch that a rotation causes in a sheared element, are
  // bounded, not solved for: with masses m and inertias J, F (1 / (m L) + 3 L / (4 J)) + M / J, and r + omega sqrt(r) with
  // r = E A L (shear strain)^2 / (2 J), because J makes shear about as fast as stretch.
  const auto magnitude = [](const Pack& x, const Pack& y, const Pack& z) { return square_root(x * x + y * y + z * z); };
  const Pack j = load(data + inertia * pack_size), free = load(data + frequency * pack_size);
  const double area = section_data_.shape.area;
  const Pack sheared = (0.5 * section_data_.youngs_modulus * area) *
                       (l / j * (k.strain[0] * k.strain[0] + k.strain[1] * k.strain[1]));
  const Pack turning = magnitude(resultant[0], resultant[1], resultant[2]) *
                           (2.0 / (section_data_.density * area * l * l) + 0.75 * l / j) +
                       magnitude(resultant[3], resultant[4], resultant[5]) / j +
                       sheared + square_root(free * sheared) +
                       2.0 * free * std::experimental::abs(k.strain[2]);
  const Pack omega = square_root(free + turning);
  const Pack ratio = 0.5 * damping / omega;
  const Pack increment = 2.0 * (square_root(1.0 + ratio * ratio) - ratio) / omega;
  merge(increment, first, stable);
}

StableIncrement BeamGroup::add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                      std::span<double> history) const {
  StableIncrement stable;
  for (const auto& run : runs)
    for (std::int32_t first = run.first; first < run.last; first += pack_size) add_pack(first, cycle, history, stable);
  return stable;
}

std::size_t BeamGroup::bytes_per_element() const { return rows * sizeof(double) + 4 * sizeof(std::int32_t); }

namespace {

const RegisterElement b31({.name = "B31",
                           .shape = Shape::line,
                           .nodes = 2,
                           .integration_points = 1,
                           .turns = true,
                           .section = Section::Kind::beam,
                           .faces = {},
                           .cycle_cost = 32,
                           .make_group = [](const GroupInput& input) -> std::unique_ptr<ElementGroup> {
                             return std::make_unique<BeamGroup>(input);
                           }});

}  // namespace

}  // namespace balocco
