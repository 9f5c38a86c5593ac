#include "imported_mesh.hpp"

#include <algorithm>

#include "checkpoint_file.hpp"
#include "model_identity.hpp"

namespace balocco {

void move_imported_nodes(const std::string& path, ImportedShape shape, Model& model) {
  const auto file = open_checkpoint(path);
  const ModelIdentity identity(*file);
  const bool of_other_job = shape == ImportedShape::positions_of_other_job;
  if (of_other_job) {
    refuse_other_step(*file, path, model);
    refuse_other_nodes(identity, path, model);
    refuse_other_elements(identity, path, model, ImportedSections::any);
  }
  const auto positions = of_other_job ? file->read("/position") : std::vector<double>{};
  for (const auto row : model.state_import->nodes) {
    const auto there = identity.row_of_node(model.nodes.id[row]);
    if (there < 0) continue;  // of another deck, which the reader of its state tells
    auto& here = model.nodes.coordinates[row];
    if (of_other_job)
      std::copy_n(positions.begin() + 3 * there, 3, here.begin());
    else
      here = identity.coordinates(there);
  }
}

}  // namespace balocco
