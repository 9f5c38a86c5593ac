// The steps of a car's equilibrium, the same for every fidelity.
#pragma once

#include <string>

#include "builders/car/body_deck.hpp"
#include "builders/car/deck_text.hpp"
#include "builders/car/suspension.hpp"
#include "builders/car/tyre_placement.hpp"

namespace balocco::car {

/// The rigid parts of each assembly as one rigid body: BODY_REFERENCE, SUBFRAME_REFERENCE.
void write_fidelity(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck);

/// Where tyres are seated and inflated: all of them in the car's own job, or one in a job of its own, from whose state all start.
enum class Inflation { of_all, of_one };

/// Seating and inflation with all held; gravity and the springs' load with the wheels held; the road rises; the car stands free. Before
/// a fall, instead: no weight, and wheels that hang lower by about `droop` mm.
void write_equilibrium(const CarSpec& spec, const TyreSpec& tyre, const TyreFacts& facts, double droop, Inflation inflation, DeckText& deck);

/// Seating and inflation of the front left tyre on its hub, for all four.
void write_tyre_steps(const TyreSpec& tyre, const TyreFacts& facts, DeckText& deck);

/// The axles moved by their wheels' centres with the body held, without tyres: both wheels up, both down, one up and one down, by
/// `travel` mm. Hubs neither spin nor are held along or across.
void write_kinematics(const CarSpec& spec, double travel, DeckText& deck);

/// The car rolls freely while the roads run under it, from where the equilibrium ended, its wheels under `loads`; or it falls.
void write_drive(const CarSpec& spec, const BodyMesh& mesh, const TyreSpec& tyre, const TyreFacts& facts,
                 const CornerWeights& loads, DeckText& deck);

}  // namespace balocco::car
