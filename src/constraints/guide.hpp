// Components of relative motion that something stops, locks, rubs, drives or loads. What holds of a row is up to a law of the step
// (solvers/guide_laws.hpp), so "gaps" are the relative motions themselves, angles times the size of the model.
#pragma once

#include "constraints/relative_motion.hpp"

namespace balocco {

class GuideConstraint : public Constraint {
 public:
  GuideConstraint(const Model& model, const Guide& guide, double model_size);

  bool turns(int i) const override { return turns_[i]; }
  const GuideConstraint* guide() const override { return this; }
  void gaps(std::span<const NodePlace> places, std::span<double> motions) const override;
  void gradient(std::span<const NodePlace> places, std::span<double> dg) const override;
  void add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers, std::span<double> pairs) const override;

  const Guide& definition() const { return guide_; }
  int component(int row) const { return guide_.rows[row].component; }
  /// What motions of a row are multiplied by, and forces divided: 1, of angles a length.
  double lever(int row) const { return component(row) < 3 ? 1.0 : lever_; }
  /// Length by which motions are judged: the model's.
  double size() const { return lever_; }
  /// Of motions of a row that differ by whole turns the one nearest to the last.
  double nearest(int row, double motion, double last) const {
    return lever(row) * relative_.nearest(component(row), motion / lever(row), last / lever(row));
  }
  /// A range of positions as one of motions of the row.
  Guide::Range of_motion(int row, const Guide::Range& positions) const;

 private:
  const Guide& guide_;
  RelativeMotion relative_;
  double lever_;
  std::array<bool, 2> turns_{};
};

}  // namespace balocco
