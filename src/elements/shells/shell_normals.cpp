#include "elements/shells/shell_normals.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "elements/element_type.hpp"
#include "math/tensor.hpp"

namespace balocco {

namespace {

using Vector = Vector3<double>;

constexpr double smooth_cosine = 0.93969262078590838;  // of 20 degrees

struct Corner {
  std::int32_t node;
  ElementRef element;
  int corner;
  Vector normal;  // of the element there
};

/// A side of an element, from the node with the smaller row to the other; `forward`: the element runs along it that
/// way.
struct Side {
  std::int32_t low, high;
  bool forward;
  ElementRef element;
  Vector normal;
};

Vector vector_of(const Point& p) {
  return {{p[0], p[1], p[2]}};
}
Vector unit(const Vector& v) {
  const double size = std::sqrt(dot(v, v));
  return size > 0.0 ? (1.0 / size) * v : v;
}

void collect(const Model& model, std::int32_t table, std::vector<Corner>& corners, std::vector<Side>& sides) {
  const ElementTable& elements = model.elements[table];
  const int count = elements.type->nodes;
  for (std::int32_t row = 0; row < elements.size(); ++row) {
    const std::int32_t* const node = elements.connectivity.data() + static_cast<std::ptrdiff_t>(row) * count;
    const auto at = [&](int i) { return vector_of(model.nodes.coordinates[node[(i + count) % count]]); };
    for (int i = 0; i < count; ++i) {
      const Vector normal = unit(cross(at(i + 1) - at(i), at(i - 1) - at(i)));
      corners.push_back({node[i], {table, row}, i, normal});
      const auto [low, high] = std::minmax(node[i], node[(i + 1) % count]);
      sides.push_back({low, high, node[i] == low, {table, row}, normal});
    }
  }
}

/// Gives the corners of one node the means of their groups: a corner joins the first group all of whose normals are
/// near its own.
void average(std::span<const Corner> corners, std::vector<ElementTable>& tables) {
  std::vector<std::vector<const Corner*>> groups;
  for (const Corner& corner : corners) {
    const auto near = [&](const Corner* other) { return dot(corner.normal, other->normal) >= smooth_cosine; };
    const auto group =
        std::ranges::find_if(groups, [&](const auto& members) { return std::ranges::all_of(members, near); });
    if (group != groups.end())
      group->push_back(&corner);
    else
      groups.push_back({&corner});
  }
  for (const auto& group : groups) {
    Vector sum;
    for (const Corner* corner : group) sum = sum + corner->normal;
    const Vector mean = unit(sum);
    for (const Corner* corner : group) {
      ElementTable& table = tables[corner->element.table];
      table.corner_normal[static_cast<std::size_t>(corner->element.row) * table.type->nodes + corner->corner] = {
          mean[0], mean[1], mean[2]};
    }
  }
}

std::vector<OpposedShells> opposed(std::vector<Side>& sides) {
  std::ranges::sort(sides, {}, [](const Side& side) { return std::tuple(side.low, side.high, side.element); });
  std::vector<OpposedShells> result;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    if (end - begin != 2) continue;  // an outer edge or a junction
    const Side &first = sides[begin], &second = sides[begin + 1];
    if (first.forward == second.forward && dot(first.normal, second.normal) < -0.5)
      result.push_back({first.element, second.element});
  }
  return result;
}

}  // namespace

std::vector<OpposedShells> set_corner_normals(Model& model, const GivenNormals& given) {
  std::vector<Corner> corners;
  std::vector<Side> sides;
  for (std::size_t t = 0; t < model.elements.size(); ++t) {
    ElementTable& table = model.elements[t];
    if (table.type->section != Section::Kind::shell) continue;
    table.corner_normal.assign(table.connectivity.size(), {});
    collect(model, static_cast<std::int32_t>(t), corners, sides);
  }
  std::ranges::stable_sort(corners, {}, &Corner::node);
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    while (end < corners.size() && corners[end].node == corners[begin].node) ++end;
    average({corners.data() + begin, end - begin}, model.elements);
  }
  for (const Corner& corner : corners) {
    ElementTable& table = model.elements[corner.element.table];
    Point& normal =
        table.corner_normal[static_cast<std::size_t>(corner.element.row) * table.type->nodes + corner.corner];
    const auto at_corner = given.at_corner.find({corner.element, corner.node});
    const auto at_node = given.at_node.find(corner.node);
    if (at_corner != given.at_corner.end())
      normal = at_corner->second;
    else if (at_node != given.at_node.end())
      normal = at_node->second;
  }
  return opposed(sides);
}

}  // namespace balocco
