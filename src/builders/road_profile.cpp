#include "builders/road_profile.hpp"

#include <cmath>

#include "builders/profile_pen.hpp"

namespace balocco {
namespace {

void draw_obstacle(const RoadSpec& road, ProfilePen& pen) {
  const double foot = road.foot_fillet, top = road.top_fillet, height = road.obstacle_height;
  const double front = road.obstacle_start, back = front + road.obstacle_length;
  pen.line_to(front - foot, 0.0);
  pen.arc_to(front, foot, front - foot, foot, true);
  pen.line_to(front, height - top);
  pen.arc_to(front + top, height, front + top, height - top, false);
  pen.line_to(back - top, height);
  pen.arc_to(back, height - top, back - top, height - top, false);
  pen.line_to(back, foot);
  pen.arc_to(back + foot, 0.0, back + foot, foot, true);
}

void draw_pothole(const PotholeSpec& hole, ProfilePen& pen) {
  const double slope = std::atan2(hole.depth, hole.ramp), r = hole.fillet, flat = r * std::tan(0.5 * slope);
  const double along = flat * std::cos(slope), up = flat * std::sin(slope), floor = -hole.depth;
  const double near = hole.start, down = near + hole.ramp, far = near + hole.length, rise = far - hole.ramp;  // the edges
  pen.line_to(near - flat, 0.0);
  pen.arc_to(near + along, -up, near - flat, -r, false);
  pen.line_to(down - along, floor + up);
  pen.arc_to(down + flat, floor, down + flat, floor + r, true);
  pen.line_to(rise - flat, floor);
  pen.arc_to(rise + along, floor + up, rise - flat, floor + r, true);
  pen.line_to(far - along, -up);
  pen.arc_to(far + flat, 0.0, far + flat, -r, false);
}

}  // namespace

std::vector<ProfileSegment> road_profile(const RoadSpec& road) {
  ProfilePen pen({-road.behind, 0.0});
  if (road.obstacle_height > 0.0) draw_obstacle(road, pen);
  if (road.pothole.depth > 0.0) draw_pothole(road.pothole, pen);
  pen.line_to(road.ahead, 0.0);
  return pen.segments();
}

AnalyticalSurface road_surface(const RoadSpec& road, const Point& origin) {
  // Right-handed: along x up = -y.
  return {AnalyticalSurface::Kind::extruded, origin, {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, road_profile(road)};
}

}  // namespace balocco
