// *IMPORT, *IMPORT ELSET, *IMPORT NSET: what starts from a state of another job. The mesh itself stands in the deck, as it
// was before any deformation. ELEMENT SHIFT and SHIFT NODES, of *ELCOPY, say that elements go on from those of other numbers: so that
// several copies of a part, wherever they stand, start from the state of one.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/state_choice.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

StateImport& state_import(Builder& builder, const Block& block) {
  auto& import = builder.model.state_import;
  if (!import)
    import = StateImport{.state = true, .update = false, .choice = {}, .elements = {}, .nodes = {}, .copies = {}, .location = block.location};
  return *import;
}

template <class Members>
void sort_members(Members& members) {
  std::ranges::sort(members);
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

template <class Members>
void merge_members(const Members& members, Members& all) {
  all.insert(all.end(), members.begin(), members.end());
  sort_members(all);
}

/// What a block imports goes on from members of numbers less its shifts.
void take_over(Builder& builder, const Block& block, ImportedCopy part, StateImport& import) {
  sort_members(part.elements);
  sort_members(part.nodes);
  const bool is_copy = part.node_shift != 0 || part.element_shift != 0;
  const auto refuse_twice = [&](const auto& member, const auto& all, const std::string& name) {
    if (!std::ranges::binary_search(all, member)) return false;
    const auto* const before = import.copy_of(member);
    if (before == nullptr ? !is_copy : before->node_shift == part.node_shift && before->element_shift == part.element_shift) return false;
    builder.error(block, block.location, fmt::format("{} is imported twice, from different numbers of the other job; name it once", name));
    return true;
  };
  const auto& model = builder.model;
  if (is_copy && !model.instances.empty())
    return builder.error(block, block.location,
                         "ELEMENT SHIFT and SHIFT NODES speak of numbers as the deck has them, which instances have not; write that part flat");
  for (const auto& element : part.elements)
    if (refuse_twice(element, import.elements, fmt::format("element {}", model.element_name(element)))) return;
  for (const auto node : part.nodes)
    if (refuse_twice(node, import.nodes, fmt::format("node {}", model.node_name(node)))) return;
  merge_members(part.elements, import.elements);
  merge_members(part.nodes, import.nodes);
  if (is_copy) import.copies.push_back(std::move(part));
}

ImportedCopy elements_of(Builder& builder, const Block& block) {
  ImportedCopy part;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field)
      if (row.has(field)) builder.elements_of(row.text(field), block, line.location, part.elements);
  }
  for (const auto& element : part.elements) {
    const auto& table = builder.model.elements[element.table];
    const auto first = table.connectivity.begin() + static_cast<std::ptrdiff_t>(element.row) * table.type->nodes;
    std::copy_if(first, first + table.type->nodes, std::back_inserter(part.nodes), [](std::int32_t node) { return node >= 0; });
  }
  return part;
}

bool is_of_one_state(const StateImport& import, bool state, bool update, const StateChoice& choice) {
  return import.state == state && import.update == update && import.choice == choice;
}

void read_import(Builder& builder, const Block& block) {
  if (builder.model.nodes.size() == 0)
    return builder.error(block, block.location,
                         "the mesh is missing: a checkpoint holds the state alone; say nodes, elements and sections as the first deck did, "
                         "by *INCLUDE, INPUT=FIRST.inp or what of it they stand in, before this line");
  const bool state = block.value("STATE", "YES") == "YES", update = block.value("UPDATE") == "YES";
  if (!state && !update)
    builder.error(block, block.location,
                  "STATE=NO with UPDATE=NO is not supported: elements here would find the stresses of the deformation that is "
                  "imported; import the deformed mesh free of stress with UPDATE=YES");
  if (block.has("ITERATION")) builder.error(block, block.location, "ITERATION: states between iterations are not kept; leave it out, or say INCREMENT");
  if (block.lines.empty()) builder.error(block, block.location, "sets of elements to import are missing; name them on data lines");
  const auto choice = read_state_choice(builder, block, "INCREMENT");
  if (const auto& before = builder.model.state_import; before && !is_of_one_state(*before, state, update, choice))
    builder.error(block, block.location,
                  fmt::format("STATE, UPDATE, STEP, INCREMENT and INTERVAL differ from those of {}; one state is imported, give them alike", builder.model.where(before->location)));
  auto& import = state_import(builder, block);
  import.state = state;
  import.update = update;
  import.choice = choice;
  auto part = elements_of(builder, block);
  part.element_shift = block.integer("ELEMENT SHIFT", 0);
  part.node_shift = block.integer("SHIFT NODES", 0);
  if (state && update && (part.element_shift != 0 || part.node_shift != 0))
    return builder.error(block, block.location, "copies (ELEMENT SHIFT, SHIFT NODES) go on from their state with UPDATE=NO alone; give that");
  take_over(builder, block, std::move(part), import);
}

void read_imported_elements(Builder& builder, const Block& block) { take_over(builder, block, elements_of(builder, block), state_import(builder, block)); }

void read_imported_nodes(Builder& builder, const Block& block) {
  ImportedCopy part;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field)
      if (row.has(field)) builder.nodes_of(row.text(field), block, line.location, part.nodes);
  }
  take_over(builder, block, std::move(part), state_import(builder, block));
}

const RegisterKeyword import_keyword({
    .keyword = "IMPORT",
    .phase = Phase::surfaces,
    .parameters = {choice("STATE", {"YES", "NO"}), required(choice("UPDATE", {"YES", "NO"})), integer("STEP"), integer("INCREMENT"),
                   integer("INTERVAL"), integer("ITERATION"), integer("ELEMENT SHIFT"), integer("SHIFT NODES")},
    .handler = read_import,
});

const RegisterKeyword import_elset({.keyword = "IMPORT ELSET", .phase = Phase::surfaces, .handler = read_imported_elements});
const RegisterKeyword import_nset({.keyword = "IMPORT NSET", .phase = Phase::surfaces, .handler = read_imported_nodes});

}  // namespace

}  // namespace balocco::deck
