// Hubs and wheels in the deck: a rigid rim that turns as one with its hub, or a wheel of shells between its hub and the seats of
// the tyre.
#pragma once

#include <optional>
#include <string>

#include "builders/car/body_deck.hpp"
#include "builders/car/wheel_mesh.hpp"

namespace balocco::car {

/// Name of the rigid body that carries a wheel's beads: the hub, or the seats of a wheel of shells.
std::string bead_carrier(const CarSpec& spec, const std::string& wheel);

/// Bodies HUB_FRONT_LEFT and so on; tyres may strike the surfaces RIM_FRONT_LEFT and so on where there are `rims`. With a wheel of
/// shells: nodes and element set RIM_AND_DISC_FRONT_LEFT, body SEATS_FRONT_LEFT of its bead seats; the hub clamps its face and is
/// lighter by the wheel. @throws InputError where a described hub is no heavier than its wheel.
void write_wheels(const CarSpec& spec, const std::optional<WheelMesh>& mesh, bool rims, DeckText& deck);

/// What a wheel of shells weighs, and what remains of the described hubs.
std::string wheel_report(const CarSpec& spec, const WheelMesh& mesh);

}  // namespace balocco::car
