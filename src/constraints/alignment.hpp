// *MPC PLANE and STRAIGHT, as CalculiX has them: a node stays in the plane of three others, or on the line of two others, which move.
#pragma once

#include "constraints/constraint.hpp"

namespace balocco {

/// Its last node is the one that is held: one row, its distance from the plane; two rows, its offsets from the line.
class AlignmentConstraint : public Constraint {
 public:
  AlignmentConstraint(const Model& model, const Alignment& alignment);

  bool turns(int) const override { return false; }
  bool couples_all() const override { return true; }
  void gaps(std::span<const NodePlace> places, std::span<double> g) const override;
  void gradient(std::span<const NodePlace> places, std::span<double> dg) const override;
  void add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers, std::span<double> pairs) const override;

 private:
  template <class T>
  void evaluate(std::span<const Vector3<T>> position, T* g) const;

  std::array<Vector3<double>, 2> across_{};  // directions perpendicular to the line at the start
};

}  // namespace balocco
