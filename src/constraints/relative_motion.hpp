// The motion of the frame of a second node relative to that of a first one, in the components that connectors speak of. Source of the
// components: Abaqus Analysis User's Guide, "Connector elements".
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "constraints/constraint.hpp"
#include "constraints/motion_seeds.hpp"

namespace balocco {

inline double arc_tangent(double y, double x) { return std::atan2(y, x); }

template <int N, class Real>
Dual<N, Real> arc_tangent(const Dual<N, Real>& y, const Dual<N, Real>& x) {
  const Real square = x.value * x.value + y.value * y.value;
  const Real by_y = x.value / square, by_x = -y.value / square;
  Dual<N, Real> result(arc_tangent(y.value, x.value));
  for (int i = 0; i < N; ++i) result.derivative[i] = by_y * y.derivative[i] + by_x * x.derivative[i];
  return result;
}

inline double plain(double x) { return x; }
template <int N, class Real>
double plain(const Dual<N, Real>& x) {
  return plain(x.value);
}

/// The rotation vector of a matrix; near the identity angle / sine by its series, whose derivatives are finite there.
template <class T>
Vector3<T> rotation_vector_of(const Matrix3<T>& m) {
  const Vector3<T> axial{{0.5 * (m(2, 1) - m(1, 2)), 0.5 * (m(0, 2) - m(2, 0)), 0.5 * (m(1, 0) - m(0, 1))}};
  const T square = dot(axial, axial), cosine = 0.5 * (m(0, 0) + m(1, 1) + m(2, 2) - 1.0);
  if (plain(square) < 1e-3 && plain(cosine) > 0.0) {
    const T factor = 1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0 + square * (15.0 / 336.0 + square * (105.0 / 3456.0))));
    return factor * axial;
  }
  const T sine = square_root(square);
  return (arc_tangent(sine, cosine) / sine) * axial;
}

class RelativeMotion {
 public:
  using Axes = std::array<Matrix3<double>, 2>;  // of the two frames at the start, rows

  /// @param arm from the first node to the second at the start
  RelativeMotion(const RelativeMotionKind& kind, const Axes& axes, const Vector3<double>& arm);

  double length() const { return length_; }
  /// Coordinate, distance or angle at the start: positions are motions more than it.
  double position_at_start(int component) const;
  /// Of angles that differ by whole turns the one nearest to the last; lengths as they are.
  double nearest(int component, double motion, double last) const {
    constexpr double turn = 2.0 * std::numbers::pi;
    return component < 3 ? motion : motion + turn * std::round((last - motion) / turn);
  }

  /// Motions from the start on, of what is measured; zero elsewhere. Angles within half a turn.
  template <class T>
  std::array<T, 6> at(std::span<const NodePlace> places, const std::array<MotionSeed<T>, 2>& seeds) const {
    std::array<Vector3<T>, 2> position;
    std::array<Matrix3<T>, 2> axes;
    for (int end = 0; end < 2; ++end) {
      for (int c = 0; c < 3; ++c) position[end][c] = places[end].position[c] + seeds[end].displacement[c];
      axes[end] = constant<T>(axes_[end] * transpose(places[end].rotation)) * transpose(seeds[end].turn);
    }
    auto motion = measure<T>(position[1] - position[0], axes);
    for (int c = 0; c < 6; ++c) motion[c] = motion[c] - at_start_[c];
    return motion;
  }
  std::array<double, 6> at(std::span<const NodePlace> places) const {
    const MotionSeed<double> still{{}, Matrix3<double>::identity()};
    return at<double>(places, {still, still});
  }

 private:
  template <class T>
  std::array<T, 6> measure(const Vector3<T>& arm, const std::array<Matrix3<T>, 2>& axes) const {
    using Translation = RelativeMotionKind::Translation;
    using Rotation = RelativeMotionKind::Rotation;
    std::array<T, 6> motion{};
    if (kind_.translation == Translation::axial) motion[0] = square_root(dot(arm, arm));
    for (int c = 0; c < 3 && kind_.translation == Translation::cartesian; ++c) motion[c] = dot(row_of(axes[0], c), arm);
    const Matrix3<T> m = axes[0] * transpose(axes[1]);  // e_i . f_j
    switch (kind_.rotation) {
      case Rotation::none:
        break;
      case Rotation::cardan:
        motion[3] = arc_tangent(-m(1, 2), m(2, 2));
        motion[4] = arc_tangent(m(0, 2), square_root(m(1, 2) * m(1, 2) + m(2, 2) * m(2, 2)));
        motion[5] = arc_tangent(-m(0, 1), m(0, 0));
        break;
      case Rotation::euler:
        motion[3] = arc_tangent(m(0, 2), -m(1, 2));
        motion[4] = arc_tangent(square_root(m(0, 2) * m(0, 2) + m(1, 2) * m(1, 2)), m(2, 2));
        motion[5] = arc_tangent(m(2, 0), m(2, 1));
        break;
      case Rotation::vector: {
        const auto vector = rotation_vector_of(m);
        for (int c = 0; c < 3; ++c) motion[3 + c] = vector[c];
      }
    }
    return motion;
  }

  RelativeMotionKind kind_;
  Axes axes_;
  double length_ = 0.0;
  std::array<double, 6> at_start_{};  // what is measured there
};

}  // namespace balocco
