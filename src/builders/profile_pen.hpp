#pragma once

#include <array>
#include <vector>

#include "model/model.hpp"

namespace balocco {

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

}  // namespace balocco
