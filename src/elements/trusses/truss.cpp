#include "elements/trusses/truss.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/bulk_viscosity.hpp"
#include "elements/element_type.hpp"
#include "elements/history_pack.hpp"
#include "elements/nodal_packs.hpp"
#include "elements/trusses/truss_kernel.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

constexpr int block_capacity = PointBatch<PointKind::line>::capacity;

std::unique_ptr<Law<PointKind::line>> line_law(const Model& model, const Section& section) {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: error: *SOLID SECTION: {}", model.where(section.location), what));
  };
  if (section.material < 0) fail("it names no material; add MATERIAL=NAME");
  if (!(section.area > 0.0)) fail(fmt::format("the area of a truss is {}; it must be positive", section.area));
  const Material& material = model.materials[section.material];
  auto law = law_of_section<PointKind::line>(material, section);
  if (law == nullptr)
    fail(fmt::format("material {} has no uniaxial law for trusses; give it *ELASTIC or *HYPERELASTIC", material.name));
  return law;
}

double truss_length(const Model& model, ElementRef element) {
  const ElementTable& table = model.elements[element.table];
  const Point& a = model.nodes.coordinates[table.connectivity[2 * static_cast<std::size_t>(element.row)]];
  const Point& b = model.nodes.coordinates[table.connectivity[2 * static_cast<std::size_t>(element.row) + 1]];
  const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  if (!(length > 0.0))
    throw InputError(fmt::format("{}: error: *ELEMENT: truss {} has no length; correct its nodes",
                                 model.where(table.location[element.row]), table.id[element.row]));
  return length;
}

}  // namespace

TrussGroup::TrussGroup(const GroupInput& input)
    : ElementGroup(input),
      law_(line_law(input.model, input.model.sections[input.section])),
      area_(input.model.sections[input.section].area),
      length_(static_cast<std::size_t>(padded_size_)) {
  const Material& material = input.model.materials[input.model.sections[input.section].material];
  density_ = material.density;
  damping_beta_ = material.damping_beta;
  for (std::int32_t element = 0; element < padded_size_; ++element)
    length_[element] = truss_length(input.model, {table_, rows_[element]});
  set_undeformed_moduli();
}

void TrussGroup::set_undeformed_moduli() {
  std::vector<double> history(static_cast<std::size_t>(law_->history_size()) * pack_size, 0.0);
  const std::array<double, 1> undeformed{};
  std::array<double, 1> stress, tangent;
  law_->tangent(undeformed, 0.0, std::span(history).first(law_->history_size()), stress, tangent);
  initial_modulus_ = tangent[0];
  Batch batch;
  batch.count = pack_size;
  std::fill_n(batch.strain[0], pack_size, 0.0);
  std::fill(history.begin(), history.end(), 0.0);
  batch.history = history.data();
  batch.history_stride = pack_size;
  law_->stress(batch);
  initial_bound_ = 2.0 * batch.shear_modulus[0];
}

int TrussGroup::history_size() const { return strain_row() + (damped() ? 1 : 0); }

void TrussGroup::initialize_history(std::span<double> history) const {
  std::fill(history.begin(), history.end(), 0.0);
  history[stretch_row()] = 1.0;
}

void TrussGroup::lumped_volume(std::int32_t element, std::span<double> volume) const {
  volume[0] = volume[1] = 0.5 * area_ * reference_length(element);
}

struct TrussGroup::Pulled {
  Pack stress, increment;
};

/// Adds the viscous stresses of a pack, books their dissipation and finds the stable increment: with lumped masses m = rho A L / 2,
/// omega^2 = (dS/dE l^2 / L^2 + S) A / L * 2 / m. Linear bulk viscosity is b1 rho c L times the rate of ln(l).
TrussGroup::Pulled TrussGroup::pull(const Batch& batch, std::int32_t first, int slot, const ExplicitCycle& cycle,
                                    std::span<double> history) const {
  const auto row = [&](int component) { return history.data() + component * std::ptrdiff_t{padded_size_} + first + slot; };
  const double inverse_increment = cycle.increment > 0.0 ? 1.0 / cycle.increment : 0.0;
  const Pack length = load(length_.data() + first + slot);
  const Pack strain = load(batch.strain[0] + slot), stress = load(batch.stress[0] + slot);
  const Pack square = 1.0 + 2.0 * strain, stretch = square_root(square);
  const Pack old_stretch = load_unaligned(row(stretch_row()));
  store_unaligned(stretch, row(stretch_row()));

  const Pack rate = 2.0 * inverse_increment * (stretch - old_stretch) / (stretch + old_stretch);
  const Pack time_scale = load_unaligned(this->time_scale(first + slot));
  const Pack viscosity = cycle.linear_bulk_viscosity * std::sqrt(density_ * initial_modulus_) * length;
  Pack viscous = viscosity * (time_scale * rate) / square;
  if (damped()) {
    const Pack strain_rate = inverse_increment * (strain - load_unaligned(row(strain_row())));
    store_unaligned(strain, row(strain_row()));
    viscous = viscous + damping_beta_ * initial_modulus_ * strain_rate;
  }
  const Pack strain_change = 0.5 * ((stretch - old_stretch) * (stretch + old_stretch));
  const Pack work = viscous_work(load_unaligned(row(viscous_row())), viscous, strain_change);
  store_unaligned(load_unaligned(row(dissipation_row())) + area_ * (length * work), row(dissipation_row()));
  store_unaligned(viscous, row(viscous_row()));

  const Pack modulus = 2.0 * load(batch.shear_modulus + slot);
  const Pack inverse_mass = 4.0 / (density_ * length * length);  // A / L * (1 / m + 1 / m)
  const Pack omega = square_root((modulus * square + maximum(stress, Pack(0.0))) * inverse_mass);
  Pack damping = viscosity / square;
  if (damped()) damping += damping_beta_ * initial_bound_ / time_scale * square;
  damping *= inverse_mass;
  const Pack ratio = 0.5 * damping / omega;
  return {stress + viscous, 2.0 * (square_root(1.0 + ratio * ratio) - ratio) / omega};
}

StableIncrement TrussGroup::add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                       std::span<double> history) const {
  StableIncrement stable;
  for (const auto& run : runs)
    for (std::int32_t first = run.first; first < run.last; first += block_capacity)
      add_block({first, std::min(first + block_capacity, run.last)}, cycle, history, stable);
  return stable;
}

[[gnu::flatten]] void TrussGroup::add_block(const PackRun& block, const ExplicitCycle& cycle, std::span<double> history,
                           StableIncrement& stable) const {
  const std::int32_t first = block.first;
  Batch batch;
  batch.count = block.last - first;
  Vector3<Pack> axis[block_capacity / pack_size];
  for (int slot = 0; slot < batch.count; slot += pack_size) {
    const std::int32_t* const node = connectivity_.data() + 2 * (first + slot);
    const Pack length = load(length_.data() + first + slot);
    axis[slot / pack_size] = gather(cycle.motion.position, node + 1, 2) - gather(cycle.motion.position, node, 2);
    store(truss_strain(axis[slot / pack_size], Pack(1.0 / (length * length))), batch.strain[0] + slot);
  }
  batch.history = history.data() + first;
  batch.history_stride = padded_size_;
  batch.increment = cycle.increment;
  law_->stress(batch);
  for (int slot = 0; slot < batch.count; slot += pack_size) {
    const Pulled pulled = pull(batch, first, slot, cycle, history);
    const Pack length = load(length_.data() + first + slot);
    const Vector3<Pack> force = truss_force(axis[slot / pack_size], pulled.stress, Pack(area_ / length));
    scatter_subtract(Vector3<Pack>() - force, scatter_.data() + 2 * (first + slot), 2, cycle.forces.force);
    scatter_subtract(force, scatter_.data() + 2 * (first + slot) + 1, 2, cycle.forces.force);
    merge(pulled.increment, first + slot, stable);
  }
}

std::size_t TrussGroup::bytes_per_element() const { return sizeof(double) + 4 * sizeof(std::int32_t); }

namespace {

const RegisterElement t3d2({.name = "T3D2",
                            .shape = Shape::line,
                            .nodes = 2,
                            .integration_points = 1,
                            .section = Section::Kind::truss,
                            .faces = {},
                            .cycle_cost = 7,
                            .make_group = [](const GroupInput& input) -> std::unique_ptr<ElementGroup> {
                              return std::make_unique<TrussGroup>(input);
                            }});

}  // namespace

}  // namespace balocco
