// *IMPORT, UPDATE=YES: the shape that another job has given to a mesh becomes its reference configuration.
#pragma once

#include <string>

#include "model/model.hpp"

namespace balocco {

/// Whose checkpoint is read: that of the job to import from, for the positions of nodes, or the job's own, for the coordinates that
/// it has given them.
enum class ImportedShape { positions_of_other_job, own_coordinates };

/// Gives the nodes of Model::state_import those coordinates. Every rank reads the same.
/// @throws InputError where the other job does not have the imported nodes and elements, or another mesh there
void move_imported_nodes(const std::string& path, ImportedShape shape, Model& model);

/// *IMPORT, STATE=YES, UPDATE=YES: the model with the reference configuration, and the sections free of stress, of the other job.
Model model_before_update(const std::string& path, const Model& model);

}  // namespace balocco
