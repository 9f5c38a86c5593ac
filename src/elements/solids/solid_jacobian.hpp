// Is a solid folded? The Jacobian of its undeformed shape at the integration points of full integration.
#pragma once

#include <span>

#include "elements/element_type.hpp"

namespace balocco {

struct SmallestJacobian {
  double determinant = 0.0;  // least det dX/dxi
  int point = 0;             // where, from 0
};

/// Of any solid; of reduced bricks at all eight, or 27, points, where their hourglass modes live.
SmallestJacobian smallest_jacobian(Shape shape, std::span<const Point> nodes);

}  // namespace balocco
