// Faces S1 .. S6 of solids in Abaqus's numbering, local nodes counter-clockwise seen from outside.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "elements/solids/nodal_shapes.hpp"

namespace balocco {

/// S1 1-2-3-4, S2 5-8-7-6, S3 1-5-6-2, S4 2-6-7-3, S5 3-7-8-4, S6 4-8-5-1 (all turned so that normals point outwards).
inline std::vector<std::vector<int>> hexahedron_faces() {
  return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
}

/// S1 1-2-3, S2 4-6-5, S3 1-4-5-2, S4 2-5-6-3, S5 3-6-4-1.
inline std::vector<std::vector<int>> wedge_faces() {
  return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
}

/// S1 1-2-3, S2 1-4-2, S3 2-4-3, S4 3-4-1.
inline std::vector<std::vector<int>> tetrahedron_faces() {
  return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
}

/// Of each face the nodes in the middle of its edges, edge after edge; `edges`: corners of the edges whose middles follow the
/// `corners` corners of the element.
inline std::vector<std::vector<int>> midsides(const std::vector<std::vector<int>>& faces, std::span<const std::array<int, 2>> edges,
                                              int corners) {
  std::vector<std::vector<int>> result;
  for (const auto& face : faces) {
    auto& middles = result.emplace_back();
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int first = face[i], second = face[(i + 1) % face.size()];
      for (std::size_t edge = 0; edge < edges.size(); ++edge)
        if (edges[edge] == std::array{first, second} || edges[edge] == std::array{second, first})
          middles.push_back(corners + static_cast<int>(edge));
    }
  }
  return result;
}

}  // namespace balocco
