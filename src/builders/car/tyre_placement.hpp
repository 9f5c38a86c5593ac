// Four tyres of one description at their places, and the roads below them.
#pragma once

#include <array>
#include <string>

#include "builders/car/curve.hpp"
#include "builders/tyre_spec.hpp"
#include "model/model.hpp"

namespace balocco::car {

constexpr std::array<const char*, 4> wheel_names{"FRONT_LEFT", "FRONT_RIGHT", "REAR_LEFT", "REAR_RIGHT"};

struct WheelPlaces {
  std::array<Vector, 4> centre;  // as wheel_names
  double clearance = 0.0;        // mm between the moulded tread and the road at first
};

/// What the rest of the car wants to know of the tyre.
struct TyreFacts {
  double outer_radius = 0.0, half_width = 0.0;  // mm
  double seat_shift = 0.0, mass = 0.0;          // mm that each bead moves to the rim, g of one tyre
  std::int64_t nodes = 0, elements = 0;         // of one tyre: by so much the numbers of one are larger than those of the one before
};

/// Adds to an empty model: element sets, node sets and surfaces of the tyre builder with _FRONT_LEFT and so on behind their names;
/// roads ROAD_LEFT and ROAD_RIGHT as rigid bodies, a pothole in the left one alone; contact of the treads with them; surfaces RIM_FRONT_LEFT and
/// so on, which the hubs' bodies are to carry, and their contact, where the tyres may strike their rims. Ids begin behind `first_id`.
TyreFacts add_tyres(const TyreSpec& tyre, const RoadSpec& road, const WheelPlaces& places, std::int64_t first_id, Model& model);

/// The first of these tyres alone, with a hub that its beads can be tied to: HUB_FRONT_LEFT.
void add_first_tyre(const TyreSpec& tyre, const WheelPlaces& places, std::int64_t first_id, Model& model);

}  // namespace balocco::car
