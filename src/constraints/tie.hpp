// A node tied to a place between others: of a face (*TIE) or of an element (*EMBEDDED ELEMENT).
#pragma once

#include "constraints/constraint.hpp"

namespace balocco {

/// Its first node is the tied one.
class TieConstraint : public Constraint {
 public:
  TieConstraint(const Model& model, const Tie& tie, double model_size);

  bool turns(int i) const override { return i == 0 ? rotations_ : others_turn_; }
  bool is_linear() const override { return !carries_offset_; }
  void gaps(std::span<const NodePlace> places, std::span<double> g) const override;
  void gradient(std::span<const NodePlace> places, std::span<double> dg) const override;
  void add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers, std::span<double> pairs) const override;

 private:
  std::vector<double> weight_;  // of each node but the first
  Vector3<double> offset_{};    // of the tied node at the start
  double lever_ = 1.0;          // what rows of rotations are multiplied by
  bool others_turn_ = false, rotations_ = false, carries_offset_ = false;
};

}  // namespace balocco
