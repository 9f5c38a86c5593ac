#include "builders/tyre_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "builders/spec_table.hpp"

namespace balocco {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Row of the item called `name`, -1 with a fault when there is none.
template <class Item>
int find_named(const std::vector<Item>& items, const std::string& name, SpecTable& table, std::string_view key) {
  if (name.empty()) return -1;  // missing or not a text, which has been reported
  std::vector<std::string> names;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) return static_cast<int>(i);
    names.push_back(items[i].name);
  }
  const auto nearest = nearest_word(name, names);
  table.fault(
      key, fmt::format("\"{}\" is not described in this file; {}", name,
                       nearest.empty() ? "describe it or name another" : fmt::format("did you mean \"{}\"?", nearest)));
  return -1;
}

void read_rubbers(SpecTable& top, TyreSpec& spec) {
  auto all = top.table("rubber");
  for (const auto& name : all.table_names()) {
    auto table = all.table(name);
    RubberSpec rubber{.name = name};
    rubber.c10 = table.number("c10", Bounds::not_negative("MPa"));
    rubber.c01 = table.number("c01", Bounds::not_negative("MPa"));
    rubber.bulk_to_shear = table.number("bulk_to_shear", Bounds::between(1.0, 1e4, ""), 20.0);
    rubber.density = table.number("density", Bounds::positive("g/mm3"));
    rubber.damping_alpha = table.number("damping_alpha", Bounds::not_negative("1/ms"), 0.0);
    rubber.damping_beta = table.number("damping_beta", Bounds::not_negative("ms"), 0.0);
    if (rubber.c10 + rubber.c01 <= 0.0)
      table.fault("c10", "c10 + c01 is 0, which is no stiffness at all; give one of them a value > 0 MPa");
    table.refuse_unknown();
    spec.rubbers.push_back(rubber);
  }
  all.refuse_unknown();
}

void read_cords(SpecTable& top, TyreSpec& spec) {
  auto all = top.table("cord");
  for (const auto& name : all.table_names()) {
    auto table = all.table(name);
    spec.cords.push_back({.name = name,
                          .modulus = table.number("modulus", Bounds::positive("MPa")),
                          .poisson = table.number("poisson", Bounds::between(0.0, 0.499, "")),
                          .density = table.number("density", Bounds::positive("g/mm3"))});
    table.refuse_unknown();
  }
  all.refuse_unknown();
}

/// The angle of a ply's cords from the circumference, told from whichever line suits the ply (`meridional`: from the
/// meridian).
double read_angle(SpecTable& table, bool& meridional) {
  const auto range = Bounds::between(-90.0, 90.0, "degrees");
  const bool meridian = table.has("angle_to_meridian"), circumference = table.has("angle_to_circumference");
  if (meridian == circumference) {
    table.fault("angle_to_meridian",
                "a ply with cords needs exactly one of angle_to_meridian and angle_to_circumference; keep one");
    if (!meridian) return 0.0;
  }
  if (meridian) {
    meridional = true;
    const double angle = 90.0 * degree - table.number("angle_to_meridian", range) * degree;
    if (circumference) table.number("angle_to_circumference", range);
    return angle;
  }
  return table.number("angle_to_circumference", range) * degree;
}

void read_plies(SpecTable& top, TyreSpec& spec) {
  auto all = top.table("ply");
  for (const auto& name : all.table_names()) {
    auto table = all.table(name);
    PlySpec ply{.name = name};
    ply.thickness = table.number("thickness", Bounds::positive("mm"));
    ply.rubber = find_named(spec.rubbers, table.text("rubber", {}), table, "rubber");
    if (table.has("cord")) {
      ply.cord = find_named(spec.cords, table.text("cord", {}), table, "cord");
      ply.cord_area = table.number("cord_area", Bounds::positive("mm2"));
      ply.spacing = table.number("spacing", Bounds::positive("mm"));
      ply.angle = read_angle(table, ply.gathers);
      if (ply.spacing > 0.0 && ply.thickness > 0.0 && ply.cord_area >= 0.9 * ply.spacing * ply.thickness)
        table.fault("cord_area",
                    fmt::format("cords fill {:.0f} % of the ply; keep cord_area below 0.9 * spacing * thickness",
                                100.0 * ply.cord_area / (ply.spacing * ply.thickness)));
    }
    table.refuse_unknown();
    spec.plies.push_back(ply);
  }
  all.refuse_unknown();
}

void read_points(SpecTable& table, bool has_cap, RegionSpec& region) {
  const std::size_t columns = has_cap ? 4 : 3;
  for (const auto& row : table.rows("points", columns, columns)) {
    const SectionPoint point{row[0], row[1], row[2], has_cap ? row[3] : 0.0};
    if (point.radius <= 0.0 || point.axial <= 0.0 || point.base <= 0.0 || (has_cap && point.cap <= 0.0))
      table.fault(
          "points",
          fmt::format("row {}: radius, axial position and thicknesses must be > 0 mm (the right half of the section)",
                      region.points.size() + 1));
    region.points.push_back(point);
  }
  if (table.has("points") && region.points.empty())
    table.fault("points", "empty; give at least the last point of the region");
}

std::vector<int> read_ply_names(SpecTable& table, std::string_view key, const TyreSpec& spec) {
  std::vector<int> plies;
  for (const auto& name : table.texts(key)) plies.push_back(find_named(spec.plies, name, table, key));
  if (table.has(key) && plies.empty()) table.fault(key, "empty; a membrane needs at least one ply");
  return plies;
}

void read_section(SpecTable& top, TyreSpec& spec) {
  auto section = top.table("section");
  spec.crown_radius = section.number("crown_radius", Bounds::positive("mm"));
  spec.cap_layers = section.integer("cap_layers", 1, 8, 1);
  constexpr std::array<const char*, solid_part_count> rubber_keys{"base_rubber", "cap_rubber", "sidewall_rubber",
                                                                  "apex_rubber", "rim_strip_rubber"};
  for (int part = 0; part < solid_part_count; ++part)
    spec.part_rubbers[part] = find_named(spec.rubbers, section.text(rubber_keys[part], {}), section, rubber_keys[part]);
  for (int r = 0; r < region_count; ++r) {
    auto table = section.table(region_names[r]);
    auto& region = spec.regions[r];
    read_points(table, static_cast<Region>(r) != Region::sidewall, region);
    region.where = table.where("points");
    region.elements = table.integer("elements", 1, 200);
    region.plies = read_ply_names(table, "plies", spec);
    if (static_cast<Region>(r) == Region::bead) {
      spec.turn_up = read_ply_names(table, "turn_up", spec);
      spec.rim_strip_top = table.number("rim_strip_top", Bounds::positive("mm"));
    }
    table.refuse_unknown();
  }
  section.refuse_unknown();
  double radius = spec.crown_radius + 1e-9;
  for (const auto& region : spec.regions) {
    for (const auto& point : region.points) {
      if (point.radius >= radius)
        section.fault(
            "crown_radius",
            fmt::format("the line must fall from crown to toe, but radius {} mm follows {:.6g} mm; order the points",
                        point.radius, radius));
      radius = point.radius;
    }
  }
}

void read_bead_and_rim(SpecTable& top, TyreSpec& spec) {
  auto bead = top.table("bead_wire");
  spec.bead.area = bead.number("area", Bounds::positive("mm2"));
  spec.bead.modulus = bead.number("modulus", Bounds::positive("MPa"));
  spec.bead.poisson = bead.number("poisson", Bounds::between(0.0, 0.499, ""), 0.3);
  spec.bead.density = bead.number("density", Bounds::positive("g/mm3"));
  spec.bead.bottom = bead.number("bottom", Bounds::not_negative("mm"));
  spec.bead.where = bead.where("bottom");
  spec.bead.top = bead.number("top", Bounds::positive("mm"));
  if (spec.bead.top <= spec.bead.bottom) bead.fault("top", "not above the bottom; give the bundle a height");
  bead.refuse_unknown();

  auto rim = top.table("rim");
  spec.rim.diameter = rim.number("diameter", Bounds::positive("mm"));
  spec.rim.width = rim.number("width", Bounds::positive("mm"));
  spec.rim.flange_height = rim.number("flange_height", Bounds::positive("mm"));
  spec.rim.pad = rim.number("pad", Bounds::not_negative("mm"), 0.0);
  spec.rim.mass = rim.number("mass", Bounds::positive("g"));
  spec.rim.spin_inertia = rim.number("spin_inertia", Bounds::positive("g mm2"));
  spec.rim.transverse_inertia = rim.number("transverse_inertia", Bounds::positive("g mm2"));
  rim.refuse_unknown();
}

void read_mesh(SpecTable& top, TyreSpec& spec) {
  auto mesh = top.table("mesh");
  spec.mesh.sectors = mesh.integer("sectors", 8, 2000);
  const auto angle = Bounds::between(1.0, 350.0, "degrees");
  if (spec.model == 3 || mesh.has("arc_angle") || mesh.has("arc_center_angle") || mesh.has("arc_sectors")) {
    spec.mesh.arc_angle = mesh.number("arc_angle", angle) * degree;
    spec.mesh.arc_center = mesh.number("arc_center_angle", Bounds::between(-180.0, 180.0, "degrees")) * degree;
    spec.mesh.arc_sectors = mesh.integer("arc_sectors", 1, 2000);
  }
  mesh.refuse_unknown();
}

void read_static(SpecTable& top, TyreSpec& spec) {
  auto table = top.table("static");
  auto& statics = spec.statics;
  statics.pressure = table.number("pressure", Bounds::positive("MPa"));
  statics.seating_pressure = table.number("seating_pressure", Bounds::not_negative("MPa"), 0.0);
  statics.load = table.number("load", Bounds::positive("N"));
  statics.contact_deflection = table.number("contact_deflection", Bounds::positive("mm"));
  statics.expected_stiffness = table.number("expected_stiffness", Bounds::positive("N/mm"), 185.0);
  statics.stabilize = table.boolean("stabilize", false);
  if (statics.seating_pressure > statics.pressure)
    table.fault("seating_pressure", "higher than the inflation pressure; seat with less");
  table.refuse_unknown();
}

void read_rolling_and_output(SpecTable& top, TyreSpec& spec) {
  auto table = top.table("rolling");
  auto& rolling = spec.rolling;
  rolling.enabled = table.boolean("enabled", true);
  rolling.speed = table.number("speed", Bounds::not_negative("mm/ms"));
  if (table.has("rolling_radius")) rolling.rolling_radius = table.number("rolling_radius", Bounds::positive("mm"));
  rolling.settle_duration = table.number("settle_duration", Bounds::not_negative("ms"), 0.0);
  rolling.duration = table.number("duration", Bounds::positive("ms"));
  rolling.linear_bulk_viscosity = table.number("linear_bulk_viscosity", Bounds::not_negative(""), 0.06);
  rolling.quadratic_bulk_viscosity = table.number("quadratic_bulk_viscosity", Bounds::not_negative(""), 1.2);
  rolling.scale_factor = table.number("scale_factor", Bounds::between(0.01, 1.0, ""), 0.9);
  if (rolling.enabled && spec.road.ahead > 0.0 &&
      rolling.speed * (rolling.settle_duration + rolling.duration) >= spec.road.ahead)
    table.fault("duration",
                fmt::format("the wheel travels {:.0f} mm and leaves the road; shorten the run or lengthen [road] ahead",
                            rolling.speed * (rolling.settle_duration + rolling.duration)));
  table.refuse_unknown();

  auto output = top.table("output");
  spec.output.frames = output.integer("frames", 1, 100000);
  spec.output.settle_frames = output.integer("settle_frames", 1, 100000, 4);
  spec.output.history_interval = output.number("history_interval", Bounds::positive("ms"));
  spec.output.checkpoints = output.integer("checkpoints", 0, 1000, 0);
  output.refuse_unknown();
}

}  // namespace

namespace {

void read_pothole(SpecTable& road_table, double ahead, PotholeSpec& pothole) {
  auto table = road_table.table("pothole");
  pothole.depth = table.number("depth", Bounds::positive("mm"));
  pothole.length = table.number("length", Bounds::positive("mm"));
  pothole.start = table.number("start", Bounds::positive("mm"));
  pothole.ramp = table.number("ramp", Bounds::positive("mm"));
  pothole.fillet = table.number("fillet", Bounds::not_negative("mm"));
  const double round = pothole.fillet * std::tan(0.5 * std::atan2(pothole.depth, pothole.ramp));  // of either piece at an edge
  if (2.0 * round > std::hypot(pothole.depth, pothole.ramp))
    table.fault("fillet", "two fillets are longer than a ramp; make them smaller");
  if (2.0 * (pothole.ramp + round) > pothole.length) table.fault("ramp", "two ramps are longer than the hole; make them shorter");
  if (pothole.start + pothole.length + round >= ahead)
    table.fault("start", "the road ends before the hole does; lengthen [road] ahead");
  table.refuse_unknown();
}

}  // namespace

void read_road(SpecTable& top, RoadSpec& road) {
  auto table = top.table("road");
  road.clearance = table.number("clearance", Bounds::positive("mm"));
  road.behind = table.number("behind", Bounds::positive("mm"));
  road.ahead = table.number("ahead", Bounds::positive("mm"));
  road.friction = table.number("friction", Bounds::not_negative(""));
  road.obstacle_height = table.number("obstacle_height", Bounds::not_negative("mm"), 0.0);
  if (road.obstacle_height > 0.0) {
    road.obstacle_length = table.number("obstacle_length", Bounds::positive("mm"));
    road.obstacle_start = table.number("obstacle_start", Bounds::positive("mm"));
    road.top_fillet = table.number("top_fillet", Bounds::not_negative("mm"));
    road.foot_fillet = table.number("foot_fillet", Bounds::not_negative("mm"));
    if (road.top_fillet + road.foot_fillet > road.obstacle_height)
      table.fault("top_fillet", "the two fillets together are higher than the obstacle; make them smaller");
    if (2.0 * road.top_fillet > road.obstacle_length)
      table.fault("top_fillet", "two fillets are longer than the obstacle; make them smaller");
    if (road.obstacle_start + road.obstacle_length + 2.0 * road.foot_fillet >= road.ahead)
      table.fault("ahead", "the road ends before the obstacle does; make it longer");
  }
  if (table.has("pothole")) read_pothole(table, road.ahead, road.pothole);
  table.refuse_unknown();
}

TyreSpec read_tyre_spec(const std::string& toml_text, const std::string& file_name, const FileText& load) {
  const auto file = parse_spec(toml_text, file_name, load);
  SpecFaults faults(file_name);
  SpecTable top(&file, "", faults);
  TyreSpec spec;
  spec.file_name = file_name;
  spec.title = top.text("title", {}, "Tyre");
  spec.model = top.integer("model", 1, 3);
  spec.membrane_type = top.text("membrane_type", {"M3D4R", "M3D4"}, "M3D4R");
  spec.solid_type = top.text("solid_type", {"C3D8R", "C3D8"}, "C3D8R");
  read_rubbers(top, spec);
  read_cords(top, spec);
  read_plies(top, spec);
  read_section(top, spec);
  read_bead_and_rim(top, spec);
  read_mesh(top, spec);
  read_static(top, spec);
  read_road(top, spec.road);
  read_rolling_and_output(top, spec);
  top.refuse_unknown();
  faults.throw_if_any();
  return spec;
}

}  // namespace balocco
