// What is welded to what.
#include <fmt/format.h>

#include <algorithm>

#include "builders/car/body_parts.hpp"

namespace balocco::car {
namespace {

enum class Meeting { flange, edge };  // sheets that lie on one another; an edge that stands on a sheet

struct Joined {
  const char *first, *second;
  Meeting meeting = Meeting::flange;
};

constexpr auto edge = Meeting::edge;

constexpr Joined joined[]{
    {"FLOOR", "REAR_FLOOR"},
    {"FLOOR", "FIREWALL"},
    {"FLOOR", "SILL_INNER", edge},
    {"REAR_FLOOR", "SILL_INNER", edge},
    {"SILL_OUTER", "SILL_INNER"},
    {"RAIL_EXTENSION", "FIREWALL", edge},
    {"RAIL_EXTENSION", "FLOOR", edge},
    {"SEAT_CROSS_MEMBER_FRONT", "FLOOR", edge},
    {"SEAT_CROSS_MEMBER_FRONT", "SILL_INNER", edge},
    {"SEAT_CROSS_MEMBER_REAR", "FLOOR", edge},
    {"SEAT_CROSS_MEMBER_REAR", "SILL_INNER", edge},
    {"HEEL_CROSS_MEMBER", "FLOOR", edge},
    {"HEEL_CROSS_MEMBER", "SILL_INNER", edge},
    {"HINGE_CROSS_MEMBER", "REAR_FLOOR", edge},
    {"HINGE_CROSS_MEMBER", "REAR_RAIL", edge},
    {"REAR_RAIL", "REAR_FLOOR", edge},
    {"REAR_RAIL", "SILL_INNER", edge},
    {"AXLE_CROSS_MEMBER", "REAR_FLOOR", edge},
    {"AXLE_CROSS_MEMBER", "REAR_RAIL", edge},
    {"REAR_WHEEL_ARCH", "REAR_FLOOR", edge},
    {"REAR_WHEEL_ARCH", "REAR_RAIL", edge},
    {"REAR_WHEEL_ARCH", "SILL_INNER", edge},
    {"REAR_WHEEL_ARCH", "SILL_OUTER", edge},
    {"REAR_WHEEL_ARCH", "QUARTER_PANEL", edge},
    {"QUARTER_INNER", "REAR_WHEEL_ARCH", edge},
    {"QUARTER_INNER", "WAIST_RAIL", edge},
    {"FRONT_RAIL_OUTER", "FRONT_RAIL_INNER"},
    {"FRONT_RAIL_OUTER", "RAIL_EXTENSION", edge},
    {"FRONT_RAIL_INNER", "RAIL_EXTENSION", edge},
    {"UPPER_RAIL_OUTER", "UPPER_RAIL_INNER"},
    {"UPPER_RAIL_OUTER", "HINGE_PILLAR_OUTER", edge},
    {"UPPER_RAIL_OUTER", "HINGE_PILLAR_INNER", edge},
    {"UPPER_RAIL_INNER", "HINGE_PILLAR_INNER", edge},
    {"STRUT_HOUSE_TOP", "STRUT_HOUSE_WALL"},
    {"STRUT_HOUSE_WALL", "UPPER_RAIL_INNER", edge},
    {"STRUT_HOUSE_WALL", "FRONT_RAIL_OUTER", edge},
    {"STRUT_HOUSE_WALL", "FRONT_RAIL_INNER", edge},
    {"WHEEL_ARCH_FRONT", "STRUT_HOUSE_WALL", edge},
    {"WHEEL_ARCH_REAR", "STRUT_HOUSE_WALL", edge},
    {"WHEEL_ARCH_FRONT", "FRONT_RAIL_OUTER", edge},
    {"WHEEL_ARCH_REAR", "FRONT_RAIL_OUTER", edge},
    {"WHEEL_ARCH_FRONT", "UPPER_RAIL_INNER", edge},
    {"WHEEL_ARCH_REAR", "UPPER_RAIL_INNER", edge},
    {"WHEEL_ARCH_REAR", "FIREWALL", edge},
    {"DASH_BEAM", "HINGE_PILLAR_INNER", edge},
    {"COWL", "FIREWALL", edge},
    {"COWL", "HINGE_PILLAR_INNER", edge},
    {"FIREWALL", "HINGE_PILLAR_INNER", edge},
    {"FIREWALL", "SILL_INNER", edge},
    {"RADIATOR_UPPER", "UPPER_RAIL_INNER", edge},
    {"RADIATOR_UPPER", "UPPER_RAIL_OUTER", edge},
    {"RADIATOR_POST", "RADIATOR_UPPER", edge},
    {"RADIATOR_POST", "RADIATOR_LOWER", edge},
    {"RADIATOR_POST", "FRONT_RAIL_OUTER", edge},
    {"BUMPER_BEAM", "FRONT_RAIL_OUTER", edge},
    {"BUMPER_BEAM", "FRONT_RAIL_INNER", edge},
    {"WING", "UPPER_RAIL_OUTER", edge},
    {"WING", "RADIATOR_UPPER", edge},
    {"WING", "BUMPER_BEAM", edge},
    {"WING", "HINGE_PILLAR_OUTER", edge},
    {"HINGE_PILLAR_OUTER", "HINGE_PILLAR_INNER"},
    {"HINGE_PILLAR_OUTER", "SILL_OUTER", edge},
    {"HINGE_PILLAR_INNER", "SILL_INNER", edge},
    {"HINGE_PILLAR_OUTER", "SIDE_FRAME_OUTER", edge},
    {"HINGE_PILLAR_INNER", "SIDE_FRAME_INNER", edge},
    {"SIDE_FRAME_OUTER", "SIDE_FRAME_INNER"},
    {"B_PILLAR_OUTER", "B_PILLAR_INNER"},
    {"B_PILLAR_OUTER", "SILL_OUTER", edge},
    {"B_PILLAR_INNER", "SILL_INNER", edge},
    {"B_PILLAR_OUTER", "SIDE_FRAME_OUTER", edge},
    {"B_PILLAR_INNER", "SIDE_FRAME_INNER", edge},
    {"ROOF", "SIDE_FRAME_OUTER"},
    {"WINDSCREEN", "SIDE_FRAME_OUTER"},
    {"WINDSCREEN", "ROOF"},
    {"WINDSCREEN", "COWL", edge},
    {"ROOF_HEADER_FRONT", "ROOF", edge},
    {"ROOF_BOW_FRONT", "ROOF", edge},
    {"ROOF_BOW_REAR", "ROOF", edge},
    {"ROOF_HEADER_REAR", "ROOF", edge},
    {"ROOF_HEADER_FRONT", "SIDE_FRAME_INNER", edge},
    {"ROOF_BOW_FRONT", "SIDE_FRAME_INNER", edge},
    {"ROOF_BOW_REAR", "SIDE_FRAME_INNER", edge},
    {"ROOF_HEADER_REAR", "SIDE_FRAME_INNER", edge},
    {"QUARTER_PANEL", "B_PILLAR_OUTER", edge},
    {"QUARTER_PANEL", "SILL_OUTER", edge},
    {"QUARTER_PANEL", "WAIST_RAIL", edge},
    {"QUARTER_PANEL", "SIDE_FRAME_OUTER", edge},
    {"WAIST_RAIL", "B_PILLAR_OUTER", edge},
    {"WAIST_RAIL", "SIDE_FRAME_OUTER", edge},
    {"WAIST_RAIL", "SIDE_FRAME_INNER", edge},
    {"C_PILLAR", "QUARTER_PANEL"},
    {"C_PILLAR", "SIDE_FRAME_OUTER", edge},
    {"REAR_PANEL", "REAR_FLOOR"},
    {"REAR_PANEL", "SIDE_FRAME_OUTER", edge},
    {"REAR_PANEL", "SIDE_FRAME_INNER", edge},
    {"REAR_RAIL", "REAR_PANEL", edge},
    {"HATCH_SILL", "REAR_PANEL", edge},
    {"HATCH_SILL", "SIDE_FRAME_INNER", edge},
    {"REAR_BUMPER_BEAM", "REAR_PANEL", edge},
    {"SUBFRAME_UPPER", "SUBFRAME_LOWER"},
};

}  // namespace

std::vector<WeldLine> weld_body(const CarSpec& spec, BodyMesh& mesh) {
  // An edge finds the nearest node of the sheet that it stands on: half a mesh size away and more in the sheet's plane. Sheets are drawn
  // up to some 20 mm apart, however fine the mesh.
  const double size = std::max(spec.mesh_size, 40.0), on_flange = 0.25 * size + 2.0, at_edge = 0.5 * size + 10.0;
  std::vector<WeldLine> lines;
  for (const auto& [first, second, meeting] : joined)
    lines.push_back({first, second, mesh.weld(first, second, meeting == Meeting::flange ? on_flange : at_edge, spec.weld_pitch)});
  return lines;
}

}  // namespace balocco::car
