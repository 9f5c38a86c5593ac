// The profile of a flat road with a rectangular obstacle, or with a pothole.
#pragma once

#include <vector>

#include "builders/tyre_spec.hpp"
#include "model/model.hpp"

namespace balocco {

/// Lines and arcs from -behind to ahead at height 0, in the plane (along, up): an obstacle with rounded top edges and a
/// rounded foot stands between obstacle_start and obstacle_start + obstacle_length; a pothole with ramps follows it. The
/// outward normal points up.
std::vector<ProfileSegment> road_profile(const RoadSpec& road);

/// The same as a surface extruded along y: `origin` lies at the wheel's foot on the road, x along, z up.
AnalyticalSurface road_surface(const RoadSpec& road, const Point& origin);

}  // namespace balocco
