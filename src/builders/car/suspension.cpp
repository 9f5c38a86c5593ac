#include "builders/car/suspension.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "builders/car/anti_roll_bar.hpp"
#include "builders/car/chassis_shells.hpp"
#include "builders/car/linkage_text.hpp"
#include "model/diagnostics.hpp"

namespace balocco::car {
namespace {

constexpr std::array<double, 3> size_of_seat{60.0, 60.0, 60.0};  // mm

/// The left or the right side: where things are there, and how they are called.
struct Side {
  const char* name;
  double sign;
  Vector operator()(const Vector& left) const { return {left[0], sign * left[1], left[2]}; }
  RigidPart operator()(RigidPart left, const std::string& part) const {
    left.name = part + "_" + name;
    left.centre = (*this)(left.centre);
    return left;
  }
};

constexpr Side sides[]{{"LEFT", 1.0}, {"RIGHT", -1.0}};

std::vector<Characteristic> along_all_axes(const BushingSpec& bushing, double factor) {
  std::vector<Characteristic> all;
  for (int component = 1; component <= 6; ++component) {
    const double stiffness = component == 1 ? bushing.axial : component <= 3 ? bushing.radial : bushing.angular;
    if (factor * stiffness > 0.0) all.push_back({.component = component, .slope = factor * stiffness, .table = {}});
  }
  return all;
}

void write_bushing(const std::string& name, const BushingSpec& bushing, LinkageText& linkage) {
  linkage.behaviour(
      {.name = name, .elasticity = along_all_axes(bushing, 1.0), .damping = along_all_axes(bushing, bushing.damping_time)});
}

/// Spring and stops of a strut over its travel from the length without load: it carries `load` at design height, where the travel
/// is -load / rate; stops touch when the gaps are used up, counted from there. Rows (force, travel).
std::vector<std::array<double, 2>> spring_with_stops(const StrutSpec& strut, double load) {
  const double design = -load / strut.spring_rate;
  std::vector<std::array<double, 2>> rows;
  for (auto at = strut.stop.rbegin(); at != strut.stop.rend(); ++at) {
    const double travel = design - strut.bump_gap - (*at)[0];
    rows.push_back({strut.spring_rate * travel - (*at)[1], travel});
  }
  for (const auto& [pressed, force] : strut.stop) {
    const double travel = design + strut.rebound_gap + pressed;
    rows.push_back({strut.spring_rate * travel + force, travel});
  }
  return rows;
}

/// Damper force over the speed at which the strut grows longer. Rows (force, velocity).
std::vector<std::array<double, 2>> damper_curve(const StrutSpec& strut) {
  std::vector<std::array<double, 2>> rows;
  for (auto at = strut.bump.rbegin(); at != strut.bump.rend(); ++at) rows.push_back({-(*at)[1], -(*at)[0]});
  for (std::size_t i = 1; i < strut.rebound.size(); ++i) rows.push_back({strut.rebound[i][1], strut.rebound[i][0]});
  return rows;
}

/// A point of the left front corner in the car: described ahead of and above the wheel's centre, and from the car's middle.
Vector hard_point(const CarSpec& spec, const Vector& point) {
  return {point[0], point[1], spec.profile.wheel_height + point[2]};
}

/// Of the left side.
Vector place_of_mount(const CarSpec& spec, const std::string& name) {
  return std::ranges::find(spec.mounts, name, &MountSpec::name)->place;
}

/// What bolts to the subframe: feet, arms, rack and anti-roll bar.
struct Seat {
  std::string name;
  Vector place;
  std::vector<int> carriers;  // nodes of its sheet
};

std::vector<Seat> seats_of_subframe(const CarSpec& spec) {
  const auto& front = spec.chassis.front;
  std::vector<Seat> seats;
  for (const auto& side : sides) {
    for (const auto& [name, place] :
         {std::pair{"SUBFRAME_ARM_FRONT_", front.arm_front}, std::pair{"SUBFRAME_ARM_REAR_", front.arm_rear},
          std::pair{"SUBFRAME_RACK_", front.rod_inner}})
      seats.push_back({std::string(name) + side.name, side(hard_point(spec, place)), {}});
    seats.push_back({std::string("SUBFRAME_BAR_") + side.name, side(bar_seat(spec)), {}});
    for (const auto& [name, mount] : {std::pair{"SUBFRAME_FOOT_FRONT_", "subframe_mount_front"},
                                      std::pair{"SUBFRAME_FOOT_REAR_", "subframe_mount_rear"}})
      seats.push_back({std::string(name) + side.name, side(place_of_mount(spec, mount)), {}});
  }
  return seats;
}

/// Each seat is carried by the free nodes of the sheet that lie closest to it.
void write_subframe(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck) {
  const auto& front = spec.chassis.front;
  auto seats = seats_of_subframe(spec);
  for (const int node : mesh.free_nodes({"SUBFRAME_UPPER", "SUBFRAME_LOWER"}, {}, 1e9)) {
    const auto away = [&](const Seat& seat) { return length(seat.place - mesh.nodes()[node]); };
    auto& seat = *std::ranges::min_element(seats, {}, away);
    if (away(seat) <= front.subframe.reach) seat.carriers.push_back(node);
  }
  for (const auto& seat : seats) {
    if (seat.carriers.size() < 3)
      throw InputError(fmt::format("{}: error: [front.subframe] reach: {} nodes of its sheet carry {}, and three are needed; "
                                   "reach farther, or lead its line nearer",
                                   front.subframe.where, seat.carriers.size(), seat.name));
    const auto node = deck.named_node(seat.name, seat.place);
    write_coupling(seat.name, node, seat.carriers, deck);
    write_mass(seat.name, node, front.subframe.seat_mass, size_of_seat, deck);
  }
}

void write_corner(const CarSpec& spec, const Side& side, DeckText& deck) {
  const auto& front = spec.chassis.front;
  const std::string s = side.name;
  const auto at = [&](const Vector& point) { return side(hard_point(spec, point)); };
  LinkageText linkage(deck);
  deck.comment("front corner, " + s);
  const auto arm_front = linkage.point("ARM_BUSH_FRONT_" + s, at(front.arm_front)),
             arm_rear = linkage.point("ARM_BUSH_REAR_" + s, at(front.arm_rear));
  const auto arm_ball = linkage.point("ARM_BALL_" + s, at(front.ball_joint));
  auto arm = front.arm;
  arm.centre = hard_point(spec, arm.centre);
  linkage.rigid(side(arm, "LOWER_ARM"), {arm_front, arm_rear, arm_ball, linkage.point("ARM_LINK_" + s, side(bar_link(spec)))});
  const auto ball = linkage.point("KNUCKLE_BALL_" + s, at(front.ball_joint)),
             tube = linkage.point("STRUT_TUBE_" + s, at(front.strut_lower));
  const auto steer = linkage.point("KNUCKLE_STEER_" + s, at(front.rod_outer)),
             axle = linkage.point("AXLE_FRONT_" + s, side(wheel_centres(spec)[0]));
  auto knuckle = front.knuckle;
  knuckle.centre = hard_point(spec, knuckle.centre);
  linkage.rigid(side(knuckle, "KNUCKLE"), {ball, tube, steer, axle});
  const Vector top = side(spec.body.strut_top);
  linkage.rigid({.name = "STRUT_ROD_" + s, .mass = front.rod_mass, .centre = top, .size = {40.0, 40.0, 250.0}}, {});
  const auto rod = deck.node_of("STRUT_ROD_" + s);

  linkage.orientation("STRUT_" + s, top - at(front.strut_lower));
  linkage.connector("ARM_FRONT_" + s, "BUSHING", deck.node_of("SUBFRAME_ARM_FRONT_" + s), arm_front, "", "ARM_BUSH");
  linkage.connector("ARM_REAR_" + s, "BUSHING", deck.node_of("SUBFRAME_ARM_REAR_" + s), arm_rear, "", "ARM_BUSH");
  linkage.connector("BALL_JOINT_" + s, "JOIN", arm_ball, ball, "", "");
  linkage.connector("STRUT_FRONT_" + s, "CYLINDRICAL", tube, rod, "STRUT_" + s, "STRUT_FRONT");
  linkage.connector("TOP_MOUNT_" + s, "BUSHING", deck.node_of("STRUT_MOUNT_FRONT_" + s), rod, "STRUT_" + s, "TOP_MOUNT");
  linkage.connector("TIE_ROD_" + s, "LINK", deck.node_of("SUBFRAME_RACK_" + s), steer, "", "");
  linkage.connector("BEARING_FRONT_" + s, "HINGE", axle, deck.node_of("HUB_FRONT_" + s), "ACROSS", "");
}

/// Force of a stop pressed by so many mm.
double stop_force(const StrutSpec& strut, double pressed) {
  for (std::size_t i = 1; i < strut.stop.size(); ++i) {
    const auto &below = strut.stop[i - 1], &above = strut.stop[i];
    if (pressed <= above[0] || i + 1 == strut.stop.size())
      return below[1] + (above[1] - below[1]) * std::max(pressed - below[0], 0.0) / (above[0] - below[0]);
  }
  return 0.0;
}

/// mm by which a wheel sinks until its stop carries its spring, which now pushes with `load`. Spring and stop grow longer by so many
/// mm for each mm that the wheel sinks.
double sinks(const StrutSpec& strut, double load, double spring, double stop) {
  double low = 0.0, high = load / (strut.spring_rate * spring);
  while (high - low > 1e-3) {
    const double middle = 0.5 * (low + high);
    const double spring_force = load - strut.spring_rate * spring * middle,
                 force_of_stop = stop_force(strut, stop * middle - strut.rebound_gap);
    (spring_force * spring > force_of_stop * stop ? low : high) = middle;
  }
  return low;
}

/// The wheel turns about the point where the arm's line meets the normal of the strut in its top; seen from ahead.
double strut_per_wheel(const CarSpec& spec) {
  const auto& front = spec.chassis.front;
  const Vector top = spec.body.strut_top, along = unit(top - hard_point(spec, front.strut_lower)),
               ball = hard_point(spec, front.ball_joint), arm = ball - hard_point(spec, 0.5 * (front.arm_front + front.arm_rear));
  const auto across = [](const Vector& a, const Vector& b) { return a[1] * b[2] - a[2] * b[1]; };
  const Vector normal{0.0, along[2], -along[1]};
  const double away = across(ball - top, arm) / across(normal, arm);
  return std::abs(away / (wheel_centres(spec)[0][1] - top[1] - away * normal[1]));
}

}  // namespace

double droop(const CarSpec& spec, const CornerWeights& weights) {
  const auto& [front, rear] = std::pair<const FrontSpec&, const RearSpec&>(spec.chassis.front, spec.chassis.rear);
  const double strut = strut_per_wheel(spec), pivot = place_of_mount(spec, "axle_pivot")[0], arm = pivot + spec.profile.wheelbase,
               spring = (pivot - rear.spring_seat[0]) / arm, damper = (pivot - rear.damper_lower[0]) / arm;
  return std::max(sinks(front.strut, weights.front / strut, strut, strut), sinks(rear.strut, weights.rear / spring, spring, damper));
}

std::array<Vector, 4> wheel_centres(const CarSpec& spec) {
  const auto& p = spec.profile;
  const double front = 0.5 * p.front_track, rear = 0.5 * p.rear_track, z = p.wheel_height;
  return {Vector{0.0, front, z}, Vector{0.0, -front, z}, Vector{-p.wheelbase, rear, z}, Vector{-p.wheelbase, -rear, z}};
}

Inertia sprung_mass(const CarSpec& spec, const BodyMesh& mesh) {
  Inertia sprung;
  for (const auto& part : mesh.parts())
    if (part.assembly != "REAR_AXLE") add_part(spec, mesh, part, sprung);
  for (const auto& mass : on_both_sides(spec.masses)) sprung.add_box(mass.mass, mass.place, mass.size);
  const auto& block = spec.chassis.engine.block;
  sprung.add_box(block.mass, block.centre, block.size);
  for (const auto& seat : seats_of_subframe(spec)) sprung.add_box(spec.chassis.front.subframe.seat_mass, seat.place, size_of_seat);
  for (const auto& side : sides) {
    sprung.add(spec.chassis.front.rod_mass, side(spec.body.strut_top));
    sprung.add(0.5 * bar_mass(spec), side(bar_seat(spec)));
  }
  return sprung;
}

CornerWeights corner_weights(const CarSpec& spec, const Inertia& sprung) {
  const double weight = sprung.mass() * gravity, behind = -sprung.centre()[0] / spec.profile.wheelbase;
  return {.front = 0.5 * weight * (1.0 - behind), .rear = 0.5 * weight * behind};
}

CornerWeights wheel_loads(const CarSpec& spec, const CornerWeights& sprung, double tyre_mass) {
  const auto& front = spec.chassis.front;
  const auto& rear = spec.chassis.rear;
  return {.front = sprung.front + gravity * (front.arm.mass + front.knuckle.mass + front.hub.mass + tyre_mass),
          .rear = sprung.rear + gravity * (rear.arm.mass + rear.wheel_hub.mass + tyre_mass)};
}

void write_front_suspension(const CarSpec& spec, const BodyMesh& mesh, const CornerWeights& weights, DeckText& deck) {
  const auto& front = spec.chassis.front;
  const Vector lower = hard_point(spec, front.strut_lower), top = spec.body.strut_top;
  LinkageText linkage(deck);
  deck.chapter("FRONT SUSPENSION: MacPherson struts, lower arms on a subframe");
  linkage.orientation("ACROSS", {0.0, 1.0, 0.0});
  write_bushing("ARM_BUSH", front.arm_bush, linkage);
  write_bushing("TOP_MOUNT", front.top_mount, linkage);
  write_bushing("SUBFRAME_MOUNT", front.subframe_mount, linkage);
  // The wheel moves about the arm's and the strut's instant centre; near design height the strut shortens by the cosine of its
  // lean.
  const double load = weights.front / (unit(top - lower)[2]), length_now = length(top - lower);
  linkage.behaviour({.name = "STRUT_FRONT",
                     .elasticity = {{.component = 1, .table = spring_with_stops(front.strut, load)}},
                     .damping = {{.component = 1, .table = damper_curve(front.strut)}},
                     .free_length = length_now + load / front.strut.spring_rate});
  write_subframe(spec, mesh, deck);
  for (const auto& side : sides)
    for (const auto* end : {"FRONT_", "REAR_"}) {
      const auto name = std::string("SUBFRAME_MOUNT_") + end + side.name;
      linkage.connector("BUSH_" + name, "BUSHING", deck.node_of(name),
                        deck.node_of(std::string("SUBFRAME_FOOT_") + end + side.name), "", "SUBFRAME_MOUNT");
    }
  for (const auto& side : sides) write_corner(spec, side, deck);
  write_anti_roll_bar(spec, deck);
}

void write_rear_suspension(const CarSpec& spec, const BodyMesh& mesh, const CornerWeights& weights, DeckText& deck) {
  const auto& rear = spec.chassis.rear;
  LinkageText linkage(deck);
  deck.chapter("REAR SUSPENSION: trailing arms, joined by a beam that twists");
  write_bushing("PIVOT_BUSH", rear.pivot_bush, linkage);
  const Vector pivot = deck.place_of("AXLE_PIVOT_LEFT"), seat = deck.place_of("SPRING_SEAT_REAR_LEFT");
  const double lever = (pivot[0] + spec.profile.wheelbase) / (pivot[0] - rear.spring_seat[0]);
  const double load = weights.rear * lever, length_now = length(seat - rear.spring_seat);
  linkage.behaviour({.name = "SPRING_REAR",
                     .elasticity = {{.component = 1, .slope = rear.strut.spring_rate, .table = {}}},
                     .damping = {},
                     .free_length = length_now + load / rear.strut.spring_rate});
  auto stops = rear.strut;
  stops.spring_rate = 1e-3;  // a damper has no spring: its table needs a slope between the stops that it does not feel
  linkage.behaviour({.name = "DAMPER_REAR",
                     .elasticity = {{.component = 1, .table = spring_with_stops(stops, 0.0)}},
                     .damping = {{.component = 1, .table = damper_curve(rear.strut)}}});
  const auto beam_ends = ends_of_torsion_beam(mesh);
  for (const auto& side : sides) {
    const std::string s = side.name;
    const auto point = [&](const std::string& name, const Vector& place) { return linkage.point(name + s, side(place)); };
    const std::vector<std::int64_t> points{point("ARM_PIVOT_", pivot), point("ARM_SPRING_", rear.spring_seat),
                                           point("ARM_DAMPER_", rear.damper_lower), point("AXLE_REAR_", wheel_centres(spec)[2])};
    auto welded = points;  // the beam's end is welded to the arm all around
    for (const int node : beam_ends[side.sign > 0.0 ? 0 : 1]) welded.push_back(node + 1);
    linkage.rigid(side(rear.arm, "TRAILING_ARM"), welded);
    linkage.connector("PIVOT_" + s, "BUSHING", deck.node_of("AXLE_PIVOT_" + s), points[0], "ACROSS", "PIVOT_BUSH");
    linkage.connector("SPRING_REAR_" + s, "AXIAL", points[1], deck.node_of("SPRING_SEAT_REAR_" + s), "", "SPRING_REAR");
    linkage.connector("DAMPER_REAR_" + s, "AXIAL", points[2], deck.node_of("DAMPER_MOUNT_REAR_" + s), "", "DAMPER_REAR");
    linkage.connector("BEARING_REAR_" + s, "HINGE", points[3], deck.node_of("HUB_REAR_" + s), "ACROSS", "");
  }
}

void write_engine(const CarSpec& spec, DeckText& deck) {
  const auto& engine = spec.chassis.engine;
  LinkageText linkage(deck);
  deck.chapter("ENGINE AND GEARBOX: a rigid body on three mounts");
  constexpr std::array<const char*, 3> names{"LEFT", "RIGHT", "REAR"};
  std::vector<std::int64_t> feet;
  for (const auto* name : names)
    feet.push_back(linkage.point(std::string("ENGINE_FOOT_") + name, deck.place_of(std::string("ENGINE_MOUNT_") + name)));
  auto block = engine.block;
  block.name = "ENGINE";
  linkage.rigid(block, feet);
  for (std::size_t i = 0; i < names.size(); ++i) {
    Behaviour behaviour{.name = std::string("ENGINE_RUBBER_") + names[i], .elasticity = {}, .damping = {}};
    for (int c = 0; c < 3; ++c) {
      behaviour.elasticity.push_back({.component = c + 1, .slope = engine.rates[i][c], .table = {}});
      if (engine.damping_time > 0.0)
        behaviour.damping.push_back({.component = c + 1, .slope = engine.damping_time * engine.rates[i][c], .table = {}});
    }
    linkage.behaviour(behaviour);
    linkage.connector(std::string("ENGINE_BUSH_") + names[i], "CARTESIAN", deck.node_of(std::string("ENGINE_MOUNT_") + names[i]),
                      feet[i], "", behaviour.name);
  }
}

}  // namespace balocco::car
