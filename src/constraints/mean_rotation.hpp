// *MPC MEANROT, as CalculiX has it: the mean angle by which nodes turn about an axis is given, or found.
#pragma once

#include "constraints/constraint.hpp"

namespace balocco {

/// Its last node is the one whose first displacement is the angle. Three rows: the mean of the nodes' angles less that, times their mean
/// distance from the axis through their centre, so that it is a length; and the last node's other displacements, which mean nothing.
class MeanRotationConstraint : public Constraint {
 public:
  MeanRotationConstraint(const Model& model, const MeanRotation& rotation);

  bool turns(int) const override { return false; }
  bool couples_all() const override { return true; }
  void gaps(std::span<const NodePlace> places, std::span<double> g) const override;
  void gradient(std::span<const NodePlace> places, std::span<double> dg) const override;
  void add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers,
                     std::span<double> pairs) const override;

 private:
  /// Of one node: its place from the centre as a length along `across` and one along `beside`.
  using Arm = std::array<double, 2>;
  std::vector<Arm> arms(std::span<const NodePlace> places) const;
  Vector3<double> direction(const Arm& arm) const { return arm[0] * across_ + arm[1] * beside_; }
  std::size_t count() const { return nodes_.size() - 1; }

  Vector3<double> across_{}, beside_{};  // unit, with the axis a right-handed system
  std::vector<Arm> start_;
  Vector3<double> angle_node_{};  // where the last node starts
  double radius_ = 0.0;
};

}  // namespace balocco
