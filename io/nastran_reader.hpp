// Reads shells from Nastran bulk data: GRID, CQUAD4, CTRIA3, PSHELL, MAT1, CORD2R, CORD2C.
#pragma once

#include <string>

#include "model/model.hpp"

namespace balocco {

struct NastranMesh {
  Model model;  // nodes that elements use, S4R and S3R, a set and a section of each property, materials; in the file's units
  std::string summary;  // lines: what was read, and what was not taken over
};

/// @throws InputError "FILE:LINE: error: CARD ID: ..." with up to 20 messages; cards without which the mesh would be another are
/// refused.
NastranMesh read_nastran(const std::string& text, const std::string& file_name);

}  // namespace balocco
