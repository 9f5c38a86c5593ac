#include "builders/car/car_builder.hpp"

#include <fmt/format.h>

#include "builders/car/body_deck.hpp"
#include "builders/car/body_parts.hpp"
#include "builders/car/car_report.hpp"
#include "builders/car/car_steps.hpp"
#include "builders/car/chassis_shells.hpp"
#include "builders/car/suspension.hpp"
#include "builders/car/wheels.hpp"
#include "builders/rim_profile.hpp"
#include "model/diagnostics.hpp"

namespace balocco::car {
namespace {

/// The body in white, all of one piece, and the chassis.
BodyMesh make_body(const CarSpec& spec, std::vector<WeldLine>& welds) {
  const BodyShape shape(spec);
  BodyMesh mesh;
  add_floor(spec, shape, mesh);
  add_front(spec, shape, mesh);
  add_sides(spec, shape, mesh);
  add_roof(spec, shape, mesh);
  add_rear(spec, shape, mesh);
  add_subframe(spec, mesh);
  add_torsion_beam(spec, mesh);
  welds = weld_body(spec, mesh);
  std::vector<std::string> faults;
  for (const auto& [first, second, places] : welds)
    if (places == 0)
      faults.push_back(fmt::format("{}: error: [body]: {} and {} are to be welded but meet nowhere; move one of them",
                                   spec.body.where, first, second));
  for (const auto& part : faults.empty() ? mesh.loose_parts() : std::vector<std::string>{})
    faults.push_back(fmt::format("{}: error: [body]: no chain of welds joins {} to the floor, or to its other half; move it",
                                 spec.body.where, part));
  if (!faults.empty()) throw InputError(faults);
  return mesh;
}

/// A tyre under its load is flatter than free, but does not ride on its rim. @throws InputError otherwise.
void check_tyre(const CarSpec& spec, const TyreSpec& tyre, const TyreFacts& facts) {
  const double height = spec.profile.wheel_height, flange = 0.5 * tyre.rim.diameter + tyre.rim.flange_height;
  const auto fault = [&](const std::string& words) {
    throw InputError(
        fmt::format("{}: error: [profile] wheel_height: {}", spec.profile.wheel_height_where, words));
  };
  if (height >= facts.outer_radius)
    fault(fmt::format("at {:g} mm the tyre of {:.0f} mm radius is not on the road; lower the wheels, or give a larger tyre", height,
                      facts.outer_radius));
  if (height <= flange)
    fault(fmt::format("at {:g} mm the rim's flange of {:.0f} mm radius is on the road; raise the wheels", height, flange));
}

/// Nothing that moves with the body may stand in a wheel at design height. @throws InputError otherwise.
void check_room(const CarSpec& spec, const BodyMesh& mesh, const TyreFacts& facts) {
  const auto centres = wheel_centres(spec);
  for (const auto& part : mesh.parts()) {
    if (part.assembly == "REAR_AXLE") continue;
    for (int node = part.first_node; node < part.first_node + part.nodes; ++node)
      for (std::size_t wheel = 0; wheel < centres.size(); ++wheel) {
        const auto& place = mesh.nodes()[node];
        const auto away = place - centres[wheel];
        if (std::abs(away[1]) >= facts.half_width || std::hypot(away[0], away[2]) >= facts.outer_radius) continue;
        const bool front = wheel < 2;
        throw InputError(fmt::format("{}: error: [profile] {}: {} stands in the wheel {} at ({:.0f}, {:.0f}, {:.0f}), whose tyre is "
                                     "{:.0f} mm wide and {:.0f} mm high; change the track, or move the part",
                                     front ? spec.profile.front_track_where : spec.profile.rear_track_where,
                                     front ? "front_track" : "rear_track", part.name, wheel_names[wheel], place[0], place[1], place[2],
                                     2.0 * facts.half_width, 2.0 * facts.outer_radius));
      }
  }
}

/// The wheel of shells, if one is described.
std::optional<WheelMesh> wheel_of(const CarSpec& spec, const TyreSpec& tyre, const CarFiles& files) {
  const auto& wheel = spec.chassis.wheel;
  if (wheel.mesh.empty()) return std::nullopt;
  const auto model = files.mesh(wheel.mesh);
  if (!model)
    throw InputError(fmt::format("{}: error: [wheel] mesh: no file {}; give the path of a wheel's mesh from this file's folder",
                                 wheel.where, wheel.mesh));
  return make_wheel(wheel, tyre.rim, *model);
}

/// What a deck has of the wheels beside the hubs: nothing where the axles move alone.
struct WheelParts {
  std::optional<WheelMesh> mesh;
  bool rims = false;  // that tyres may strike
};

std::string car_without_tyres(const CarSpec& spec, const BodyMesh& mesh, const CornerWeights& weights, const WheelParts& wheels) {
  DeckText deck;
  write_body(spec, mesh, deck);
  write_mounts(spec, mesh, deck);
  write_materials(spec, deck);
  write_fidelity(spec, mesh, deck);
  write_wheels(spec, wheels.mesh, wheels.rims, deck);
  write_front_suspension(spec, mesh, weights, deck);
  write_rear_suspension(spec, mesh, weights, deck);
  write_engine(spec, deck);
  deck.line("*NSET, NSET=ALL_BUT_TYRES, GENERATE\n1, {}", deck.last_node());
  return deck.text();
}

}  // namespace

}  // namespace balocco::car

namespace balocco {

CarDeck build_car(const std::string& toml_text, const std::string& file_name, const CarFiles& files, const CarChoices& choices) {
  using namespace car;
  const auto spec = read_car_spec(toml_text, file_name, files.text, choices);
  std::vector<WeldLine> welds;
  const auto mesh = make_body(spec, welds);
  const auto tyre_text = files.text(spec.tyre);
  if (!tyre_text)
    throw InputError(fmt::format("{}: error: tyre: no file {}; give the path of a tyre's description from this file's folder",
                                 spec.tyre_where, spec.tyre));
  const auto tyre = read_tyre_spec(*tyre_text, spec.tyre, files.text);

  CarDeck car;
  car.tyres.heading =
      spec.title + ". Units mm, ms, g, N, MPa; x forward, y left, z up; the origin lies on the road below the front axle.";
  constexpr double kinematic_travel = 50.0;  // mm up and down: within the stops
  constexpr std::int64_t first_tyre_id = 2'000'000;  // behind any body's nodes and elements
  const WheelPlaces places{.centre = wheel_centres(spec), .clearance = spec.chassis.road.clearance};
  const auto facts = add_tyres(tyre, spec.chassis.road, places, first_tyre_id, car.tyres);

  check_tyre(spec, tyre, facts);
  check_room(spec, mesh, facts);

  const auto weights = corner_weights(spec, sprung_mass(spec, mesh));
  const auto wheel = wheel_of(spec, tyre, files);
  car.car = car_without_tyres(spec, mesh, weights, {.mesh = wheel, .rims = strikes_rim(tyre)});
  DeckText equilibrium, drive, kinematics;
  write_equilibrium(spec, tyre, facts, droop(spec, weights), choices.inflates_one_tyre ? Inflation::of_one : Inflation::of_all, equilibrium);
  if (choices.inflates_one_tyre) {
    DeckText inflation;
    car.tyre.heading = spec.title + ": a tyre on its wheel. Units mm, ms, g, N, MPa";
    add_first_tyre(tyre, places, first_tyre_id, car.tyre);
    write_tyre_steps(tyre, facts, inflation);
    car.inflation = inflation.text();
  }
  write_drive(spec, mesh, tyre, facts, wheel_loads(spec, weights, facts.mass), drive);
  write_kinematics(spec, kinematic_travel, kinematics);
  car.equilibrium = equilibrium.text();
  car.kinematics = "*HEADING\n" + car.tyres.heading + "\n" + car_without_tyres(spec, mesh, weights, {}) + kinematics.text();
  car.drive = drive.text();
  car.report = car_report(spec, mesh, welds) +
               (wheel ? wheel_report(spec, *wheel) : "") +
               fmt::format("  sprung weight on the springs of a front wheel {:.0f} N, of a rear wheel {:.0f} N\n", weights.front,
                           weights.rear);
  return car;
}

}  // namespace balocco
