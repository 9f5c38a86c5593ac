// Shape functions of faces whose number of nodes (3, 4, 6 or 8, corners first) is known at run time; see face_shapes.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "elements/face_shapes.hpp"

namespace balocco {

inline constexpr std::size_t most_face_nodes = 8;

/// Of a face with fewer nodes the last entries are zero.
struct AnyFaceShapes {
  std::array<double, most_face_nodes> value{}, by_xi{}, by_eta{};
};

constexpr bool is_triangle(std::size_t nodes) { return nodes == 3 || nodes == 6; }
constexpr std::size_t corners_of_face(std::size_t nodes) { return is_triangle(nodes) ? 3 : 4; }

namespace detail {

template <class Face>
AnyFaceShapes any_shapes(double xi, double eta) {
  const auto shapes = Face::at(xi, eta);
  AnyFaceShapes result;
  std::ranges::copy(shapes.value, result.value.begin());
  std::ranges::copy(shapes.by_xi, result.by_xi.begin());
  std::ranges::copy(shapes.by_eta, result.by_eta.begin());
  return result;
}

}  // namespace detail

inline AnyFaceShapes face_shapes(std::size_t nodes, double xi, double eta) {
  switch (nodes) {
    case 3: return detail::any_shapes<LinearTriangleFace>(xi, eta);
    case 6: return detail::any_shapes<QuadraticTriangleFace>(xi, eta);
    case 8: return detail::any_shapes<SerendipityFace>(xi, eta);
    default: return detail::any_shapes<BilinearFace>(xi, eta);
  }
}

/// Places where a field over the face is integrated, exactly for products of two shape functions of a plane face with straight edges.
inline std::vector<FaceStation> face_stations(std::size_t nodes) {
  const auto list = [](const auto& stations) { return std::vector<FaceStation>(stations.begin(), stations.end()); };
  constexpr double sixth = 1.0 / 6.0, rest = 2.0 / 3.0;
  switch (nodes) {
    case 3: return {{sixth, sixth, sixth}, {rest, sixth, sixth}, {sixth, rest, sixth}};
    case 6: return list(QuadraticTriangleFace::stations());
    case 8: return list(SerendipityFace::stations());
    default: return list(BilinearFace::stations());
  }
}

}  // namespace balocco
