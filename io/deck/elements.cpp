// *ELEMENT *ELGEN *ELCOPY.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/element_spellings.hpp"
#include "deck/mesh.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

std::int32_t table_of(Builder& builder, const ElementType* type) {
  auto& tables = builder.model.elements;
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const ElementTable& t) { return t.type == type; });
  if (found != tables.end()) return static_cast<std::int32_t>(found - tables.begin());
  tables.emplace_back();
  tables.back().type = type;
  return static_cast<std::int32_t>(tables.size()) - 1;
}

/// Nodes of an element about to be added, checked for repetition.
bool distinct(Builder& builder, const Block& block, Location location, std::int64_t id,
              std::span<const std::int32_t> nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (nodes[i] != nodes[j]) continue;
      builder.error(block, location,
                    fmt::format("element {} has node {} twice; use an element type with fewer nodes or correct "
                                "the connectivity",
                                id, builder.model.node_name(nodes[i])));
      return false;
    }
  }
  return true;
}

std::optional<ElementRef> add_element(Builder& builder, const Block& block, Location location, std::int32_t table,
                                      std::int64_t id, std::span<const std::int32_t> nodes) {
  if (id <= 0) {
    builder.error(block, location, fmt::format("element id {} is out of range; ids are positive", id));
    return std::nullopt;
  }
  if (!distinct(builder, block, location, id, nodes)) return std::nullopt;
  ElementTable& elements = builder.model.elements[table];
  const ElementRef reference{table, elements.size()};
  const std::int64_t unique = id + element_offset(builder);
  const auto [place, added] = builder.element_of_id.emplace(unique, reference);
  if (!added) {
    const auto& other = builder.model.elements[place->second.table];
    builder.error(block, location,
                  fmt::format("element {} is defined twice, first at {}; give one of them another id", id,
                              builder.model.where(other.location[place->second.row])));
    return std::nullopt;
  }
  builder.scope->largest_element = std::max(builder.scope->largest_element, id);
  elements.id.push_back(unique);
  const Scope& scope = *builder.scope;
  if (!builder.model.instances.empty()) elements.instance.push_back(scope.instance);
  if (scope.instance >= 0) builder.model.instances[scope.instance].element_offset = *scope.element_offset;
  if (scope.element_set >= 0) builder.add_to_element_set(scope.element_set, reference);
  elements.connectivity.insert(elements.connectivity.end(), nodes.begin(), nodes.end());
  elements.section.push_back(-1);
  elements.location.push_back(location);
  return reference;
}

std::string_view first_field(const Block& block) {
  const std::string_view line = block.lines.front().text;
  return trim(line.substr(0, line.find(',')));
}

const ElementType* type_of(Builder& builder, const Block& block) {
  const std::string name = computed_as(builder, block, block.value("TYPE"));
  const ElementType* type = find_element_type(name);
  if (type == nullptr) {
    std::vector<std::string> known;
    for (const auto* candidate : element_types()) known.push_back(candidate->name);
    const std::string set = block.has("ELSET") ? fmt::format(" of set {}", block.value("ELSET")) : "";
    const std::string first = block.lines.empty() ? "" : fmt::format(" (element {}{})", first_field(block), set);
    const bool plane = name.starts_with("CP") || name.starts_with("CAX");
    builder.error(block, block.location,
                  fmt::format("element type {}{} is unknown or not supported{}; supported: {}{}", name, first,
                              did_you_mean(name, known), join(known),
                              plane ? "; plane faces that a mesher wrote beside the solids are not needed: delete them" : ""));
  }
  return type;
}

/// Reads *ELEMENT data lines; an element runs over as many lines as its nodes need.
class ElementReader {
 public:
  ElementReader(Builder& builder, const Block& block, const ElementType& type)
      : builder_(builder), block_(block), type_(type), table_(table_of(builder, &type)) {
    if (block.has("ELSET")) set_ = builder.element_set_row(block.value("ELSET"));
    auto& elements = builder.model.elements[table_];
    const std::size_t expected = elements.id.size() + block.lines.size();
    if (block.lines.size() > 1000) {
      elements.id.reserve(expected);
      elements.connectivity.reserve(expected * static_cast<std::size_t>(type.nodes));
      elements.section.reserve(expected);
      elements.location.reserve(expected);
      builder.element_of_id.reserve(builder.element_of_id.size() + block.lines.size());
    }
  }

  void read() {
    for (std::size_t line = 0; line < block_.lines.size();) line = read_one(line);
  }

 private:
  /// @return the line after the element.
  std::size_t read_one(std::size_t line) {
    const Location location = block_.lines[line].location;
    nodes_.clear();
    bool good = true, first = true, more = true;
    std::int64_t id = 0;
    for (; more && line < block_.lines.size(); ++line) {
      const DataLine& data = block_.lines[line];
      split(data.text, fields_);
      for (std::size_t field = 0; field < fields_.size(); ++field) {
        const auto number = parse_integer(fields_[field]);
        if (!first && is_ground(fields_[field])) {
          nodes_.push_back(ground);
        } else if (!first && is_of_instance(fields_[field])) {
          if (good) good = builder_.nodes_of(fields_[field], block_, location, nodes_);
        } else if (!number) {
          if (good) tell_bad_field(data, field);
          good = false;
        } else if (first) {
          id = *number;
        } else if (good) {
          add_node_id(*number, location, good);
        }
        first = false;
      }
      more = data.text.back() == ',' && static_cast<int>(nodes_.size()) < type_.nodes && good;
    }
    if (good) finish(id, location);
    return line;
  }

  /// A connector's node that is left empty, or 0.
  bool is_ground(std::string_view field) const {
    return type_.section == Section::Kind::connector && static_cast<int>(nodes_.size()) < type_.nodes && (field.empty() || field == "0");
  }

  /// A node of an instance, as the assembly names it: INSTANCE.5.
  static bool is_of_instance(std::string_view field) {
    const auto dot = field.rfind('.');
    return dot != std::string_view::npos && dot > 0 && parse_integer(field.substr(dot + 1)) && !parse_real(field);
  }

  /// The ground is where the other node is.
  bool put_on_ground(std::int64_t id, Location location) {
    if (type_.section == Section::Kind::connector && nodes_.size() == 1) nodes_.push_back(ground);
    if (std::ranges::count(nodes_, ground) == 0) return true;
    const auto other = std::ranges::find_if(nodes_, [](std::int32_t node) { return node != ground; });
    if (other == nodes_.end()) {
      builder_.error(block_, location, fmt::format("element {} joins the ground to itself; name one of its nodes", id));
      return false;
    }
    const Point place = builder_.model.nodes.coordinates[*other];
    std::ranges::replace(nodes_, ground, add_ground_node(builder_, location, place));
    return true;
  }

  void add_node_id(std::int64_t id, Location location, bool& good) {
    const auto row = builder_.require_node(id, block_, location);
    if (row) nodes_.push_back(*row);
    good = row.has_value();
  }

  void tell_bad_field(const DataLine& data, std::size_t field) {
    builder_.error(block_, data.location,
                   fmt::format("field {} ('{}') should be a whole number: element id or node; correct it", field + 1,
                               fields_[field]));
  }

  void finish(std::int64_t id, Location location) {
    if (!put_on_ground(id, location)) return;
    if (static_cast<int>(nodes_.size()) != type_.nodes) {
      builder_.error(block_, location,
                     fmt::format("element {} has {} nodes, but {} needs {}; correct the line or the type (a line "
                                 "that goes on ends with a comma)",
                                 id, nodes_.size(), type_.name, type_.nodes));
      return;
    }
    const auto added = add_element(builder_, block_, location, table_, id, nodes_);
    if (added && set_ >= 0) builder_.add_to_element_set(set_, *added);
  }

  static constexpr std::int32_t ground = -1;  // in nodes_
  Builder& builder_;
  const Block& block_;
  const ElementType& type_;
  std::int32_t table_, set_ = -1;
  std::vector<std::int32_t> nodes_;
  std::vector<std::string_view> fields_;
};

void read_elements(Builder& builder, const Block& block) {
  const ElementType* type = type_of(builder, block);
  if (type == nullptr) return;
  ElementReader reader(builder, block, *type);
  const auto table = table_of(builder, type), first = builder.model.elements[table].size();
  reader.read();
  if (can_lock(block.value("TYPE"))) builder.locking_hybrids.push_back({&block, table, first, builder.model.elements[table].size()});
}

/// Order of the nodes of a solid of which the nodes of a mirror image make a solid that is not inside out; empty: not known.
std::vector<int> mirrored_order(const ElementType& type) {
  if (type.section != Section::Kind::solid) return {};
  switch (type.nodes) {
    case 4: return {0, 2, 1, 3};
    case 6: return {0, 2, 1, 3, 5, 4};
    case 8: return {0, 3, 2, 1, 4, 7, 6, 5};
    case 10: return {0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
    case 20: return {0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17};
    default: return {};
  }
}

/// Adds a copy of an element with its node ids shifted. `order`: of the nodes; empty: as they are.
std::optional<ElementRef> copy_element(Builder& builder, const Block& block, Location location, ElementRef old,
                                       std::int64_t id, std::int64_t node_shift, const std::vector<int>& order = {}) {
  const ElementTable& elements = builder.model.elements[old.table];
  const int count = elements.type->nodes;
  std::vector<std::int32_t> nodes;
  for (int n = 0; n < count; ++n) {
    const std::int32_t row = elements.connectivity[old.row * count + (order.empty() ? n : order[n])];
    const std::int64_t local = builder.model.nodes.id[row] - builder.scope->node_offset.value_or(0);
    const auto shifted = builder.require_node(local + node_shift, block, location);
    if (!shifted) return std::nullopt;
    nodes.push_back(*shifted);
  }
  return add_element(builder, block, location, old.table, id, nodes);
}

/// *ELGEN: up to three directions of (number, node increment, element increment).
void generate_elements(Builder& builder, const Block& block) {
  const std::int32_t set = block.has("ELSET") ? builder.element_set_row(block.value("ELSET")) : -1;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const std::int64_t master = row.integer(0, "master element");
    std::array<std::array<std::int64_t, 3>, 3> directions{};
    for (int d = 0; d < 3; ++d) {
      const bool given = row.has(1 + 3 * d);
      directions[d] = {given ? row.integer(1 + 3 * d, "number of elements") : 1,
                       row.integer_or(2 + 3 * d, 1, "node increment"),
                       row.integer_or(3 + 3 * d, 1, "element increment")};
    }
    row.at_most(10);
    if (!row.ok()) continue;
    std::vector<ElementRef> found;
    if (!builder.elements_of(row.text(0), block, line.location, found)) continue;
    if (set >= 0) builder.add_to_element_set(set, found[0]);
    const auto& [u, v, w] = directions;
    for (std::int64_t k = 0; k < w[0]; ++k) {
      for (std::int64_t j = 0; j < v[0]; ++j) {
        for (std::int64_t i = 0; i < u[0]; ++i) {
          if (i == 0 && j == 0 && k == 0) continue;
          const auto added = copy_element(builder, block, line.location, found[0],
                                          master + i * u[2] + j * v[2] + k * w[2], i * u[1] + j * v[1] + k * w[1]);
          if (added && set >= 0) builder.add_to_element_set(set, *added);
        }
      }
    }
  }
}

void copy_elements(Builder& builder, const Block& block) {
  std::vector<ElementRef> old;
  if (!builder.elements_of(block.value("OLD SET"), block, block.location, old)) return;
  const std::int32_t set = block.has("NEW SET") ? builder.element_set_row(block.value("NEW SET")) : -1;
  const std::int64_t change = block.integer("ELEMENT SHIFT", 0), node_shift = block.integer("SHIFT NODES", 0);
  for (const auto element : old) {
    const std::int64_t id = builder.element_id(element) - builder.scope->element_offset.value_or(0) + change;
    const auto& type = *builder.model.elements[element.table].type;
    const auto order = block.has("REFLECT") ? mirrored_order(type) : std::vector<int>{};
    if (block.has("REFLECT") && order.empty())
      return builder.error(
          block, block.location,
          fmt::format("REFLECT turns solids right side out, and {} is none; leave it out for a set without solids", type.name));
    const auto added = copy_element(builder, block, block.location, element, id, node_shift, order);
    if (added && set >= 0) builder.add_to_element_set(set, *added);
  }
}

const RegisterKeyword element{
    {"ELEMENT", Phase::elements, Place::model, {required(name("TYPE")), name("ELSET"), text("INPUT")}, read_elements}};
const RegisterKeyword elgen{{"ELGEN", Phase::elements, Place::model, {name("ELSET")}, generate_elements}};
const RegisterKeyword elcopy{{"ELCOPY",
                              Phase::elements,
                              Place::model,
                              {required(integer("ELEMENT SHIFT")), required(integer("SHIFT NODES")), required(name("OLD SET")),
                               name("NEW SET"), flag("REFLECT")},
                              copy_elements}};

}  // namespace

}  // namespace balocco::deck
