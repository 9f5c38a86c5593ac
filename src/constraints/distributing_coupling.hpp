// A reference node that moves with the weighted mean of many nodes: forces on it are shared out by weight, moments as forces across
// the arms, and the nodes stay free to deform. The mean rotation R makes the weighted moment of the nodes about their mean vanish,
// sum w (R A) x x = 0 with the arms A at the start: the rotation of the polar decomposition of their weighted second moment.
#pragma once

#include "constraints/constraint.hpp"

namespace balocco {

/// All that the gaps of a coupling know of the places of its cloud, or their rates of its velocities.
struct CloudMoments {
  Vector3<double> center{};  // sum w x
  Matrix3<double> spread{};  // sum w A (x - any origin)^T: the weighted arms A at the start have no sum
};

/// Its first node is the reference node. About the line on which all nodes lie it does not turn: nothing else would hold it.
class DistributingConstraint : public Constraint {
 public:
  DistributingConstraint(const Model& model, const DistributingCoupling& coupling);

  bool turns(int i) const override { return i == 0 && rotates_; }
  void gaps(std::span<const NodePlace> places, std::span<double> g) const override;
  void gradient(std::span<const NodePlace> places, std::span<double> dg) const override;
  void add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers, std::span<double> pairs) const override;

  /// False with axes of its own.
  bool knows_moments_alone() const { return own_arm_[0].empty() && own_arm_[1].empty() && own_arm_[2].empty(); }
  /// gaps() and the six columns of the reference node in gradient() (row-major), where it knows moments alone.
  void gaps_of(const CloudMoments& moments, const NodePlace& reference, std::span<double> g) const;
  void reference_gradient(const CloudMoments& moments, const Matrix3<double>& rotation, std::span<double> dg) const;
  /// What a row holds: 0-2 the mean's place, 3-5 the moment over lever().
  std::vector<int> components() const;
  const std::vector<double>& weights() const { return weight_; }
  const std::vector<Vector3<double>>& arms() const { return arm_; }
  double lever() const { return lever_; }

 private:
  CloudMoments moments(std::span<const NodePlace> places) const;
  void find_loose_directions();
  Vector3<double> mean(std::span<const NodePlace> places) const;

  std::vector<double> weight_;        // of each node but the first; their sum is 1
  std::vector<Vector3<double>> arm_;  // from the mean to each node at the start
  Vector3<double> offset_{};          // from the mean to the reference node at the start
  std::array<bool, 6> freedoms_{};
  /// The arms that moments about axes of the coupling's own have: axis x arm, by axis and node; they turn with the reference node. Empty: global axes.
  std::array<std::vector<Vector3<double>>, 3> own_arm_;
  Matrix3<double> loose_{};           // projects onto directions about which the nodes, on a line or in one place, tell no rotation
  double lever_ = 1.0;                // weighted mean length of the arms: what rows of rotations are divided by
  bool rotates_ = false;
};

}  // namespace balocco
