// The anti-roll bar of the front axle: beams on two bushings of the subframe, linked to the lower arms.
#pragma once

#include "builders/car/body_deck.hpp"
#include "builders/car/car_spec.hpp"

namespace balocco::car {

/// Where the bar's bushings sit on the subframe, and where its links meet the lower arms: of the left side, in the car.
Vector bar_seat(const CarSpec& spec);
Vector bar_link(const CarSpec& spec);

/// Mass of the bar, g.
double bar_mass(const CarSpec& spec);

/// The bar between SUBFRAME_BAR_LEFT and SUBFRAME_BAR_RIGHT, and from its ends to ARM_LINK_LEFT and ARM_LINK_RIGHT.
void write_anti_roll_bar(const CarSpec& spec, DeckText& deck);

}  // namespace balocco::car
