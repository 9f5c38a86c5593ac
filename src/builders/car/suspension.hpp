// Suspension, wheels and engine in the deck: rigid parts, bushings, struts, hinges.
#pragma once

#include "builders/car/body_deck.hpp"
#include "builders/car/car_spec.hpp"

namespace balocco::car {

constexpr double gravity = 9.81e-3;  // mm/ms2

/// Load of one wheel of each axle, N.
struct CornerWeights {
  double front = 0.0, rear = 0.0;
};

/// Everything that the springs carry: body, masses, engine, subframe.
Inertia sprung_mass(const CarSpec& spec, const BodyMesh& mesh);
CornerWeights corner_weights(const CarSpec& spec, const Inertia& sprung);
/// On the road below a wheel: with all that moves with the wheel.
CornerWeights wheel_loads(const CarSpec& spec, const CornerWeights& sprung, double tyre_mass);

/// Places of the wheels' centres at design height, as wheel_names.
std::array<Vector, 4> wheel_centres(const CarSpec& spec);

/// How far below design height, mm, the wheels that sink most come to rest where nothing carries them: on their rebound stops. Small
/// motions and no rubber: good to some millimetres.
double droop(const CarSpec& spec, const CornerWeights& weights);

/// Springs are as long without load as makes them carry `weights` at design height.
void write_front_suspension(const CarSpec& spec, const BodyMesh& mesh, const CornerWeights& weights, DeckText& deck);
void write_rear_suspension(const CarSpec& spec, const BodyMesh& mesh, const CornerWeights& weights, DeckText& deck);
void write_engine(const CarSpec& spec, DeckText& deck);

}  // namespace balocco::car
