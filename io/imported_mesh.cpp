#include "imported_mesh.hpp"

#include <algorithm>

#include "checkpoint_file.hpp"
#include "model_identity.hpp"

namespace balocco {

void move_imported_nodes(const std::string& path, ImportedShape shape, Model& model) {
  const auto file = open_checkpoint(path);
  const ModelIdentity identity(*file);
  const bool of_other_job = shape == ImportedShape::positions_of_other_job;
  const auto& import = *model.state_import;
  std::vector<Point> ways;  // of copies
  if (of_other_job) {
    refuse_other_step(*file, path, model);
    ways = refuse_other_nodes(identity, path, model);
    refuse_other_elements(identity, path, model, ImportedSections::any);
  }
  const auto positions = of_other_job ? file->read("/position") : std::vector<double>{};
  for (const auto row : import.nodes) {
    const auto there = identity.row_of_node(of_other_job ? id_there(model, row) : model.nodes.id[row]);
    if (there < 0) continue;  // of another deck, which the reader of its state tells
    auto& here = model.nodes.coordinates[row];
    if (!of_other_job) {
      here = identity.coordinates(there);
      continue;
    }
    std::copy_n(positions.begin() + 3 * there, 3, here.begin());
    if (const auto* const copy = import.copy_of(row))
      for (int c = 0; c < 3; ++c) here[c] += ways[static_cast<std::size_t>(copy - import.copies.data())][c];
  }
}

Model model_before_update(const std::string& path, const Model& model) {
  const ModelIdentity identity(*open_checkpoint(path));
  Model before = model;
  before.state_import->update = false;
  before.initial_fields.clear();
  for (const auto row : before.state_import->nodes)
    before.nodes.coordinates[row] = identity.coordinates(identity.row_of_node(model.nodes.id[row]));
  for (const auto& element : before.state_import->elements)
    if (const auto section = before.elements[element.table].section[element.row]; section >= 0)
      before.sections[section].initially_stressed = false;
  return before;
}

}  // namespace balocco
