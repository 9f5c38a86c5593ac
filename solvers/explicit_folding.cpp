#include "explicit_folding.hpp"

#include <array>
#include <cmath>

#include "elements/element_type.hpp"
#include "math/tensor.hpp"

namespace balocco {

namespace {

/// Of each corner the ends of its three edges, which form a right-handed system.
using Edges = std::array<int, 3>;
constexpr std::array<Edges, 8> of_hexahedron{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
constexpr std::array<Edges, 6> of_wedge{{{1, 2, 3}, {2, 0, 4}, {0, 1, 5}, {5, 4, 0}, {3, 5, 1}, {4, 3, 2}}};

/// Corners whose edges span less than this part of the product of their lengths are those of collapsed elements.
constexpr double flat = 1e-6;

/// Folded deeper than this part of the mean volume at its corners an element has turned inside out.
constexpr double deepest_fold = 0.5;

std::span<const Edges> corners_of(const ElementType& type) {
  if (type.section != Section::Kind::solid) return {};
  if (type.shape == Shape::hexahedron) return of_hexahedron;
  if (type.shape == Shape::wedge) return of_wedge;
  return {};
}

/// Triple product of the edges, where it is above `least` times the product of their lengths; else 0. `place(i)`: of node i.
double volume_at(int corner, const Edges& edges, double least, const auto& place) {
  const Vector3<double> here = place(corner);
  const auto a = place(edges[0]) - here, b = place(edges[1]) - here, c = place(edges[2]) - here;
  const double volume = dot(cross(a, b), c);
  return std::abs(volume) > least * std::sqrt(dot(a, a) * dot(b, b) * dot(c, c)) ? volume : 0.0;
}

/// Corners of an element that are folded now and were not in the reference configuration; -1: none.
struct Corners {
  int folded = -1, inside_out = -1;
};

Corners folded_corners(const Analysis& analysis, std::span<const std::int32_t> nodes, std::span<const Edges> corners) {
  const auto now = [&](int i) {
    const double* const x = &analysis.current.position[4 * static_cast<std::size_t>(nodes[i])];
    return Vector3<double>{x[0], x[1], x[2]};
  };
  const auto reference = [&](int i) { return Vector3<double>{analysis.model.nodes.coordinates[analysis.domain.node_row[nodes[i]]]}; };
  std::array<double, 8> volume{};
  int deepest = -1;
  double mean = 0.0;
  for (int corner = 0; corner < static_cast<int>(corners.size()); ++corner) {
    volume[corner] = volume_at(corner, corners[corner], 0.0, now);
    mean += volume[corner] / static_cast<double>(corners.size());
    const bool deeper = deepest < 0 ? volume[corner] <= 0.0 : volume[corner] < volume[deepest];
    if (deeper && volume_at(corner, corners[corner], flat, reference) > 0.0) deepest = corner;
  }
  if (deepest < 0) return {};
  return {deepest, volume[deepest] < -deepest_fold * mean ? deepest : -1};
}

}  // namespace

Folding find_folding(const Analysis& analysis, const ElementFailures& failures) {
  Folding found;
  for (std::size_t index = 0; index < analysis.element_groups.size(); ++index) {
    const auto& group = *analysis.element_groups[index];
    const auto& table = analysis.model.elements[group.table()];
    const auto corners = corners_of(*table.type);
    if (corners.empty()) continue;
    for (std::int32_t element = 0; element < group.size(); ++element) {
      if (!group.acts(element) || failures.failed(index, element, analysis.current.element_history[index])) continue;
      const auto nodes = group.nodes(element);
      const auto [folded, inside_out] = folded_corners(analysis, nodes, corners);
      if (folded < 0) continue;
      const auto id = table.id[group.row(element)];
      const auto take = [&](std::optional<FoldedCorner>& smallest, int corner) {
        if (corner >= 0 && (!smallest || id < smallest->element))
          smallest = FoldedCorner{id, analysis.model.nodes.id[analysis.domain.node_row[nodes[corner]]]};
      };
      take(found.folded, folded);
      take(found.inside_out, inside_out);
    }
  }
  return found;
}

}  // namespace balocco
