// The meridian section of a tyre as a two-dimensional mesh: a line of membranes from bead to bead with layers of rubber
// outside.
#pragma once

#include <array>
#include <vector>

#include "builders/tyre_spec.hpp"

namespace balocco {

/// Rubber between two line nodes and two layers: its first edge lies inside and runs as the line does, the second
/// outside.
struct SectionQuad {
  std::array<int, 4> nodes{};  // (j, k), (j + 1, k), (j + 1, k + 1), (j, k + 1)
  SolidPart part = SolidPart::tread_base;
  bool outermost = false;  // nothing lies outside it
};

struct TyreSection {
  std::vector<std::array<double, 2>> nodes;  // (radius, axial), mm
  std::vector<std::vector<int>>
      layers;  // layers[k][j]: node of line position j in layer k, -1 where there is none; 0 is the line
  std::vector<Region> line_regions;  // of each membrane, from axial < 0 over the crown to axial > 0
  std::vector<SectionQuad> quads;
  std::vector<int> bead_right, bead_left;  // nodes that touch the rim, at axial < 0 and > 0; sorted
  std::vector<int> wire_nodes;             // nodes that share the wires of one bead each, both beads
  double seat_shift = 0.0;       // axial distance by which each bead moves inwards to the rim, mm (negative: outwards)
  double sidewall_rubber = 0.0;  // mean thickness of the sidewall rubber, mm

  int line_size() const { return static_cast<int>(layers[0].size()); }
  double outer_radius() const;
  double width() const;
};

/// @throws InputError if a layer of rubber folds over itself.
TyreSection make_section(const TyreSpec& spec);

/// Volume of a quad revolved about the wheel axis (theorem of Pappus), mm3.
double revolved_volume(const TyreSection& section, const SectionQuad& quad);
/// Mean radius of a region's line, mm.
double mean_radius(const TyreSection& section, Region region);
/// Area of membrane j revolved about the wheel axis, mm2.
double revolved_area(const TyreSection& section, int membrane);

}  // namespace balocco
