// The part of a results file that never changes: who wrote it, nodes, elements, parts, sets and analytical surfaces.
#pragma once

#include "hdf5_file.hpp"
#include "model/model.hpp"

namespace balocco {

/// Writes the attributes of the file and /mesh. @throws SystemError.
void write_mesh(const Hdf5File& file, const Model& model);

}  // namespace balocco
