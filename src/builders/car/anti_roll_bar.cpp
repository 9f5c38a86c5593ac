#include "builders/car/anti_roll_bar.hpp"

#include <algorithm>
#include <cctype>
#include <numbers>

#include "builders/car/linkage_text.hpp"

namespace balocco::car {
namespace {

/// The whole bar, from its left end to its right one.
Curve whole_bar(const BarSpec& bar) {
  std::vector<Vector> line(bar.line.rbegin(), bar.line.rend());
  for (std::size_t i = 1; i < bar.line.size(); ++i) line.push_back(mirrored(bar.line[i]));
  return Curve(line);
}

std::int64_t write_beams(const CarSpec& spec, std::int64_t& left_seat, std::int64_t& right_seat, DeckText& deck) {
  const auto& bar = spec.chassis.front.bar;
  const auto line = whole_bar(bar);
  const auto at = stations(line.corners(), spec.mesh_size);
  // Seen from an end, the second of the described points is the last corner but the middle.
  const double seat = line.corners()[bar.line.size() - 2];
  deck.line("*NODE, NSET=N_ANTI_ROLL_BAR");
  std::int64_t first = 0;
  for (const double station : at) {
    const auto node = deck.next_node();
    if (first == 0) first = node;
    if (station == seat) left_seat = node;
    deck.node(node, line.at(station));
  }
  const auto count = static_cast<std::int64_t>(at.size());
  right_seat = 2 * first + count - 1 - left_seat;
  deck.line("*ELEMENT, TYPE=B31, ELSET=ANTI_ROLL_BAR");
  for (auto node = first; node + 1 < first + count; ++node) deck.line("{}, {}, {}", deck.next_element(), node, node + 1);
  auto material = bar.material;
  std::ranges::transform(material, material.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  deck.line("*BEAM SECTION, ELSET=ANTI_ROLL_BAR, MATERIAL={}, SECTION=CIRC\n{:g}\n0., 0., 1.", material, 0.5 * bar.diameter);
  return first;
}

}  // namespace

Vector bar_seat(const CarSpec& spec) {
  return spec.chassis.front.bar.line[1];
}

Vector bar_link(const CarSpec& spec) {
  return spec.chassis.front.bar.link + Vector{0.0, 0.0, spec.profile.wheel_height};
}

double bar_mass(const CarSpec& spec) {
  const auto& bar = spec.chassis.front.bar;
  const auto material = std::ranges::find(spec.materials, bar.material, &SheetMaterial::name);
  return 0.25 * std::numbers::pi * bar.diameter * bar.diameter * whole_bar(bar).length() * material->density;
}

void write_anti_roll_bar(const CarSpec& spec, DeckText& deck) {
  const auto& bar = spec.chassis.front.bar;
  LinkageText linkage(deck);
  deck.comment("anti-roll bar");
  std::int64_t left_seat = 0, right_seat = 0;
  const auto left_end = write_beams(spec, left_seat, right_seat, deck), right_end = left_seat + right_seat - left_end;
  // Rubber around the bar holds it and lets it turn; the links are as stiff as the rubber of their ends.
  Behaviour rubber{.name = "BAR_BUSH", .elasticity = {}, .damping = {}}, link{.name = "BAR_LINK", .elasticity = {}, .damping = {}};
  for (int component = 1; component <= 3; ++component) {
    rubber.elasticity.push_back({.component = component, .slope = bar.bushing_rate, .table = {}});
    rubber.damping.push_back({.component = component, .slope = bar.damping_time * bar.bushing_rate, .table = {}});
  }
  link.elasticity.push_back({.component = 1, .slope = bar.link_rate, .table = {}});
  link.damping.push_back({.component = 1, .slope = bar.damping_time * bar.link_rate, .table = {}});
  linkage.behaviour(rubber);
  linkage.behaviour(link);
  linkage.connector("BAR_BUSH_LEFT", "CARTESIAN", deck.node_of("SUBFRAME_BAR_LEFT"), left_seat, "", "BAR_BUSH");
  linkage.connector("BAR_BUSH_RIGHT", "CARTESIAN", deck.node_of("SUBFRAME_BAR_RIGHT"), right_seat, "", "BAR_BUSH");
  linkage.connector("BAR_LINK_LEFT", "AXIAL", left_end, deck.node_of("ARM_LINK_LEFT"), "", "BAR_LINK");
  linkage.connector("BAR_LINK_RIGHT", "AXIAL", right_end, deck.node_of("ARM_LINK_RIGHT"), "", "BAR_LINK");
}

}  // namespace balocco::car
