#include "constraints/mean_rotation.hpp"

#include <cmath>

namespace balocco {

MeanRotationConstraint::MeanRotationConstraint(const Model& model, const MeanRotation& rotation) {
  nodes_ = rotation.nodes;
  nodes_.push_back(rotation.angle_node);
  rows_ = 3;
  const Vector3<double> axis{rotation.axis};
  int least = 0;
  for (int c = 1; c < 3; ++c)
    if (std::abs(axis[c]) < std::abs(axis[least])) least = c;
  Vector3<double> aside{};
  aside[least] = 1.0;
  across_ = cross(aside, axis);
  across_ = (1.0 / std::sqrt(dot(across_, across_))) * across_;
  beside_ = cross(axis, across_);
  std::vector<NodePlace> places(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) places[i].position = Vector3<double>{model.nodes.coordinates[nodes_[i]]};
  start_ = arms(places);
  angle_node_ = places.back().position;
  for (const auto& arm : start_) radius_ += std::hypot(arm[0], arm[1]) / static_cast<double>(count());
}

std::vector<MeanRotationConstraint::Arm> MeanRotationConstraint::arms(std::span<const NodePlace> places) const {
  Vector3<double> centre{};
  for (std::size_t i = 0; i < count(); ++i) centre = centre + (1.0 / static_cast<double>(count())) * places[i].position;
  std::vector<Arm> result;
  for (std::size_t i = 0; i < count(); ++i) {
    const auto arm = places[i].position - centre;
    result.push_back({dot(across_, arm), dot(beside_, arm)});
  }
  return result;
}

/// Angles between the arms and those of the start: atan2(across * beside' - beside * across', scalar product).
void MeanRotationConstraint::gaps(std::span<const NodePlace> places, std::span<double> g) const {
  const auto now = arms(places);
  double sum = 0.0;
  for (std::size_t i = 0; i < count(); ++i)
    sum += std::atan2(start_[i][0] * now[i][1] - start_[i][1] * now[i][0], start_[i][0] * now[i][0] + start_[i][1] * now[i][1]);
  g[0] = radius_ * (sum / static_cast<double>(count()) - (places.back().position[0] - angle_node_[0]));
  for (int row = 1; row < rows_; ++row) g[row] = places.back().position[row] - angle_node_[row];
}

/// An angle changes by t . d(arm) / r, where t is perpendicular to an arm of length r; the centre moves with all.
void MeanRotationConstraint::gradient(std::span<const NodePlace> places, std::span<double> dg) const {
  const auto n = static_cast<double>(count());
  std::vector<Vector3<double>> slope;
  Vector3<double> mean{};
  for (const auto& [a, b] : arms(places)) {
    slope.push_back((radius_ / (n * (a * a + b * b))) * direction({-b, a}));
    mean = mean + (1.0 / n) * slope.back();
  }
  std::ranges::fill(dg, 0.0);
  for (std::size_t i = 0; i < count(); ++i)
    for (int k = 0; k < 3; ++k) dg[6 * i + k] = slope[i][k] - mean[k];
  dg[6 * count()] = -radius_;
  for (int row = 1; row < rows_; ++row) dg[static_cast<std::size_t>(columns() * row + row) + 6 * count()] = 1.0;
}

/// The second derivative of an angle by its arm is -(n t' + t n') / r^2, with the unit vectors n along the arm and t across it.
void MeanRotationConstraint::add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers,
                                           std::span<double> pairs) const {
  const auto n = static_cast<double>(count());
  const auto all = arms(places);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      std::vector<double> own;
      double mean = 0.0;
      for (const auto& [a, b] : all) {
        const double square = a * a + b * b;
        const auto along = direction({a, b}), aside = direction({-b, a});
        own.push_back(-multipliers[0] * radius_ / n * (along[k] * aside[l] + aside[k] * along[l]) / (square * square));
        mean += own.back() / n;
      }
      for (std::size_t i = 0; i < count(); ++i)
        for (std::size_t j = 0; j < count(); ++j)
          pairs[static_cast<std::size_t>(columns()) * (6 * i + k) + 6 * j + l] +=
              (i == j ? own[i] : 0.0) - (own[i] + own[j]) / n + mean / n;
    }
}

}  // namespace balocco
