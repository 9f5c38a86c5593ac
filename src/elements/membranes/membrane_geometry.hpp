// Reference geometry of one membrane element: local directions, shape function gradients and the constants of its hourglass mode.
#pragma once

#include <array>

#include "math/tensor.hpp"
#include "model/model.hpp"

namespace balocco {

/// One integration point: orthonormal directions in the surface, normal = direction1 x direction2, and gradients along them.
struct MembranePoint {
  Vector3<double> direction1, direction2;
  std::array<double, 4> gradient1{}, gradient2{};  // dN_I / d(direction), 1 / length
  double area = 0.0;                               // weight times area element
};

/// A symmetric tensor in the local directions.
struct PlaneTensor {
  double c11 = 0.0, c22 = 0.0, c12 = 0.0;
};

/// Splits a quadrilateral's gradients as B_q = B + g_q gamma^T: the mean B acts on affine motions, gamma on the hourglass mode
/// h = (1, -1, 1, -1) only (Flanagan & Belytschko, Int. J. Num. Meth. Eng. 17, 1981). Exact for flat elements.
struct HourglassMode {
  std::array<double, 4> gamma{};
  PlaneTensor mean_gg;               // area mean of g (x) g, 1 / length^2
  double greatest_gradient = 0.0;    // max |g_q|
  double axis_angle = 0.0;           // from direction1 to the element's own first axis
  double warp = 0.0;                 // gamma . X along the normal: not zero if the reference element is not flat
  double gradient_residual = 0.0;    // largest |B_q - B - g_q gamma| / |B|: not zero if the element is not flat
};

struct MembraneGeometry {
  int points = 0;
  std::array<MembranePoint, 4> point;
  std::array<double, 4> nodal_area{};  // integral of N_I dA
  std::array<double, 4> mean_gradient1{}, mean_gradient2{};
  double area = 0.0;
  double characteristic_length = 0.0;  // area / longest side (triangles: twice that, the smallest height)
  HourglassMode hourglass;             // quadrilaterals
};

/// Geometry of a three-node (1 point) or four-node element (1 or 2 x 2 points) with the directions of the section's orientation.
/// @throws InputError if the element has no area, is folded, or the orientation gives no direction in its surface.
MembraneGeometry membrane_geometry(const Model& model, ElementRef element, const Section& section, int points);

}  // namespace balocco
