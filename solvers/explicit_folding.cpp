#include "explicit_folding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

constexpr std::int32_t folding_lanes = 8;  // elements looked at together

/// Folded deeper than this part of the mean volume at its corners an element has turned inside out.
constexpr double deepest_fold = 0.5;

std::span<const Edges> corners_of(const ElementType& type) {
  if (type.section != Section::Kind::solid) return {};
  if (type.shape == Shape::hexahedron) return of_hexahedron;
  if (type.shape == Shape::wedge) return of_wedge;
  return {};
}

/// The three edges of a corner; `place(i)`: of node i.
std::array<Vector3<double>, 3> edges_at(int corner, const Edges& ends, const auto& place) {
  const Vector3<double> here = place(corner);
  return {place(ends[0]) - here, place(ends[1]) - here, place(ends[2]) - here};
}

double triple_product(const std::array<Vector3<double>, 3>& edge) { return dot(cross(edge[0], edge[1]), edge[2]); }

bool spans_a_volume(const std::array<Vector3<double>, 3>& edge) {
  return triple_product(edge) > flat * std::sqrt(dot(edge[0], edge[0]) * dot(edge[1], edge[1]) * dot(edge[2], edge[2]));
}

/// Whether a corner of the elements [first, last), eight at most, is folded now: most never are, and lanes tell it at a tenth of the cost.
bool any_folded(const Analysis& analysis, const ElementGroup& group, std::int32_t first, std::int32_t last, std::span<const Edges> corners) {
  std::array<std::array<std::array<double, folding_lanes>, 3>, 8> place;  // of each node
  for (int lane = 0; lane < folding_lanes; ++lane) {
    const auto nodes = group.nodes(std::min(first + lane, last - 1));
    for (std::size_t node = 0; node < corners.size(); ++node)
      for (int i = 0; i < 3; ++i) place[node][i][lane] = analysis.current.position[4 * static_cast<std::size_t>(nodes[node]) + i];
  }
  std::array<double, folding_lanes> least;
  least.fill(std::numeric_limits<double>::max());
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const auto &here = place[corner], &p = place[corners[corner][0]], &q = place[corners[corner][1]], &r = place[corners[corner][2]];
    for (int lane = 0; lane < folding_lanes; ++lane) {
      const auto edge = [&](const auto& end) {
        return Vector3<double>{{end[0][lane] - here[0][lane], end[1][lane] - here[1][lane], end[2][lane] - here[2][lane]}};
      };
      least[lane] = std::min(least[lane], dot(cross(edge(p), edge(q)), edge(r)));
    }
  }
  return std::ranges::min(least) <= 0.0;
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
  double sum = 0.0;
  for (int corner = 0; corner < static_cast<int>(corners.size()); ++corner) {
    volume[corner] = triple_product(edges_at(corner, corners[corner], now));
    sum += volume[corner];
    const bool deeper = deepest < 0 ? volume[corner] <= 0.0 : volume[corner] < volume[deepest];
    if (deeper && spans_a_volume(edges_at(corner, corners[corner], reference))) deepest = corner;
  }
  if (deepest < 0) return {};
  return {deepest, volume[deepest] < -deepest_fold * sum / static_cast<double>(corners.size()) ? deepest : -1};
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
      if (element % folding_lanes == 0 && !any_folded(analysis, group, element, std::min(element + folding_lanes, group.size()), corners)) {
        element += folding_lanes - 1;
        continue;
      }
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
