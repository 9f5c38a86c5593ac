// *EQUATION: one row, sum of coefficient * displacement (rotation vector) along the nodes' own directions.
#pragma once

#include <array>

#include "constraints/constraint.hpp"

namespace balocco {

class EquationConstraint : public Constraint {
 public:
  EquationConstraint(const Model& model, const LinearEquation& equation);

  bool turns(int i) const override { return turns_[i]; }
  bool uses(int i, int dof) const override { return uses_[i][dof]; }
  bool is_linear() const override { return true; }
  void gaps(std::span<const NodePlace> places, std::span<double> g) const override;
  void gradient(std::span<const NodePlace> places, std::span<double> dg) const override;
  void add_curvature(std::span<const NodePlace>, std::span<const double>, std::span<double>) const override {}

 private:
  std::vector<double> gradient_;
  std::vector<Point> reference_;  // coordinates of the nodes
  std::vector<bool> turns_;
  std::vector<std::array<bool, 6>> uses_;
};

}  // namespace balocco
