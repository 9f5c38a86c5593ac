#include "rounding_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/exact_sum.hpp"

namespace balocco {

namespace {

constexpr double rounding = 4096.0 * std::numeric_limits<double>::epsilon();  // of the farthest place

double length(const double* vector) { return std::sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]); }

}  // namespace

RoundingEnergy::RoundingEnergy(const Analysis& analysis) {
  for (const auto& place : analysis.model.nodes.coordinates) way_ = std::max(way_, rounding * length(place.data()));
  ExactSum mass;
  for (std::int32_t node = 0; node < analysis.domain.size(); ++node)
    if (analysis.domain.owned[node]) mass.add(analysis.inertia.mass[node]);
  analysis.communicator.sum(std::span<ExactSum>(&mass, 1));
  mass_ = mass.value();
}

double RoundingEnergy::value(const Analysis& analysis, std::span<const double> external, std::span<const std::int32_t> loaded,
                             double weight_of_bodies) const {
  ExactSum force;
  for (const auto node : loaded)
    if (analysis.domain.owned[node]) force.add(length(&external[4 * static_cast<std::size_t>(node)]));
  analysis.communicator.sum(std::span<ExactSum>(&force, 1));
  const double speed = way_ / analysis.output_increment;
  return way_ * (force.value() + weight_of_bodies) + 0.5 * mass_ * speed * speed;
}

}  // namespace balocco
