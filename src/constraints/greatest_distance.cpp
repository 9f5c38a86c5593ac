#include "constraints/greatest_distance.hpp"

#include <algorithm>
#include <cmath>

namespace balocco {

namespace {

Vector3<double> apart(std::span<const NodePlace> places) { return places[1].position - places[0].position; }

}  // namespace

GreatestDistanceConstraint::GreatestDistanceConstraint(const Model&, const GreatestDistance& rope) : distance_(rope.distance) {
  nodes_.assign(rope.nodes.begin(), rope.nodes.end());
  rows_ = 1;
}

void GreatestDistanceConstraint::gaps(std::span<const NodePlace> places, std::span<double> g) const {
  const auto arm = apart(places);
  g[0] = std::sqrt(dot(arm, arm)) - distance_;
}

void GreatestDistanceConstraint::gradient(std::span<const NodePlace> places, std::span<double> dg) const {
  const auto arm = apart(places);
  const double inverse = 1.0 / std::sqrt(dot(arm, arm));
  std::ranges::fill(dg, 0.0);
  for (int c = 0; c < 3; ++c) {
    dg[c] = -inverse * arm[c];
    dg[6 + c] = inverse * arm[c];
  }
}

void GreatestDistanceConstraint::add_curvature(std::span<const NodePlace> places, std::span<const double> multipliers,
                                               std::span<double> pairs) const {
  const auto arm = apart(places);
  const double square = dot(arm, arm), factor = multipliers[0] / std::sqrt(square);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          pairs[12 * (6 * a + i) + 6 * b + k] += (a == b ? factor : -factor) * ((i == k ? 1.0 : 0.0) - arm[i] * arm[k] / square);
}

}  // namespace balocco
