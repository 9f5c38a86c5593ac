// *MPC DIST, as CalculiX has it: a rope between two nodes, which pulls where it is taut and hangs loose elsewhere.
#pragma once

#include "constraints/constraint.hpp"

namespace balocco {

class GreatestDistanceConstraint : public Constraint {
 public:
  GreatestDistanceConstraint(const Model& model, const GreatestDistance& rope);

  bool turns(int) const override { return false; }
  bool is_one_sided() const override { return true; }
  void gaps(std::span<const NodePlace> places, std::span<double> g) const override;
  void gradient(std::span<const NodePlace> places, std::span<double> dg) const override;
  void add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers, std::span<double> pairs) const override;

 private:
  double distance_;
};

}  // namespace balocco
