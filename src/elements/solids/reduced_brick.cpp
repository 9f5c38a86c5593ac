#include "elements/solids/reduced_brick.hpp"

#include <algorithm>
#include <cmath>

#include "elements/bulk_viscosity.hpp"
#include "elements/element_type.hpp"
#include "elements/nodal_packs.hpp"
#include "elements/solids/reduced_brick_damping.hpp"
#include "elements/solids/reduced_brick_stability.hpp"
#include "elements/solids/solid_faces.hpp"

namespace balocco {

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) {
  return std::make_unique<ReducedBrick>(input);
}

const RegisterElement registered({.name = "C3D8R",
                                  .shape = Shape::hexahedron,
                                  .nodes = nodes_per_brick,
                                  .integration_points = 1,
                                  .section = Section::Kind::solid,
                                  .faces = hexahedron_faces(),
                                  .cycle_cost = 50,
                                  .make_group = make_group,
                                  .point_shapes = [](int, std::span<double> values) { std::ranges::fill(values, 0.125); }});

BrickHourglass hourglass_of(const Section& section, const SolidMaterial& material, bool flows) {
  if (section.hourglass == HourglassControl::stiffness) return BrickHourglass::scalar;
  if (flows) return BrickHourglass::flowing;
  return isotropic_poisson_ratio(material) ? BrickHourglass::isotropic : BrickHourglass::anisotropic;
}

/// Asks for the history of a pack that comes soon: it lies in more streams, one a component, than processors foresee.
void prefetch_history(const double* pack, int components, std::ptrdiff_t stride) {
  for (int k = 0; k < components; ++k) __builtin_prefetch(pack + k * stride, 1);
}

}  // namespace

HourglassFlow HourglassFlow::of(const SolidMaterial& solid, const Material& material, const Section& section, int own_history) {
  HourglassFlow flow;
  const int strain = field_row(*solid.law, "PEEQ");
  if (strain < 0 || section.hourglass != HourglassControl::enhanced) return flow;
  flow.plastic_strain = own_history + history_size + strain;
  flow.plastic_deformation = own_history + history_size + field_row(*solid.law, "FP");
  if (const int failure = field_row(*solid.law, "FAILED"); failure >= 0) flow.failure = own_history + history_size + failure;
  const double lame = solid.stiffness[1], shear = solid.stiffness[21];
  flow.yield = FlowStress::of(material);
  flow.least_yield = flow.yield.least();
  flow.twice_shear = section.hourglass_scale * 2.0 * shear;
  flow.plane_ratio = lame / (lame + 2.0 * shear);
  flow.young = section.hourglass_scale * shear * (3.0 * lame + 2.0 * shear) / (lame + shear);
  return flow;
}

ReducedBrick::ReducedBrick(const GroupInput& input)
    : ElementGroup(input),
      material_(SolidMaterial::of_section(input.model, input.model.sections.at(input.section))),
      flow_(HourglassFlow::of(material_, input.model.materials[input.model.sections[input.section].material],
                              input.model.sections[input.section], own_history)),
      hourglass_(hourglass_of(input.model.sections[input.section], material_, flow_.active())),
      poisson_(isotropic_poisson_ratio(material_).value_or(0.0)),
      record_size_(brick_record::size(hourglass_)),
      law_row_(flow_.active() ? own_history + HourglassFlow::history_size : own_history),
      records_(static_cast<std::size_t>(padded_size_) * record_size_) {
  const Section& section = input.model.sections[input.section];
  std::array<Vector3<double>, nodes_per_brick> nodes;
  for (std::int32_t lane = 0; lane < padded_size_; ++lane) {
    reference_nodes(input.model, section, input.model.elements[input.table], rows_[lane], nodes);
    const auto record = reduced_brick_record(HexahedronGeometry(nodes), material_, section, hourglass_);
    double* const data = &records_[static_cast<std::size_t>(lane / pack_size) * pack_size * record_size_ + lane % pack_size];
    for (int k = 0; k < record_size_; ++k) data[pack_size * k] = record[k];
  }
}

void ReducedBrick::initialize_history(std::span<double> history) const {
  std::fill(history.begin(), history.end(), 0.0);
  history[0] = 1.0;
}

void ReducedBrick::lumped_volume(std::int32_t element, std::span<double> volume) const {
  std::fill(volume.begin(), volume.end(), reference(element)[brick_record::volume] / nodes_per_brick);
}

StableIncrement ReducedBrick::add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                         std::span<double> history) const {
  const bool damped = material_.damping_beta > 0.0 && cycle.increment > 0.0;
  const auto add = [&]<Hourglass hourglass>() {
    return damped ? add_packs<hourglass, true>(runs, cycle, history) : add_packs<hourglass, false>(runs, cycle, history);
  };
  switch (hourglass_) {
    case Hourglass::scalar: return add.template operator()<Hourglass::scalar>();
    case Hourglass::isotropic: return add.template operator()<Hourglass::isotropic>();
    case Hourglass::flowing: return add.template operator()<Hourglass::flowing>();
    default: return add.template operator()<Hourglass::anisotropic>();
  }
}

template <ReducedBrick::Hourglass hourglass, bool damped>
StableIncrement ReducedBrick::add_packs(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                        std::span<double> history) const {
  StableIncrement smallest;
  PointBatch<PointKind::solid> points;
  points.count =
      pack_size;  // one pack at a time stays in L1 together with its record: measured faster than batches of 64
  points.history_stride = padded_size_;
  points.increment = cycle.increment;
  for (const auto& run : runs)
    for (std::int32_t element = run.first; element < run.last; element += pack_size) {
      points.history = history.data() + static_cast<std::ptrdiff_t>(law_row_) * padded_size_ + element;
      merge(add_pack<hourglass, damped>(element, cycle, points, history), element, smallest);
    }
  return smallest;
}

template <ReducedBrick::Hourglass hourglass, bool damped>
[[gnu::flatten]] Pack ReducedBrick::add_pack(std::int32_t element, const ExplicitCycle& cycle,
                                             PointBatch<PointKind::solid>& points, std::span<double> history) const {
  constexpr int size = brick_record::size(hourglass);
  const PackReference reference{records_.data() + static_cast<std::size_t>(element) * size};
  prefetch_record(reference.data + pack_size * size, size);
  constexpr int packs_ahead = 2;
  prefetch_history(history.data() + element + packs_ahead * pack_size, history_size(), padded_size_);
  if (const auto next = element + pack_size; next < padded_size_)
    prefetch_nodes(&connectivity_[static_cast<std::size_t>(next) * nodes_per_brick], pack_size * nodes_per_brick, cycle.motion.position,
                   cycle.forces.force);
  const HexahedronCoefficients<Pack> c = coefficients(gather_nodes(element, cycle.motion.position));
  const Matrix3<Pack> f = mean_deformation_gradient(c, reference);
  for (int k = 0; k < 9; ++k) store(f.component[k], points.strain[k]);
  const auto component = [&](int k) { return Pack(&history[k * padded_size_ + element], std::experimental::element_aligned); };
  material_.law->stress(points);
  Matrix3<Pack> stress;
  for (int k = 0; k < 9; ++k) stress.component[k] = load(points.stress[k]);
  const Pack volume = reference[brick_record::volume], length = reference[brick_record::length];
  const Invariants<Pack> invariant = invariants(f);

  Pack old_jacobian(&history[element], std::experimental::element_aligned);
  Pack dissipation(&history[padded_size_ + element], std::experimental::element_aligned);
  const BulkViscosity viscosity(cycle.linear_bulk_viscosity, cycle.quadratic_bulk_viscosity, material_.density,
                                material_.wave_speed);
  const double inverse_increment = cycle.increment > 0.0 ? 1.0 / cycle.increment : 0.0;
  auto shape = [&] {  // its plastic deformation is new, the rest as it was when the increment began
    if constexpr (hourglass == Hourglass::flowing)
      return FlowedReference<Pack, PackReference>(reference, flow_, own_history, component);
    else if constexpr (hourglass == Hourglass::isotropic)
      return IsotropicShape{reference, poisson_};
    else
      return reference;
  }();
  std::array<Vector3<Pack>, 4> q = hourglass_vectors(c, f, shape);
  if constexpr (hourglass == Hourglass::flowing) {
    const HourglassTrial<Pack> trial(c, q, shape);
    const Pack hardened = component(own_history + HourglassFlow::hardening);
    const auto [factor, hardening] = hourglass_return(centre_mises(stress, f), Pack(component(flow_.plastic_strain) + hardened), c,
                                                      trial.stress, trial.energy, volume, flow_);
    const auto change = shape_change(factor, q, invariant);
    q = flowed(factor, q);
    shape.add_shape(change);
    const auto put = [&](int k, const Pack& value) {
      value.copy_to(&history[(own_history + k) * padded_size_ + element], std::experimental::element_aligned);
    };
    for (int k = 0; k < 12; ++k) put(k, component(own_history + k) + change[k]);
    const Pack kept = factor * factor * trial.energy;
    Pack lost = flow_dissipation(factor, trial.energy, component(own_history + HourglassFlow::elastic));
    if (flow_.failure >= 0) lost += select(component(flow_.failure) > 0.0, kept, Pack(0.0));  // what fails gives up its elastic energy
    put(HourglassFlow::dissipated, component(own_history + HourglassFlow::dissipated) + lost);
    put(HourglassFlow::elastic, kept);
    put(HourglassFlow::hardening, hardened + hardening);
  }
  const Pack time_scale(this->time_scale(element), std::experimental::element_aligned);
  const Pack rate = time_scale * volume_rate(invariant.jacobian, old_jacobian, inverse_increment);
  const Pack mean_stress = viscosity.stress(length, rate);
  const Pack old_stress(&history[2 * padded_size_ + element], std::experimental::element_aligned);
  dissipation += volume * viscous_work(old_stress, mean_stress, invariant.jacobian - old_jacobian);
  for (int k = 0; k < 9; ++k)
    stress.component[k] = volume * (stress.component[k] + mean_stress * invariant.cofactor.component[k]);

  HexahedronCoefficients<Pack> conjugates;
  if constexpr (damped) {
    const BrickMotion<Pack> motion{c, f, q};
    const auto c_rate = coefficients(gather_nodes(element, cycle.motion.velocity));
    conjugates = damped_conjugates<hourglass != Hourglass::scalar>(motion, c_rate, stress, material_, shape, cycle.increment, dissipation);
  } else if constexpr (hourglass != Hourglass::scalar) {
    const auto hourglass_stress = hourglass_stresses(hourglass_strains(c, q), shape);
    conjugates = conjugates_with_stresses(c, q, hourglass_stress, stress, shape);
  } else {
    conjugates = conjugates_with_scalar(scalar_hourglass_forces(q, reference), stress, reference);
  }
  const std::array<Vector3<Pack>, nodes_per_brick> forces = nodal_forces(conjugates);
  const std::int32_t* targets = scatter_.data() + static_cast<std::size_t>(element) * nodes_per_brick;
  for (int node = 0; node < nodes_per_brick; ++node)
    scatter_subtract(forces[node], targets + node, nodes_per_brick, cycle.forces.force);

  invariant.jacobian.copy_to(&history[element], std::experimental::element_aligned);
  dissipation.copy_to(&history[padded_size_ + element], std::experimental::element_aligned);
  mean_stress.copy_to(&history[2 * padded_size_ + element], std::experimental::element_aligned);
  const TangentBound<Pack> bound{load(points.volumetric_modulus), load(points.shear_modulus)};
  const BrickStability<Pack> stability{material_.density, damped ? Pack(material_.damping_beta / time_scale) : Pack(0.0)};
  if constexpr (hourglass == Hourglass::flowing)
    return stability.increment(invariant, f, bound, q, viscosity.slope(length, rate), shape);
  else
    return stability.increment(invariant, bound, q, viscosity.slope(length, rate), reference);
}

std::array<Vector3<Pack>, nodes_per_brick> ReducedBrick::gather_nodes(std::int32_t element, const double* nodal) const {
  const std::int32_t* nodes = connectivity_.data() + static_cast<std::size_t>(element) * nodes_per_brick;
  std::array<Vector3<Pack>, nodes_per_brick> values;
  for (int node = 0; node < nodes_per_brick; ++node) values[node] = gather(nodal, nodes + node, nodes_per_brick);
  return values;
}

void ReducedBrick::energies(std::int32_t first, const NodalMotion& motion, std::span<const double> group_history,
                            std::span<ElementEnergies> of_lanes) const {
  for (std::size_t lane = 0; lane < of_lanes.size(); lane += pack_size)
    pack_energies(first + static_cast<std::int32_t>(lane), motion, group_history, of_lanes.subspan(lane).first<pack_size>());
}

[[gnu::flatten]] void ReducedBrick::pack_energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history,
                                                  std::span<ElementEnergies, pack_size> of_lanes) const {
  const PackReference reference{record(element)};
  prefetch_record(reference.data + pack_size * record_size_, record_size_);
  const HexahedronCoefficients<Pack> c = coefficients(gather_nodes(element, motion.position));
  const Matrix3<Pack> f = mean_deformation_gradient(c, reference);
  const Pack hourglass = artificial_energy(
      c, f, reference, [&](int k) { return Pack(&history[k * padded_size_ + element], std::experimental::element_aligned); });
  const Pack volume = reference[brick_record::volume];
  PointBatch<PointKind::solid> points;
  points.count = pack_size;
  for (int k = 0; k < 9; ++k) store(f.component[k], points.strain[k]);
  std::array<EnergyDensity, pack_size> density;
  material_.law->energy_densities(points, history.data() + static_cast<std::ptrdiff_t>(law_row_) * padded_size_ + element,
                                  padded_size_, density);
  for (int lane = 0; lane < pack_size; ++lane)
    of_lanes[lane] = element_energies(volume[lane], density[lane], hourglass[lane], history[padded_size_ + element + lane]);
}

std::size_t ReducedBrick::bytes_per_element() const {
  return sizeof(double) * (record_size_ + history_size()) + sizeof(std::int32_t) * (2 * nodes_per_brick + 1);
}

}  // namespace balocco
