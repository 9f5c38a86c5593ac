// Suspension, engine, wheels and road of the car's description. Points of the left side; front ones relative to the wheel's centre.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "builders/car/car_choices.hpp"
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

/// The ring of the subframe, from the middle ahead to the middle behind.
struct SubframeSpec {
  std::vector<Vector> line;  // of the left half, where the flanges lie; in the car
  double reach = 0.0;        // mm around mounts, arms and rack within which its sheet carries them
  double seat_mass = 0.0;    // g, of the bracket and the bushing's sleeve at each of them
  std::string where;         // the reach stands, for messages
};

/// A bar that resists roll, of the left half: from the middle by its bushing on the subframe to where its link hangs.
struct BarSpec {
  std::vector<Vector> line;  // its second point is the bushing's; in the car
  Vector link;               // on the lower arm; relative to the wheel's centre as the arm's own points
  double diameter = 0.0;     // mm
  double bushing_rate = 0.0, link_rate = 0.0, damping_time = 0.0;  // N/mm along each axis, N/mm along the link; ms times stiffness
  std::string material;
};

/// A V of one sheet, open downwards.
struct BeamSpec {
  std::vector<Vector> line;            // of its edge, from the middle to the left arm; in the car
  double leg = 0.0, opening = 0.0;     // mm; degrees between the legs
};

struct FrontSpec {
  Vector arm_front, arm_rear, ball_joint, strut_lower, rod_inner, rod_outer;  // hard points; the strut's top is the body's
  SubframeSpec subframe;
  BarSpec bar;
  RigidPart arm, knuckle, hub;            // of the left side
  double rod_mass = 0.0;                  // g of the strut's rod with its bearing
  StrutSpec strut;
  BushingSpec arm_bush, top_mount, subframe_mount;
};

struct RearSpec {
  Vector spring_seat, damper_lower;       // on the left arm, in the car; its pivot and the upper ends are mounts of the body
  RigidPart arm, wheel_hub;
  StrutSpec strut;                        // spring and damper stand apart; the stops are the damper's
  BushingSpec pivot_bush;
  BeamSpec beam;
};

struct EngineSpec {
  RigidPart block;
  std::vector<std::array<double, 3>> rates;  // N/mm along x, y, z of the left, the right and the rear mount
  double damping_time = 0.0;                 // ms times stiffness
};

struct DriveSpec {
  std::string obstacle;                           // comfort: under both sides; pothole: under the left wheels alone; drop: none
  double speed = 0.0;                             // mm/ms
  double height = 0.0;                            // mm of a fall until the first wheel touches; 0: it does not fall
  double duration = 0.0, history_interval = 0.0;  // ms
  double stable_increment = 0.0;                     // ms: elements that allow less are made denser; 0: none are
  int frames = 0;
};

/// A wheel that deforms between its hub and the rigid seats of the tyre's beads, in place of the rigid rim.
struct WheelSpec {
  std::string mesh;                                    // path of its shells, mm; empty: rims are rigid
  double seat_diameter = 0.0, width = 0.0;             // mm, of the mesh's own rim: it is scaled to the tyre's
  double seat_width = 0.0, mounting_diameter = 0.0;    // mm inside the flanges that carry a bead; of the hub's face; both scaled
  std::string material;
  double stable_increment = 0.0;                       // ms: its elements that allow less in the drive are made denser; 0: none are
  std::string where;                                   // the mesh is named, for messages
};

struct ChassisSpec {
  FrontSpec front;
  RearSpec rear;
  WheelSpec wheel;
  EngineSpec engine;
  RoadSpec road;
  std::optional<double> standing_friction;  // of the road while the car is brought to stand; none: as in the drive
  DriveSpec drive;
};

/// What the chassis must fit.
struct ChassisPlace {
  std::vector<std::string> materials;  // names of those that the description has
  Vector strut_top;                    // of the left one
  double wheel_height = 0.0;           // mm
  double front_track = 0.0;            // mm
};

/// One row [[x, y, z]].
Vector read_place(SpecTable& table, std::string_view key);
/// `choices`: the fidelity of the car, and an obstacle that overrides the description's.
void read_chassis(SpecTable& top, const CarChoices& choices, const ChassisPlace& place, ChassisSpec& chassis);

}  // namespace balocco::car
