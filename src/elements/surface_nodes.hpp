// Nodes of faces and surfaces, as model rows.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Of a face, corners first.
std::vector<std::int32_t> face_nodes(const Model& model, const FaceRef& face);

/// Of all faces of a surface and those named one by one, sorted, without repetition.
std::vector<std::int32_t> surface_nodes(const Model& model, const Surface& surface);

}  // namespace balocco
