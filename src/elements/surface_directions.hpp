// Local directions in a surface: how Abaqus turns an orientation, or its default, into two axes of membranes and
// shells.
#pragma once

#include <optional>

#include "math/tensor.hpp"
#include "model/model.hpp"

namespace balocco {

struct SurfaceDirections {
  Vector3<double> first, second;  // orthonormal; normal = first x second
};

/// Directions at `point` of a surface with unit `normal`: the orientation's axis, projected and turned by its
/// additional rotation; without orientation (null) the global x axis projected, z where x lies within 0.1 degrees of
/// the normal.
/// @return nothing if that axis is along the normal.
std::optional<SurfaceDirections> surface_directions(const Orientation* orientation, const Vector3<double>& point,
                                                    const Vector3<double>& normal);

}  // namespace balocco
