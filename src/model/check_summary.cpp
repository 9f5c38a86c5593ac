// The summary of `balocco check`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "elements/element_type.hpp"
#include "math/exact_sum.hpp"
#include "model/check.hpp"
#include "model/rigid_constraints.hpp"

namespace balocco {

namespace {

/// Mass, first moment and second moment (integral of x x^T dm, row-major) of a part of the model.
struct MassProperties {
  double mass = 0.0;
  Point moment{};
  std::array<double, 9> second{};

  void add(double m, const Point& x) {
    mass += m;
    for (int i = 0; i < 3; ++i) {
      moment[i] += m * x[i];
      for (int j = 0; j < 3; ++j) second[3 * i + j] += m * x[i] * x[j];
    }
  }
  Point center() const { return mass > 0.0 ? Point{moment[0] / mass, moment[1] / mass, moment[2] / mass} : Point{}; }
  /// I11 I22 I33 I12 I13 I23 about the centre of mass.
  std::array<double, 6> inertia() const {
    const Point c = center();
    const auto central = [&](int i, int j) { return second[3 * i + j] - mass * c[i] * c[j]; };
    const double xx = central(0, 0), yy = central(1, 1), zz = central(2, 2);
    return {yy + zz, xx + zz, xx + yy, -central(0, 1), -central(0, 2), -central(1, 2)};
  }
};

/// The elements of one table with one section.
struct Part {
  std::int32_t table, section;
  std::vector<std::int32_t> rows;
};

std::vector<Part> parts_of(const Model& model) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> rows;
  for (std::size_t t = 0; t < model.elements.size(); ++t) {
    const auto& table = model.elements[t];
    for (std::int32_t row = 0; row < table.size(); ++row) {
      if (table.section[row] >= 0) rows[{static_cast<std::int32_t>(t), table.section[row]}].push_back(row);
    }
  }
  std::vector<Part> parts;
  for (auto& [key, list] : rows) parts.push_back({key.first, key.second, std::move(list)});
  return parts;
}

constexpr double usual_part = 0.9;  // of the limit: what an explicit step takes of it

class Summary {
 public:
  Summary(const Model& model, int ranks) : model_(model), ranks_(ranks), body_of_(lasting_bodies(model)) {}

  std::string text() {
    counts();
    for (const auto& part : parts_of(model_)) add_part(part);
    add_rotary_inertia();
    mass_lines();
    box();
    time_lines();
    memory_line();
    warnings();
    return std::move(text_);
  }

 private:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    text_ += fmt::format(format, std::forward<Arguments>(arguments)...) + "\n";
  }

  void counts();
  void add_part(const Part& part);
  void add_point_masses(const Part& part, MassProperties& properties);
  void add_group(const Part& part, MassProperties& properties);
  void add_rotary_inertia();
  void mass_lines();
  void box();
  void time_lines();
  void memory_line();
  void warnings();

  const Model& model_;
  int ranks_;
  std::vector<std::int32_t> body_of_;  // that carries each node for good
  std::string text_;
  MassProperties total_;
  std::array<double, 6> rotary_{};
  std::vector<std::string> part_lines_;
  double stable_increment_ = 0.0;
  std::int64_t critical_element_ = -1;
  std::string critical_type_;
  double bytes_ = 0.0;
  double nanoseconds_ = 0.0;             // of an explicit cycle on one core, elements alone
  std::map<std::string, double> costs_;  // of an element, by the types that are computed
};

void Summary::counts() {
  line(
      "Model {}: {} nodes, {} node sets, {} element sets, {} surfaces, {} materials, {} rigid bodies, {} contact "
      "pairs, {} steps",
      model_.name, model_.nodes.size(), model_.node_sets.size(), model_.element_sets.size(), model_.surfaces.size(),
      model_.materials.size(), model_.rigid_bodies.size(), model_.contact_pairs.size(), model_.steps.size());
  if (!model_.units.length.empty() || !model_.units.mass.empty() || !model_.units.time.empty()) {
    line("Units: length {}, mass {}, time {}", model_.units.length, model_.units.mass, model_.units.time);
  }
  for (const auto& table : model_.elements) line("  {:>9} elements {}", table.size(), table.type->name);
}

void Summary::add_point_masses(const Part& part, MassProperties& properties) {
  const auto& table = model_.elements[part.table];
  for (const auto row : part.rows) {
    properties.add(model_.sections[part.section].mass, model_.nodes.coordinates[table.connectivity[row]]);
  }
}

/// Lumped masses, and the kernel at rest for the stable increment.
void Summary::add_group(const Part& part, MassProperties& properties) {
  const auto& table = model_.elements[part.table];
  const auto scratch = static_cast<std::int32_t>(model_.nodes.size());
  GroupInput input{model_, part.table, part.section, part.rows, 0, {}, scratch};
  const int count = table.type->nodes;
  for (const auto row : part.rows) {
    const auto begin = table.connectivity.begin() + std::int64_t{row} * count;
    input.connectivity.insert(input.connectivity.end(), begin, begin + count);
  }
  const auto group = table.type->make_group(input);
  std::vector<double> masses(static_cast<std::size_t>(count));
  std::vector<bool> acting;
  for (std::int32_t element = 0; element < group->size(); ++element) {
    acting.push_back(!rests_for_good(group->nodes(element), body_of_));
    group->lumped_mass(element, masses);
    for (int n = 0; n < count; ++n) properties.add(masses[n], model_.nodes.coordinates[group->nodes(element)[n]]);
  }
  bytes_ +=
      static_cast<double>(group->bytes_per_element() + sizeof(double) * group->history_size()) * group->padded_size();
  nanoseconds_ += table.type->cycle_cost * static_cast<double>(std::ranges::count(acting, true));
  group->set_acting(std::move(acting));
  costs_[table.type->name] = table.type->cycle_cost;
  if (properties.mass <= 0.0) return;  // no density: no stable increment
  std::vector<double> position(4 * (model_.nodes.id.size() + 1)), velocity(position.size()), force(position.size());
  for (std::size_t node = 0; node < model_.nodes.id.size(); ++node) {
    for (int i = 0; i < 3; ++i) position[4 * node + i] = model_.nodes.coordinates[node][i];
  }
  for (std::size_t node = 0; node <= model_.nodes.id.size(); ++node) force[4 * node + 3] = rounding_constant(1.0);
  auto history = group->initial_history();
  std::vector<double> orientation(position.size()), moment(force);
  for (std::size_t i = 0; i < orientation.size(); i += 4) orientation[i] = 1.0;
  const ExplicitCycle cycle{
      {position.data(), velocity.data(), orientation.data(), velocity.data()}, {force.data(), moment.data()}, 0.0, 0.06, 1.2};
  StableIncrement stable = group->add_forces(Portion::interface, cycle, history);
  stable.merge(group->add_forces(Portion::interior, cycle, history));
  if (stable.element >= 0 && (critical_element_ < 0 || stable.increment < stable_increment_)) {
    stable_increment_ = stable.increment;
    critical_element_ = table.id[group->row(stable.element)];
    critical_type_ = table.type->name;
  }
}

void Summary::add_part(const Part& part) {
  const auto& table = model_.elements[part.table];
  const auto& section = model_.sections[part.section];
  MassProperties properties;
  if (table.type->make_group != nullptr) {
    add_group(part, properties);
  } else if (section.kind == Section::Kind::mass) {
    add_point_masses(part, properties);
  }
  total_.mass += properties.mass;
  for (int i = 0; i < 3; ++i) total_.moment[i] += properties.moment[i];
  for (int i = 0; i < 9; ++i) total_.second[i] += properties.second[i];
  if (section.kind == Section::Kind::rotary_inertia) return;
  const Point c = properties.center();
  part_lines_.push_back(fmt::format("  {:<24} {:<7} {:>9} elements  mass {:<12.6g} centre ({:.6g}, {:.6g}, {:.6g})",
                                    section.element_set.empty() ? "-" : section.element_set, table.type->name,
                                    part.rows.size(), properties.mass, c[0], c[1], c[2]));
}

void Summary::add_rotary_inertia() {
  for (const auto& table : model_.elements) {
    for (const auto section : table.section) {
      if (section < 0 || model_.sections[section].kind != Section::Kind::rotary_inertia) continue;
      for (int i = 0; i < 6; ++i) rotary_[i] += model_.sections[section].inertia[i];
    }
  }
}

void Summary::mass_lines() {
  const Point c = total_.center();
  auto inertia = total_.inertia();
  for (int i = 0; i < 6; ++i) inertia[i] += rotary_[i];
  line("Mass {:.6g}, centre of gravity ({:.6g}, {:.6g}, {:.6g})", total_.mass, c[0], c[1], c[2]);
  line("Inertia about it I11 {:.6g} I22 {:.6g} I33 {:.6g} I12 {:.6g} I13 {:.6g} I23 {:.6g}", inertia[0], inertia[1],
       inertia[2], inertia[3], inertia[4], inertia[5]);
  line("By section:");
  for (const auto& part : part_lines_) text_ += part + "\n";
}

void Summary::box() {
  if (model_.nodes.coordinates.empty()) return;
  Point low = model_.nodes.coordinates[0], high = low;
  for (const auto& x : model_.nodes.coordinates) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  }
  line("Bounding box ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", low[0], low[1], low[2], high[0], high[1],
       high[2]);
}

void Summary::time_lines() {
  if (critical_element_ < 0) {
    line("Stable increment: none (no element with mass)");
    return;
  }
  line("Stable increment of the undeformed model {:.6g}, element {} ({})", stable_increment_, critical_element_,
       critical_type_);
  bool any_explicit = false;
  for (const auto& step : model_.steps) {
    const auto* procedure = std::get_if<ExplicitProcedure>(&step.procedure);
    if (procedure == nullptr) {
      line("Step {}: {}, period {:.6g}", step.name, step.procedure_name(), step.duration());
      continue;
    }
    const double increment = procedure->fixed_increment.value_or(stable_increment_ * procedure->scale_factor * usual_part);
    const double cycles = step.duration() / increment;
    any_explicit = true;
    line("Step {}: explicit, period {:.6g}, about {:.3g} increments, {:.3g} s on {} ranks", step.name, step.duration(),
         cycles, 1e-9 * cycles * nanoseconds_ / ranks_, ranks_);
  }
  if (!any_explicit) return;
  std::string assumed;
  for (const auto& [type, cost] : costs_) assumed += fmt::format("{}{} {} ns", assumed.empty() ? "" : ", ", type, cost);
  line("  assumed: {} for an element in an increment (middle of the laws that balocco_bench measures on one core), ranks that "
       "share evenly, no contact and no output, the increment of the undeformed model (deformation and contact shorten it)",
       assumed);
}

void Summary::memory_line() {
  // Per node: position, velocity, force, acceleration, reaction (4 doubles each), mass, work, damping, and the tables
  // of the model.
  const double nodes = static_cast<double>(model_.nodes.size()) * (5 * 32 + 4 * 8 + 100);
  line("Memory about {:.3g} MB in all, {:.3g} MB a rank on {} ranks (implicit steps need more for the factors)",
       (nodes + bytes_) / 1e6, (nodes + bytes_) / 1e6 / ranks_, ranks_);
}

void Summary::warnings() {
  if (model_.steps.empty()) line("warning: there are no steps: nothing would be run");
  for (const auto& material : model_.materials) {
    if (material.density <= 0.0) line("warning: material {} has no density", material.name);
  }
}

}  // namespace

std::string summarize(const Model& model, int ranks) {
  return Summary(model, ranks).text();
}

}  // namespace balocco
