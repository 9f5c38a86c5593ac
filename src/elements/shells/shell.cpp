// Shells in the explicit loop, and their registration. Statics, energies: shell_static.cpp; output: shell_output.cpp.
#include "elements/shells/shell.hpp"

#include <algorithm>

#include "elements/bulk_viscosity.hpp"
#include "elements/element_type.hpp"
#include "elements/failure.hpp"
#include "elements/history_pack.hpp"
#include "elements/nodal_packs.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

constexpr int block_packs = 4;  // 32 elements: what they carry between the kernel and the laws stays in L1
constexpr int block_capacity = block_packs * pack_size;

}  // namespace

/// Elements on their way through the kernel.
template <int corners, int points>
struct ShellGroup<corners, points>::Block {
  std::int32_t first = 0;  // lane of the group
  int packs = 0;
  ShellKernel<Pack, corners> kernel[block_packs];
  ShellModes<Pack, corners> strain[block_packs], stress[block_packs];
  SurfaceStrain<Pack> here[block_packs], resultants[block_packs];  // of the point at hand
  Pack stiffening[block_packs];                                    // largest tangent modulus over that at rest
  Pack tension[block_packs], dissipated[block_packs];
  PointBatch<PointKind::plane> batch;
};

template <int corners, int points>
ShellGroup<corners, points>::ShellGroup(const GroupInput& input)
    : ElementGroup(input),
      section_(shell_section(input.model, input.model.sections[input.section])),
      record_(static_cast<std::size_t>(padded_size_) * Record::size),
      nodal_volume_(static_cast<std::size_t>(padded_size_) * corners),
      nodal_inertia_(nodal_volume_.size()),
      plate_inertia_(nodal_volume_.size()) {
  failed_rows_ = failure_rows(*this);
  const Section& section = input.model.sections[input.section];
  const ElementTable& elements = input.model.elements[table_];
  std::vector<double> stiffness(36 * corners * corners);
  for (std::int32_t element = 0; element < padded_size_; ++element) {
    const ShellGeometry geometry = shell_geometry(input.model, {table_, rows_[element]}, section);
    std::array<double, corners> thickness;
    const double own = elements.thickness.empty() ? 0.0 : elements.thickness[static_cast<std::size_t>(rows_[element])];
    thickness.fill(own > 0.0 ? own : section_.thickness);
    if (section_.nodal_thickness)
      for (int i = 0; i < corners; ++i)
        thickness[i] =
            input.model.nodes.thickness[elements.connectivity[static_cast<std::size_t>(rows_[element]) * corners + i]];
    double* const data = record(element);
    fill_shell_reference<corners, points>(geometry, section_, thickness, {section.hourglass, section.hourglass_scale},
                                          data);

    std::array<double, corners> mass;
    const std::span<double> inertia(nodal_inertia_.data() + element * corners, corners);
    for (int i = 0; i < corners; ++i) {
      const double volume = thickness[i] * geometry.nodal_area[i];
      nodal_volume_[element * corners + i] = volume;
      mass[i] = section_.density * volume;
      plate_inertia_[element * corners + i] = mass[i] * rotary_inertia_per_mass(section_, thickness[i]);
      inertia[i] = mass[i] * scaled_rotary_inertia_per_mass(section_, thickness[i], geometry.area);
    }
    stiffness_at_rest(element, geometry, stiffness);
    set_shell_stability<corners, points>(geometry, section_, stiffness, mass, inertia, data);
  }
}

/// A section whose laws are linear is integrated through the thickness once and for all.
template <int corners, int points>
[[gnu::flatten]] void ShellGroup<corners, points>::add_linear_point(int point, Block& block) const {
  const auto& [a, b, d] = section_.stiffness;
  for (int pack = 0; pack < block.packs; ++pack) {
    const double* const data = record(block.first + pack * pack_size);
    const Pack h = reference_value<Pack>(data, Record::point + point * Record::point_size + 1);
    const auto& e = block.here[pack].membrane;
    const std::array<Pack, 3> k{h * block.here[pack].curvature[0], h * block.here[pack].curvature[1],
                                h * block.here[pack].curvature[2]};
    for (int i = 0; i < 3; ++i) {
      block.resultants[pack].membrane[i] = h * (a[3 * i] * e[0] + a[3 * i + 1] * e[1] + a[3 * i + 2] * e[2] +
                                                b[3 * i] * k[0] + b[3 * i + 1] * k[1] + b[3 * i + 2] * k[2]);
      block.resultants[pack].curvature[i] = h * h *
                                            (b[3 * i] * e[0] + b[3 * i + 1] * e[1] + b[3 * i + 2] * e[2] +
                                             d[3 * i] * k[0] + d[3 * i + 1] * k[1] + d[3 * i + 2] * k[2]);
    }
    const auto& n = block.resultants[pack];
    const Pack greatest =
        maximum(maximum(n.membrane[0], n.membrane[1]), Pack(0.0)) / h +
        6.0 * maximum(maximum(n.curvature[0], -n.curvature[0]), maximum(n.curvature[1], -n.curvature[1])) / (h * h);
    block.tension[pack] = maximum(block.tension[pack], greatest);
  }
}

/// The layers of a point of the surface, a batch of elements for each.
template <int corners, int points>
[[gnu::flatten]] void ShellGroup<corners, points>::add_layers(int point, Block& block, double increment,
                                             std::span<double> history) const {
  auto& batch = block.batch;
  batch.count = block.packs * pack_size;
  batch.history_stride = padded_size_;
  batch.increment = increment;
  for (int pack = 0; pack < block.packs; ++pack) block.resultants[pack] = {};
  for (const ShellLayer& layer : section_.layers) {
    const ShellPly& ply = section_.plies[layer.ply];
    for (int pack = 0; pack < block.packs; ++pack) {
      const Pack h =
          reference_value<Pack>(record(block.first + pack * pack_size), Record::point + point * Record::point_size + 1);
      const auto strain =
          layer_strain<Pack>(ply, layer.height * h, block.here[pack].membrane, block.here[pack].curvature);
      for (int i = 0; i < 3; ++i) store(strain[i], batch.strain[i] + pack * pack_size);
    }
    batch.history =
        history.data() + (point * section_.history_size + layer.history) * std::ptrdiff_t{padded_size_} + block.first;
    ply.law->stress(batch);
    const double softness = 2.0 / ply.initial_modulus;
    for (int pack = 0; pack < block.packs; ++pack) {
      const Pack h =
          reference_value<Pack>(record(block.first + pack * pack_size), Record::point + point * Record::point_size + 1);
      const int slot = pack * pack_size;
      const std::array<Pack, 3> own{load(batch.stress[0] + slot), load(batch.stress[1] + slot),
                                    load(batch.stress[2] + slot)};
      const auto stress = stress_in_section(ply, own);
      const Pack weight = layer.weight * h, moment = weight * (layer.height * h);
      for (int i = 0; i < 3; ++i) {
        block.resultants[pack].membrane[i] = block.resultants[pack].membrane[i] + weight * stress[i];
        block.resultants[pack].curvature[i] = block.resultants[pack].curvature[i] + moment * stress[i];
      }
      const Pack mean = 0.5 * (own[0] + own[1]), deviation = 0.5 * (own[0] - own[1]);
      block.tension[pack] = maximum(block.tension[pack], mean + square_root(deviation * deviation + own[2] * own[2]));
      block.stiffening[pack] = maximum(block.stiffening[pack], softness * load(batch.shear_modulus + slot));
    }
  }
}

/// Linear bulk viscosity of the surface and stiffness-proportional damping, of the mean strains; updates the history of
/// their rates. The rate of dilatation is that of ln(area), by the mean-value quotient 2 (J - J0) / (J + J0).
template <int corners, int points>
void ShellGroup<corners, points>::add_viscosity(Block& block, int pack, const ExplicitCycle& cycle,
                                                std::span<double> history) const {
  const std::int32_t element = block.first + pack * pack_size;
  const double* const data = record(element);
  const auto row = [&](int component) { return history.data() + component * std::ptrdiff_t{padded_size_} + element; };
  const double inverse_increment = cycle.increment > 0.0 ? 1.0 / cycle.increment : 0.0;
  const auto& kernel = block.kernel[pack];
  const Pack c11 = dot(kernel.tangent1(), kernel.tangent1()), c22 = dot(kernel.tangent2(), kernel.tangent2()),
             c12 = dot(kernel.tangent1(), kernel.tangent2());
  const Pack square = c11 * c22 - c12 * c12, ratio = square_root(square);
  const Pack old_ratio = load_unaligned(row(area_ratio_row()));
  store_unaligned(ratio, row(area_ratio_row()));
  Pack area = reference_value<Pack>(data, Record::point);
  for (int q = 1; q < points; ++q) area = area + reference_value<Pack>(data, Record::point + q * Record::point_size);

  const Pack rate = 2.0 * inverse_increment * (ratio - old_ratio) / (ratio + old_ratio);
  const Pack pressure = cycle.linear_bulk_viscosity * reference_value<Pack>(data, Record::viscosity) *
                        (load_unaligned(time_scale(element)) * rate);
  const Pack contravariant = area * pressure / square;  // Cauchy stress pressure * 1 pulled back: pressure * C^-1
  auto& stress = block.stress[pack];
  stress.membrane[0] = stress.membrane[0] + contravariant * c22;
  stress.membrane[1] = stress.membrane[1] + contravariant * c11;
  stress.membrane[2] = stress.membrane[2] - contravariant * c12;
  Pack work = area * viscous_work(load_unaligned(row(viscous_row())), pressure, cycle.increment * rate);
  store_unaligned(pressure, row(viscous_row()));

  if (damped()) {
    const Pack h = reference_value<Pack>(data, Record::point + 1);
    std::array<Pack, 6> rates;
    for (int i = 0; i < 6; ++i) {
      const Pack strain = i < 3 ? block.strain[pack].membrane[i] : block.strain[pack].curvature[i - 3];
      rates[i] = inverse_increment * (strain - load_unaligned(row(strain_row() + i)));
      if (i >= 3) rates[i] = h * rates[i];
      store_unaligned(strain, row(strain_row() + i));
    }
    const auto& [a, b, d] = section_.damping;
    Pack power = 0.0;
    for (int i = 0; i < 3; ++i) {
      Pack n(0.0), m(0.0);
      for (int j = 0; j < 3; ++j) {
        n = n + a[3 * i + j] * rates[j] + b[3 * i + j] * rates[3 + j];
        m = m + b[3 * i + j] * rates[j] + d[3 * i + j] * rates[3 + j];
      }
      stress.membrane[i] = stress.membrane[i] + area * h * n;
      stress.curvature[i] = stress.curvature[i] + area * h * h * m;
      power = power + area * h * (n * rates[i] + m * rates[3 + i]);
    }
    work = work + cycle.increment * power;
  }
  block.dissipated[pack] = work;
}

/// 2 / omega (sqrt(1 + xi^2) - xi) with the largest frequency at rest, exact, grown by what has changed since: all
/// strains are products of vectors that stretch at most as much as the surface does, and initial stress adds its own
/// stiffness.
template <int corners, int points>
Pack ShellGroup<corners, points>::stable_increment(const Block& block, int pack, const ExplicitCycle& cycle) const {
  const double* const data = record(block.first + pack * pack_size);
  const auto& kernel = block.kernel[pack];
  const Pack c11 = dot(kernel.tangent1(), kernel.tangent1()), c22 = dot(kernel.tangent2(), kernel.tangent2()),
             c12 = dot(kernel.tangent1(), kernel.tangent2());
  const Pack half = 0.5 * (c11 + c22), difference = 0.5 * (c11 - c22);
  const Pack stretch = maximum(half + square_root(difference * difference + c12 * c12), Pack(1.0));
  const Pack eigenvalue = reference_value<Pack>(data, Record::eigenvalue);
  const Pack stiffness = stretch * (block.stiffening[pack] * eigenvalue) +
                         block.tension[pack] * reference_value<Pack>(data, Record::tension);
  const Pack least = maximum(c11 * c22 - c12 * c12, Pack(1e-300));
  Pack viscous = cycle.linear_bulk_viscosity * reference_value<Pack>(data, Record::viscosity) *
                 reference_value<Pack>(data, Record::dilatation) * (2.0 * half / least);
  if (damped())
    viscous += section_.damping_beta / load_unaligned(time_scale(block.first + pack * pack_size)) * (stretch * eigenvalue);
  const Pack omega = square_root(stiffness), damping = 0.5 * viscous / omega;
  return 2.0 * (square_root(1.0 + damping * damping) - damping) / omega;
}

/// Energy of transverse shear, drill and hourglass of elements that have failed in this cycle, which nothing gives back: it counts
/// as dissipated with them. That of the layers is in their laws' books.
template <int corners, int points>
Pack ShellGroup<corners, points>::given_up(const Block& block, int pack, std::span<const double> history) const {
  if (failed_rows_.empty()) return 0.0;
  PackMask gone(true);
  for (const int row : failed_rows_)
    gone = gone && load_unaligned(history.data() + row * std::ptrdiff_t{padded_size_} + block.first + pack * pack_size) > 0.0;
  if (!any(gone)) return 0.0;
  const auto &strain = block.strain[pack], &stress = block.stress[pack];
  Pack energy = 0.0;
  for (int i = 0; i < corners; ++i)
    energy = energy + 0.5 * (stress.shear[i] * strain.shear[i] + stress.drill[i] * strain.drill[i]);
  for (int a = 0; a < Record::Layout::modes; ++a)
    energy = energy + 0.5 * (stress.membrane_mode[a] * strain.membrane_mode[a] + stress.bending_mode[a] * strain.bending_mode[a]);
  return select(gone, energy, Pack(0.0));
}

/// Hands a block's forces to its nodes, books the dissipation and finds the governing element.
template <int corners, int points>
[[gnu::flatten]] void ShellGroup<corners, points>::finish(Block& block, const ExplicitCycle& cycle, std::span<double> history,
                                         StableIncrement& stable) const {
  double* const dissipation = history.data() + dissipation_row() * std::ptrdiff_t{padded_size_};
  for (int pack = 0; pack < block.packs; ++pack) {
    const std::int32_t element = block.first + pack * pack_size;
    const std::int32_t* const scatter = scatter_.data() + element * corners;
    add_viscosity(block, pack, cycle, history);
    ShellForces<Pack, corners> nodal;
    block.kernel[pack].add_forces(block.stress[pack], nodal);
    Vector3<Pack> on_first;
    for (int i = 1; i < corners; ++i) {
      on_first = on_first - nodal.force[i - 1];
      scatter_subtract(nodal.force[i - 1], scatter + i, corners, cycle.forces.force);
    }
    scatter_subtract(on_first, scatter, corners, cycle.forces.force);
    for (int i = 0; i < corners; ++i) scatter_subtract(nodal.moment[i], scatter + i, corners, cycle.forces.moment);
    store_unaligned(load_unaligned(dissipation + element) + block.dissipated[pack] + given_up(block, pack, history), dissipation + element);

    merge(stable_increment(block, pack, cycle), element, stable);
  }
}

template <int corners, int points>
StableIncrement ShellGroup<corners, points>::add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                                        std::span<double> history) const {
  StableIncrement stable;
  Block block;
  for (const auto& run : runs)
    for (block.first = run.first; block.first < run.last; block.first += block_capacity) {
      block.packs = std::min(block_capacity, run.last - block.first) / pack_size;
      for (int pack = 0; pack < block.packs; ++pack) begin(pack, block, cycle);
      for (int point = 0; point < points; ++point) {
        for (int pack = 0; pack < block.packs; ++pack)
          block.here[pack] = strain_at<Pack>(record(block.first + pack * pack_size), point, block.strain[pack]);
        section_.linear ? add_linear_point(point, block) : add_layers(point, block, cycle.increment, history);
        for (int pack = 0; pack < block.packs; ++pack)
          add_resultants<Pack>(record(block.first + pack * pack_size), point, block.resultants[pack],
                               block.stress[pack]);
      }
      finish(block, cycle, history, stable);
    }
  return stable;
}

template <int corners, int points>
[[gnu::flatten]] void ShellGroup<corners, points>::begin(int pack, Block& block, const ExplicitCycle& cycle) const {
  const std::int32_t* const node = connectivity_.data() + (block.first + pack * pack_size) * corners;
  const double* const data = record(block.first + pack * pack_size);
  const Vector3<Pack> origin = gather(cycle.motion.position, node, corners);
  typename ShellKernel<Pack, corners>::Edges edge;
  Rotations<Pack> rotation;
  for (int i = 0; i < corners; ++i) {
    if (i > 0) edge[i - 1] = gather(cycle.motion.position, node + i, corners) - origin;
    rotation[i] = rotation_matrix<Pack>(gather_four(cycle.motion.orientation, node + i, corners));
  }
  block.kernel[pack].set(data, edge, rotation);
  block.strain[pack] = block.kernel[pack].strains();
  block.stress[pack] = {};
  block.kernel[pack].add_elastic(block.strain[pack], block.stress[pack]);
  add_hourglass<Pack>(data, block.strain[pack], block.stress[pack]);
  block.stiffening[pack] = 1.0;
  block.tension[pack] = 0.0;
}

template <int corners, int points>
void ShellGroup<corners, points>::lumped_volume(std::int32_t element, std::span<double> volume) const {
  std::copy_n(nodal_volume_.begin() + element * corners, corners, volume.begin());
}

template <int corners, int points>
void ShellGroup<corners, points>::lumped_rotary_inertia(std::int32_t element, std::span<double> inertia) const {
  std::copy_n(nodal_inertia_.begin() + element * corners, corners, inertia.begin());
}

template <int corners, int points>
void ShellGroup<corners, points>::material_rotary_inertia(std::int32_t element, std::span<double> tensors) const {
  const double* const director = record(element) + Record::director * pack_size;
  for (int i = 0; i < corners; ++i)
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) {
        const double along = director[(3 * i + row) * pack_size] * director[(3 * i + column) * pack_size];
        tensors[9 * i + 3 * row + column] = plate_inertia_[element * corners + i] * ((row == column ? 1.0 : 0.0) - along);
      }
}

template <int corners, int points>
std::size_t ShellGroup<corners, points>::bytes_per_element() const {
  return sizeof(double) * (Record::size + 3 * corners) + 2 * corners * sizeof(std::int32_t);
}

template class ShellGroup<3, 1>;
template class ShellGroup<4, 1>;
template class ShellGroup<4, 4>;

namespace {

template <int corners, int points>
std::unique_ptr<ElementGroup> make_shell(const GroupInput& input) {
  return std::make_unique<ShellGroup<corners, points>>(input);
}

ElementType quadrilateral(const char* name, int points, double cost,
                          std::unique_ptr<ElementGroup> (*make)(const GroupInput&)) {
  return {.name = name,
          .shape = Shape::quadrilateral,
          .nodes = 4,
          .integration_points = points,
          .turns = true,
          .section = Section::Kind::shell,
          .faces = {{0, 1, 2, 3}, {3, 2, 1, 0}},
          .cycle_cost = cost,
          .make_group = make};
}

ElementType triangle(const char* name) {
  return {.name = name,
          .shape = Shape::triangle,
          .nodes = 3,
          .integration_points = 1,
          .turns = true,
          .section = Section::Kind::shell,
          .faces = {{0, 1, 2}, {2, 1, 0}},
          .cycle_cost = 90,
          .make_group = make_shell<3, 1>};
}

const RegisterElement s4(quadrilateral("S4", 4, 300, make_shell<4, 4>));
const RegisterElement s4r(quadrilateral("S4R", 1, 175, make_shell<4, 1>));
const RegisterElement s3r(triangle("S3R"));
const RegisterElement s3(triangle("S3"));

}  // namespace

}  // namespace balocco
