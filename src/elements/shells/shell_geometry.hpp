// Reference geometry of one shell element, seen along its mean normal: local directions, gradients, the hourglass mode,
// and the points at which its fields are integrated.
#pragma once

#include <array>

#include "math/tensor.hpp"
#include "model/model.hpp"

namespace balocco {

/// A point of the flattened element.
struct ShellPoint {
  double area = 0.0;                           // weight times area element
  std::array<double, 2> natural{};             // xi, eta; triangles: r, s
  std::array<double, 4> natural_gradient{};    // d xi / d 1, d eta / d 1, d xi / d 2, d eta / d 2
  std::array<double, 2> hourglass_gradient{};  // quadrilaterals: g in B_q = B + g gamma^T
  std::array<double, 4> shape{};               // of the corners
};

struct ShellGeometry {
  int corners = 0, points = 0;                     // quadrilaterals: 2 x 2 Gauss points, triangles: 3
  Vector3<double> direction1, direction2, normal;  // orthonormal
  std::array<Vector3<double>, 4> edge, director;   // X_I - X_0; unit normals of the smooth surface at the corners
  std::array<double, 4> gradient1{}, gradient2{};  // mean of dN_I / d(direction), 1 / length
  std::array<double, 4> gamma{};                   // hourglass mode without its affine part
  std::array<double, 4> nodal_area{};
  std::array<ShellPoint, 4> point;
  double area = 0.0;
  double length = 0.0;      // area / longest side (triangles: twice that, the smallest height)
  double warp = 0.0;        // gamma . X along the normal: not zero if the element is not flat
  std::array<std::array<double, 2>, 2> mid_line{};      // quadrilaterals: d X / d xi and d X / d eta in the middle
};

/// @throws InputError if the element has no area, is folded, a corner's normal lies in its surface, or the section's
/// orientation gives no direction there.
ShellGeometry shell_geometry(const Model& model, ElementRef element, const Section& section);

}  // namespace balocco
