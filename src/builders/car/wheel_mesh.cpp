#include "builders/car/wheel_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"

namespace balocco::car {
namespace {

[[noreturn]] void fail(const WheelSpec& spec, const std::string& key, const std::string& what_and_cure) {
  throw InputError(fmt::format("{}: error: [wheel] {}: {}", spec.where, key, what_and_cure));
}

/// What the shells of one section become; nothing else can be a wheel.
WheelGauge gauge_of(const WheelSpec& spec, const Model& model, std::int32_t section) {
  const auto& from = model.sections[section];
  const bool own_thickness = std::ranges::any_of(model.elements, [](const auto& table) { return !table.thickness.empty(); });
  if (from.kind != Section::Kind::shell || !from.plies.empty() || from.shell.general || from.shell.nodal_thickness || own_thickness ||
      from.shell.offset != 0.0)
    fail(
        spec, "mesh",
        fmt::format("{} are no plain shells; a wheel is made of shells of one material and one thickness a set", from.element_set));
  WheelGauge gauge{.thickness = from.thickness, .shells = {}};
  for (const auto& table : model.elements)
    for (std::int32_t row = 0; row < table.size(); ++row) {
      const auto* first = &table.connectivity[static_cast<std::size_t>(row) * table.type->nodes];
      if (table.section[row] == section) gauge.shells.emplace_back(first, first + table.type->nodes);
    }
  return gauge;
}

/// The shells with those nodes alone that they use.
WheelMesh shells_of(const WheelSpec& spec, const Model& model) {
  WheelMesh mesh;
  for (std::int32_t section = 0; section < static_cast<std::int32_t>(model.sections.size()); ++section)
    mesh.gauges.push_back(gauge_of(spec, model, section));
  std::map<int, int> row_of;
  for (auto& gauge : mesh.gauges)
    for (auto& shell : gauge.shells)
      for (int& node : shell) {
        const auto [found, is_new] = row_of.emplace(node, static_cast<int>(mesh.nodes.size()));
        if (is_new) mesh.nodes.push_back({model.nodes.coordinates[node]});
        node = found->second;
      }
  return mesh;
}

double across(const Vector& place) {
  return std::hypot(place[0], place[2]);
}

/// Turns the wheel until `axis` is y and moves `centre` to the origin.
void set_upright(WheelMesh& mesh, const Vector& centre, const Vector& axis) {
  const auto aside = unit(cross(axis, std::abs(axis[2]) < 0.9 ? Vector{0.0, 0.0, 1.0} : Vector{1.0, 0.0, 0.0}));
  const auto up = cross(aside, axis);
  for (auto& node : mesh.nodes) {
    const auto from_centre = node - centre;
    node = {dot(from_centre, aside), dot(from_centre, axis), dot(from_centre, up)};
  }
}

void scale(WheelMesh& mesh, double radial, double axial) {
  for (auto& node : mesh.nodes) node = {radial * node[0], axial * node[1], radial * node[2]};
}

/// The flanges of a rim stand out beyond its seats by some 17 mm, and their edges beyond its width by some 10 mm a side.
void check_size(const WheelSpec& spec, double edge_radius, double edge_width) {
  const double seat = 0.5 * spec.seat_diameter;
  if (edge_radius <= seat || edge_radius > 1.2 * seat)
    fail(spec, "seat_diameter",
         fmt::format(
             "the mesh's flanges end at a diameter of {:.1f} mm, which is no rim of {:g} mm; give the diameter of its bead seats",
             2.0 * edge_radius, spec.seat_diameter));
  if (edge_width < spec.width || edge_width > 1.3 * spec.width)
    fail(spec, "width",
         fmt::format("the mesh's flanges end {:.1f} mm apart, which is no rim {:g} mm wide; give the width between its flanges",
                     edge_width, spec.width));
}

/// The outermost nodes on both sides, and those about the axis.
void choose_held_nodes(const WheelSpec& spec, const RimSpec& rim, WheelMesh& mesh) {
  const double from = 0.5 * rim.width - spec.seat_width, least_radius = 0.45 * rim.diameter;  // the rim's, not the disc's
  std::array<int, 2> on_side{};
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
    const auto& place = mesh.nodes[node];
    if (across(place) <= 0.5 * spec.mounting_diameter) {
      mesh.mounting.push_back(node);
    } else if (across(place) >= least_radius && std::abs(place[1]) >= from) {
      mesh.seats.push_back(node);
      ++on_side[place[1] > 0.0];
    }
  }
  if (mesh.mounting.size() < 3)
    fail(spec, "mounting_diameter",
         fmt::format("{} nodes of the wheel lie within it, and three are needed; make it larger", mesh.mounting.size()));
  if (std::ranges::min(on_side) < 3)
    fail(spec, "seat_width",
         fmt::format("{} and {} nodes carry the beads, and three a side are needed; make it wider", on_side[0], on_side[1]));
}

/// The mean place along the axis of what the hub clamps.
double face_of_hub(const WheelSpec& spec, const WheelMesh& mesh) {
  double sum = 0.0;
  for (const auto& node : mesh.nodes)
    if (across(node) <= 0.5 * spec.mounting_diameter) sum += node[1];
  return sum;
}

}  // namespace

std::vector<Vector> corners_of(const WheelMesh& mesh, const std::vector<int>& shell) {
  std::vector<Vector> corners;
  for (const int node : shell) corners.push_back(mesh.nodes[node]);
  return corners;
}

std::vector<FreeEdge> free_edges(const WheelMesh& mesh) {
  std::map<std::pair<int, int>, int> shells_at;
  for (const auto& gauge : mesh.gauges)
    for (const auto& shell : gauge.shells)
      for (std::size_t i = 0; i < shell.size(); ++i) ++shells_at[std::minmax(shell[i], shell[(i + 1) % shell.size()])];
  std::map<int, std::vector<int>> neighbours;
  for (const auto& [edge, shells] : shells_at) {
    if (shells != 1) continue;
    neighbours[edge.first].push_back(edge.second);
    neighbours[edge.second].push_back(edge.first);
  }
  std::vector<FreeEdge> edges;
  std::set<int> seen;
  for (const auto& [start, unused] : neighbours) {
    std::vector<int> run{start};
    if (!seen.insert(start).second) continue;
    double span = 0.0;
    Vector moment{};
    for (std::size_t i = 0; i < run.size(); ++i)
      for (const int next : neighbours[run[i]]) {
        const double piece = length(mesh.nodes[next] - mesh.nodes[run[i]]);
        span += piece;  // both ways, which weighs all alike
        moment = moment + 0.5 * piece * (mesh.nodes[next] + mesh.nodes[run[i]]);
        if (seen.insert(next).second) run.push_back(next);
      }
    FreeEdge edge{.middle = (1.0 / span) * moment};
    for (const int node : run) edge.radius += length(mesh.nodes[node] - edge.middle) / static_cast<double>(run.size());
    edges.push_back(edge);
  }
  std::ranges::stable_sort(edges, std::greater(), &FreeEdge::radius);
  return edges;
}

WheelMesh make_wheel(const WheelSpec& spec, const RimSpec& rim, const Model& model) {
  auto mesh = shells_of(spec, model);
  const auto edges = free_edges(mesh);
  if (edges.size() < 2 || edges[1].radius < 0.9 * edges[0].radius)
    fail(
        spec, "mesh",
        "its two largest free edges are no pair of flanges, between which a wheel's axis runs; give a mesh of a whole wheel alone");
  const auto axis = edges[1].middle - edges[0].middle;
  check_size(spec, edges[0].radius, length(axis));
  set_upright(mesh, 0.5 * (edges[0].middle + edges[1].middle), unit(axis));
  scale(mesh, rim.diameter / spec.seat_diameter, rim.width / spec.width);
  if (face_of_hub(spec, mesh) < 0.0)
    for (auto& node : mesh.nodes) node = {-node[0], -node[1], node[2]};
  choose_held_nodes(spec, rim, mesh);
  return mesh;
}

}  // namespace balocco::car
