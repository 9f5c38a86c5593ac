// Rim, road and the steps of a tyre job: seating, inflation, contact, load, rolling.
#pragma once

#include "builders/tyre_mesh.hpp"

namespace balocco {

/// Rows in the model of what the steps act on.
struct WheelAndRoad {
  std::int32_t hub = -1, road = -1;  // reference nodes
  std::int32_t rim_body = -1, road_body = -1;
};

/// Adds the rim (rigid body of HUB at the wheel centre, with mass and inertia), the road (analytical surface carried by
/// ROAD) and their contact.
WheelAndRoad add_rim_and_road(const TyreSpec& spec, const TyreSection& section, const TyreMesh& mesh, Model& model);

/// Adds all steps and the initial velocities of the rolling ones.
void add_steps(const TyreSpec& spec, const TyreSection& section, const TyreMesh& mesh, const WheelAndRoad& rig,
               Model& model);

/// Radius on which the wheel is expected to roll, mm: as described, or free radius less a third of the expected
/// deflection.
double rolling_radius(const TyreSpec& spec, double outer_radius, double load);
double rolling_radius(const TyreSpec& spec, const TyreSection& section);  // under the load of its static steps

}  // namespace balocco
