// What the rounding of positions makes of energies in an explicit step.
#pragma once

#include <cstdint>
#include <span>

#include "analysis.hpp"

namespace balocco {

/// Work of forces over the least way that positions can tell, and kinetic energy of the least speed: below it energies mean nothing.
class RoundingEnergy {
 public:
  /// Collective.
  explicit RoundingEnergy(const Analysis& analysis);

  /// With the increment of Analysis::output_increment. Collective.
  /// @param external forces, 4 a node; those on `loaded` nodes count
  double value(const Analysis& analysis, std::span<const double> external, std::span<const std::int32_t> loaded, double weight_of_bodies) const;

 private:
  double way_ = 0.0, mass_ = 0.0;
};

}  // namespace balocco
