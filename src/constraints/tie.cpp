#include "constraints/tie.hpp"

#include <algorithm>

namespace balocco {

TieConstraint::TieConstraint(const Model& model, const Tie& tie, double model_size)
    : weight_(tie.weights), lever_(model_size), rotations_(tie.rotations) {
  nodes_.push_back(tie.node);
  nodes_.insert(nodes_.end(), tie.others.begin(), tie.others.end());
  const auto place = [&](std::int32_t row) { return Vector3<double>{model.nodes.coordinates[row]}; };
  offset_ = place(tie.node);
  for (std::size_t i = 0; i < weight_.size(); ++i) offset_ = offset_ - weight_[i] * place(tie.others[i]);
  carries_offset_ = tie.others_turn && dot(offset_, offset_) > 1e-24 * model_size * model_size;
  others_turn_ = carries_offset_ || rotations_;
  rows_ = rotations_ ? 6 : 3;
}

void TieConstraint::gaps(std::span<const NodePlace> places, std::span<double> g) const {
  auto apart = places[0].position;
  auto turned = places[0].turn;
  if (!carries_offset_) apart = apart - offset_;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const auto& other = places[i + 1];
    apart = apart - weight_[i] * (carries_offset_ ? other.position + other.rotation * offset_ : other.position);
    turned = turned - weight_[i] * other.turn;
  }
  for (int c = 0; c < 3; ++c) {
    g[c] = apart[c];
    if (rotations_) g[3 + c] = lever_ * turned[c];
  }
}

void TieConstraint::gradient(std::span<const NodePlace> places, std::span<double> dg) const {
  std::ranges::fill(dg, 0.0);
  const auto width = static_cast<std::size_t>(columns());
  for (int c = 0; c < 3; ++c) {
    double* const line = &dg[c * width];
    line[c] = 1.0;
    for (std::size_t i = 0; i < weight_.size(); ++i) {
      double* const other = line + 6 * (i + 1);
      other[c] = -weight_[i];
      if (!carries_offset_) continue;
      const auto arm = weight_[i] * (places[i + 1].rotation * offset_);
      const int k = (c + 1) % 3, l = (c + 2) % 3;
      other[3 + k] = -arm[l];  // -(spin x arm)
      other[3 + l] = arm[k];
    }
    if (!rotations_) continue;
    double* const turning = &dg[(3 + c) * width];
    turning[3 + c] = lever_;
    for (std::size_t i = 0; i < weight_.size(); ++i) turning[6 * (i + 1) + 3 + c] = -lever_ * weight_[i];
  }
}

void TieConstraint::add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers, std::span<double> pairs) const {
  if (!carries_offset_) return;
  const Vector3<double> force{{multipliers[0], multipliers[1], multipliers[2]}};
  for (std::size_t node = 0; node < weight_.size(); ++node) {
    const auto arm = weight_[node] * (places[node + 1].rotation * offset_);
    const double along = dot(arm, force);
    double* const pair = &pairs[144 * node];
    // -force . (virtual x (real x arm)) = -((virtual . arm)(force . real) - (force . arm)(virtual . real))
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) pair[12 * (9 + i) + 9 + k] -= arm[i] * force[k] - (i == k ? along : 0.0);
  }
}

}  // namespace balocco
