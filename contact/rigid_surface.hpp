// An analytical rigid surface in the frame of its body: signed distance and outward normal in space.
#pragma once

#include <cmath>

#include "math/tensor.hpp"
#include "profile.hpp"
#include "surface_point.hpp"

namespace balocco {

class RigidSurface {
 public:
  RigidSurface() = default;
  /// `reference`: initial place of the body's reference node, the origin of the body frame.
  RigidSurface(const AnalyticalSurface& surface, const Point& reference)
      : profile_(surface.profile), revolved_(surface.kind == AnalyticalSurface::Kind::revolved) {
    for (int i = 0; i < 3; ++i) {
      origin_[i] = surface.origin[i] - reference[i];
      for (int j = 0; j < 3; ++j) axes_(i, j) = surface.axes[i][j];
    }
  }

  bool empty() const { return profile_.empty(); }

  /// True only if the distance is positive; far cheaper than the distance.
  bool surely_outside(const Vector3<double>& place) const {
    const Vector3<double> arm{place[0] - origin_[0], place[1] - origin_[1], place[2] - origin_[2]};
    const double first = along(0, arm), third = along(2, arm);
    return profile_.surely_outside({revolved_ ? std::sqrt(first * first + third * third) : first, along(1, arm)});
  }

  /// Whether the profile had ended where it is nearest to `place`, and only its continuation is there.
  bool past_end(const Vector3<double>& place) const {
    const Vector3<double> arm{place[0] - origin_[0], place[1] - origin_[1], place[2] - origin_[2]};
    const double first = along(0, arm), third = along(2, arm);
    return profile_.past_end({revolved_ ? std::sqrt(first * first + third * third) : first, along(1, arm)});
  }

  /// `place` in the body frame. T: double or Dual.
  template <class T>
  SurfacePoint<T> nearest(const Vector3<T>& place) const {
    const Vector3<T> arm{place[0] - origin_[0], place[1] - origin_[1], place[2] - origin_[2]};
    const T first = along(0, arm), second = along(1, arm);
    if (!revolved_) {
      const auto at = profile_.nearest<T>({first, second});
      return {at.distance, combine(at.normal[0], at.normal[1], T(0.0))};
    }
    const T third = along(2, arm);
    const T square = first * first + third * third;
    if (value_of(square) == 0.0) {  // on the axis: any radial direction serves
      const auto at = profile_.nearest<T>({first, second});
      return {at.distance, combine(at.normal[0], at.normal[1], T(0.0))};
    }
    const T radius = square_root(square);
    const auto at = profile_.nearest<T>({radius, second});
    return {at.distance, combine(at.normal[0] * first / radius, at.normal[1], at.normal[0] * third / radius)};
  }

 private:
  template <class T>
  T along(int axis, const Vector3<T>& arm) const {
    return arm[0] * axes_(axis, 0) + arm[1] * axes_(axis, 1) + arm[2] * axes_(axis, 2);
  }

  template <class T>
  Vector3<T> combine(const T& first, const T& second, const T& third) const {
    Vector3<T> sum;
    for (int i = 0; i < 3; ++i) sum[i] = first * axes_(0, i) + second * axes_(1, i) + third * axes_(2, i);
    return sum;
  }

  Profile profile_;
  bool revolved_ = false;
  Point origin_{};
  Matrix3<double> axes_{};  // rows: profile's first and second direction, and the third
};

}  // namespace balocco
