#include "builders/tyre_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "builders/tyre_lamina.hpp"
#include "builders/tyre_steps.hpp"
#include "elements/element_type.hpp"
#include "math/tensor.hpp"

namespace balocco {
namespace {

using Vector = Vector3<double>;

Vector vector_of(const Point& point) {
  return {point[0], point[1], point[2]};
}

double length(const Vector& v) {
  return std::sqrt(dot(v, v));
}

std::vector<Point> corners_of(const Model& model, const ElementTable& elements, std::int32_t row) {
  std::vector<Point> corners;
  const int count = elements.type->nodes;
  for (int i = 0; i < count; ++i) corners.push_back(model.nodes.coordinates[elements.connectivity[row * count + i]]);
  return corners;
}

double quadrilateral_area(const std::vector<Point>& corners) {
  const auto first = vector_of(corners[2]) - vector_of(corners[0]),
             second = vector_of(corners[3]) - vector_of(corners[1]);
  return 0.5 * length(cross(first, second));
}

/// Mass per area of a composite membrane.
double areal_density(const Model& model, const Section& section) {
  double density = 0.0;
  for (const auto& ply : section.plies) density += ply.thickness * model.materials[ply.material].density;
  return density;
}

/// The shortest edges of a table's elements of one section: across the tyre, around it, and outwards for solids.
double shortest_edge(const Model& model, const ElementTable& elements, std::int32_t section, int from, int to) {
  double shortest = 1e300;
  for (std::int32_t row = 0; row < elements.size(); ++row) {
    if (elements.section[row] != section) continue;
    const auto corners = corners_of(model, elements, row);
    shortest = std::min(shortest, length(vector_of(corners[to]) - vector_of(corners[from])));
  }
  return shortest;
}

struct StableLine {
  std::string part;
  double increment;
};

/// dt = edge / wave speed: what the run's own estimator refines.
std::vector<StableLine> stable_increments(const TyreSpec& spec, const TyreSection& section, const TyreMesh& mesh,
                                          const Model& model) {
  std::vector<StableLine> lines;
  const auto& membranes = model.elements[mesh.membranes];
  for (int r = 0; r <= region_count; ++r) {  // the sections of the line, then that of the turn-up
    const auto region = static_cast<Region>(std::min(r, region_count - 1));
    const auto stiffness = laminate_stiffness(r < region_count ? spec.regions[r].plies : spec.turn_up, spec,
                                              mean_radius(section, region) / spec.crown_radius);
    const double density = areal_density(model, model.sections[r]);
    const double across = shortest_edge(model, membranes, r, 0, 1),
                 around = std::min(shortest_edge(model, membranes, r, 0, 3), shortest_edge(model, membranes, r, 1, 2));
    lines.push_back({model.sections[r].element_set, std::min(across * std::sqrt(density / stiffness.meridional),
                                                             around * std::sqrt(density / stiffness.circumferential))});
  }
  const auto& solids = model.elements[mesh.solids];
  for (int part = 0; part < solid_part_count; ++part) {
    const auto row = std::find_if(model.sections.begin(), model.sections.end(), [&](const Section& candidate) {
      return candidate.element_set == solid_part_names[part];
    });
    if (row == model.sections.end()) continue;
    const auto section_row = static_cast<std::int32_t>(row - model.sections.begin());
    const auto& rubber = spec.rubbers[spec.part_rubbers[part]];
    double edge = 1e300;
    for (const int to : {1, 3, 4}) edge = std::min(edge, shortest_edge(model, solids, section_row, 0, to));
    lines.push_back({solid_part_names[part],
                     edge * std::sqrt(rubber.density / (rubber.bulk_modulus() + 4.0 / 3.0 * rubber.shear_modulus()))});
  }
  const auto& wires = model.elements[mesh.wires];
  lines.push_back({"BEAD_WIRE", shortest_edge(model, wires, wires.section[0], 0, 1) *
                                    std::sqrt(spec.bead.density / spec.bead.modulus)});
  return lines;
}

}  // namespace

double hexahedron_volume(const std::vector<Point>& corners) {
  constexpr int signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const double gauss = 1.0 / std::sqrt(3.0);
  double volume = 0.0;
  for (const auto& point : signs) {
    std::array<Vector, 3> edges{};
    for (int node = 0; node < 8; ++node) {
      for (int axis = 0; axis < 3; ++axis) {
        double slope = signs[node][axis] / 8.0;
        for (int other = 0; other < 3; ++other)
          if (other != axis) slope *= 1.0 + gauss * point[other] * signs[node][other];
        edges[axis] = edges[axis] + slope * vector_of(corners[node]);
      }
    }
    volume += dot(edges[0], cross(edges[1], edges[2]));
  }
  return volume;
}

std::vector<PartMass> tyre_masses(const TyreSpec& spec, const TyreMesh& mesh, const Model& model) {
  std::vector<PartMass> masses;
  const auto add = [&](const std::string& part) -> double& {
    for (auto& entry : masses)
      if (entry.part == part) return entry.mass;
    return masses.emplace_back(PartMass{part, 0.0}).mass;
  };
  const auto& membranes = model.elements[mesh.membranes];
  for (std::int32_t row = 0; row < membranes.size(); ++row) {
    const auto& part = model.sections[membranes.section[row]];
    add(part.element_set) += areal_density(model, part) * quadrilateral_area(corners_of(model, membranes, row));
  }
  const auto& solids = model.elements[mesh.solids];
  for (std::int32_t row = 0; row < solids.size(); ++row) {
    const auto& part = model.sections[solids.section[row]];
    add(part.element_set) += model.materials[part.material].density * hexahedron_volume(corners_of(model, solids, row));
  }
  const auto& wires = model.elements[mesh.wires];
  for (std::int32_t row = 0; row < wires.size(); ++row) {
    const auto ends = corners_of(model, wires, row);
    add("BEAD_WIRE") +=
        spec.bead.density * model.sections[wires.section[row]].area * length(vector_of(ends[1]) - vector_of(ends[0]));
  }
  return masses;
}

std::string tyre_report(const TyreSpec& spec, const TyreSection& section, const TyreMesh& mesh, const Model& model) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}, model {}\n", spec.title, spec.model);
  double total = 0.0;
  for (const auto& [part, mass] : tyre_masses(spec, mesh, model)) {
    fmt::format_to(out, "  mass {:<18} {:8.3f} kg\n", part, mass / 1000.0);
    total += mass;
  }
  fmt::format_to(out, "  mass {:<18} {:8.3f} kg (rim {:.3f} kg not counted)\n", "tyre", total / 1000.0,
                 spec.rim.mass / 1000.0);
  fmt::format_to(
      out, "  moulded section    width {:.1f} mm, outer diameter {:.1f} mm; beads move {:.2f} mm a side to the rim\n",
      section.width(), 2.0 * section.outer_radius(), section.seat_shift);
  fmt::format_to(out, "  mesh               {} nodes, {} sectors", model.nodes.size(), mesh.sectors());
  for (const auto& elements : model.elements) fmt::format_to(out, ", {} {}", elements.size(), elements.type->name);
  fmt::format_to(out, "\n");
  for (const auto& [part, increment] : stable_increments(spec, section, mesh, model))
    fmt::format_to(out, "  stable increment   {:<18} {:.3e} ms\n", part, increment);
  if (spec.rolling.enabled) {
    const double radius = rolling_radius(spec, section);
    fmt::format_to(
        out, "  rolling            radius {:.1f} mm, spin {:.5f} rad/ms at {:.2f} mm/ms; wheel turns {:.0f} degrees\n",
        radius, spec.rolling.speed / radius, spec.rolling.speed,
        (spec.rolling.settle_duration + spec.rolling.duration) * spec.rolling.speed / radius * 180.0 /
            std::numbers::pi);
  }
  return text;
}

}  // namespace balocco
