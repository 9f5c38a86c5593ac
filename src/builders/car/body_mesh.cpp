#include "builders/car/body_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace balocco::car {
namespace {

constexpr std::size_t most_sheets = 4;  // in one weld, as guns on the line can join

/// Cells of a grid that finds the nodes around a place.
class Cells {
 public:
  Cells(const std::vector<Vector>& nodes, int first, int count, double size) : nodes_(nodes), size_(size) {
    for (int node = first; node < first + count; ++node) rows_[key(cell(nodes[node]))].push_back(node);
  }
  template <class Visit>
  void around(const Vector& place, Visit visit) const {
    const auto middle = cell(place);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (const auto found = rows_.find(key({middle[0] + i, middle[1] + j, middle[2] + k})); found != rows_.end())
            for (const int node : found->second) visit(node, length(nodes_[node] - place));
  }
  void insert(int node) { rows_[key(cell(nodes_[node]))].push_back(node); }

 private:
  std::array<std::int64_t, 3> cell(const Vector& place) const {
    return {static_cast<std::int64_t>(std::floor(place[0] / size_)), static_cast<std::int64_t>(std::floor(place[1] / size_)),
            static_cast<std::int64_t>(std::floor(place[2] / size_))};
  }
  static std::int64_t key(const std::array<std::int64_t, 3>& c) {
    return (c[0] * 73856093) ^ (c[1] * 19349663) ^ (c[2] * 83492791);
  }

  const std::vector<Vector>& nodes_;
  double size_;
  std::unordered_map<std::int64_t, std::vector<int>> rows_;
};

}  // namespace

void BodyMesh::add(const Sheet& sheet) {
  Part part{.name = sheet.part,
            .gauge = sheet.part,
            .assembly = assembly_,
            .first_node = static_cast<int>(nodes_.size()),
            .nodes = sheet.rows * sheet.columns,
            .columns = sheet.columns,
            .quadrilaterals = {}};
  for (const char* side : {"_LEFT", "_RIGHT"})
    if (part.gauge.ends_with(side)) part.gauge.resize(part.gauge.size() - std::string(side).size());
  nodes_.insert(nodes_.end(), sheet.points.begin(), sheet.points.end());
  part_of_.resize(nodes_.size(), static_cast<int>(parts_.size()));
  weld_of_.resize(nodes_.size(), -1);
  const auto node = [&](int row, int column) { return part.first_node + row * sheet.columns + column % sheet.columns; };
  for (int row = 0; row + 1 < sheet.rows; ++row)
    for (int column = 0; column + (sheet.closed ? 0 : 1) < sheet.columns; ++column) {
      const int ahead = sheet.turned ? 0 : 1, aside = 1 - ahead;
      part.quadrilaterals.push_back(
          {node(row, column), node(row + ahead, column + aside), node(row + 1, column + 1), node(row + aside, column + ahead)});
    }
  parts_.push_back(std::move(part));
}

void BodyMesh::add_both(const Sheet& left) {
  Sheet named = left;
  named.part = left.part + "_LEFT";
  add(named);
  add(mirrored(left, left.part + "_RIGHT"));
}

const Part* BodyMesh::find(const std::string& name) const {
  const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const Part& part) { return part.name == name; });
  return found == parts_.end() ? nullptr : &*found;
}

int BodyMesh::weld(const std::string& first, const std::string& second, double gap, double pitch) {
  int joined = 0;
  for (int a = 0; a < static_cast<int>(parts_.size()); ++a)
    for (int b = 0; b < static_cast<int>(parts_.size()); ++b) {
      if (a == b || parts_[a].gauge != first || parts_[b].gauge != second) continue;
      const auto side = [](const Part& part) { return part.name.substr(part.gauge.size()); };
      if (side(parts_[a]).empty() || side(parts_[b]).empty() || side(parts_[a]) == side(parts_[b]))
        joined += weld_pair(a, b, gap, pitch);
    }
  return joined;
}

int BodyMesh::weld_pair(int first, int second, double gap, double pitch) {
  const Part &a = parts_[first], &b = parts_[second];
  const Cells cells(nodes_, b.first_node, b.nodes, gap);
  struct Candidate {
    int gap_class, a;
    double distance;
    int b;
  };
  std::vector<Candidate> candidates;
  for (int node = a.first_node; node < a.first_node + a.nodes; ++node)
    cells.around(nodes_[node], [&](int other, double distance) {
      if (distance <= gap) candidates.push_back({static_cast<int>(distance / gap * 8.0), node, distance, other});
    });
  // The closest first, so that flanges are welded where they lie on one another; then along the sheet.
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& p, const Candidate& q) {
    return std::tie(p.gap_class, p.a, p.distance, p.b) < std::tie(q.gap_class, q.a, q.distance, q.b);
  });
  Cells places(nodes_, 0, 0, pitch);
  int joined = 0;
  for (const auto& candidate : candidates) {
    bool crowded = false;
    places.around(nodes_[candidate.a], [&](int, double distance) { crowded = crowded || distance < 0.999 * pitch; });
    if (crowded || !join(candidate.a, candidate.b)) continue;
    places.insert(candidate.a);
    ++joined;
  }
  return joined;
}

bool BodyMesh::join(int a, int b) {
  const int weld_a = weld_of_[a], weld_b = weld_of_[b];
  if (weld_a >= 0 && weld_a == weld_b) return true;
  const Weld of_a = weld_a < 0 ? Weld{a} : welds_[weld_a], of_b = weld_b < 0 ? Weld{b} : welds_[weld_b];
  if (of_a.size() + of_b.size() > most_sheets) return false;
  for (const int one : of_a)
    for (const int other : of_b)
      if (part_of_[one] == part_of_[other]) return false;
  Weld both = of_a;
  both.insert(both.end(), of_b.begin(), of_b.end());
  const int into = weld_a >= 0 ? weld_a : weld_b >= 0 ? weld_b : static_cast<int>(welds_.size());
  if (into == static_cast<int>(welds_.size())) welds_.emplace_back();
  if (weld_a >= 0 && weld_b >= 0) welds_[weld_b].clear();
  for (const int node : both) weld_of_[node] = into;
  welds_[into] = std::move(both);
  return true;
}

std::vector<Weld> BodyMesh::welds() const {
  std::vector<Weld> all;
  std::copy_if(welds_.begin(), welds_.end(), std::back_inserter(all), [](const Weld& weld) { return weld.size() > 1; });
  return all;
}

std::vector<int> BodyMesh::free_nodes(const std::vector<std::string>& parts, const Vector& place, double reach) const {
  std::vector<int> found;
  for (const auto& part : parts_) {
    const bool wanted =
        std::any_of(parts.begin(), parts.end(), [&](const auto& name) { return name == part.name || name == part.gauge; });
    for (int node = part.first_node; wanted && node < part.first_node + part.nodes; ++node)
      if (weld_of_[node] < 0 && length(nodes_[node] - place) <= reach) found.push_back(node);
  }
  return found;
}

std::vector<std::string> BodyMesh::loose_parts() const {
  std::vector<int> root(parts_.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find_root = [&](int part) {
    while (root[part] != part) part = root[part] = root[root[part]];
    return part;
  };
  for (const auto& weld : welds_)
    for (std::size_t i = 1; i < weld.size(); ++i) root[find_root(part_of_[weld[i]])] = find_root(part_of_[weld[0]]);
  std::vector<std::string> loose;
  int first = 0;
  for (int part = 1; part < static_cast<int>(parts_.size()); ++part) {
    if (parts_[part].assembly != parts_[first].assembly) first = part;
    if (find_root(part) != find_root(first)) loose.push_back(parts_[part].name);
  }
  return loose;
}

}  // namespace balocco::car
