// *SURFACE INTERACTION: how the surfaces of contact pairs press and rub.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "model/location.hpp"
#include "model/pressure_law.hpp"

namespace balocco {

/// *SURFACE INTERACTION.
struct Interaction {
  std::string name;
  double friction = 0.0;
  double shear_stress_limit = std::numeric_limits<double>::infinity();  // of friction
  double penalty_scale = 1.0;          // multiplies the automatic normal stiffness
  std::optional<double> elastic_slip;  // slip at which sticking friction reaches its limit; none: automatic
  PressureLaw behavior;
  std::optional<double> stick_slope;  // of a deformable master: shear stress per slip of what sticks; none: automatic
  Location location;
};

/// *CHANGE FRICTION, *CHANGE SURFACE BEHAVIOR: what an interaction is from a step on. Steps after it inherit it.
struct ChangedInteraction {
  std::int32_t interaction = -1;  // row of Model::interactions
  Interaction properties;
  double friction_before = 0.0;  // from which static steps go to the friction of `properties`, linearly
};

}  // namespace balocco
