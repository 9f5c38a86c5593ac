// A wheel of shells from a mesh of another one: set upright about its own axis and scaled to the tyre's rim.
#pragma once

#include <vector>

#include "builders/car/curve.hpp"
#include "builders/car/suspension_spec.hpp"
#include "model/model.hpp"

namespace balocco::car {

/// Shells of one thickness, of three or four corners each.
struct WheelGauge {
  double thickness = 0.0;  // mm
  std::vector<std::vector<int>> shells;
};

/// Its axis is y, which points to the outside of the car; the origin lies in the middle between its flanges.
struct WheelMesh {
  std::vector<Vector> nodes;
  std::vector<WheelGauge> gauges;
  std::vector<int> seats;     // nodes of flanges and bead seats, which the tyre's beads hold round
  std::vector<int> mounting;  // nodes that the hub clamps
};

/// A closed run of edges that belong to one shell each.
struct FreeEdge {
  Vector middle;        // of its length
  double radius = 0.0;  // mean distance of its nodes from there
};

/// The shells' free edges, largest radius first.
std::vector<FreeEdge> free_edges(const WheelMesh& mesh);

/// The wheel in `model` for a rim like the tyre's. Its axis leads through the middles of the two largest free edges, its flanges;
/// the hub's face lies towards the outside, as in front-driven cars. Thicknesses stay. @throws InputError where `model` is no such
/// wheel.
WheelMesh make_wheel(const WheelSpec& spec, const RimSpec& rim, const Model& model);

/// Corners of a shell where they are.
std::vector<Vector> corners_of(const WheelMesh& mesh, const std::vector<int>& shell);

}  // namespace balocco::car
