// Membranes in the explicit loop, and their registration. Statics, energies and output: membrane_static.cpp.
#include "elements/membranes/membrane.hpp"

#include <algorithm>

#include "elements/bulk_viscosity.hpp"
#include "elements/element_type.hpp"
#include "elements/history_pack.hpp"
#include "elements/membranes/membrane_reference.hpp"
#include "elements/membranes/membrane_stability.hpp"
#include "elements/nodal_packs.hpp"

namespace balocco {

namespace {

constexpr int block_capacity = PointBatch<PointKind::plane>::capacity;
constexpr int block_packs = block_capacity / pack_size;

}  // namespace

/// Up to 64 elements on their way through the kernel, small enough for L1.
template <int corners, int points>
struct MembraneGroup<corners, points>::Block {
  using Edges = typename MembraneKernel<Pack, corners, points>::Edges;
  std::int32_t first = 0;  // lane of the group
  int packs = 0;
  Edges edge[block_packs], force[block_packs];
  SurfaceTangents<Pack> tangents[block_packs];       // of the point at hand
  SurfaceTangents<Pack> mean_tangents[block_packs];  // volume integral over the points
  Pack modulus[block_packs], tension[block_packs], dissipated[block_packs];
  PointBatch<PointKind::plane> batch;
};

template <int corners, int points>
MembraneGroup<corners, points>::MembraneGroup(const GroupInput& input)
    : ElementGroup(input),
      section_data_(membrane_section(input.model, input.model.sections[input.section])),
      reference_(static_cast<std::size_t>(padded_size_) * Layout::size),
      nodal_area_(static_cast<std::size_t>(size_) * corners) {
  const Section& section = input.model.sections[input.section];
  for (std::int32_t element = 0; element < padded_size_; ++element) {
    const MembraneGeometry geometry = membrane_geometry(input.model, {table_, rows_[element]}, section, points);
    double* const data = reference_.data() + element / pack_size * (Layout::size * pack_size) + element % pack_size;
    fill_membrane_reference<corners, points>(geometry, section_data_, {section.hourglass, section.hourglass_scale}, data);
    if (element < size_) std::copy_n(geometry.nodal_area.begin(), corners, nodal_area_.begin() + element * corners);
  }
}

/// Stress of linear bulk viscosity and of stiffness-proportional damping at a point; updates the history of their rates and the
/// energy that they dissipate. The rate of dilatation is that of ln(area), by the mean-value quotient 2 (J - J0) / (J + J0).
template <int corners, int points>
std::array<Pack, 3> MembraneGroup<corners, points>::viscous_stress(Block& block, int pack, int point,
                                                                 const Metric<Pack>& stretch, const ExplicitCycle& cycle,
                                                                 std::span<double> history) const {
  const std::int32_t element = block.first + pack * pack_size;
  const double* const data = pack_reference(element);
  const auto row = [&](int component) { return history.data() + component * std::ptrdiff_t{padded_size_} + element; };
  const double inverse_increment = cycle.increment > 0.0 ? 1.0 / cycle.increment : 0.0;

  const Pack square = metric_determinant(stretch), ratio = square_root(square);
  const Pack old_ratio = load_unaligned(row(area_ratio_row(point)));
  store_unaligned(ratio, row(area_ratio_row(point)));
  const Pack rate = 2.0 * inverse_increment * (ratio - old_ratio) / (ratio + old_ratio);
  const Pack pressure = cycle.linear_bulk_viscosity * reference_value<Pack>(data, Layout::viscosity) *
                        (load_unaligned(time_scale(element)) * rate);
  const Pack contravariant = pressure / square;  // Cauchy stress pressure * 1 pulled back: pressure * C^-1
  std::array<Pack, 3> stress{contravariant * stretch.c22, contravariant * stretch.c11, -contravariant * stretch.c12};
  Pack work = viscous_work(load_unaligned(row(viscous_row(point))), pressure, cycle.increment * rate);
  store_unaligned(pressure, row(viscous_row(point)));

  if (damped()) {
    const auto& d = section_data_.damping_stiffness;
    Pack strain_rate[3];
    for (int i = 0; i < 3; ++i) {
      const Pack strain = load(block.batch.strain[i] + pack * pack_size);
      strain_rate[i] = inverse_increment * (strain - load_unaligned(row(strain_row(point) + i)));
      store_unaligned(strain, row(strain_row(point) + i));
    }
    Pack power = 0.0;
    for (int i = 0; i < 3; ++i) {
      const Pack damping = d[3 * i] * strain_rate[0] + d[3 * i + 1] * strain_rate[1] + d[3 * i + 2] * strain_rate[2];
      stress[i] = stress[i] + damping;
      power = power + damping * strain_rate[i];
    }
    work = work + cycle.increment * power;
  }
  const Pack volume = MembraneKernel<Pack, corners, points>::volume(data, point);
  block.dissipated[pack] = block.dissipated[pack] + volume * work;
  return stress;
}

/// Strains of one integration point of the whole block, the law, and the forces of its stresses.
template <int corners, int points>
[[gnu::flatten]] void MembraneGroup<corners, points>::add_point(int point, Block& block, const ExplicitCycle& cycle,
                                             std::span<double> history) const {
  using Kernel = MembraneKernel<Pack, corners, points>;
  auto& batch = block.batch;
  for (int pack = 0; pack < block.packs; ++pack) {
    const double* const data = pack_reference(block.first + pack * pack_size);
    block.tangents[pack] = Kernel::tangents(data, point, block.edge[pack]);
    const auto strain = Kernel::strain(data, block.tangents[pack], block.edge[pack]);
    for (int i = 0; i < 3; ++i) store(strain[i], batch.strain[i] + pack * pack_size);
  }
  batch.count = block.packs * pack_size;
  batch.history =
      history.data() + point * section_data_.law->history_size() * std::ptrdiff_t{padded_size_} + block.first;
  batch.history_stride = padded_size_;
  batch.increment = cycle.increment;
  section_data_.law->stress(batch);

  for (int pack = 0; pack < block.packs; ++pack) {
    const double* const data = pack_reference(block.first + pack * pack_size);
    const SurfaceTangents<Pack>& tangents = block.tangents[pack];
    const int slot = pack * pack_size;
    std::array<Pack, 3> stress{load(batch.stress[0] + slot), load(batch.stress[1] + slot), load(batch.stress[2] + slot)};
    const Pack mean = 0.5 * (stress[0] + stress[1]), deviation = 0.5 * (stress[0] - stress[1]);
    const Pack principal = mean + square_root(deviation * deviation + stress[2] * stress[2]);
    block.tension[pack] = maximum(block.tension[pack], principal);
    block.modulus[pack] = maximum(block.modulus[pack], 2.0 * load(batch.shear_modulus + slot));

    const auto viscous = viscous_stress(block, pack, point, metric(tangents), cycle, history);
    for (int i = 0; i < 3; ++i) stress[i] = stress[i] + viscous[i];
    Kernel::add_forces(data, point, tangents, stress, block.force[pack]);
    if constexpr (Layout::one_point_quadrilateral)
      Kernel::add_hourglass_forces(data, tangents, stress, block.edge[pack], block.force[pack]);
    const Pack volume = Kernel::volume(data, point);
    block.mean_tangents[pack].first = block.mean_tangents[pack].first + scaled(volume, tangents.first);
    block.mean_tangents[pack].second = block.mean_tangents[pack].second + scaled(volume, tangents.second);
  }
}

template <int corners, int points>
Pack MembraneGroup<corners, points>::stable_increment(const Block& block, int pack, const ExplicitCycle& cycle) const {
  using Kernel = MembraneKernel<Pack, corners, points>;
  const double* const data = pack_reference(block.first + pack * pack_size);
  Pack volume = Kernel::volume(data, 0);
  for (int q = 1; q < points; ++q) volume = volume + Kernel::volume(data, q);
  const Metric<Pack> integral = metric(block.mean_tangents[pack]);
  const Pack scale = 1.0 / (volume * volume);

  MembraneState<Pack> state;
  state.stretch = {scale * integral.c11, scale * integral.c22, scale * integral.c12};
  state.tension = block.tension[pack];
  const Pack modulus = block.modulus[pack];
  state.stiffness = {modulus, modulus, 0.5 * modulus, Pack(0.0), Pack(0.0), Pack(0.0)};
  if (section_data_.linear) {
    const auto& d = section_data_.initial_stiffness;
    state.stiffness = {Pack(d[0]), Pack(d[4]), Pack(d[8]), Pack(d[1]), Pack(d[2]), Pack(d[5])};
  }
  if constexpr (Layout::quadrilateral) state.hourglass = Kernel::hourglass_vector(data, block.edge[pack]);
  const Pack viscosity = cycle.linear_bulk_viscosity * reference_value<Pack>(data, Layout::viscosity);
  // Damping belongs to the undeformed moduli, the bound of the stiffness to the current ones.
  Pack beta = 0.0;
  if (damped()) {
    const Pack scale = load_unaligned(time_scale(block.first + pack * pack_size));
    beta = section_data_.damping_beta / scale * (section_data_.linear ? Pack(1.0) : section_data_.initial_modulus / modulus);
  }
  return MembraneStability<Pack, corners, points>::increment(data, state, {viscosity, beta});
}

/// Hands a block's forces to its nodes, books the dissipation and finds the governing element.
template <int corners, int points>
[[gnu::flatten]] void MembraneGroup<corners, points>::finish(const Block& block, const ExplicitCycle& cycle, std::span<double> history,
                                          StableIncrement& stable) const {
  double* const dissipation = history.data() + dissipation_row() * std::ptrdiff_t{padded_size_};
  for (int pack = 0; pack < block.packs; ++pack) {
    const std::int32_t element = block.first + pack * pack_size;
    const std::int32_t* const scatter = scatter_.data() + element * corners;
    Vector3<Pack> on_first;
    for (int i = 0; i < Layout::edges; ++i) {
      on_first = on_first - block.force[pack][i];
      scatter_subtract(block.force[pack][i], scatter + i + 1, corners, cycle.forces.force);
    }
    scatter_subtract(on_first, scatter, corners, cycle.forces.force);
    store_unaligned(load_unaligned(dissipation + element) + block.dissipated[pack], dissipation + element);

    merge(stable_increment(block, pack, cycle), element, stable);
  }
}

template <int corners, int points>
StableIncrement MembraneGroup<corners, points>::add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                                         std::span<double> history) const {
  StableIncrement stable;
  Block block;
  for (const auto& run : runs)
    for (block.first = run.first; block.first < run.last; block.first += block_capacity) {
      block.packs = std::min(block_capacity, run.last - block.first) / pack_size;
      begin(block, cycle);
      for (int point = 0; point < points; ++point) add_point(point, block, cycle, history);
      finish(block, cycle, history, stable);
    }
  return stable;
}

template <int corners, int points>
[[gnu::flatten]] void MembraneGroup<corners, points>::begin(Block& block, const ExplicitCycle& cycle) const {
  for (int pack = 0; pack < block.packs; ++pack) {
    const std::int32_t* const node = connectivity_.data() + (block.first + pack * pack_size) * corners;
    const Vector3<Pack> origin = gather(cycle.motion.position, node, corners);
    for (int i = 0; i < Layout::edges; ++i) {
      block.edge[pack][i] = gather(cycle.motion.position, node + i + 1, corners) - origin;
      block.force[pack][i] = {};
    }
    block.mean_tangents[pack] = {};
    block.modulus[pack] = block.tension[pack] = block.dissipated[pack] = 0.0;
  }
}

template <int corners, int points>
std::size_t MembraneGroup<corners, points>::bytes_per_element() const {
  return sizeof(double) * (Layout::size + corners) + 2 * corners * sizeof(std::int32_t);
}

template class MembraneGroup<3, 1>;
template class MembraneGroup<4, 1>;
template class MembraneGroup<4, 4>;

namespace {

template <int corners, int points>
std::unique_ptr<ElementGroup> make_membrane(const GroupInput& input) {
  return std::make_unique<MembraneGroup<corners, points>>(input);
}

const RegisterElement m3d4({.name = "M3D4",
                            .shape = Shape::quadrilateral,
                            .nodes = 4,
                            .integration_points = 4,
                            .section = Section::Kind::membrane,
                            .faces = {{0, 1, 2, 3}, {3, 2, 1, 0}},
                            .cycle_cost = 120,
                            .make_group = make_membrane<4, 4>});
const RegisterElement m3d4r({.name = "M3D4R",
                             .shape = Shape::quadrilateral,
                             .nodes = 4,
                             .integration_points = 1,
                             .section = Section::Kind::membrane,
                             .faces = {{0, 1, 2, 3}, {3, 2, 1, 0}},
                             .cycle_cost = 65,
                             .make_group = make_membrane<4, 1>});
const RegisterElement m3d3({.name = "M3D3",
                            .shape = Shape::triangle,
                            .nodes = 3,
                            .integration_points = 1,
                            .section = Section::Kind::membrane,
                            .faces = {{0, 1, 2}, {2, 1, 0}},
                            .cycle_cost = 40,
                            .make_group = make_membrane<3, 1>});

}  // namespace

}  // namespace balocco
