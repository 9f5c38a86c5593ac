// Joints of two nodes: kinematic couplings, multi-point constraints and the kinematic part of connectors, all put together from a few
// pieces. Every piece is a function of the two frames; its second derivatives are those of dual numbers.
#pragma once

#include "constraints/constraint.hpp"
#include "constraints/motion_seeds.hpp"

namespace balocco {

class JointConstraint : public Constraint {
 public:
  JointConstraint(const Model& model, const Joint& joint, double model_size);

  bool turns(int i) const override { return turns_[i]; }
  void gaps(std::span<const NodePlace> places, std::span<double> g) const override;
  void gradient(std::span<const NodePlace> places, std::span<double> dg) const override;
  void add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers,
                     std::span<double> pairs) const override;

  /// Forces and moments of the components that it holds, in the first frame, as of a spring that is pulled; zero elsewhere.
  std::array<double, 6> component_forces(std::span<const double> multipliers) const;
  /// The multipliers of a joint without gaps that holds all offsets, and all rotations or none, where it exerts a force and a moment on its
  /// first node as moved to the second. `rotation` turns the first node from the start. Sign as of component_forces().
  void find_multipliers(const Vector3<double>& force, const Vector3<double>& moment, const Matrix3<double>& rotation,
                        std::span<double> multipliers) const;

 private:
  template <class T>
  struct Frame {
    Vector3<T> position;
    Matrix3<T> axes;  // rows e1 e2 e3
  };
  std::array<Frame<double>, 2> frames(std::span<const NodePlace> places) const;
  template <class T>
  std::array<Frame<T>, 2> seeded_frames(std::span<const NodePlace> places, const std::array<MotionSeed<T>, 2>& seeds) const;
  template <class T>
  struct Gaps;
  struct Gradient;
  struct Forces;
  template <class Rows>
  void list_rows(Rows&& rows) const;

  std::vector<Joint::Piece> pieces_;
  std::array<Matrix3<double>, 2> axes_;  // at the start
  Vector3<double> offset_{};             // of the second node in the first frame at the start
  double length_ = 0.0;                  // of it
  double lever_ = 1.0;                   // what rows of rotations are multiplied by
  std::array<bool, 2> turns_{};
};

}  // namespace balocco
