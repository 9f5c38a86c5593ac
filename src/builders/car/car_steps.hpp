// The steps of a car's equilibrium, the same for every fidelity.
#pragma once

#include <string>

#include "builders/car/body_deck.hpp"
#include "builders/car/deck_text.hpp"
#include "builders/car/suspension.hpp"
#include "builders/car/tyre_placement.hpp"

namespace balocco::car {

/// The body's rigid parts as one rigid body.
void write_fidelity(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck);

/// Seating and inflation with all held; gravity and the springs' load with the wheels held; the road rises; the car stands free.
void write_equilibrium(const CarSpec& spec, const TyreSpec& tyre, const TyreFacts& facts, DeckText& deck);

/// The car rolls freely while the roads run under it, from where the equilibrium ended, its wheels under `loads`.
void write_drive(const CarSpec& spec, const TyreSpec& tyre, const TyreFacts& facts, const CornerWeights& loads, DeckText& deck);

}  // namespace balocco::car
