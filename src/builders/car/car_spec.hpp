// The description of a car as read from TOML. Units mm, ms, g, N, MPa; x forward, y left, z up; the origin lies on the road, in the
// middle below the front axle.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "builders/car/car_choices.hpp"
#include "builders/car/sheet.hpp"
#include "builders/car/suspension_spec.hpp"

namespace balocco::car {

struct SheetMaterial {
  std::string name;
  double modulus = 0.0, poisson = 0.0, density = 0.0;  // MPa, -, g/mm3
  std::vector<std::array<double, 2>> plastic;          // (true stress MPa, plastic strain)
  double rate_reference = 0.0, rate_exponent = 0.0;    // Cowper-Symonds: D in 1/ms, p; 0: no rate dependence
};

/// What a part is pressed from.
struct GaugeSpec {
  double thickness = 0.0;  // mm
  std::string material;
};

/// A closed member of two halves (or of a hat and the panel that it is welded to).
struct MemberSpec {
  Hat outer;                 // what bulges outwards
  double inner_depth = 0.0;  // of the other half, mm; 0: a closing plate, or the panel
};

/// A node that parts around a place carry: something heavy that is no sheet hangs there, or a spring or bearing pushes.
struct MountSpec {
  std::string name;
  double mass = 0.0;  // g; 0: a mount
  Vector place;
  std::array<double, 3> size{};    // of a box with the same inertia, mm
  std::vector<std::string> parts;  // that carry it
  double reach = 0.0;              // mm around the place within which they do
  bool both_sides = false;         // the same again on the other side
  std::string where;               // its reach stands, for messages
};

/// The designer's lines.
struct ProfileSpec {
  double wheelbase = 0.0, front_track = 0.0, rear_track = 0.0, wheel_height = 0.0;  // mm; height of the wheel centres
  std::string wheel_height_where, front_track_where, rear_track_where;  // they stand, for faults that tyres and body bring to light
  Graph plan;      // half width of the car at its widest height against x
  Graph section;   // the same in parts of it against z
  Graph waist;     // z of the lower edge of the windows, and of the wings' upper one, against x
  Graph roof;      // z of the roof in the middle against x
  Graph tail;      // x of the tail against z
  double roof_crown = 0.0;  // by which the roof's edges lie lower than its middle
  double arch_radius = 0.0;   // of the wheel arches' edges
  double wing_front = 0.0;    // x where the wings end
  double bumper_height = 0.0, hatch_sill = 0.0;  // z of the skin's lower edge before and behind the wheels; of the tailgate's
  double window_rear = 0.0;   // x of the side window's rear end on the waist
};

struct BodySpec {
  double floor_height = 0.0, floor_half_width = 0.0;
  double tunnel_foot = 0.0, tunnel_crown = 0.0, tunnel_height = 0.0;  // half widths below and above
  double kick_front = 0.0, kick_rear = 0.0, rear_floor_height = 0.0, rear_floor_half_width = 0.0;
  double well_centre = 0.0, well_radius = 0.0, well_depth = 0.0;
  double pillar_front = 0.0, pillar_middle = 0.0;  // x of the hinge pillar and of the B pillar
  double sill_height = 0.0;
  double seat_front = 0.0, seat_rear = 0.0;     // x of the cross members below the front seats
  double dash_x = 0.0, dash_height = 0.0;       // of the beam behind the firewall
  std::vector<Vector> firewall;    // from the floor to the cowl in the plane y = 0
  std::vector<Vector> front_rail, upper_rail, rear_rail;  // lines of the left ones
  double rail_extension = 0.0;     // x where the front rail ends below the floor
  Vector strut_top;                // of the left one
  double tower_half_length = 0.0, tower_half_width = 0.0, tower_middle = 0.0, tower_dome = 0.0, tower_hole = 0.0;
  double radiator_x = 0.0, radiator_top = 0.0, radiator_bottom = 0.0;
  std::string where;  // it is described, for messages
};

struct CarSpec {
  std::string file_name, title;
  std::string fidelity;  // complete, semi-flexible or rigid
  std::string tyre, tyre_where;  // path of the tyre's description, and where it stands for messages
  std::array<std::optional<double>, 4> pressure;  // MPa that is left in tyres which lose their air as the drive begins
  double pressure_loss_time = 0.0;                // ms in which they do
  double mesh_size = 0.0, weld_pitch = 0.0;  // mm
  ProfileSpec profile;
  BodySpec body;
  std::map<std::string, MemberSpec> members;
  std::map<std::string, GaugeSpec> gauges;  // by part, without its side
  std::string gauges_where;                 // they stand, for messages
  std::vector<SheetMaterial> materials;
  std::vector<MountSpec> masses, mounts;
  ChassisSpec chassis;
};

/// Members that every body has, in the order of the reader's messages.
extern const std::vector<std::string> member_names;

/// @throws InputError with every fault found.
CarSpec read_car_spec(const std::string& toml_text, const std::string& file_name, const FileText& load,
                      const CarChoices& choices = {});

}  // namespace balocco::car
