// *NSET *ELSET.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// first, last, increment of a GENERATE line.
struct Range {
  std::int64_t first, last, increment;
};

std::optional<Range> range_of(Builder& builder, const Block& block, const DataLine& line) {
  Row row(builder, block, line);
  const Range range{row.integer(0, "first id"),
                    row.integer_or(1, row.has(0) ? row.integer(0, "first id") : 0, "last id"),
                    row.integer_or(2, 1, "increment")};
  row.at_most(3);
  if (row.ok() && (range.increment <= 0 || range.last < range.first)) {
    row.error(fmt::format("{}, {}, {} generates nothing; give first <= last and a positive increment", range.first,
                          range.last, range.increment));
  }
  return row.ok() ? std::optional(range) : std::nullopt;
}

/// Runs `use` in the scope that INSTANCE= names, where ids and names of the data lines live.
template <class Use>
void in_instance(Builder& builder, const Block& block, const Use& use) {
  if (!block.has("INSTANCE")) return use();
  const std::string prefix = block.value("INSTANCE") + ".";
  for (auto& candidate : builder.scopes) {
    if (candidate.prefix != prefix) continue;
    Scope* const outer = builder.scope;
    builder.scope = &candidate;
    use();
    builder.scope = outer;
    return;
  }
  if (!builder.is_poisoned(block.value("INSTANCE"))) {
    builder.error(
        block, block.location,
        fmt::format("instance {} is not defined; correct the name or add *INSTANCE", block.value("INSTANCE")));
  }
}

/// True if a data field can be resolved now; in the first pass what cannot be is tried again later.
bool node_field_known(const Builder& builder, std::string_view field) {
  if (const auto id = parse_integer(field)) return builder.node(*id).has_value();
  return builder.find(builder.node_sets, clean_name(field)).has_value();
}

bool element_field_known(const Builder& builder, std::string_view field) {
  if (const auto id = parse_integer(field)) return builder.element(*id).has_value();
  return builder.find(builder.element_sets, clean_name(field)).has_value();
}

/// What a GENERATE block lists: rows of nodes, or elements; `absent`: ids below the greatest of a node that no node has, each with
/// how many nodes stand before it.
struct Generated {
  std::vector<std::int32_t> nodes;
  std::vector<ElementRef> elements;
  std::vector<std::pair<std::size_t, std::int64_t>> absent;
};

void collect_generated(Builder& builder, const Block& block, bool of_nodes, Generated& list) {
  auto& [nodes, elements, absent] = list;
  const auto& ids = builder.model.nodes.id;
  const std::int64_t greatest = ids.empty() || builder.scope != &builder.scopes.front() ? 0 : std::ranges::max(ids);
  for (const auto& line : block.lines) {
    const auto range = range_of(builder, block, line);
    if (!range) continue;
    const std::size_t before = nodes.size() + elements.size();
    const auto last = std::min(range->last, of_nodes ? std::max(builder.scope->largest_node, greatest) : builder.scope->largest_element);
    for (std::int64_t id = range->first; id <= last; id += range->increment) {
      if (of_nodes) {
        if (const auto row = builder.node(id))
          nodes.push_back(*row);
        else if (id < greatest)
          absent.emplace_back(nodes.size(), id);
      } else if (const auto element = builder.element(id)) {
        elements.push_back(*element);
      }
    }
    if (nodes.size() + elements.size() != before) continue;
    if (builder.first_pass) {
      builder.put_off = true;
    } else if (!(of_nodes ? builder.nodes_incomplete : builder.elements_incomplete)) {
      builder.error(block, line.location, "none of these ids exists; correct the range");
    }
  }
}

void collect_nodes_of_elements(Builder& builder, const Block& block, std::vector<std::int32_t>& nodes) {
  const std::string name = block.value("ELSET");
  if (builder.first_pass && !builder.find(builder.element_sets, name)) {
    builder.put_off = true;
    return;
  }
  std::vector<ElementRef> elements;
  if (!builder.elements_of(name, block, block.location, elements)) return;
  for (const auto element : elements) {
    const auto& table = builder.model.elements[element.table];
    const auto per_element = static_cast<std::ptrdiff_t>(table.connectivity.size() / table.id.size());
    const auto begin = table.connectivity.begin() + element.row * per_element;
    nodes.insert(nodes.end(), begin, begin + per_element);
  }
}

void read_node_set(Builder& builder, const Block& block) {
  Generated list;
  auto& nodes = list.nodes;
  in_instance(builder, block, [&] {
    if (block.has("ELSET")) return collect_nodes_of_elements(builder, block, nodes);
    if (block.has("GENERATE")) return collect_generated(builder, block, true, list);
    std::vector<std::string_view> fields;
    for (const auto& line : block.lines) {
      split(line.text, fields);
      for (const auto field : fields) {
        if (field.empty()) continue;
        if (builder.first_pass && !node_field_known(builder, field)) {
          builder.put_off = true;
          return;
        }
        builder.nodes_of(field, block, line.location, nodes);
      }
    }
  });
  if (builder.put_off) return;
  const std::int32_t set = builder.node_set_row(block.value("NSET"));
  if (block.has("UNSORTED")) builder.unsorted_node_sets.insert(set);
  auto absent = list.absent.begin();
  for (std::size_t i = 0; i <= nodes.size(); ++i) {
    for (; absent != list.absent.end() && absent->first == i; ++absent) builder.add_absent_node(set, absent->second);
    if (i < nodes.size()) builder.add_to_node_set(set, nodes[i]);
  }
}

void read_element_set(Builder& builder, const Block& block) {
  Generated list;
  auto& elements = list.elements;
  in_instance(builder, block, [&] {
    if (block.has("GENERATE")) return collect_generated(builder, block, false, list);
    std::vector<std::string_view> fields;
    for (const auto& line : block.lines) {
      split(line.text, fields);
      for (const auto field : fields) {
        if (field.empty()) continue;
        if (builder.first_pass && !element_field_known(builder, field)) {
          builder.put_off = true;
          return;
        }
        builder.elements_of(field, block, line.location, elements);
      }
    }
  });
  if (builder.put_off) return;
  const std::int32_t set = builder.element_set_row(block.value("ELSET"));
  for (const auto element : elements) builder.add_to_element_set(set, element);
}

const RegisterKeyword nset{
    {"NSET",
     Phase::nodes,
     Place::anywhere,
     {required(name("NSET")), flag("GENERATE"), flag("UNSORTED"), flag("INTERNAL"), name("INSTANCE"), name("ELSET"),
      foreign("FREQUENCY")},
     read_node_set}};
const RegisterKeyword elset{
    {"ELSET",
     Phase::elements,
     Place::anywhere,
     {required(name("ELSET")), flag("GENERATE"), flag("UNSORTED"), flag("INTERNAL"), name("INSTANCE")},
     read_element_set}};

}  // namespace

}  // namespace balocco::deck
