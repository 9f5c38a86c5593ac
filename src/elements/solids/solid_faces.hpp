// Faces S1 .. S6 of solids in Abaqus's numbering, local nodes counter-clockwise seen from outside.
#pragma once

#include <vector>

namespace balocco {

/// S1 1-2-3-4, S2 5-8-7-6, S3 1-5-6-2, S4 2-6-7-3, S5 3-7-8-4, S6 4-8-5-1 (all turned so that normals point outwards).
inline std::vector<std::vector<int>> hexahedron_faces() {
  return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
}

/// S1 1-2-3, S2 4-6-5, S3 1-4-5-2, S4 2-5-6-3, S5 3-6-4-1.
inline std::vector<std::vector<int>> wedge_faces() {
  return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
}

}  // namespace balocco
