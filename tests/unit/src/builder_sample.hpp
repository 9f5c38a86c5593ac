// A small tyre description for the builder's tests.
#pragma once

#include <optional>
#include <string>

namespace balocco {

/// What reads files for a description that names none.
inline std::optional<std::string> no_file(const std::string&) {
  return std::nullopt;
}

inline std::string sample_tyre(int model = 3) {
  return "title = \"sample\"\nmodel = " + std::to_string(model) + R"(
[rubber.soft]
c10 = 0.4
c01 = 0.1
density = 1.1e-3
[cord.steel]
modulus = 180000.0
poisson = 0.3
density = 7.85e-3
[cord.polyester]
modulus = 9870.0
poisson = 0.3
density = 1.38e-3
[ply.body]
rubber = "soft"
thickness = 1.0
cord = "polyester"
cord_area = 0.25
spacing = 1.25
angle_to_meridian = 0.0
[ply.belt]
rubber = "soft"
thickness = 1.0
cord = "steel"
cord_area = 0.22
spacing = 1.1
angle_to_circumference = 20.0
[ply.liner]
rubber = "soft"
thickness = 1.2
[section]
crown_radius = 276.0
cap_layers = 2
base_rubber = "soft"
cap_rubber = "soft"
sidewall_rubber = "soft"
apex_rubber = "soft"
rim_strip_rubber = "soft"
[section.belt]
points = [[275.6, 20.0, 2.5, 5.5], [274.3, 40.0, 2.5, 5.3], [271.8, 58.0, 2.5, 4.8]]
elements = 4
plies = ["belt", "body", "liner"]
[section.shoulder]
points = [[268.6, 66.0, 3.0, 4.6], [263.8, 72.8, 3.8, 4.2]]
elements = 2
plies = ["body", "liner"]
[section.sidewall]
points = [[256.0, 78.4, 4.2], [236.0, 82.2, 3.5], [216.0, 74.6, 4.8], [207.5, 68.6, 6.2]]
elements = 6
plies = ["body", "liner"]
[section.bead]
points = [[200.0, 62.5, 5.0, 3.5], [192.5, 58.7, 6.5, 3.5], [185.5, 57.0, 7.0, 3.5], [177.4, 56.5, 7.0, 4.0]]
elements = 4
plies = ["body", "liner"]
turn_up = ["body"]
rim_strip_top = 2.5
[bead_wire]
area = 35.0
bottom = 5.0
top = 13.0
modulus = 200000.0
density = 7.85e-3
[rim]
diameter = 354.8
width = 127.0
flange_height = 15.5
mass = 5000.0
spin_inertia = 9.0e7
transverse_inertia = 5.5e7
[mesh]
sectors = 60
arc_angle = 90.0
arc_center_angle = 20.0
arc_sectors = 36
[static]
pressure = 0.22
seating_pressure = 0.02
load = 3061.0
contact_deflection = 8.0
[road]
clearance = 5.0
behind = 500.0
ahead = 1000.0
friction = 0.9
obstacle_height = 25.0
obstacle_length = 100.0
obstacle_start = 350.0
top_fillet = 4.0
foot_fillet = 3.0
[rolling]
speed = 11.11
settle_duration = 10.0
duration = 40.0
[output]
frames = 20
history_interval = 0.1
)";
}

/// The sample with `from` replaced by `to` (the first time it occurs).
inline std::string sample_with(const std::string& from, const std::string& to, int model = 3) {
  auto text = sample_tyre(model);
  const auto at = text.find(from);
  return at == std::string::npos ? std::string("the sample has no such text: ") + from
                                 : text.replace(at, from.size(), to);
}

}  // namespace balocco
