#include "builders/car/car_builder.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "builders/car/body_deck.hpp"
#include "builders/car/body_parts.hpp"
#include "builders/car/car_report.hpp"
#include "builders/car/car_steps.hpp"
#include "builders/car/suspension.hpp"
#include "builders/rim_profile.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

using namespace car;

/// The body in white, all of one piece.
BodyMesh make_body(const CarSpec& spec, std::vector<WeldLine>& welds) {
  const BodyShape shape(spec);
  BodyMesh mesh;
  add_floor(spec, shape, mesh);
  add_front(spec, shape, mesh);
  add_sides(spec, shape, mesh);
  add_roof(spec, shape, mesh);
  add_rear(spec, shape, mesh);
  welds = weld_body(spec, mesh);
  std::vector<std::string> faults;
  for (const auto& [first, second, places] : welds)
    if (places == 0)
      faults.push_back(fmt::format("{}:1: error: [body]: {} and {} are to be welded but meet nowhere; move one of them",
                                   spec.file_name, first, second));
  for (const auto& part : faults.empty() ? mesh.loose_parts() : std::vector<std::string>{})
    faults.push_back(fmt::format("{}:1: error: [body]: no chain of welds joins {} to the floor; move it", spec.file_name, part));
  if (!faults.empty()) throw InputError(faults);
  return mesh;
}

/// The wheels' hubs with their rims; the tyres' beads join them when they are inflated.
void write_hubs(const CarSpec& spec, const TyreSpec& tyre, DeckText& deck) {
  deck.chapter("WHEELS: rim, hub and brake turn as one");
  LinkageText linkage(deck);
  const auto centres = wheel_centres(spec);
  for (std::size_t wheel = 0; wheel < wheel_names.size(); ++wheel) {
    const auto& hub = wheel < 2 ? spec.chassis.front.hub : spec.chassis.rear.wheel_hub;
    const std::string name = wheel_names[wheel];
    linkage.rigid({.name = "HUB_" + name, .mass = hub.mass, .centre = centres[wheel], .size = hub.size,
                   .surface = strikes_rim(tyre) ? "RIM_" + name : ""},
                  {});
  }
}

std::string beside(const std::string& file_name, const std::string& path) {
  return (std::filesystem::path(file_name).parent_path() / path).string();
}

}  // namespace

CarDeck build_car(const std::string& toml_text, const std::string& file_name, const FileText& load, const std::string& obstacle) {
  const auto spec = read_car_spec(toml_text, file_name, obstacle);
  std::vector<WeldLine> welds;
  const auto mesh = make_body(spec, welds);
  const auto tyre_file = beside(file_name, spec.tyre);
  const auto tyre_text = load(tyre_file);
  if (!tyre_text)
    throw InputError(fmt::format("{}:1: error: tyre: no file {}; give the path of a tyre's description from this file's folder",
                                 file_name, tyre_file));
  const auto tyre = read_tyre_spec(*tyre_text, tyre_file);

  CarDeck car;
  car.tyres.heading =
      spec.title + ". Units mm, ms, g, N, MPa; x forward, y left, z up; the origin lies on the road below the front axle.";
  constexpr std::int64_t first_tyre_id = 2'000'000;  // behind any body's nodes and elements
  const auto facts = add_tyres(tyre, spec.chassis.road, {.centre = wheel_centres(spec), .clearance = spec.chassis.road.clearance},
                               first_tyre_id, car.tyres);

  DeckText deck;
  write_body(spec, mesh, deck);
  write_mounts(spec, mesh, deck);
  write_materials(spec, deck);
  write_fidelity(spec, mesh, deck);
  const auto weights = corner_weights(spec, sprung_mass(spec, mesh));
  write_hubs(spec, tyre, deck);
  write_front_suspension(spec, weights, deck);
  write_rear_suspension(spec, weights, deck);
  write_engine(spec, deck);
  car.car = deck.text();
  DeckText equilibrium, drive;
  write_equilibrium(spec, tyre, facts, equilibrium);
  write_drive(spec, tyre, facts, wheel_loads(spec, weights, facts.mass), drive);
  car.equilibrium = equilibrium.text();
  car.drive = drive.text();
  car.report = car_report(spec, mesh, welds) +
               fmt::format("  sprung weight on the springs of a front wheel {:.0f} N, of a rear wheel {:.0f} N\n", weights.front,
                           weights.rear);
  return car;
}

}  // namespace balocco
