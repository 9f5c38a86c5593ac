// The part of a results file that never changes: who wrote it, nodes, elements, parts, sets and analytical surfaces.
//
// Ids are unique in the model: those of an instance are the part's plus an offset. /mesh/node/instance and part_id, and the same of
// each element type, lead back to the deck's: the index of /mesh/instance/<i> (name, part; 0: the assembly) and the id there.
#pragma once

#include "hdf5_file.hpp"
#include "model/model.hpp"

namespace balocco {

/// Writes the attributes of the file and /mesh. @throws SystemError.
void write_mesh(const Hdf5File& file, const Model& model);

}  // namespace balocco
