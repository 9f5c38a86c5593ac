#include "nastran/shell_sides.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace balocco::nastran {

namespace {

/// A shell at an edge; `forward`: it runs along it from the smaller number to the larger.
struct AtEdge {
  int shell;
  bool forward;
};

struct Neighbour {
  int shell;
  bool alike;  // both point to the same side
};

std::vector<std::vector<Neighbour>> neighbours_of(const std::vector<std::vector<std::int64_t>*>& shells) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<AtEdge>> edges;
  for (int shell = 0; shell < static_cast<int>(shells.size()); ++shell) {
    const auto& nodes = *shells[shell];
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto from = nodes[i], to = nodes[(i + 1) % nodes.size()];
      edges[std::minmax(from, to)].push_back({shell, from < to});
    }
  }
  std::vector<std::vector<Neighbour>> neighbours(shells.size());
  for (const auto& [edge, at] : edges) {
    if (at.size() != 2) continue;
    const bool alike = at[0].forward != at[1].forward;
    neighbours[at[0].shell].push_back({at[1].shell, alike});
    neighbours[at[1].shell].push_back({at[0].shell, alike});
  }
  return neighbours;
}

/// The shells of one surface, and of each whether it is to be turned for the first to stay.
struct Surface {
  std::vector<int> shells;
  bool has_sides = true;
};

Surface flood(int first, const std::vector<std::vector<Neighbour>>& neighbours, std::vector<std::optional<bool>>& turned) {
  Surface surface{.shells = {first}};
  turned[first] = false;
  for (std::size_t i = 0; i < surface.shells.size(); ++i) {
    const int shell = surface.shells[i];
    for (const auto& [next, alike] : neighbours[shell]) {
      const bool wanted = *turned[shell] == alike;
      if (!turned[next]) {
        turned[next] = wanted;
        surface.shells.push_back(next);
      } else if (*turned[next] != wanted) {
        surface.has_sides = false;
      }
    }
  }
  return surface;
}

}  // namespace

int unify_sides(const std::vector<std::vector<std::int64_t>*>& shells) {
  const auto neighbours = neighbours_of(shells);
  std::vector<std::optional<bool>> turned(shells.size());
  int count = 0;
  for (int first = 0; first < static_cast<int>(shells.size()); ++first) {
    if (turned[first]) continue;
    const auto surface = flood(first, neighbours, turned);
    if (!surface.has_sides) continue;
    const auto many = std::ranges::count_if(surface.shells, [&](int shell) { return *turned[shell]; });
    const bool turn_these = 2 * many <= static_cast<std::ptrdiff_t>(surface.shells.size());
    for (const int shell : surface.shells) {
      if (*turned[shell] != turn_these) continue;
      std::reverse(shells[shell]->begin() + 1, shells[shell]->end());
      ++count;
    }
  }
  return count;
}

}  // namespace balocco::nastran
