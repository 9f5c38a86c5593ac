#include "model_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "checkpoint_file.hpp"
#include "constraints/constraint.hpp"
#include "elements/element_type.hpp"
#include "elements/slave_places.hpp"
#include "model/diagnostics.hpp"
#include "model_digest.hpp"

namespace balocco {

namespace {

std::string name_of_pair(const std::string& slave, const std::string& master) { return slave + ", " + master; }

std::int64_t as_stored(std::uint64_t digest) { return static_cast<std::int64_t>(digest); }

void write_elements(const Hdf5File& file, const Model& model) {
  file.create_group("/identity/elements");
  for (const auto& table : model.elements) {
    std::vector<std::int64_t> values;
    for (std::int32_t row = 0; row < table.size(); ++row)
      values.insert(values.end(), {table.id[row], as_stored(digest_of_element(model, table, row)),
                                   as_stored(digest_of_section(model, model.sections[table.section[row]]))});
    file.write("/identity/elements/" + std::string(table.type->name), {values.size() / 3, 3}, values);
  }
}

void write_contact_pairs(const Hdf5File& file, const Model& model) {
  file.create_group("/identity/contact");
  for (std::size_t pair = 0; pair < model.contact_pairs.size(); ++pair) {
    const auto& slave = model.surfaces[model.contact_pairs[pair].slave];
    std::vector<std::int64_t> nodes;
    for (const auto row : homes_of_places(model, model.contact_pairs[pair])) nodes.push_back(model.nodes.id[row]);
    file.write(fmt::format("/identity/contact/{}", pair), {nodes.size(), 1}, nodes);
    file.set_attribute("/identity/contact", fmt::format("surfaces {}", pair),
                       name_of_pair(slave.name, model.surfaces[model.contact_pairs[pair].master].name));
  }
}

}  // namespace

void write_identity(const Hdf5File& file, const Model& model) {
  file.create_group("/identity");
  const std::vector<std::int64_t> ids(model.nodes.id.begin(), model.nodes.id.end());
  std::vector<double> coordinates;
  for (const auto& point : model.nodes.coordinates) coordinates.insert(coordinates.end(), point.begin(), point.end());
  file.write("/identity/node_id", {ids.size(), 1}, ids);
  file.write("/identity/coordinates", {ids.size(), 3}, coordinates);
  write_elements(file, model);
  write_contact_pairs(file, model);
  std::vector<std::int64_t> references, constraints;
  for (const auto& body : model.rigid_bodies) references.push_back(model.nodes.id[body.reference_node]);
  file.write("/identity/rigid_reference", {references.size(), 1}, references);
  for (const auto& constraint : make_constraints(model))
    constraints.insert(constraints.end(), {as_stored(digest_of_constraint(model, *constraint)), constraint->rows()});
  file.write("/identity/constraints", {constraints.size() / 2, 2}, constraints);
}

ModelIdentity::ModelIdentity(const Hdf5File& file) : node_id_(file.read_integers("/identity/node_id")), coordinates_(file.read("/identity/coordinates")) {
  for (std::size_t row = 0; row < node_id_.size(); ++row) row_of_node_.emplace(node_id_[row], row);
  for (const auto& type : file.children("/identity/elements")) {
    const auto values = file.read_integers("/identity/elements/" + type);
    for (std::size_t row = 0; row < values.size() / 3; ++row)
      elements_[type].emplace(values[3 * row], Element{static_cast<std::int64_t>(row), static_cast<std::uint64_t>(values[3 * row + 1]),
                                                       static_cast<std::uint64_t>(values[3 * row + 2])});
  }
  for (const auto& pair : file.children("/identity/contact")) {
    ContactPair known{.index = std::stoll(pair), .places = 0, .rows_of_home = {}};
    const auto nodes = file.read_integers("/identity/contact/" + pair);
    known.places = static_cast<std::int64_t>(nodes.size());
    for (std::size_t row = 0; row < nodes.size(); ++row) known.rows_of_home[nodes[row]].push_back(static_cast<std::int64_t>(row));
    contact_pairs_.emplace(file.text_attribute("/identity/contact", "surfaces " + pair), std::move(known));
  }
  const auto read = [&](const char* path) { return file.exists(path) ? file.read_integers(path) : std::vector<std::int64_t>{}; };
  const auto references = read("/identity/rigid_reference");
  for (std::size_t body = 0; body < references.size(); ++body) rigid_body_.emplace(references[body], body);
  const auto constraints = read("/identity/constraints");
  std::int64_t first = 0;
  for (std::size_t i = 0; i < constraints.size() / 2; ++i) {
    constraints_.emplace(static_cast<std::uint64_t>(constraints[2 * i]), first);
    first += constraints[2 * i + 1];
  }
}

std::int64_t ModelIdentity::find(const std::map<std::int64_t, std::int64_t>& rows, std::int64_t id) {
  const auto found = rows.find(id);
  return found == rows.end() ? -1 : found->second;
}

Point ModelIdentity::coordinates(std::int64_t row) const {
  const auto at = static_cast<std::size_t>(3 * row);
  return {coordinates_[at], coordinates_[at + 1], coordinates_[at + 2]};
}

std::int64_t ModelIdentity::elements(const std::string& type) const {
  const auto table = elements_.find(type);
  return table == elements_.end() ? 0 : static_cast<std::int64_t>(table->second.size());
}

const ModelIdentity::Element* ModelIdentity::element(const std::string& type, std::int64_t id) const {
  const auto table = elements_.find(type);
  if (table == elements_.end()) return nullptr;
  const auto found = table->second.find(id);
  return found == table->second.end() ? nullptr : &found->second;
}

const ModelIdentity::ContactPair* ModelIdentity::contact_pair(const std::string& slave, const std::string& master) const {
  const auto found = contact_pairs_.find(name_of_pair(slave, master));
  return found == contact_pairs_.end() ? nullptr : &found->second;
}

std::int64_t ModelIdentity::constraint(std::uint64_t digest) const {
  const auto found = constraints_.find(digest);
  return found == constraints_.end() ? -1 : found->second;
}

void refuse_import(const std::string& path, const Model& model, const std::string& what) {
  throw InputError(fmt::format("{}: error: *IMPORT: {} has {}", model.where(model.state_import->location), path, what));
}

std::int64_t id_there(const Model& model, std::int32_t node_row) {
  const auto* const copy = model.state_import->copy_of(node_row);
  return model.nodes.id[node_row] - (copy == nullptr ? 0 : copy->node_shift);
}

std::int64_t id_there(const Model& model, ElementRef element) {
  const auto* const copy = model.state_import->copy_of(element);
  return model.elements[element.table].id[element.row] - (copy == nullptr ? 0 : copy->element_shift);
}

std::int64_t refuse_other_step(const Hdf5File& file, const std::string& path, const Model& model) {
  const auto& [asked, increment, interval] = model.state_import->choice;
  const CheckpointPlace place(file);
  const bool within = increment || interval;
  if (asked && (*asked != place.number() || (place.within_step() && !within)))
    refuse_import(path, model,
                  fmt::format("the state {} step {}, not of the end of step {}; let that job keep its states (*RESTART, WRITE without OVERLAY), or leave STEP out",
                              place.within_step() ? "within" : "of the end of", place.number(), *asked));
  return place.step;
}

namespace {

std::string words(const Point& place) { return fmt::format("({:g}, {:g}, {:g})", place[0], place[1], place[2]); }

/// Coordinates are written with the digits that a double needs, so that copies are off by rounding alone.
bool are_one(const Point& way, const Point& other, const Point& place) {
  constexpr double rounding = 1e-12;
  const auto largest = [](const Point& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}); };
  const double allowed = rounding * std::max(largest(way), largest(place));
  return largest({way[0] - other[0], way[1] - other[1], way[2] - other[2]}) <= allowed;
}

}  // namespace

std::vector<Point> refuse_other_nodes(const ModelIdentity& identity, const std::string& path, const Model& model) {
  const auto& import = *model.state_import;
  std::vector<std::optional<Point>> ways(import.copies.size());
  for (const auto row : import.nodes) {
    const auto* const copy = import.copy_of(row);
    const auto id = model.nodes.id[row], source = id_there(model, row), old = identity.row_of_node(source);
    if (old < 0 && copy == nullptr) refuse_import(path, model, fmt::format("no node {}; import only what both models have", id));
    if (old < 0)
      refuse_import(path, model, fmt::format("no node {}, from which node {} is to go on; look at SHIFT NODES={}", source, id, copy->node_shift));
    const auto there = identity.coordinates(old), here = model.nodes.coordinates[row];
    if (copy == nullptr && there != here)
      refuse_import(path, model,
                    fmt::format("node {} at {}, this deck at {}; both jobs must have the same mesh there", id, words(there), words(here)));
    if (copy == nullptr) continue;
    auto& way = ways[static_cast<std::size_t>(copy - import.copies.data())];
    const Point found{here[0] - there[0], here[1] - there[1], here[2] - there[2]};
    if (!way) way = found;
    if (!are_one(*way, found, here))
      refuse_import(path, model,
                    fmt::format("node {} at {} and this deck node {} of its copy at {}, which is another way than that of the nodes before, {}; "
                                "a copy is moved as a whole and not turned",
                                source, words(there), id, words(here), words(*way)));
  }
  std::vector<Point> found;
  for (const auto& way : ways) found.push_back(way.value_or(Point{}));
  return found;
}

void refuse_other_elements(const ModelIdentity& identity, const std::string& path, const Model& model, ImportedSections sections) {
  const auto& import = *model.state_import;
  for (const auto& element : import.elements) {
    const auto [table_row, row] = element;
    const auto& table = model.elements[table_row];
    const auto id = id_there(model, element);
    const auto* const copy = import.copy_of(element);
    const auto* const old = identity.element(table.type->name, id);
    const auto name = fmt::format("{} element {}", table.type->name, id);
    if (old == nullptr) refuse_import(path, model, fmt::format("no {}; import only what both models have", name));
    if (old->nodes != digest_of_element(model, table, row, copy == nullptr ? 0 : copy->node_shift))
      refuse_import(path, model, fmt::format("{} with other nodes; both jobs must have the same mesh there", name));
    if (sections == ImportedSections::same && old->section != digest_of_section(model, model.sections[table.section[row]]))
      refuse_import(path, model, fmt::format("{} with another section or material; give it the same in both jobs", name));
  }
}

}  // namespace balocco
