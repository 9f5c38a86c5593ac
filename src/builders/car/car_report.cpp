#include "builders/car/car_report.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace balocco::car {
namespace {

/// Box around the body, mm: lower and upper corner.
std::array<Vector, 2> extent(const BodyMesh& mesh) {
  constexpr double far = std::numeric_limits<double>::max();
  std::array<Vector, 2> box{Vector{far, far, far}, Vector{-far, -far, -far}};
  for (const auto& node : mesh.nodes())
    for (int c = 0; c < 3; ++c) {
      box[0][c] = std::min(box[0][c], node[c]);
      box[1][c] = std::max(box[1][c], node[c]);
    }
  return box;
}

void warn_outside(std::string& text, const char* what, double value, double least, double most, const char* unit) {
  if (value < least || value > most)
    text += fmt::format("  warning: {} {:.4g} {} lies outside the class of {:g} to {:g}\n", what, value, unit, least, most);
}

}  // namespace

std::string car_report(const CarSpec& spec, const BodyMesh& mesh, const std::vector<WeldLine>& welds) {
  auto text = fmt::format("{}\n", spec.title);
  Inertia car;
  std::map<std::string, double> by_part, by_assembly;
  std::size_t shells = 0;
  for (const auto& part : mesh.parts()) {
    Inertia own;
    add_part(spec, mesh, part, own);
    by_assembly[part.assembly] += own.mass();
    if (part.assembly == "BODY") add_part(spec, mesh, part, car);
    by_part[part.gauge] += own.mass();
    shells += part.quadrilaterals.size();
  }
  for (const auto& [part, mass] : by_part)
    text += fmt::format("  mass {:<20} {:8.2f} kg   {:g} mm {}\n", part, mass / 1e3, spec.gauges.at(part).thickness,
                        spec.gauges.at(part).material);
  const double body = by_assembly.at("BODY") / 1e3;
  text += fmt::format("  mass {:<20} {:8.2f} kg\n  mass {:<20} {:8.2f} kg\n  mass {:<20} {:8.2f} kg\n", "body in white", body,
                      "subframe", by_assembly.at("SUBFRAME") / 1e3, "torsion beam", by_assembly.at("REAR_AXLE") / 1e3);
  for (const auto& mass : on_both_sides(spec.masses)) {
    car.add_box(mass.mass, mass.place, mass.size);
    text += fmt::format("  mass {:<20} {:8.2f} kg   hung at {:.0f}, {:.0f}, {:.0f}\n", mass.name, mass.mass / 1e3, mass.place[0],
                        mass.place[1], mass.place[2]);
  }
  const auto centre = car.centre();
  const auto inertia = car.about_centre();
  text += fmt::format(
      "  body with its load   {:.1f} kg; centre of gravity {:.0f} mm behind the front axle, {:.0f} mm high; roll, pitch, yaw "
      "inertia {:.0f}, {:.0f}, {:.0f} kg m2\n",
      car.mass() / 1e3, -centre[0], centre[2], inertia[0] / 1e9, inertia[1] / 1e9, inertia[2] / 1e9);
  const auto box = extent(mesh);
  text += fmt::format(
      "  body                 {:.0f} mm long, {:.0f} mm wide, {:.0f} mm high; wheelbase {:g} mm, tracks {:g} and {:g} mm\n",
      box[1][0] - box[0][0], box[1][1] - box[0][1], box[1][2], spec.profile.wheelbase, spec.profile.front_track,
      spec.profile.rear_track);
  std::size_t places = 0;
  for (const auto& line : welds) places += static_cast<std::size_t>(line.places);
  text += fmt::format("  mesh                 {} nodes, {} S4R in {} parts, {} welds in {} places of {} seams\n",
                      mesh.nodes().size(), shells, mesh.parts().size(), mesh.welds().size(), places, welds.size());
  // Bodies in white of three-door cars of this size and time, without doors, bonnet and wings' bolts: 180 to 260 kg.
  warn_outside(text, "the body in white's mass", body, 180.0, 260.0, "kg");
  return text;
}

}  // namespace balocco::car
