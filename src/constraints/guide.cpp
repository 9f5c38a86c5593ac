#include "constraints/guide.hpp"

namespace balocco {

namespace {

RelativeMotion relative_motion(const Model& model, const Guide& guide) {
  RelativeMotion::Axes axes;
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) {
      axes[0](i, c) = guide.axes[i][c];
      axes[1](i, c) = guide.second_axes[i][c];
    }
  const auto at = [&](int end) { return Vector3<double>{model.nodes.coordinates[guide.nodes[end]]}; };
  return {guide.kind, axes, at(1) - at(0)};
}

}  // namespace

GuideConstraint::GuideConstraint(const Model& model, const Guide& guide, double model_size)
    : guide_(guide), relative_(relative_motion(model, guide)), lever_(model_size) {
  nodes_.assign(guide.nodes.begin(), guide.nodes.end());
  rows_ = static_cast<int>(guide.rows.size());
  for (const auto& row : guide.rows) {
    const bool in_frame = row.component < 3 && guide.kind.translation == RelativeMotionKind::Translation::cartesian;
    turns_[0] = turns_[0] || in_frame || row.component >= 3;
    turns_[1] = turns_[1] || row.component >= 3;
  }
}

Guide::Range GuideConstraint::of_motion(int row, const Guide::Range& positions) const {
  const double start = relative_.position_at_start(component(row));
  return {lever(row) * (positions[0] - start), lever(row) * (positions[1] - start)};
}

void GuideConstraint::gaps(std::span<const NodePlace> places, std::span<double> motions) const {
  const auto measured = relative_.at(places);
  for (int row = 0; row < rows_; ++row) motions[row] = lever(row) * measured[component(row)];
}

void GuideConstraint::gradient(std::span<const NodePlace> places, std::span<double> dg) const {
  const auto measured = relative_.at<Slope>(places, {slope_seed(0), slope_seed(1)});
  for (int row = 0; row < rows_; ++row)
    for (int k = 0; k < 12; ++k) dg[12 * row + k] = lever(row) * measured[component(row)].derivative[k];
}

void GuideConstraint::add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers, std::span<double> pairs) const {
  const auto measured = relative_.at<Curvature>(places, {curvature_seed(0), curvature_seed(1)});
  for (int row = 0; row < rows_; ++row)
    for (int k = 0; k < 12; ++k)
      for (int l = 0; l < 12; ++l)
        pairs[12 * k + l] += multipliers[row] * lever(row) * measured[component(row)].derivative[k].derivative[l];
}

}  // namespace balocco
