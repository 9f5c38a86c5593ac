#include "builders/car/wheels.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

#include "builders/car/linkage_text.hpp"
#include "builders/car/suspension.hpp"
#include "builders/car/tyre_placement.hpp"
#include "model/diagnostics.hpp"

namespace balocco::car {
namespace {

bool is_front(const std::string& wheel) {
  return wheel.starts_with("FRONT");
}

double area_of(const std::vector<Vector>& corners) {
  return 0.5 * (corners.size() == 4 ? length(cross(corners[2] - corners[0], corners[3] - corners[1]))
                                    : length(cross(corners[1] - corners[0], corners[2] - corners[0])));
}

Inertia inertia_of(const CarSpec& spec, const WheelMesh& mesh) {
  const auto material = std::ranges::find(spec.materials, spec.chassis.wheel.material, &SheetMaterial::name);
  Inertia inertia;
  for (const auto& gauge : mesh.gauges)
    for (const auto& shell : gauge.shells) {
      const auto corners = corners_of(mesh, shell);
      const auto sum = std::accumulate(corners.begin(), corners.end(), Vector{});
      inertia.add(area_of(corners) * gauge.thickness * material->density, (1.0 / static_cast<double>(corners.size())) * sum);
    }
  return inertia;
}

/// The described hub turns with its wheel: what is left of its mass and inertia beside a wheel of shells.
RigidPart hub_beside(const CarSpec& spec, const std::string& wheel, const Inertia& shells) {
  auto hub = is_front(wheel) ? spec.chassis.front.hub : spec.chassis.rear.wheel_hub;
  const auto whole = box_inertia(hub.mass, hub.size), own = shells.about_origin();
  hub.mass -= shells.mass();
  const double sum = 0.5 * std::accumulate(whole.begin(), whole.end(), -std::accumulate(own.begin(), own.end(), 0.0));
  for (int c = 0; c < 3; ++c) {
    const double square = 12.0 * (sum - (whole[c] - own[c])) / hub.mass;  // of the side of the box that has such inertia
    if (hub.mass <= 0.0 || square <= 0.0)
      throw InputError(fmt::format(
          "{}: error: [wheel] mesh: the wheel weighs {:.2f} kg, and its {} hub, with brake and wheel, is no heavier, or "
          "not as large; raise mass or size in [{}.hub]",
          spec.chassis.wheel.where, shells.mass() / 1e3, is_front(wheel) ? "front" : "rear", is_front(wheel) ? "front" : "rear"));
    hub.size[c] = std::sqrt(square);
  }
  return hub;
}

/// @return ids of the nodes.
std::vector<std::int64_t> write_shells(const CarSpec& spec, const WheelMesh& mesh, const std::string& wheel, const Vector& centre,
                                       DeckText& deck) {
  const auto name = "RIM_AND_DISC_" + wheel;
  const double outwards = wheel.ends_with("LEFT") ? 1.0 : -1.0;  // the same wheel on both sides, turned about the upright axis
  std::vector<std::int64_t> ids;
  deck.line("*NODE, NSET={}", name);
  for (const auto& node : mesh.nodes) {
    ids.push_back(deck.next_node());
    deck.node(ids.back(), centre + Vector{outwards * node[0], outwards * node[1], node[2]});
  }
  std::string sets;
  for (std::size_t i = 0; i < mesh.gauges.size(); ++i) {
    const auto set = fmt::format("{}_{}", name, i + 1);
    for (const std::size_t corners : {4, 3}) {
      const auto is_such = [&](const std::vector<int>& shell) { return shell.size() == corners; };
      if (std::ranges::none_of(mesh.gauges[i].shells, is_such)) continue;
      deck.line("*ELEMENT, TYPE={}, ELSET={}", corners == 4 ? "S4R" : "S3R", set);
      for (const auto& shell : mesh.gauges[i].shells) {
        if (!is_such(shell)) continue;
        std::string line = fmt::format("{}", deck.next_element());
        for (const int node : shell) line += fmt::format(", {}", ids[node]);
        deck.line("{}", line);
      }
    }
    auto material = spec.chassis.wheel.material;
    std::ranges::transform(material, material.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    deck.line("*SHELL SECTION, ELSET={}, MATERIAL={}\n{:g}, 5", set, material, mesh.gauges[i].thickness);
    sets += set + "\n";
  }
  deck.line("*ELSET, ELSET={}\n{}**", name, sets);
  return ids;
}

std::vector<std::int64_t> chosen(const std::vector<std::int64_t>& ids, const std::vector<int>& rows) {
  std::vector<std::int64_t> some;
  for (const int row : rows) some.push_back(ids[row]);
  return some;
}

}  // namespace

std::string bead_carrier(const CarSpec& spec, const std::string& wheel) {
  return (spec.chassis.wheel.mesh.empty() ? "HUB_" : "SEATS_") + wheel;
}

void write_wheels(const CarSpec& spec, const std::optional<WheelMesh>& mesh, bool rims, DeckText& deck) {
  deck.chapter(mesh ? "WHEELS: shells between the hub and the seats of the beads" : "WHEELS: rim, hub and brake turn as one");
  LinkageText linkage(deck);
  const auto centres = wheel_centres(spec);
  for (std::size_t row = 0; row < wheel_names.size(); ++row) {
    const std::string wheel = wheel_names[row], surface = rims ? "RIM_" + wheel : "";
    auto hub = is_front(wheel) ? spec.chassis.front.hub : spec.chassis.rear.wheel_hub;
    std::vector<std::int64_t> mounting;
    if (mesh) {
      const auto ids = write_shells(spec, *mesh, wheel, centres[row], deck);
      linkage.rigid({.name = "SEATS_" + wheel, .centre = centres[row], .surface = surface}, chosen(ids, mesh->seats));
      mounting = chosen(ids, mesh->mounting);
      hub = hub_beside(spec, wheel, inertia_of(spec, *mesh));
    }
    linkage.rigid(
        {.name = "HUB_" + wheel, .mass = hub.mass, .centre = centres[row], .size = hub.size, .surface = mesh ? "" : surface},
        mounting);
  }
}

std::string wheel_report(const CarSpec& spec, const WheelMesh& mesh) {
  const double mass = inertia_of(spec, mesh).mass();
  std::size_t shells = 0;
  for (const auto& gauge : mesh.gauges) shells += gauge.shells.size();
  return fmt::format(
      "  each wheel           {:.2f} kg in {} shells; its hub with brake weighs {:.2f} kg in front, {:.2f} kg behind\n", mass / 1e3,
      shells, (spec.chassis.front.hub.mass - mass) / 1e3, (spec.chassis.rear.wheel_hub.mass - mass) / 1e3);
}

}  // namespace balocco::car
