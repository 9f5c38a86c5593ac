// Normals of the smooth surface at the corners of shells: what their directors start from.
#pragma once

#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Normals that the deck gives: fields 5 to 7 of *NODE for all elements at a node, *NORMAL for one element there. Unit
/// vectors by node row.
struct GivenNormals {
  std::unordered_map<std::int32_t, Point> at_node;
  std::map<std::pair<ElementRef, std::int32_t>, Point> at_corner;
};

/// Neighbours in a smooth surface whose normals point to opposite sides.
struct OpposedShells {
  ElementRef first, second;
};

/// Fills ElementTable::corner_normal of all shells. Where nothing is given, the elements of a node whose normals lie
/// within 20 degrees of each other share their mean, so that folds and junctions keep their angles (Abaqus's rule).
std::vector<OpposedShells> set_corner_normals(Model& model, const GivenNormals& given);

}  // namespace balocco
