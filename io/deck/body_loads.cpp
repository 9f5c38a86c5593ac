#include "deck/body_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "deck/geometry.hpp"
#include "deck/load_magnitude.hpp"
#include "deck/steady_state.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"
#include "sections/beam_section.hpp"

namespace balocco::deck {

namespace {

struct Label {
  const char* name;
  BodyLoad::Kind kind;
  const char* magnitude;  // what the first number is
  std::array<double, 3> direction{};
  bool by_length = false;  // of a line: becomes a force by volume
  bool by_volume = false;  // density * omega^2: becomes omega^2
};

const std::array labels{Label{"GRAV", BodyLoad::Kind::gravity, "acceleration"},
                        Label{"CENTRIF", BodyLoad::Kind::centrifugal, "square of the angular velocity"},
                        Label{"BX", BodyLoad::Kind::volume_force, "force by volume", {1.0, 0.0, 0.0}},
                        Label{"BY", BodyLoad::Kind::volume_force, "force by volume", {0.0, 1.0, 0.0}},
                        Label{"BZ", BodyLoad::Kind::volume_force, "force by volume", {0.0, 0.0, 1.0}},
                        Label{"PX", BodyLoad::Kind::volume_force, "force by length", {1.0, 0.0, 0.0}, true},
                        Label{"PY", BodyLoad::Kind::volume_force, "force by length", {0.0, 1.0, 0.0}, true},
                        Label{"PZ", BodyLoad::Kind::volume_force, "force by length", {0.0, 0.0, 1.0}, true},
                        Label{"CENT", BodyLoad::Kind::centrifugal, "density * square of the angular velocity", {}, false, true}};

const Label* find_label(const std::string& name) {
  const auto found = std::ranges::find_if(labels, [&](const Label& label) { return name == label.name; });
  return found == labels.end() ? nullptr : &*found;
}

/// Whether an element has mass, or for a force by volume a volume, for a load to act on.
bool takes(const ElementType& type, BodyLoad::Kind kind) {
  switch (type.section) {
    case Section::Kind::mass: return kind != BodyLoad::Kind::volume_force;
    case Section::Kind::rotary_inertia:
    case Section::Kind::spring:
    case Section::Kind::dashpot:
    case Section::Kind::connector:
    case Section::Kind::rigid: return false;
    default: return true;
  }
}

/// Set of a line, -1: the whole model; a single element gets a set of its own.
std::optional<std::int32_t> set_of(Builder& builder, const Block& block, Row& row, BodyLoad::Kind kind) {
  if (!row.has(0)) return -1;
  std::vector<ElementRef> elements;
  if (!builder.elements_of(row.text(0), block, row.location(), elements)) return std::nullopt;
  if (std::ranges::none_of(elements, [&](ElementRef element) { return takes(*builder.model.elements[element.table].type, kind); })) {
    row.error(fmt::format("no element of {} has {} for {} to act on; load solids, sheets or lines{}", row.text(0),
                          kind == BodyLoad::Kind::volume_force ? "a volume" : "mass", row.name(1),
                          kind == BodyLoad::Kind::volume_force ? "" : ", or MASS elements"));
    return std::nullopt;
  }
  if (!parse_integer(row.text(0))) return *builder.find(builder.element_sets, row.name(0));
  const auto set = builder.element_set_row("_DLOAD-" + row.name(0));
  builder.add_to_element_set(set, elements[0]);
  builder.elements_in(set);
  return set;
}

void read_direction(Row& row, int first, const char* what, std::array<double, 3>& direction) {
  for (int i = 0; i < 3; ++i) direction[i] = row.real_or(first + i, 0.0, what);
  row.at_most(first + 3);
  const double length = norm(direction);
  if (row.ok() && !(length > 0.0)) row.error(fmt::format("the {} is missing; give three components", what));
  for (double& component : direction) component /= length;
}

void read_numbers(Row& row, const Label& label, BodyLoad& load) {
  load.magnitude = row.real(2, label.magnitude);
  load.direction = label.direction;
  switch (label.kind) {
    case BodyLoad::Kind::gravity: return read_direction(row, 3, "direction", load.direction);
    case BodyLoad::Kind::volume_force: return row.at_most(3);
    case BodyLoad::Kind::centrifugal:
      if (row.ok() && load.magnitude < 0.0)
        row.error("the square of the angular velocity is negative; give omega^2, at least 0");
      for (int i = 0; i < 3; ++i) load.point[i] = row.real_or(3 + i, 0.0, "point of the axis");
      return read_direction(row, 6, "direction of the axis", load.direction);
  }
}

/// Area of a line's section; 0 of anything else.
double area_of(const Model& model, const ElementTable& table, std::int32_t section) {
  const bool beam = table.type->section == Section::Kind::beam;
  if (!beam && table.type->section != Section::Kind::truss) return 0.0;
  return beam ? beam_area(model.sections[section].beam).area : model.sections[section].area;
}

double density_of(const Model& model, const ElementTable&, std::int32_t section) {
  const auto material = model.sections[section].material;
  return material < 0 ? 0.0 : model.materials[material].density;
}

/// Sets of an element or a set, one for each area or density, by which the load is divided. Told where an element has none.
std::map<double, std::int32_t> sets_by_divisor(Builder& builder, const Block& block, Row& row, bool by_length) {
  std::vector<ElementRef> elements;
  std::map<double, std::int32_t> sets;
  if (!builder.elements_of(row.text(0), block, row.location(), elements)) return sets;
  std::map<double, std::vector<ElementRef>> found;
  for (const auto element : elements) {
    const auto& table = builder.model.elements[element.table];
    const auto section = table.section[element.row];
    const double divisor = section < 0 ? 0.0 : (by_length ? area_of : density_of)(builder.model, table, section);
    if (!(divisor > 0.0)) {
      row.error(fmt::format("element {} of type {} cannot take the load {}, a force by {}", builder.model.element_name(element),
                            table.type->name, row.name(1),
                            by_length ? "length; load beams or trusses with a section"
                                      : "volume; load elements of a material with *DENSITY, or give CENTRIF and omega^2"));
      return {};
    }
    found[divisor].push_back(element);
  }
  for (const auto& [divisor, members] : found) {
    sets[divisor] = builder.element_set_row(fmt::format("_DLOAD-{}-{}{}", row.name(0), by_length ? "" : "DENSITY-", sets.size()));
    if (!builder.elements_in(sets[divisor]).empty()) continue;  // made by a line before
    for (const auto element : members) builder.add_to_element_set(sets[divisor], element);
    builder.elements_in(sets[divisor]);
  }
  return sets;
}

bool replaces(const BodyLoad& load, const BodyLoad& other) {
  return load.kind == other.kind && load.element_set == other.element_set && load.direction == other.direction &&
         load.point == other.point && load.imaginary == other.imaginary;
}

void set_body_load(Builder& builder, const BodyLoad& load) {
  auto& loads = current_step(builder).body_loads;
  const auto found = std::ranges::find_if(loads, [&](const BodyLoad& other) { return replaces(load, other); });
  if (found == loads.end()) {
    loads.push_back(load);
    return;
  }
  const double previous = found->previous;
  *found = load;
  found->previous = previous;
}

}  // namespace

bool is_body_load(const std::string& label) { return find_label(label) != nullptr; }

std::string body_load_labels() {
  std::string text;
  for (const auto& label : labels) text += (text.empty() ? "" : ", ") + std::string(label.name);
  return text;
}

void read_body_load(Builder& builder, const Block& block, Row& row, std::int32_t amplitude) {
  const Label& label = *find_label(row.name(1));
  BodyLoad load;
  load.kind = label.kind;
  read_numbers(row, label, load);
  if (!row.ok()) return;
  load.imaginary = is_imaginary(builder, block);
  load.amplitude = amplitude;
  load.file = row.location().file;
  load.line = row.location().line;
  builder.draft.said.insert({load.file, load.line});
  const double magnitude = scaled(builder, amplitude, load.magnitude);
  if (label.by_length || label.by_volume) {
    for (const auto& [divisor, set] : sets_by_divisor(builder, block, row, label.by_length)) {
      load.element_set = set;
      load.magnitude = magnitude / divisor;
      set_body_load(builder, load);
    }
    return;
  }
  const auto set = set_of(builder, block, row, load.kind);
  if (!set) return;
  load.element_set = *set;
  load.magnitude = magnitude;
  set_body_load(builder, load);
}

std::string body_load_text(const BodyLoad& load) {
  const auto label = std::ranges::find_if(labels, [&](const Label& candidate) {
    return candidate.kind == load.kind && (load.kind != BodyLoad::Kind::volume_force || candidate.direction == load.direction);
  });
  std::string text = fmt::format("{}, {}", label->name, load.magnitude);
  const auto add = [&](const std::array<double, 3>& vector) { text += fmt::format(", {}, {}, {}", vector[0], vector[1], vector[2]); };
  if (load.kind == BodyLoad::Kind::centrifugal) add(load.point);
  if (load.kind != BodyLoad::Kind::volume_force) add(load.direction);
  return text;
}

}  // namespace balocco::deck
