// Suspension, engine, wheels and road of the car's description. Points of the left side; front ones relative to the wheel's centre.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "builders/car/linkage_text.hpp"
#include "builders/tyre_spec.hpp"

namespace balocco {
class SpecTable;
}

namespace balocco::car {

/// A spring with its damper and its stops, all along one line.
struct StrutSpec {
  double spring_rate = 0.0;                              // N/mm
  std::vector<std::array<double, 2>> bump, rebound;      // (mm/ms, N), both positive
  double bump_gap = 0.0, rebound_gap = 0.0;              // mm of travel from design height before the stops
  std::vector<std::array<double, 2>> stop;               // (mm, N) of the stops, from touching on
};

/// Bushing: radial stiffness (across its axis), axial, N/mm; torsional and cardanic about all axes, N mm/rad; loss: damping in ms
/// times stiffness.
struct BushingSpec {
  double radial = 0.0, axial = 0.0, angular = 0.0, damping_time = 0.0;
};

struct FrontSpec {
  Vector arm_front, arm_rear, ball_joint, strut_lower, rod_inner, rod_outer;  // hard points; the strut's top is the body's
  RigidPart subframe, arm, knuckle, hub;  // of the left side
  double rod_mass = 0.0;                  // g of the strut's rod with its bearing
  StrutSpec strut;
  BushingSpec arm_bush, top_mount, subframe_mount;
  double bar_rate = 0.0;                  // N/mm of the anti-roll bar at its links
};

struct RearSpec {
  Vector spring_seat, damper_lower;       // on the left arm, in the car; its pivot and the upper ends are mounts of the body
  RigidPart arm, wheel_hub;
  StrutSpec strut;                        // spring and damper stand apart; the stops are the damper's
  BushingSpec pivot_bush;
  double beam_torsion = 0.0, beam_bending = 0.0;  // N mm/rad of the beam between the arms: about y, and about x and z
};

struct EngineSpec {
  RigidPart block;
  std::vector<std::array<double, 3>> rates;  // N/mm along x, y, z of the left, the right and the rear mount
  double damping_time = 0.0;                 // ms times stiffness
};

struct DriveSpec {
  std::string obstacle;                           // comfort: under both sides; pothole: under the left wheels alone
  double speed = 0.0;                             // mm/ms
  double duration = 0.0, history_interval = 0.0;  // ms
  double stable_increment = 0.0;                     // ms: elements that allow less are made denser; 0: none are
  int frames = 0;
};

struct ChassisSpec {
  FrontSpec front;
  RearSpec rear;
  EngineSpec engine;
  RoadSpec road;
  DriveSpec drive;
};

/// `obstacle` overrides the description's; empty: as described.
void read_chassis(SpecTable& top, const std::string& obstacle, ChassisSpec& chassis);

}  // namespace balocco::car
