#include "builders/tyre_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "builders/meridian_line.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

constexpr int rim_layer = 2;  // outside of the rim strip

/// Layers of rubber outside a membrane. Model 1 has none on the sidewall: its rubber is a ply of the membrane there.
int layers_outside(const TyreSpec& spec, Region region) {
  if (region == Region::belt || region == Region::shoulder) return 1 + spec.cap_layers;
  if (region == Region::bead) return 2;
  return spec.model == 1 ? 0 : 1;
}

SolidPart part_of(Region region, int layer) {
  if (region == Region::bead) return layer == 0 ? SolidPart::apex : SolidPart::rim_strip;
  if (region == Region::sidewall) return SolidPart::sidewall;
  return layer == 0 ? SolidPart::tread_base : SolidPart::tread_cap;
}

/// Arc lengths of the nodes of the right half, from the crown, and the region of each membrane between them.
struct Division {
  std::vector<double> arc_lengths{0.0};
  std::vector<Region> regions;
};

Division divide(const TyreSpec& spec, const MeridianLine& line) {
  Division division;
  double start = 0.0;
  for (int r = 0; r < region_count; ++r) {
    const auto region = static_cast<Region>(r);
    const double end = line.region_end(region);
    const int elements = spec.region(region).elements;
    for (int i = 1; i <= elements; ++i) {
      division.arc_lengths.push_back(start + (end - start) * i / elements);
      division.regions.push_back(region);
    }
    start = end;
  }
  return division;
}

/// Position of a node `depth` mm of rubber away from the line.
std::array<double, 2> offset(const LinePoint& point, double depth, bool left) {
  const double axial = point.axial + depth * point.normal[1];
  return {point.radius + depth * point.normal[0], left ? axial : -axial};
}

double depth_of_layer(const LinePoint& point, int layer, int cap_layers) {
  if (layer == 0) return 0.0;
  return point.base + point.cap * (layer - 1) / cap_layers;
}

double signed_area(const TyreSection& section, const SectionQuad& quad) {
  double twice = 0.0;
  for (int i = 0; i < 4; ++i) {
    const auto &a = section.nodes[quad.nodes[i]], &b = section.nodes[quad.nodes[(i + 1) % 4]];
    twice += a[1] * b[0] - b[1] * a[0];
  }
  return 0.5 * twice;
}

/// Twice the smallest triangle at a corner: not positive where the quad is folded or not convex.
double smallest_corner(const TyreSection& section, const SectionQuad& quad) {
  double smallest = 1e300;
  for (int i = 0; i < 4; ++i) {
    const auto &a = section.nodes[quad.nodes[(i + 3) % 4]], &b = section.nodes[quad.nodes[i]],
               &c = section.nodes[quad.nodes[(i + 1) % 4]];
    smallest = std::min(smallest, (b[1] - a[1]) * (c[0] - b[0]) - (c[1] - b[1]) * (b[0] - a[0]));
  }
  return smallest;
}

void add_nodes(const TyreSpec& spec, const MeridianLine& line, const Division& half, TyreSection& section) {
  const int half_size = static_cast<int>(half.regions.size());
  const auto first_of_bead = std::find(half.regions.begin(), half.regions.end(), Region::bead) - half.regions.begin();
  const auto layers_of = [&](int j) {
    int layers = 0;
    for (const int membrane : {j - 1, j})
      if (membrane >= 0 && membrane < 2 * half_size)
        layers = std::max(layers, layers_outside(spec, section.line_regions[membrane]));
    return layers;
  };
  section.layers.assign(2 + spec.cap_layers, std::vector<int>(2 * half_size + 1, -1));
  for (int layer = 0; layer < static_cast<int>(section.layers.size()); ++layer) {
    for (int j = 0; j <= 2 * half_size; ++j) {
      if (layer > layers_of(j)) continue;
      const auto point = line.at(half.arc_lengths[std::abs(j - half_size)]);
      section.layers[layer][j] = static_cast<int>(section.nodes.size());
      section.nodes.push_back(
          offset(point, depth_of_layer(point, layer, std::abs(j - half_size) < first_of_bead ? spec.cap_layers : 1),
                 j >= half_size));
    }
  }
}

void add_quads(const TyreSpec& spec, TyreSection& section) {
  for (std::size_t j = 0; j < section.line_regions.size(); ++j) {
    const auto region = section.line_regions[j];
    const int layers = layers_outside(spec, region);
    for (int k = 0; k < layers; ++k) {
      const auto &inside = section.layers[k], &outside = section.layers[k + 1];
      section.quads.push_back(
          {{inside[j], inside[j + 1], outside[j + 1], outside[j]}, part_of(region, k), k + 1 == layers});
      if (smallest_corner(section, section.quads.back()) > 0.0) continue;
      const auto& node = section.nodes[inside[j]];
      throw InputError(fmt::format(
          "{}: error: [section] points: the rubber outside the line folds over itself near radius {:.1f} mm, axial "
          "{:.1f} mm; make it thinner there or the line less curved",
          spec.region(region).where, node[0], node[1]));
    }
  }
}

void find_rim_contact(const TyreSpec& spec, TyreSection& section) {
  const double flange = 0.5 * spec.rim.diameter + spec.rim.flange_height;
  const int last = section.line_size() - 1;
  double heel = 0.0;
  for (int j = 0; j <= last; ++j) {
    if (section.line_regions[std::min(j, last - 1)] != Region::bead &&
        section.line_regions[std::max(j - 1, 0)] != Region::bead)
      continue;
    const bool toe = j == 0 || j == last;
    for (int layer = 0; layer <= rim_layer; ++layer) {
      const int node = section.layers[layer][j];
      const bool on_flange = layer == rim_layer && section.nodes[node][0] <= flange;
      if (!toe && !on_flange) continue;
      (section.nodes[node][1] > 0.0 ? section.bead_left : section.bead_right).push_back(node);
      if (toe && layer == rim_layer) heel = std::abs(section.nodes[node][1]);
    }
  }
  std::sort(section.bead_left.begin(), section.bead_left.end());
  std::sort(section.bead_right.begin(), section.bead_right.end());
  section.seat_shift = heel - 0.5 * spec.rim.width;
}

/// The wires lie between the plies: on both sides of the apex, over the height of their bundle.
void find_wires(const TyreSpec& spec, TyreSection& section) {
  const auto& line = section.layers[0];
  const double toe = section.nodes[line[0]][0];
  for (int j = 1; j + 1 < section.line_size(); ++j) {
    const double height = section.nodes[line[j]][0] - toe;
    if (height < spec.bead.bottom || height > spec.bead.top) continue;
    if (section.line_regions[j - 1] != Region::bead && section.line_regions[j] != Region::bead) continue;
    for (const int layer : {0, 1}) section.wire_nodes.push_back(section.layers[layer][j]);
  }
  if (section.wire_nodes.empty())
    throw InputError(
        fmt::format("{}: error: [bead_wire] bottom: no node of the line lies between {} and {} mm above the toe; "
                    "widen the range or "
                    "raise elements in [section.bead]",
                    spec.bead.where, spec.bead.bottom, spec.bead.top));
}

/// Sidewall rubber of the described section whatever the model, spread evenly over the line.
double mean_sidewall_thickness(const MeridianLine& line, const Division& half) {
  double volume = 0.0, area = 0.0;
  for (std::size_t j = 0; j < half.regions.size(); ++j) {
    if (half.regions[j] != Region::sidewall) continue;
    TyreSection strip;
    const auto a = line.at(half.arc_lengths[j]), b = line.at(half.arc_lengths[j + 1]);
    strip.nodes = {offset(a, 0.0, true), offset(b, 0.0, true), offset(b, b.base, true), offset(a, a.base, true)};
    strip.layers = {{0, 1}};
    volume += revolved_volume(strip, {{0, 1, 2, 3}, SolidPart::sidewall, true});
    area += revolved_area(strip, 0);
  }
  return volume / area;
}

}  // namespace

double TyreSection::outer_radius() const {
  double radius = 0.0;
  for (const auto& node : nodes) radius = std::max(radius, node[0]);
  return radius;
}

double TyreSection::width() const {
  double width = 0.0;
  for (const auto& node : nodes) width = std::max(width, 2.0 * std::abs(node[1]));
  return width;
}

TyreSection make_section(const TyreSpec& spec) {
  const MeridianLine line(spec);
  const auto half = divide(spec, line);
  TyreSection section;
  section.line_regions.assign(half.regions.rbegin(), half.regions.rend());
  section.line_regions.insert(section.line_regions.end(), half.regions.begin(), half.regions.end());
  add_nodes(spec, line, half, section);
  add_quads(spec, section);
  find_rim_contact(spec, section);
  find_wires(spec, section);
  section.sidewall_rubber = mean_sidewall_thickness(line, half);
  return section;
}

double revolved_volume(const TyreSection& section, const SectionQuad& quad) {
  double first_moment = 0.0;  // of the area about the wheel axis
  for (int i = 0; i < 4; ++i) {
    const auto &a = section.nodes[quad.nodes[i]], &b = section.nodes[quad.nodes[(i + 1) % 4]];
    first_moment += (a[1] * b[0] - b[1] * a[0]) * (a[0] + b[0]) / 6.0;
  }
  return 2.0 * std::numbers::pi * (signed_area(section, quad) > 0.0 ? first_moment : -first_moment);
}

double mean_radius(const TyreSection& section, Region region) {
  double area = 0.0, moment = 0.0;
  for (std::size_t j = 0; j < section.line_regions.size(); ++j) {
    if (section.line_regions[j] != region) continue;
    const double strip = revolved_area(section, static_cast<int>(j));
    const auto& line = section.layers[0];
    area += strip;
    moment += 0.5 * strip * (section.nodes[line[j]][0] + section.nodes[line[j + 1]][0]);
  }
  return moment / area;
}

double revolved_area(const TyreSection& section, int membrane) {
  const auto &a = section.nodes[section.layers[0][membrane]], &b = section.nodes[section.layers[0][membrane + 1]];
  return std::numbers::pi * (a[0] + b[0]) * std::hypot(b[0] - a[0], b[1] - a[1]);
}

}  // namespace balocco
