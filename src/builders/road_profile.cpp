#include "builders/road_profile.hpp"

namespace balocco {
namespace {

/// A profile that grows piece by piece from where it ended.
class ProfilePen {
 public:
  explicit ProfilePen(std::array<double, 2> start) : at_(start) {}
  void line_to(double along, double up) {
    if (along == at_[0] && up == at_[1]) return;
    segments_.push_back({ProfileSegment::Kind::line, at_, {along, up}, {}, false});
    at_ = {along, up};
  }
  void arc_to(double along, double up, double centre_along, double centre_up, bool counter_clockwise) {
    if (along == at_[0] && up == at_[1]) return;
    segments_.push_back({ProfileSegment::Kind::arc, at_, {along, up}, {centre_along, centre_up}, counter_clockwise});
    at_ = {along, up};
  }
  std::vector<ProfileSegment> segments() const { return segments_; }

 private:
  std::array<double, 2> at_;
  std::vector<ProfileSegment> segments_;
};

}  // namespace

std::vector<ProfileSegment> road_profile(const RoadSpec& road) {
  ProfilePen pen({-road.behind, 0.0});
  if (road.obstacle_height > 0.0) {
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
  pen.line_to(road.ahead, 0.0);
  return pen.segments();
}

AnalyticalSurface road_surface(const RoadSpec& road, const Point& origin) {
  // Right-handed: along x up = -y.
  return {AnalyticalSurface::Kind::extruded, origin, {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, road_profile(road)};
}

}  // namespace balocco
