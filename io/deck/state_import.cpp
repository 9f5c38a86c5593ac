// *IMPORT, *IMPORT ELSET, *IMPORT NSET: what starts from the last state of another job. The mesh itself stands in the deck, as it
// was before any deformation.
#include <algorithm>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

StateImport& state_import(Builder& builder, const Block& block) {
  auto& import = builder.model.state_import;
  if (!import)
    import = StateImport{.state = true, .update = false, .step = {}, .elements = {}, .nodes = {}, .location = block.location};
  return *import;
}

template <class Members>
void sort_members(Members& members) {
  std::ranges::sort(members);
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

void add_elements(Builder& builder, const Block& block, StateImport& import) {
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field)
      if (row.has(field)) builder.elements_of(row.text(field), block, line.location, import.elements);
  }
  sort_members(import.elements);
  for (const auto& element : import.elements) {
    const auto& table = builder.model.elements[element.table];
    const auto first = table.connectivity.begin() + static_cast<std::ptrdiff_t>(element.row) * table.type->nodes;
    import.nodes.insert(import.nodes.end(), first, first + table.type->nodes);
  }
  sort_members(import.nodes);
}

void read_import(Builder& builder, const Block& block) {
  const bool state = block.value("STATE", "YES") == "YES", update = block.value("UPDATE") == "YES";
  if (state && update)
    builder.error(
        block, block.location,
        "UPDATE=YES with STATE=YES is not supported: laws here find stresses from the deformation since the reference "
        "configuration, so that stresses go on exactly with UPDATE=NO alone; import with UPDATE=NO, or the mesh alone with "
        "STATE=NO");
  if (!state && !update)
    builder.error(block, block.location,
                  "STATE=NO with UPDATE=NO is not supported: elements here would find the stresses of the deformation that is "
                  "imported; import the deformed mesh free of stress with UPDATE=YES");
  for (const char* parameter : {"INCREMENT", "INTERVAL", "ITERATION"})
    if (block.has(parameter))
      builder.error(block, block.location,
                    std::string(parameter) + ": a checkpoint holds the last state of its job alone; leave it out, or end that job there");
  if (block.lines.empty()) builder.error(block, block.location, "sets of elements to import are missing; name them on data lines");
  auto& import = state_import(builder, block);
  import.state = state;
  import.update = update;
  if (block.has("STEP")) import.step = static_cast<std::int32_t>(block.integer("STEP", 0));
  add_elements(builder, block, import);
}

void read_elements(Builder& builder, const Block& block) { add_elements(builder, block, state_import(builder, block)); }

void read_nodes(Builder& builder, const Block& block) {
  auto& import = state_import(builder, block);
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field)
      if (row.has(field)) builder.nodes_of(row.text(field), block, line.location, import.nodes);
  }
  sort_members(import.nodes);
}

const RegisterKeyword import_keyword({
    .keyword = "IMPORT",
    .phase = Phase::surfaces,
    .parameters = {choice("STATE", {"YES", "NO"}), required(choice("UPDATE", {"YES", "NO"})), integer("STEP"), integer("INCREMENT"),
                   integer("INTERVAL"), integer("ITERATION")},
    .handler = read_import,
});

const RegisterKeyword import_elset({.keyword = "IMPORT ELSET", .phase = Phase::surfaces, .handler = read_elements});
const RegisterKeyword import_nset({.keyword = "IMPORT NSET", .phase = Phase::surfaces, .handler = read_nodes});

}  // namespace

}  // namespace balocco::deck
