#include "elements/springs/spring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/nodal_directions.hpp"
#include "elements/element_type.hpp"
#include "math/exact_sum.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

enum HistoryRow { elongation_row, force_row, dissipation_row };

Vector3<double> vector(const Point& point) { return {point}; }

Vector3<double> entry(const double* nodal, std::int32_t node) {
  const double* x = nodal + 4 * std::ptrdiff_t{node};
  return {{x[0], x[1], x[2]}};
}

void subtract(const Vector3<double>& vector, std::int32_t node, double* force) {
  double* sum = force + 4 * std::ptrdiff_t{node};
  for (int i = 0; i < 3; ++i) sum[i] -= rounded(vector[i], sum[3]);
}

}  // namespace

SpringGroup::SpringGroup(const GroupInput& input)
    : ElementGroup(input),
      curve_(input.model.sections[section_].spring.slope, input.model.sections[section_].spring.table),
      viscous_(input.model.sections[section_].kind == Section::Kind::dashpot),
      axial_(input.model.sections[section_].spring.freedom[0] < 0) {
  if (input.model.sections[section_].spring.freedom[0] >= 3) freedoms_per_node_ = 6;
  axial_ ? find_axial_lengths(input) : find_directions(input);
}

void SpringGroup::find_axial_lengths(const GroupInput& input) {
  const ElementTable& table = input.model.elements[table_];
  for (std::int32_t element = 0; element < size_; ++element) {
    const auto* node = &table.connectivity[2 * static_cast<std::size_t>(rows_[element])];
    const auto axis = vector(input.model.nodes.coordinates[node[1]]) - vector(input.model.nodes.coordinates[node[0]]);
    origin_.push_back(std::sqrt(dot(axis, axis)));
    if (origin_.back() > 0.0) continue;
    throw InputError(fmt::format("{}: error: *ELEMENT: element {} has no length; its nodes must not coincide",
                                 input.model.where(table.location[rows_[element]]), table.id[rows_[element]]));
  }
}

void SpringGroup::find_directions(const GroupInput& input) {
  const Model& model = input.model;
  const Section& section = model.sections[section_];
  const ElementTable& table = model.elements[table_];
  const NodalDirections nodal(model);
  for (std::int32_t element = 0; element < size_; ++element) {
    std::array<Vector3<double>, 2> direction{};
    double origin = 0.0;
    for (int end = 0; end < nodes_per_element_; ++end) {
      const auto node = table.connectivity[static_cast<std::size_t>(rows_[element]) * nodes_per_element_ + end];
      const Point& at = model.nodes.coordinates[node];
      const int axis = section.spring.freedom[end] % 3;
      auto unit = vector(nodal.direction(node, axis));
      if (section.orientation >= 0) {
        const auto axes = local_axes(model.orientations[section.orientation], at);
        unit = {{axes(axis, 0), axes(axis, 1), axes(axis, 2)}};
      }
      direction[end] = (end == 0 ? 1.0 : -1.0) * unit;
      if (!turns()) origin += dot(direction[end], vector(at));
    }
    direction_.push_back(direction);
    origin_.push_back(origin);
  }
}

bool SpringGroup::acts_along(std::int32_t element, int end, const std::array<double, 3>& direction) const {
  constexpr double rounding = 1e-12;  // of unit vectors
  return axial_ || std::abs(dot(direction_[element][end], vector(direction))) > rounding;
}

void SpringGroup::initialize_history(std::span<double> history) const { std::ranges::fill(history, 0.0); }

void SpringGroup::lumped_volume(std::int32_t, std::span<double> volume) const { std::ranges::fill(volume, 0.0); }

SpringGroup::Elongation SpringGroup::elongation(std::int32_t element, const NodalMotion& motion) const {
  const auto node = nodes(element);
  if (axial_) {
    const auto axis = entry(motion.position, node[1]) - entry(motion.position, node[0]);
    const double length = std::sqrt(dot(axis, axis));
    const auto unit = (1.0 / length) * axis;
    return {length - origin_[element], {-1.0 * unit, unit}, 1.0 / length};
  }
  Elongation result{-origin_[element], direction_[element], 0.0};
  for (int end = 0; end < nodes_per_element_; ++end) result.value += dot(result.gradient[end], entry(turns() ? motion.rotation : motion.position, node[end]));
  return result;
}

SpringGroup::Pull SpringGroup::pull(std::int32_t element, const Elongation& now, const NodalMotion& motion, double old_elongation) const {
  if (!viscous_ || motion.velocity_slope <= 0.0) return pull(now.value, old_elongation, motion.increment);
  double rate = 0.0;
  for (int end = 0; end < nodes_per_element_; ++end)
    rate += dot(now.gradient[end], entry(turns() ? motion.angular_velocity : motion.velocity, nodes(element)[end]));
  const auto [force, slope] = curve_.at(rate);
  return {force, slope * motion.velocity_slope};
}

SpringGroup::Pull SpringGroup::pull(double elongation, double old_elongation, double increment) const {
  if (!viscous_) {
    const auto [force, slope] = curve_.at(elongation);
    return {force, slope};
  }
  if (increment <= 0.0) return {};
  const auto [force, slope] = curve_.at((elongation - old_elongation) / increment);
  return {force, slope / increment};
}

StableIncrement SpringGroup::add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                                        std::span<double> history) const {
  for (const auto& run : runs)
    for (std::int32_t element = run.first; element < std::min(run.last, size_); ++element)
      if (acts(element)) add_force(element, cycle, history);
  return {};  // no mass, no frequency: see restraint
}

void SpringGroup::add_force(std::int32_t element, const ExplicitCycle& cycle, std::span<double> history) const {
  const auto row = [&](int component) -> double& { return history[component * std::size_t(padded_size_) + element]; };
  const Elongation now = elongation(element, cycle.motion);
  const double force = pull(now.value, row(elongation_row), cycle.increment).force;
  if (viscous_) row(dissipation_row) += 0.5 * (row(force_row) + force) * (now.value - row(elongation_row));
  row(elongation_row) = now.value;
  row(force_row) = force;
  double* const sums = turns() ? cycle.forces.moment : cycle.forces.force;
  for (int n = 0; n < nodes_per_element_; ++n) subtract(force * now.gradient[n], nodes(element)[n], sums);
}

bool SpringGroup::linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                            std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const {
  const Elongation now = elongation(element, motion);
  const Pull pulled = pull(element, now, motion, old_history[elongation_row]);
  if (axial_ && !(now.value + origin_[element] > 0.0)) return false;
  new_history[elongation_row] = now.value;
  new_history[force_row] = pulled.force;
  new_history[dissipation_row] = old_history[dissipation_row];
  if (viscous_)
    new_history[dissipation_row] +=
        0.5 * (old_history[force_row] + pulled.force) * (now.value - old_history[elongation_row]);
  std::ranges::fill(force, 0.0);
  std::ranges::fill(stiffness, 0.0);
  const int size = freedoms_per_node_ * nodes_per_element_;
  const auto place = [&](int i) { return freedoms_per_node_ * (i / 3) + first_freedom() + i % 3; };
  for (int i = 0; i < 3 * nodes_per_element_; ++i) {
    force[place(i)] = pulled.force * now.gradient[i / 3][i % 3];
    if (stiffness.empty()) continue;
    for (int j = 0; j < 3 * nodes_per_element_; ++j) {
      const double product = now.gradient[i / 3][i % 3] * now.gradient[j / 3][j % 3];
      const double sign = i / 3 == j / 3 ? 1.0 : -1.0;
      const double turning = now.curvature * ((i % 3 == j % 3 ? sign : 0.0) - product);
      stiffness[size * place(i) + place(j)] = pulled.slope * product + pulled.force * turning;
    }
  }
  return true;
}

ElementEnergies SpringGroup::energies(std::int32_t, const NodalMotion&, std::span<const double> history) const {
  ElementEnergies result;
  if (!viscous_) result.strain = curve_.integral(history[elongation_row]);
  result.viscous = history[dissipation_row];
  return result;
}

Restraint SpringGroup::bound(std::int32_t element) const {
  Restraint bound{.force = curve_.largest_force()};
  if (viscous_) {
    bound.viscosity = curve_.steepest();
  } else {
    bound.stiffness = std::max(curve_.steepest(), axial_ ? curve_.tautness(origin_[element]) : 0.0);
  }
  return bound;
}

int SpringGroup::point_components(std::string_view variable) const { return variable == "S" || variable == "E" ? 6 : 0; }

void SpringGroup::point_output(std::string_view variable, std::int32_t, int, const NodalMotion&,
                               std::span<const double> history, std::span<double> values) const {
  std::ranges::fill(values, 0.0);
  values[0] = history[variable == "S" ? force_row : elongation_row];
}

std::size_t SpringGroup::bytes_per_element() const {
  return sizeof(double) + (axial_ ? 0 : sizeof direction_[0]) + 2 * nodes_per_element_ * sizeof(std::int32_t);
}

namespace {

ElementType spring_type(const char* name, int nodes, Section::Kind section) {
  ElementType type{.name = name,
                   .shape = nodes == 1 ? Shape::point : Shape::line,
                   .nodes = nodes,
                   .section = section,
                   .faces = {},
                   .cycle_cost = 10,
                   .make_group = [](const GroupInput& input) -> std::unique_ptr<ElementGroup> {
                     return std::make_unique<SpringGroup>(input);
                   }};
  return type;
}

const RegisterElement springs[]{RegisterElement(spring_type("SPRINGA", 2, Section::Kind::spring)),
                                RegisterElement(spring_type("SPRING1", 1, Section::Kind::spring)),
                                RegisterElement(spring_type("SPRING2", 2, Section::Kind::spring)),
                                RegisterElement(spring_type("DASHPOTA", 2, Section::Kind::dashpot)),
                                RegisterElement(spring_type("DASHPOT1", 1, Section::Kind::dashpot)),
                                RegisterElement(spring_type("DASHPOT2", 2, Section::Kind::dashpot))};

}  // namespace

}  // namespace balocco
