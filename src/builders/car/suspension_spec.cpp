#include "builders/car/suspension_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "builders/spec_table.hpp"

namespace balocco::car {

Vector read_place(SpecTable& table, std::string_view key) {
  const auto rows = table.rows(key, 3, 3);
  if (rows.size() == 1) return {rows[0][0], rows[0][1], rows[0][2]};
  if (table.has(key)) table.fault(key, fmt::format("it has {} rows; a place is one row [[x, y, z]]", rows.size()));
  return {};
}

namespace {

RigidPart read_part(SpecTable& parent, std::string_view key) {
  auto table = parent.table(key);
  RigidPart part;
  part.mass = table.number("mass", Bounds::positive("g"));
  part.centre = read_place(table, "centre");
  const auto size = read_place(table, "size");
  part.size = {size[0], size[1], size[2]};
  if (table.has("size") && std::ranges::min(part.size) <= 0.0)
    table.fault("size", "a box with a side of 0 mm has no inertia; give it three sides > 0 mm");
  table.refuse_unknown();
  return part;
}

/// Rows (travel or velocity, force), both rising from (0, 0).
std::vector<std::array<double, 2>> read_curve(SpecTable& table, std::string_view key) {
  std::vector<std::array<double, 2>> curve;
  for (const auto& row : table.rows(key, 2, 2)) {
    if (!curve.empty() && row[0] <= curve.back()[0])
      table.fault(key, fmt::format("{:g} follows {:g}; list the rows in rising order", row[0], curve.back()[0]));
    else if (!curve.empty() && row[1] < curve.back()[1])
      table.fault(key, fmt::format("its force falls from {:g} to {:g} N, and what falls drives; let it rise", curve.back()[1],
                                   row[1]));
    curve.push_back({row[0], row[1]});
  }
  if (!curve.empty() && (curve[0][0] != 0.0 || curve[0][1] != 0.0))
    table.fault(key, "the curve must begin at [0, 0]; add that row");
  if (table.has(key) && curve.size() < 2) table.fault(key, "a curve needs two rows and more; add them");
  return curve;
}

StrutSpec read_strut(SpecTable& parent, std::string_view key) {
  auto table = parent.table(key);
  StrutSpec strut;
  strut.spring_rate = table.number("spring_rate", Bounds::positive("N/mm"));
  strut.bump = read_curve(table, "damper_bump");
  strut.rebound = read_curve(table, "damper_rebound");
  strut.bump_gap = table.number("bump_gap", Bounds::positive("mm"));
  strut.rebound_gap = table.number("rebound_gap", Bounds::positive("mm"));
  strut.stop = read_curve(table, "stop");
  table.refuse_unknown();
  return strut;
}

BushingSpec read_bushing(SpecTable& parent, std::string_view key) {
  auto table = parent.table(key);
  const BushingSpec bushing{.radial = table.number("radial", Bounds::positive("N/mm")),
                            .axial = table.number("axial", Bounds::positive("N/mm")),
                            .angular = table.number("angular", Bounds::positive("N mm/rad")),
                            .damping_time = table.number("damping_time", Bounds::not_negative("ms"))};
  table.refuse_unknown();
  return bushing;
}

/// The left half of a line that both sides share: from the middle outwards, and back to it where `closed`.
std::vector<Vector> read_half(SpecTable& table, std::string_view key, std::size_t least, bool closed) {
  std::vector<Vector> line;
  for (const auto& row : table.rows(key, 3, 3)) line.push_back({row[0], row[1], row[2]});
  if (!table.has(key)) return line;
  if (line.size() < least) {
    table.fault(key, fmt::format("it has {} points; this line needs {} or more", line.size(), least));
    return line;
  }
  if (line.front()[1] != 0.0) table.fault(key, "the line begins beside the car's middle; give its first point y = 0");
  if (closed && line.back()[1] != 0.0) table.fault(key, "the ring does not close; give its last point y = 0");
  const auto inner = std::span(line).subspan(1, line.size() - (closed ? 2 : 1));
  if (std::ranges::any_of(inner, [](const Vector& point) { return point[1] <= 0.0; }))
    table.fault(key, "a point between the ends lies not on the left side; give it y > 0");
  return line;
}

/// What cannot be put together as described: arms and rods that reach inwards or through the wheel, struts shorter than their
/// travel.
void check_front(SpecTable& table, const FrontSpec& front, const ChassisPlace& place_of) {
  const auto& [materials, strut_top, wheel_height, track] = place_of;
  const std::pair<const char*, Vector> within[]{
      {"ball_joint", front.ball_joint}, {"strut_lower", front.strut_lower}, {"rod_outer", front.rod_outer}};
  for (const auto& [key, point] : within)
    if (point[1] >= 0.5 * track)
      table.fault(key, fmt::format("at y = {:g} mm it lies beyond the wheel's middle at {:g} mm; move it inwards", point[1],
                                   0.5 * track));
  if (front.ball_joint[2] >= front.strut_lower[2])
    table.fault("ball_joint", "it lies no lower than strut_lower, but the knuckle stands on it; lower it");
  if (front.arm_front[0] <= front.arm_rear[0])
    table.fault("arm_front", "it lies behind arm_rear; give the front bushing the larger x");
  if (front.ball_joint[1] <= std::max(front.arm_front[1], front.arm_rear[1]))
    table.fault("ball_joint", "the arm reaches inwards; give its ball joint a larger y than its bushings");
  if (front.rod_outer[1] <= front.rod_inner[1])
    table.fault("rod_outer", "the tie rod reaches inwards; give its outer end a larger y than its inner one");
  const double room = length(strut_top - front.strut_lower - Vector{0.0, 0.0, wheel_height}), above = strut_top[2] - wheel_height;
  const double travel = front.strut.stop.empty() ? 0.0 : front.strut.bump_gap + front.strut.stop.back()[0];
  if (above <= front.strut_lower[2] || room <= travel)
    table.fault("strut_lower", fmt::format("{:.0f} mm below [body] strut_top, the strut cannot shorten by the {:.0f} mm of its "
                                           "bump_gap and stop; lower it, or raise strut_top",
                                           above - front.strut_lower[2], travel));
}

void read_bar(SpecTable& parent, const std::vector<std::string>& materials, BarSpec& bar) {
  auto table = parent.table("bar");
  bar.line = read_half(table, "line", 3, false);
  bar.link = read_place(table, "link");
  bar.diameter = table.number("diameter", Bounds::positive("mm"));
  bar.material = table.text("material", materials);
  bar.bushing_rate = table.number("bushing_rate", Bounds::positive("N/mm"));
  bar.link_rate = table.number("link_rate", Bounds::positive("N/mm"));
  bar.damping_time = table.number("damping_time", Bounds::positive("ms"));
  table.refuse_unknown();
}

void read_front(SpecTable& top, const ChassisPlace& place_of, FrontSpec& front) {
  auto table = top.table("front");
  const std::pair<const char*, Vector*> points[]{{"arm_front", &front.arm_front},   {"arm_rear", &front.arm_rear},
                                                 {"ball_joint", &front.ball_joint}, {"strut_lower", &front.strut_lower},
                                                 {"rod_inner", &front.rod_inner},   {"rod_outer", &front.rod_outer}};
  for (const auto& [key, place] : points) *place = read_place(table, key);
  auto subframe = table.table("subframe");
  front.subframe.line = read_half(subframe, "line", 4, true);
  front.subframe.reach = subframe.number("reach", Bounds::positive("mm"));
  front.subframe.where = subframe.where("reach");
  front.subframe.seat_mass = subframe.number("seat_mass", Bounds::positive("g"));
  subframe.refuse_unknown();
  read_bar(table, place_of.materials, front.bar);
  front.arm = read_part(table, "arm");
  front.knuckle = read_part(table, "knuckle");
  front.hub = read_part(table, "hub");
  front.rod_mass = table.number("rod_mass", Bounds::positive("g"));
  front.strut = read_strut(table, "strut");
  front.arm_bush = read_bushing(table, "arm_bush");
  front.top_mount = read_bushing(table, "top_mount");
  front.subframe_mount = read_bushing(table, "subframe_mount");
  if (table.has("strut_lower")) check_front(table, front, place_of);
  table.refuse_unknown();
}

void read_rear(SpecTable& top, RearSpec& rear) {
  auto table = top.table("rear");
  const std::pair<const char*, Vector*> points[]{{"spring_seat", &rear.spring_seat}, {"damper_lower", &rear.damper_lower}};
  for (const auto& [key, place] : points) *place = read_place(table, key);
  rear.arm = read_part(table, "arm");
  rear.wheel_hub = read_part(table, "hub");
  rear.strut = read_strut(table, "strut");
  rear.pivot_bush = read_bushing(table, "pivot_bush");
  auto beam = table.table("beam");
  rear.beam.line = read_half(beam, "line", 2, false);
  rear.beam.leg = beam.number("leg", Bounds::positive("mm"));
  rear.beam.opening = beam.number("opening", Bounds::between(1.0, 179.0, "degrees"));
  beam.refuse_unknown();
  table.refuse_unknown();
}

void read_wheel(SpecTable& top, const ChassisPlace& place, WheelSpec& wheel) {
  if (!top.has("wheel")) return;
  auto table = top.table("wheel");
  wheel.mesh = table.path("mesh");
  wheel.where = table.where("mesh");
  wheel.seat_diameter = table.number("seat_diameter", Bounds::positive("mm"));
  wheel.width = table.number("width", Bounds::positive("mm"));
  wheel.seat_width = table.number("seat_width", Bounds::positive("mm"));
  wheel.mounting_diameter = table.number("mounting_diameter", Bounds::positive("mm"));
  wheel.material = table.text("material", place.materials);
  wheel.stable_increment = table.number("stable_increment", Bounds::not_negative("ms"), 0.0);
  table.refuse_unknown();
}

void read_engine(SpecTable& top, EngineSpec& engine) {
  auto table = top.table("engine");
  engine.block = read_part(table, "block");
  for (const auto& row : table.rows("rates", 3, 3)) {
    if (std::ranges::min(row) <= 0.0) table.fault("rates", "a mount does not carry along one of its axes; give rates > 0 N/mm");
    engine.rates.push_back({row[0], row[1], row[2]});
  }
  if (engine.rates.size() != 3 && table.has("rates")) table.fault("rates", "the engine hangs on three mounts; give three rows");
  engine.damping_time = table.number("damping_time", Bounds::not_negative("ms"));
  table.refuse_unknown();
}

void read_drive(SpecTable& top, const CarChoices& choices, DriveSpec& drive) {
  auto table = top.table("drive");
  drive.obstacle = table.text("obstacle", {"comfort", "pothole", "drop"});
  if (!choices.obstacle.empty()) drive.obstacle = choices.obstacle;
  for (const std::string name : {"comfort", "pothole", "drop"}) {
    const bool falls = name == "drop", chosen = drive.obstacle == name;
    if (!chosen && !table.has(name)) continue;
    auto course = table.table(name);
    const double start = falls ? course.number("height", Bounds::positive("mm")) : course.number("speed", Bounds::positive("mm/ms")),
                 duration = course.number("duration", Bounds::positive("ms")),
                 complete = course.number("complete_duration", Bounds::positive("ms"), duration);
    course.refuse_unknown();
    if (!chosen) continue;
    (falls ? drive.height : drive.speed) = start;
    drive.duration = choices.fidelity == "complete" ? complete : duration;
  }
  drive.frames = table.integer("frames", 1, 100000);
  drive.history_interval = table.number("history_interval", Bounds::positive("ms"));
  drive.stable_increment = table.number("stable_increment", Bounds::not_negative("ms"), 0.0);
  table.refuse_unknown();
}

}  // namespace

void read_chassis(SpecTable& top, const CarChoices& choices, const ChassisPlace& place, ChassisSpec& chassis) {
  read_front(top, place, chassis.front);
  read_rear(top, chassis.rear);
  read_wheel(top, place, chassis.wheel);
  read_engine(top, chassis.engine);
  read_road(top, chassis.road);
  if (top.has("equilibrium")) {
    auto table = top.table("equilibrium");
    chassis.standing_friction = table.number("friction", Bounds::not_negative(""));
    table.refuse_unknown();
  }
  read_drive(top, choices, chassis.drive);
  if (chassis.drive.obstacle != "comfort") chassis.road.obstacle_height = 0.0;
  if (chassis.drive.obstacle != "pothole") chassis.road.pothole.depth = 0.0;
  if (chassis.drive.speed * chassis.drive.duration >= chassis.road.ahead)
    top.fault("drive", "the car leaves the road; shorten the duration or lengthen [road] ahead");
}

}  // namespace balocco::car
