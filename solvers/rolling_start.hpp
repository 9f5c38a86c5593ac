// How what rolls starts: about its axis as the state stands, and so that its material runs through its deformed shape.
#pragma once

#include <optional>
#include <vector>

#include "math/tensor.hpp"

namespace balocco {

struct RotationAxis {
  Vector3<double> point{}, direction{};  // the direction is a unit vector
};

using Flow = std::vector<std::optional<Vector3<double>>>;

/// Velocity for a spin of one about `now` that leaves the shape of circles of nodes as it is, less that of a rigid spin: in steady
/// rolling each node comes, after a while, to where its neighbour on its circle is. Circles are those about `before` in the
/// undeformed model; nodes on none (gaps wider than an eighth of a turn) get nothing: they spin rigidly.
Flow flow_through_shape(const std::vector<Vector3<double>>& undeformed, const std::vector<Vector3<double>>& deformed,
                        const RotationAxis& before, const RotationAxis& now);

}  // namespace balocco
