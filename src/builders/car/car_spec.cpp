#include "builders/car/car_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "builders/spec_table.hpp"

namespace balocco::car {
namespace {

const auto place_row = Bounds::any("mm");

Vector vector_of(const std::vector<double>& row) {
  return {row[0], row[1], row[2]};
}

/// A function through rows of two numbers whose first ones rise.
Graph read_graph(SpecTable& table, std::string_view key) {
  std::vector<std::array<double, 2>> rows;
  for (const auto& row : table.rows(key, 2, 2)) {
    if (!rows.empty() && row[0] <= rows.back()[0])
      table.fault(key, fmt::format("{:g} follows {:g}; list the rows by their first number, rising", row[0], rows.back()[0]));
    rows.push_back({row[0], row[1]});
  }
  if (rows.size() < 2) {
    if (table.has(key)) table.fault(key, "one row is no line; give two or more");
    rows = {{0.0, 0.0}, {1.0, 0.0}};
  }
  return Graph(std::move(rows));
}

/// Points of a line, from front to rear or upwards.
std::vector<Vector> read_line(SpecTable& table, std::string_view key, std::size_t least) {
  std::vector<Vector> line;
  for (const auto& row : table.rows(key, 3, 3)) line.push_back(vector_of(row));
  if (line.size() >= least) return line;
  if (table.has(key)) table.fault(key, fmt::format("it has {} points; a line needs {} or more", line.size(), least));
  return {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
}

void read_profile(SpecTable& top, ProfileSpec& profile) {
  auto table = top.table("profile");
  profile.wheelbase = table.number("wheelbase", Bounds::positive("mm"));
  profile.front_track = table.number("front_track", Bounds::positive("mm"));
  profile.rear_track = table.number("rear_track", Bounds::positive("mm"));
  profile.wheel_height = table.number("wheel_height", Bounds::positive("mm"));
  profile.wheel_height_where = table.where("wheel_height");
  profile.front_track_where = table.where("front_track");
  profile.rear_track_where = table.where("rear_track");
  profile.plan = read_graph(table, "plan");
  profile.section = read_graph(table, "section");
  profile.waist = read_graph(table, "waist");
  profile.roof = read_graph(table, "roof");
  profile.tail = read_graph(table, "tail");
  profile.roof_crown = table.number("roof_crown", Bounds::not_negative("mm"));
  profile.arch_radius = table.number("arch_radius", Bounds::positive("mm"));
  profile.wing_front = table.number("wing_front", Bounds::positive("mm"));
  profile.bumper_height = table.number("bumper_height", Bounds::positive("mm"));
  profile.hatch_sill = table.number("hatch_sill", Bounds::positive("mm"));
  profile.window_rear = table.number("window_rear", place_row);
  struct Axle {
    const char* name;
    double x, track;
  };
  const Axle axles[]{{"front", 0.0, profile.front_track}, {"rear", -profile.wheelbase, profile.rear_track}};
  for (const auto& [name, x, track] : axles)
    if (profile.plan(x) < 0.5 * track)
      table.fault("plan", fmt::format("the skin at the {} axle is {:.0f} mm from the middle, inside the wheel's centre at {:.0f} "
                                      "mm; widen the body or narrow the track",
                                      name, profile.plan(x), 0.5 * track));
  table.refuse_unknown();
}

void read_body(SpecTable& top, BodySpec& body) {
  auto table = top.table("body");
  body.where = top.where("body");
  const std::pair<const char*, double*> lengths[]{{"floor_height", &body.floor_height},
                                                  {"floor_half_width", &body.floor_half_width},
                                                  {"tunnel_foot", &body.tunnel_foot},
                                                  {"tunnel_crown", &body.tunnel_crown},
                                                  {"tunnel_height", &body.tunnel_height},
                                                  {"rear_floor_height", &body.rear_floor_height},
                                                  {"rear_floor_half_width", &body.rear_floor_half_width},
                                                  {"well_radius", &body.well_radius},
                                                  {"well_depth", &body.well_depth},
                                                  {"sill_height", &body.sill_height},
                                                  {"dash_height", &body.dash_height},
                                                  {"tower_half_length", &body.tower_half_length},
                                                  {"tower_half_width", &body.tower_half_width},
                                                  {"tower_dome", &body.tower_dome},
                                                  {"tower_hole", &body.tower_hole},
                                                  {"radiator_top", &body.radiator_top},
                                                  {"radiator_bottom", &body.radiator_bottom}};
  for (const auto& [key, value] : lengths) *value = table.number(key, Bounds::positive("mm"));
  const std::pair<const char*, double*> places[]{{"kick_front", &body.kick_front},         {"kick_rear", &body.kick_rear},
                                                 {"well_centre", &body.well_centre},       {"pillar_front", &body.pillar_front},
                                                 {"pillar_middle", &body.pillar_middle},   {"seat_front", &body.seat_front},
                                                 {"seat_rear", &body.seat_rear},           {"dash_x", &body.dash_x},
                                                 {"rail_extension", &body.rail_extension}, {"tower_middle", &body.tower_middle},
                                                 {"radiator_x", &body.radiator_x}};
  for (const auto& [key, value] : places) *value = table.number(key, place_row);
  body.firewall = read_line(table, "firewall", 3);
  body.front_rail = read_line(table, "front_rail", 2);
  body.upper_rail = read_line(table, "upper_rail", 2);
  body.rear_rail = read_line(table, "rear_rail", 2);
  body.strut_top = read_place(table, "strut_top");
  if (body.kick_rear >= body.kick_front)
    table.fault("kick_rear", "the floor rises backwards; give kick_rear a smaller x than kick_front");
  if (body.tunnel_crown >= body.tunnel_foot)
    table.fault("tunnel_crown", "the tunnel is wider above than below; make its crown narrower than its foot");
  if (body.tower_hole >= std::min(body.tower_half_length, body.tower_half_width))
    table.fault("tower_hole", "the hole is larger than the strut house; make it smaller");
  table.refuse_unknown();
}

void read_members(SpecTable& top, CarSpec& spec) {
  auto all = top.table("member");
  for (const auto& name : member_names) {
    auto table = all.table(name);
    auto& member = spec.members[name];
    member.outer.width = table.number("width", Bounds::positive("mm"));
    member.outer.depth = table.number("depth", Bounds::positive("mm"));
    member.outer.flange = table.number("flange", Bounds::not_negative("mm"), 0.0);
    member.outer.end_width = table.number("end_width", Bounds::not_negative("mm"), 0.0);
    member.inner_depth = table.number("inner_depth", Bounds::not_negative("mm"), 0.0);
    table.refuse_unknown();
  }
  all.refuse_unknown();
}

void read_materials(SpecTable& top, CarSpec& spec) {
  auto all = top.table("material");
  for (const auto& name : all.table_names()) {
    auto table = all.table(name);
    SheetMaterial material{.name = name};
    material.modulus = table.number("modulus", Bounds::positive("MPa"));
    material.poisson = table.number("poisson", Bounds::between(0.0, 0.499, ""));
    material.density = table.number("density", Bounds::positive("g/mm3"));
    for (const auto& row : table.rows("plastic", 2, 2)) {
      if (!material.plastic.empty() && (row[0] < material.plastic.back()[0] || row[1] <= material.plastic.back()[1]))
        table.fault("plastic",
                    fmt::format("[{:g}, {:g}] follows [{:g}, {:g}]; list strains rising, with stresses that do not fall", row[0],
                                row[1], material.plastic.back()[0], material.plastic.back()[1]));
      material.plastic.push_back({row[0], row[1]});
    }
    if (!material.plastic.empty() && material.plastic[0][1] != 0.0)
      table.fault("plastic", "the first plastic strain must be 0: the yield stress");
    material.rate_reference = table.number("rate_reference", Bounds::not_negative("1/ms"), 0.0);
    if (material.rate_reference > 0.0) material.rate_exponent = table.number("rate_exponent", Bounds::positive(""));
    table.refuse_unknown();
    spec.materials.push_back(material);
  }
  all.refuse_unknown();
}

void read_gauges(SpecTable& top, CarSpec& spec) {
  auto all = top.table("gauge");
  spec.gauges_where = top.where("gauge");
  for (const auto& name : all.table_names()) {
    auto table = all.table(name);
    GaugeSpec gauge{.thickness = table.number("thickness", Bounds::positive("mm")), .material = table.text("material", {})};
    std::vector<std::string> known;
    for (const auto& material : spec.materials) known.push_back(material.name);
    if (!gauge.material.empty() && std::ranges::find(known, gauge.material) == known.end()) {
      const auto nearest = nearest_word(gauge.material, known);
      table.fault("material",
                  fmt::format("\"{}\" is not described in this file; {}", gauge.material,
                              nearest.empty() ? "describe it under [material]" : fmt::format("did you mean \"{}\"?", nearest)));
    }
    for (const auto& part : table.texts("parts")) {
      if (spec.gauges.contains(part)) table.fault("parts", fmt::format("{} has a gauge already; name it once", part));
      spec.gauges[part] = gauge;
    }
    table.refuse_unknown();
  }
  all.refuse_unknown();
}

/// Mounts on both sides, but the engine's.
constexpr const char* needed_mounts[]{"strut_mount_front",   "spring_seat_rear",   "damper_mount_rear",
                                      "axle_pivot",          "subframe_mount_front", "subframe_mount_rear",
                                      "engine_mount_left",   "engine_mount_right", "engine_mount_rear"};

/// The rear axle swings about pivots ahead of its wheels; the strut's top is where the body carries it.
void check_mounts(SpecTable& top, const CarSpec& spec) {
  auto mounts = top.table("mount");
  const auto place_of = [&](const char* name) {
    const auto found = std::ranges::find(spec.mounts, name, &MountSpec::name);
    return found == spec.mounts.end() ? std::nullopt : std::optional(found->place);
  };
  const auto fault = [&](const char* name, const std::string& words) { mounts.table(name).fault("place", words); };
  const auto& rear = spec.chassis.rear;
  if (const auto pivot = place_of("axle_pivot"); pivot && (*pivot)[0] <= -spec.profile.wheelbase)
    fault("axle_pivot", fmt::format("the arm's pivot does not lie ahead of the rear wheels at x = {:g}; move it forward",
                                    -spec.profile.wheelbase));
  else if (pivot && rear.spring_seat[0] >= (*pivot)[0])
    top.table("rear").fault("spring_seat",
                            fmt::format("it does not lie behind the arm's pivot at x = {:g}; move it backwards", (*pivot)[0]));
  if (const auto top_mount = place_of("strut_mount_front"); top_mount && length(*top_mount - spec.body.strut_top) > 1.0)
    fault("strut_mount_front", fmt::format("it lies {:.0f} mm from [body] strut_top, where the strut ends; give both one place",
                                           length(*top_mount - spec.body.strut_top)));
  if (const auto seat = place_of("spring_seat_rear"); seat && (*seat)[2] <= rear.spring_seat[2])
    fault("spring_seat_rear", "it lies below the arm's [rear] spring_seat: the spring has no room; raise it");
  if (const auto damper = place_of("damper_mount_rear"); damper && (*damper)[2] <= rear.damper_lower[2])
    fault("damper_mount_rear", "it lies below the arm's [rear] damper_lower: the damper has no room; raise it");
}

std::vector<MountSpec> read_mounts(SpecTable& top, const char* kind, bool heavy) {
  std::vector<MountSpec> mounts;
  auto all = top.table(kind);
  for (const auto& name : all.table_names()) {
    auto table = all.table(name);
    MountSpec mount{.name = name};
    if (heavy) {
      mount.mass = table.number("mass", Bounds::positive("g"));
      const auto size = read_place(table, "size");
      mount.size = {size[0], size[1], size[2]};
      if (table.has("size") && std::ranges::min(mount.size) <= 0.0)
        table.fault("size", "a box with a side of 0 mm has no inertia; give it three sides > 0 mm");
    }
    mount.place = read_place(table, "place");
    mount.parts = table.texts("parts");
    mount.reach = table.number("reach", Bounds::positive("mm"));
    mount.where = table.where("reach");
    mount.both_sides = table.boolean("both_sides", false);
    table.refuse_unknown();
    mounts.push_back(std::move(mount));
  }
  for (const auto* name : heavy ? std::span<const char* const>{} : std::span<const char* const>(needed_mounts))
    if (std::ranges::find(mounts, name, &MountSpec::name) == mounts.end())
      all.fault(name, fmt::format("missing; the chassis hangs there: add a table [{}.{}]", kind, name));
  all.refuse_unknown();
  return mounts;
}

void read_pressure(SpecTable& top, CarSpec& spec) {
  if (!top.has("pressure")) return;
  auto table = top.table("pressure");
  const std::pair<const char*, int> wheels[]{{"front_left", 0}, {"front_right", 1}, {"rear_left", 2}, {"rear_right", 3}};
  for (const auto& [name, wheel] : wheels) {
    const double pressure = table.number(name, Bounds::not_negative("MPa"), 0.0);
    if (table.has(name)) spec.pressure[wheel] = pressure;
  }
  spec.pressure_loss_time = table.number("loss_time", Bounds::positive("ms"));
  table.refuse_unknown();
}

}  // namespace

const std::vector<std::string> member_names{
    "sill",         "hinge_pillar", "b_pillar",    "side_frame", "front_rail", "upper_rail",  "rail_extension", "rear_rail",
    "cross_member", "cowl",         "front_frame", "bumper",     "dash_beam",  "roof_header", "roof_bow",       "waist_rail",
    "subframe"};

CarSpec read_car_spec(const std::string& toml_text, const std::string& file_name, const FileText& load,
                      const CarChoices& choices) {
  const auto file = parse_spec(toml_text, file_name, load);
  SpecFaults faults(file_name);
  SpecTable top(&file, "", faults);
  CarSpec spec;
  spec.file_name = file_name;
  spec.title = top.text("title", {}, "Car");
  spec.fidelity = top.text("fidelity", {"complete", "semi-flexible", "rigid"});
  if (!choices.fidelity.empty()) spec.fidelity = choices.fidelity;
  spec.tyre = top.path("tyre");
  spec.tyre_where = top.where("tyre");
  read_pressure(top, spec);
  spec.mesh_size = top.number("mesh_size", Bounds::between(3.0, 200.0, "mm"));
  spec.weld_pitch = top.number("weld_pitch", Bounds::positive("mm"));
  read_profile(top, spec.profile);
  read_body(top, spec.body);
  read_members(top, spec);
  read_materials(top, spec);
  read_gauges(top, spec);
  spec.masses = read_mounts(top, "mass", true);
  spec.mounts = read_mounts(top, "mount", false);
  ChassisPlace place{.materials = {},
                     .strut_top = spec.body.strut_top,
                     .wheel_height = spec.profile.wheel_height,
                     .front_track = spec.profile.front_track};
  for (const auto& material : spec.materials) place.materials.push_back(material.name);
  read_chassis(top, {choices.obstacle, spec.fidelity}, place, spec.chassis);
  check_mounts(top, spec);
  top.refuse_unknown();
  faults.throw_if_any();
  return spec;
}

}  // namespace balocco::car
