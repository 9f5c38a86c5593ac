#include "builders/car/car_builder.hpp"

#include <fmt/format.h>

#include "builders/car/body_deck.hpp"
#include "builders/car/body_parts.hpp"
#include "builders/car/car_report.hpp"
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
      faults.push_back(fmt::format("{}:1: error: [body]: {} and {} are to be welded but meet nowhere; move one of them", spec.file_name, first, second));
  for (const auto& part : faults.empty() ? mesh.loose_parts() : std::vector<std::string>{})
    faults.push_back(fmt::format("{}:1: error: [body]: no chain of welds joins {} to the floor; move it", spec.file_name, part));
  if (!faults.empty()) throw InputError(faults);
  return mesh;
}

}  // namespace

std::string build_car(const std::string& toml_text, const std::string& file_name, std::string& report) {
  const auto spec = read_car_spec(toml_text, file_name);
  std::vector<WeldLine> welds;
  const auto mesh = make_body(spec, welds);
  DeckText deck;
  deck.line("*HEADING\n{}. Units mm, ms, g, N, MPa; x forward, y left, z up; the origin lies on the road below the front axle.\n*UNITS, LENGTH=MM, MASS=G, TIME=MS", spec.title);
  write_body(spec, mesh, deck);
  write_mounts(spec, mesh, deck);
  write_materials(spec, deck);
  report = car_report(spec, mesh, welds);
  return deck.text();
}

}  // namespace balocco
