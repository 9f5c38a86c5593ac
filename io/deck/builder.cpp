#include "deck/builder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "deck/register.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// Appended rows mostly come in order already; sorting is for the others.
template <class T>
void sort_unique(std::vector<T>& values) {
  if (!std::is_sorted(values.begin(), values.end())) std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Takes repetitions out of what a deck lists, and all of it where the order is that of `members`.
template <class T>
void settle_order(const std::vector<T>& members, std::vector<T>& listed) {
  if (listed != members) {
    std::set<T> seen;
    std::erase_if(listed, [&](const T& member) { return !seen.insert(member).second; });
  }
  if (listed == members) listed = {};
}

std::string after_instance(std::string_view name) {
  const auto dot = name.rfind('.');
  return std::string(dot == std::string_view::npos ? name : name.substr(dot + 1));
}

}  // namespace

Point Scope::turn(const Point& direction) const {
  Point result{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[i] += rotation[i][j] * direction[j];
  }
  return result;
}

Point Scope::place(const Point& local) const {
  if (prefix.empty()) return local;
  Point moved{};
  for (int i = 0; i < 3; ++i) moved[i] = local[i] + translation[i] - centre[i];
  moved = turn(moved);
  for (int i = 0; i < 3; ++i) moved[i] += centre[i];
  return moved;
}

void Builder::error(const Block& block, Location location, std::string text) {
  diagnostics.error(location, block.written, std::move(text));
  poison(block);
}

void Builder::warning(const Block& block, Location location, std::string text) {
  diagnostics.warning(location, block.written, std::move(text));
}

void Builder::poison(const Block& block) {
  const KeywordRule* rule = find_keyword(block.keyword);
  const bool anything = rule == nullptr || block.keyword == "PART" || block.keyword == "INSTANCE";
  const bool of_sets = block.keyword == "NSET" || block.keyword == "ELSET";  // what they define is known by its name
  const bool of_nodes = anything || (rule->phase == Phase::nodes && !of_sets);
  nodes_incomplete = nodes_incomplete || of_nodes;
  elements_incomplete = elements_incomplete || of_nodes || (rule->phase == Phase::elements && !of_sets);
  if (in_step) draft.faulty = true;
  for (const auto& parameter : block.parameters) {
    if (parameter.has_value) poisoned_.insert(squeezed(parameter.value));
  }
}

bool Builder::is_poisoned(std::string_view name) const {
  const auto dot = name.rfind('.');
  return poisoned_.contains(squeezed(name)) ||
         (dot != std::string_view::npos && poisoned_.contains(squeezed(name.substr(0, dot))));
}

std::string Builder::squeezed(std::string_view name) {
  return squeeze(after_instance(name));
}

std::optional<std::int32_t> Builder::find(const Names& names, std::string_view name) const {
  if (!scope->prefix.empty()) {
    if (const auto found = names.rows.find(scope->prefix + std::string(name)); found != names.rows.end())
      return found->second;
  }
  const auto found = names.rows.find(name);
  if (found != names.rows.end()) return found->second;
  return std::nullopt;
}

std::optional<std::int32_t> Builder::require(const Names& names, std::string_view name, const Block& block,
                                             Location location) {
  if (const auto found = find(names, name)) return found;
  if (!is_poisoned(name) && !text_incomplete) {
    std::vector<std::string> known;
    for (const auto& [key, row] : names.rows) known.push_back(key);
    const std::string guess = nearest(name, known);
    tell_undefined(fmt::format("{} {}", names.kind, name), guess.empty() ? "define it" : "did you mean " + guess + "?",
                   block, location);
  }
  poison(block);
  return std::nullopt;
}

void Builder::tell_undefined(const std::string& what, const std::string& cure, const Block& block, Location location) {
  if (!told_undefined_.insert(what).second) return;
  diagnostics.error(location, block.written, fmt::format("{} is not defined; {}", what, cure));
}

std::optional<std::string> Builder::define(Names& names, std::string_view name, std::int32_t row, const Block& block) {
  std::string full = scope->prefix + std::string(name);
  if (!names.rows.emplace(full, row).second) {
    error(block, block.location, fmt::format("{} {} is defined twice; give the second another name", names.kind, full));
    return std::nullopt;
  }
  return full;
}

std::optional<std::int32_t> Builder::node(std::int64_t id) const {
  if (!scope->node_offset || id > scope->largest_node) return std::nullopt;
  const auto found = model.nodes.row_of_id.find(id + *scope->node_offset);
  if (found == model.nodes.row_of_id.end()) return std::nullopt;
  return found->second;
}

std::optional<ElementRef> Builder::element(std::int64_t id) const {
  if (!scope->element_offset || id > scope->largest_element) return std::nullopt;
  const auto found = element_of_id.find(id + *scope->element_offset);
  if (found == element_of_id.end()) return std::nullopt;
  return found->second;
}

std::optional<std::int32_t> Builder::require_node(std::int64_t id, const Block& block, Location location) {
  const auto row = node(id);
  if (!row) {
    if (!nodes_incomplete) {
      tell_undefined(fmt::format("node {}{}", scope->prefix, id), "define it under *NODE or correct the id", block,
                     location);
    }
    poison(block);
  }
  return row;
}

const Scope* Builder::scope_of_instance(std::string_view name) const {
  for (const auto& candidate : scopes) {
    if (!candidate.prefix.empty() &&
        std::string_view(candidate.prefix).substr(0, candidate.prefix.size() - 1) == name) {
      return &candidate;
    }
  }
  return nullptr;
}

bool Builder::nodes_of(std::string_view field, const Block& block, Location location, std::vector<std::int32_t>& rows) {
  if (const auto id = parse_integer(field)) {
    const auto row = require_node(*id, block, location);
    if (row) rows.push_back(*row);
    return row.has_value();
  }
  const std::string name = clean_name(field);
  const auto dot = name.rfind('.');
  const auto id = dot == std::string::npos ? std::nullopt : parse_integer(std::string_view(name).substr(dot + 1));
  if (const Scope* instance = id ? scope_of_instance(std::string_view(name).substr(0, dot)) : nullptr) {
    Scope* const current = scope;
    scope = const_cast<Scope*>(instance);
    const auto row = require_node(*id, block, location);
    scope = current;
    if (row) rows.push_back(*row);
    return row.has_value();
  }
  const auto set = require(node_sets, name, block, location);
  if (!set) return false;
  const auto& members = nodes_in(*set);
  if (members.empty() && !nodes_incomplete && !elements_incomplete && !is_poisoned(name)) {
    error(block, location, fmt::format("node set {} is empty; give it nodes or do not use it", name));
    return false;
  }
  rows.insert(rows.end(), members.begin(), members.end());
  return true;
}

bool Builder::elements_of(std::string_view field, const Block& block, Location location,
                          std::vector<ElementRef>& elements) {
  if (const auto id = parse_integer(field)) {
    const auto found = element(*id);
    if (found) {
      elements.push_back(*found);
    } else {
      if (!elements_incomplete) {
        tell_undefined(fmt::format("element {}{}", scope->prefix, *id), "define it under *ELEMENT or correct the id",
                       block, location);
      }
      poison(block);
    }
    return found.has_value();
  }
  const std::string name = clean_name(field);
  const auto set = require(element_sets, name, block, location);
  if (!set) return false;
  const auto& members = elements_in(*set);
  if (members.empty() && !elements_incomplete && !is_poisoned(name)) {
    error(block, location, fmt::format("element set {} is empty; give it elements or do not use it", name));
    return false;
  }
  elements.insert(elements.end(), members.begin(), members.end());
  return true;
}

std::int32_t Builder::node_set_row(std::string_view name) {
  const std::string full = scope->prefix + std::string(name);
  const auto [place, added] = node_sets.rows.emplace(full, static_cast<std::int32_t>(model.node_sets.size()));
  if (added) {
    model.node_sets.push_back({full, {}});
    node_set_dirty_.push_back(false);
  }
  return place->second;
}

std::int32_t Builder::element_set_row(std::string_view name) {
  const std::string full = scope->prefix + std::string(name);
  const auto [place, added] = element_sets.rows.emplace(full, static_cast<std::int32_t>(model.element_sets.size()));
  if (added) {
    model.element_sets.push_back({full, {}});
    element_set_dirty_.push_back(false);
  }
  return place->second;
}

void Builder::add_to_node_set(std::int32_t set, std::int32_t row) {
  model.node_sets[set].nodes.push_back(row);
  model.node_sets[set].deck_order.push_back(row);
  node_set_dirty_[set] = true;
}

void Builder::add_absent_node(std::int32_t set, std::int64_t id) {
  auto& [name, nodes, deck_order, absent] = model.node_sets[set];
  auto index = std::ranges::find(absent, id) - absent.begin();
  if (index == std::ssize(absent)) absent.push_back(id);
  deck_order.push_back(static_cast<std::int32_t>(-1 - index));
}

void Builder::add_to_element_set(std::int32_t set, ElementRef element) {
  model.element_sets[set].elements.push_back(element);
  model.element_sets[set].deck_order.push_back(element);
  element_set_dirty_[set] = true;
}

const std::vector<std::int32_t>& Builder::nodes_in(std::int32_t set) {
  auto& nodes = model.node_sets[set].nodes;
  if (node_set_dirty_[set] && !unsorted_node_sets.contains(set)) sort_unique(nodes);
  node_set_dirty_[set] = false;
  return nodes;
}

const std::vector<ElementRef>& Builder::elements_in(std::int32_t set) {
  auto& elements = model.element_sets[set].elements;
  if (element_set_dirty_[set]) sort_unique(elements);
  element_set_dirty_[set] = false;
  return elements;
}

const std::vector<double>* Builder::require_time_points(const Block& block) {
  const auto found = time_points.find(block.value("TIME POINTS"));
  if (found != time_points.end()) return &found->second;
  if (!is_poisoned(block.value("TIME POINTS")))
    error(block, block.location,
          fmt::format("time points {} are not defined; define them under *TIME POINTS", block.value("TIME POINTS")));
  return nullptr;
}

void Builder::normalize_sets() {
  for (std::size_t set = 0; set < model.node_sets.size(); ++set)
    settle_order(nodes_in(static_cast<std::int32_t>(set)), model.node_sets[set].deck_order);
  for (std::size_t set = 0; set < model.element_sets.size(); ++set)
    settle_order(elements_in(static_cast<std::int32_t>(set)), model.element_sets[set].deck_order);
}

Row::Row(Builder& builder, const Block& block, const DataLine& line) : builder_(builder), block_(block), line_(line) {
  split(line.text, fields_);
}

std::string Row::name(int field) const {
  return clean_name(text(field));
}

void Row::error(std::string text) {
  ok_ = false;
  builder_.error(block_, line_.location, std::move(text));
}

std::string Row::missing_or_bad(int field, const char* what, const char* kind) const {
  if (!has(field)) return fmt::format("field {} is missing: {}; add {}", field + 1, what, kind);
  return fmt::format("field {} ('{}') should be {}: {}; correct it", field + 1, text(field), kind, what);
}

double Row::real(int field, const char* what) {
  const auto value = parse_real(text(field));
  if (!value) error(missing_or_bad(field, what, "a number"));
  return value.value_or(0.0);
}

std::int64_t Row::integer(int field, const char* what) {
  const auto value = parse_integer(text(field));
  if (!value) error(missing_or_bad(field, what, "a whole number"));
  return value.value_or(0);
}

void Row::at_most(int fields) {
  for (int field = fields; field < size(); ++field) {
    if (!has(field)) continue;
    error(fmt::format("field {} ('{}') is not known: the line has at most {} here; remove it", field + 1, text(field),
                      fields));
    return;
  }
}

}  // namespace balocco::deck
