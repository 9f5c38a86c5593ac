// The description of a tyre, its rim, its road and its run, as read from TOML. Units mm, ms, g, N, MPa; angles in
// radians.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "builders/file_text.hpp"

namespace balocco {

class SpecTable;

/// Mooney-Rivlin rubber.
struct RubberSpec {
  std::string name;
  double c10 = 0.0, c01 = 0.0;  // MPa
  double bulk_to_shear = 20.0;  // initial bulk / shear modulus
  double density = 0.0;         // g/mm3
  double damping_alpha = 0.0;   // 1/ms
  double damping_beta = 0.0;    // ms

  double shear_modulus() const { return 2.0 * (c10 + c01); }
  double bulk_modulus() const { return bulk_to_shear * shear_modulus(); }
};

struct CordSpec {
  std::string name;
  double modulus = 0.0, poisson = 0.0, density = 0.0;  // MPa, -, g/mm3
};

/// One ply of the carcass or the belts: cords in a rubber sheet, or the sheet alone (`cord` < 0).
struct PlySpec {
  std::string name;
  int rubber = -1, cord = -1;
  double thickness = 0.0;  // mm
  double cord_area = 0.0;  // mm2
  double spacing = 0.0;    // mm between cords; of a gathering ply: at the crown
  bool gathers = false;  // cords run from bead to bead: as many at every radius, so they draw together towards the bead
  double angle = 0.0;    // from the circumference, about the outward normal
};

/// A point of the right half of the moulded carcass line and the rubber outside it there.
struct SectionPoint {
  double radius = 0.0, axial = 0.0;  // mm, axial >= 0
  double base = 0.0;                 // rubber normal to the line, the layer that runs from bead to bead
  double cap = 0.0;                  // and on top of it: the tread cap, or the rim strip
};

/// The rubber outside the line.
enum class SolidPart { tread_base, tread_cap, sidewall, apex, rim_strip };
constexpr int solid_part_count = 5;
constexpr std::array<const char*, solid_part_count> solid_part_names{"TREAD_BASE", "TREAD_CAP", "SIDEWALL_SOLID",
                                                                     "APEX", "RIM_STRIP"};

enum class Region { belt, shoulder, sidewall, bead };
constexpr int region_count = 4;
constexpr std::array<const char*, region_count> region_names{"belt", "shoulder", "sidewall", "bead"};

/// Part of the section between the last point of the region above and its own last point.
struct RegionSpec {
  std::vector<SectionPoint> points;
  int elements = 0;
  std::vector<int> plies;  // rows of TyreSpec::plies, from outside to inside
  std::string where;       // the points stand, for messages
};

struct BeadSpec {
  double area = 0.0;  // mm2 of wire a side
  double modulus = 0.0, poisson = 0.0, density = 0.0;
  double bottom = 0.0, top = 0.0;  // mm above the toe between which the bundle of wires lies
  std::string where;               // the bottom stands, for messages
};

struct RimSpec {
  double diameter = 0.0, width = 0.0;                   // mm
  double flange_height = 0.0;                           // mm above the seat over which bead and rim touch
  double pad = 0.0;                                     // mm of rubber between rim and carcass that strikes it; 0: it cannot
  double mass = 0.0;                                    // g
  double spin_inertia = 0.0, transverse_inertia = 0.0;  // g mm2
};

struct MeshSpec {
  int sectors = 0;                           // around the whole tyre, outside the refined arc
  double arc_angle = 0.0, arc_center = 0.0;  // radians; model 3
  int arc_sectors = 0;
};

struct StaticSpec {
  double pressure = 0.0, seating_pressure = 0.0;  // MPa
  double load = 0.0;                              // N
  double contact_deflection = 0.0;                // mm by which the road rises beyond first touch
  double expected_stiffness = 0.0;                // N/mm, for the estimate of the rolling radius
  bool stabilize = false;
};

/// A hole across the road with a straight ramp at each end, its edges rounded.
struct PotholeSpec {
  double depth = 0.0, length = 0.0, start = 0.0;  // mm; depth 0: none; length from edge to edge at the top
  double ramp = 0.0, fillet = 0.0;                // mm: length of a ramp along the road, radius of the edges
};

struct RoadSpec {
  double clearance = 0.0;                                                     // mm below the moulded tread
  double behind = 0.0, ahead = 0.0;                                           // mm of flat road
  double obstacle_height = 0.0, obstacle_length = 0.0, obstacle_start = 0.0;  // mm; height 0: none
  double top_fillet = 0.0, foot_fillet = 0.0;                                 // mm
  double friction = 0.0;
  PotholeSpec pothole;
};

struct RollingSpec {
  bool enabled = true;
  double speed = 0.0;                            // mm/ms
  std::optional<double> rolling_radius;          // mm
  double settle_duration = 0.0, duration = 0.0;  // ms
  double linear_bulk_viscosity = 0.06, quadratic_bulk_viscosity = 1.2;
  double scale_factor = 0.9;  // of the stable increment
};

struct OutputSpec {
  int frames = 0, settle_frames = 0;
  double history_interval = 0.0;  // ms
  int checkpoints = 0;
};

struct TyreSpec {
  std::string file_name, title;
  int model = 3;
  std::string membrane_type;  // M3D4R or M3D4
  std::string solid_type;     // C3D8R or C3D8
  std::vector<RubberSpec> rubbers;
  std::vector<CordSpec> cords;
  std::vector<PlySpec> plies;
  double crown_radius = 0.0;  // of the line, at axial 0; its rubber is that of the first point
  std::array<RegionSpec, region_count> regions;
  int cap_layers = 1;
  std::array<int, solid_part_count> part_rubbers{-1, -1, -1, -1, -1};  // rows of `rubbers`
  std::vector<int> turn_up;    // plies folded back around the bead: between apex and rim strip
  double rim_strip_top = 0.0;  // thickness of the rim strip at its upper end, mm
  BeadSpec bead;
  RimSpec rim;
  MeshSpec mesh;
  StaticSpec statics;
  RoadSpec road;
  RollingSpec rolling;
  OutputSpec output;

  const RegionSpec& region(Region r) const { return regions[static_cast<int>(r)]; }
};

/// The table [road] of a description.
void read_road(SpecTable& top, RoadSpec& road);

/// @throws InputError with every fault found.
TyreSpec read_tyre_spec(const std::string& toml_text, const std::string& file_name, const FileText& load);

}  // namespace balocco
