#include "builders/car/car_builder.hpp"

#include <fmt/format.h>

#include "builders/car/body_deck.hpp"
#include "builders/car/body_parts.hpp"
#include "builders/car/car_report.hpp"
#include "builders/car/car_steps.hpp"
#include "builders/car/chassis_shells.hpp"
#include "builders/car/suspension.hpp"
#include "builders/rim_profile.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

using namespace car;

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
      faults.push_back(fmt::format("{}:1: error: [body]: {} and {} are to be welded but meet nowhere; move one of them",
                                   spec.file_name, first, second));
  for (const auto& part : faults.empty() ? mesh.loose_parts() : std::vector<std::string>{})
    faults.push_back(fmt::format("{}:1: error: [body]: no chain of welds joins {} to the floor, or to its other half; move it",
                                 spec.file_name, part));
  if (!faults.empty()) throw InputError(faults);
  return mesh;
}

/// The wheels' hubs; tyres' beads join them when they are inflated, and may strike their rims where there are `rims`.
void write_hubs(const CarSpec& spec, bool rims, DeckText& deck) {
  deck.chapter("WHEELS: rim, hub and brake turn as one");
  LinkageText linkage(deck);
  const auto centres = wheel_centres(spec);
  for (std::size_t wheel = 0; wheel < wheel_names.size(); ++wheel) {
    const auto& hub = wheel < 2 ? spec.chassis.front.hub : spec.chassis.rear.wheel_hub;
    const std::string name = wheel_names[wheel];
    linkage.rigid({.name = "HUB_" + name, .mass = hub.mass, .centre = centres[wheel], .size = hub.size,
                   .surface = rims ? "RIM_" + name : ""},
                  {});
  }
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

std::string car_without_tyres(const CarSpec& spec, const BodyMesh& mesh, const CornerWeights& weights, bool rims) {
  DeckText deck;
  write_body(spec, mesh, deck);
  write_mounts(spec, mesh, deck);
  write_materials(spec, deck);
  write_fidelity(spec, mesh, deck);
  write_hubs(spec, rims, deck);
  write_front_suspension(spec, mesh, weights, deck);
  write_rear_suspension(spec, mesh, weights, deck);
  write_engine(spec, deck);
  return deck.text();
}

}  // namespace

CarDeck build_car(const std::string& toml_text, const std::string& file_name, const FileText& load, const CarChoices& choices) {
  const auto spec = read_car_spec(toml_text, file_name, load, choices);
  std::vector<WeldLine> welds;
  const auto mesh = make_body(spec, welds);
  const auto tyre_file = beside(file_name, spec.tyre);
  const auto tyre_text = load(tyre_file);
  if (!tyre_text)
    throw InputError(fmt::format("{}:1: error: tyre: no file {}; give the path of a tyre's description from this file's folder",
                                 file_name, tyre_file));
  const auto tyre = read_tyre_spec(*tyre_text, tyre_file, load);

  CarDeck car;
  car.tyres.heading =
      spec.title + ". Units mm, ms, g, N, MPa; x forward, y left, z up; the origin lies on the road below the front axle.";
  constexpr double kinematic_travel = 50.0;  // mm up and down: within the stops
  constexpr std::int64_t first_tyre_id = 2'000'000;  // behind any body's nodes and elements
  const auto facts = add_tyres(tyre, spec.chassis.road, {.centre = wheel_centres(spec), .clearance = spec.chassis.road.clearance},
                               first_tyre_id, car.tyres);

  check_tyre(spec, tyre, facts);

  const auto weights = corner_weights(spec, sprung_mass(spec, mesh));
  car.car = car_without_tyres(spec, mesh, weights, strikes_rim(tyre));
  DeckText equilibrium, drive, kinematics;
  write_equilibrium(spec, tyre, facts, equilibrium);
  write_drive(spec, mesh, tyre, facts, wheel_loads(spec, weights, facts.mass), drive);
  write_kinematics(spec, kinematic_travel, kinematics);
  car.equilibrium = equilibrium.text();
  car.kinematics = "*HEADING\n" + car.tyres.heading + "\n" + car_without_tyres(spec, mesh, weights, false) + kinematics.text();
  car.drive = drive.text();
  car.report = car_report(spec, mesh, welds) +
               fmt::format("  sprung weight on the springs of a front wheel {:.0f} N, of a rear wheel {:.0f} N\n", weights.front,
                           weights.rear);
  return car;
}

}  // namespace balocco
