#include "deck_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "constraints/rigid_body.hpp"
#include "deck/builder.hpp"
#include "deck/digest.hpp"
#include "deck/element_spellings.hpp"
#include "deck/groups.hpp"
#include "deck/held_rotations.hpp"
#include "deck/schedule.hpp"
#include "deck/shell_sections.hpp"
#include "deck/tokens.hpp"
#include "deck/updated_stresses.hpp"
#include "model/check.hpp"
#include "model/diagnostics.hpp"
#include "model/rigid_constraints.hpp"

namespace balocco::deck {

namespace {

void run_task(Builder& builder, const Task& task) {
  builder.scope = task.scope;
  builder.in_step = task.in_step;
  task.rule->handler(builder, *task.block);
}

void run_phase(Builder& builder, const std::vector<Task>& tasks, Phase phase) {
  for (const auto& task : tasks) {
    if (task.phase == phase) run_task(builder, task);
  }
}

/// Nodes and elements. Sets may list what is defined further down: they are tried again as long as that helps.
void build_mesh(Builder& builder, const std::vector<Task>& tasks) {
  std::vector<const Task*> waiting;
  const auto attempt = [&](const Task& task) {
    builder.put_off = false;
    run_task(builder, task);
    if (builder.put_off) waiting.push_back(&task);
  };
  builder.first_pass = true;
  for (const Phase phase : {Phase::nodes, Phase::elements}) {
    for (const auto& task : tasks) {
      if (task.phase == phase) attempt(task);
    }
  }
  for (std::size_t before = waiting.size() + 1; waiting.size() < before && !waiting.empty();) {
    before = waiting.size();
    const auto again = std::move(waiting);
    waiting.clear();
    for (const Task* task : again) attempt(*task);
  }
  builder.first_pass = builder.put_off = false;
  for (const Task* task : waiting) run_task(builder, *task);
  builder.normalize_sets();
}

/// Gives back what only a reader needs: the room in which tables grew, and the index of node ids, larger than the coordinates.
void trim(Model& model) {
  model.nodes.row_of_id = {};
  const auto shrink = [](auto&... tables) { (tables.shrink_to_fit(), ...); };
  shrink(model.nodes.id, model.nodes.coordinates, model.nodes.location);
  for (auto& table : model.elements) shrink(table.id, table.connectivity, table.section, table.location);
  for (auto& set : model.node_sets) shrink(set.nodes);
  for (auto& set : model.element_sets) shrink(set.elements);
}

void throw_if_wrong(const Diagnostics& diagnostics, const std::vector<std::string>& files) {
  if (diagnostics.number_of_errors() > 0) throw InputError(diagnostics.errors(files));
}

}  // namespace

}  // namespace balocco::deck

namespace balocco {

FileLoader file_loader() {
  return [](const std::string& path) -> std::optional<std::string> {
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path)) return std::nullopt;
    std::ostringstream text;
    text << file.rdbuf();
    return std::move(text).str();
  };
}

ReadResult read_deck(const std::string& path, const FileLoader& loader, const ReadOptions& options) {
  using namespace deck;
  register_material_laws();
  Diagnostics diagnostics;
  Tokens tokens = tokenize(path, loader, diagnostics);
  Builder builder(diagnostics);
  builder.model.name = std::filesystem::path(path).stem().string();
  builder.model.files = tokens.files;
  builder.model.deck_sha256 = digest(tokens.texts);
  if (tokens.blocks.empty() && diagnostics.number_of_errors() == 0) {
    diagnostics.error({0, 1}, "", "the deck is empty; it needs at least nodes, elements and a step");
  }
  builder.text_incomplete = builder.nodes_incomplete = builder.elements_incomplete = diagnostics.number_of_errors() > 0;
  const auto tasks = schedule(builder, tokens.blocks, options);
  run_phase(builder, tasks, Phase::definitions);
  build_mesh(builder, tasks);
  run_phase(builder, tasks, Phase::surfaces);
  if (const auto& import = builder.model.state_import;
      import && import->update && options.move_imported_nodes && diagnostics.number_of_errors() == 0)
    options.move_imported_nodes(builder.model);
  run_phase(builder, tasks, Phase::sections);
  keep_updated_stresses(builder);
  run_phase(builder, tasks, Phase::constraints);
  hold_rotations(builder);
  run_phase(builder, tasks, Phase::history);
  throw_if_wrong(diagnostics, tokens.files);
  const auto implied = drop_implied_joints(builder.model);
  join_rigid_clouds(builder.model);
  auto found = check_model(builder.model);
  if (!found.errors.empty()) {
    found.errors.resize(std::min(found.errors.size(), Diagnostics::greatest_number_of_errors));
    throw InputError(std::move(found.errors));
  }
  place_reference_nodes(builder.model);
  carry_joined_nodes(builder.model);
  finish_shells(builder);
  check_hybrids(builder);
  throw_if_wrong(diagnostics, tokens.files);
  finish_output(builder);  // asks the elements, so the model must be sound
  throw_if_wrong(diagnostics, tokens.files);
  auto warnings = diagnostics.warnings(tokens.files);
  warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
  if (implied) warnings.push_back(*implied);
  trim(builder.model);
  return {std::move(builder.model), std::move(warnings)};
}

}  // namespace balocco
