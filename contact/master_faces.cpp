#include "master_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "elements/surface_nodes.hpp"

namespace balocco {

namespace {

/// How far a face goes on beyond an edge at which the surface ends: a tenth of the face.
constexpr double margin = 0.1;
/// Distance, of the faces' edge, below which the direction from an edge or a corner is round-off.
constexpr double no_direction = 1e-9;
/// Rounding must not let a place over a common edge fall between two faces.
constexpr double overlap = 1e-9;
/// A face that covers more, large among small ones or torn by a run that diverges, is a candidate everywhere.
constexpr double most_cells = 4096.0;

double norm(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

Vector3<double> unit(const Vector3<double>& v) {
  const double length = norm(v);
  return length > 0.0 ? (1.0 / length) * v : v;
}

Vector3<double> place_of(const double* position, std::int32_t node) {
  const double* x = position + 4 * static_cast<std::ptrdiff_t>(node);
  return {x[0], x[1], x[2]};
}

Vector3<double> sum(const double* position, std::span<const std::int32_t> nodes, const std::array<double, most_face_nodes>& weights) {
  Vector3<double> total{};
  for (std::size_t i = 0; i < nodes.size(); ++i) total = total + weights[i] * place_of(position, nodes[i]);
  return total;
}

using Coordinates = std::array<double, 2>;

Coordinates corner_coordinates(std::size_t nodes, int corner) {
  constexpr std::array<Coordinates, 3> triangle{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
  if (is_triangle(nodes)) return triangle[corner];
  return {static_cast<double>(face_corners[corner][0]), static_cast<double>(face_corners[corner][1])};
}

/// How far a place is beyond edge i of its face, of the way from there to the opposite side.
double beyond(std::size_t nodes, int edge, double xi, double eta) {
  if (is_triangle(nodes)) return edge == 0 ? -eta : edge == 1 ? xi + eta - 1.0 : -xi;
  const std::array<double, 4> out{-1.0 - eta, xi - 1.0, eta - 1.0, -1.0 - xi};
  return 0.5 * out[edge];
}

}  // namespace

MasterFaces::MasterFaces(const Model& model, const Surface& surface, std::span<const std::int32_t> local_node) {
  std::size_t last = 0;
  double length = 0.0;
  std::size_t edges = 0;
  for (const auto& reference : surface.faces) {
    auto& face = faces_.emplace_back();
    const auto rows = face_nodes(model, reference);
    for (const auto row : rows) {
      face.nodes.push_back(local_node[row]);
      last = std::max(last, static_cast<std::size_t>(local_node[row]));
    }
    const auto corners = corners_of_face(rows.size());
    for (std::size_t i = 0; i < corners; ++i, ++edges)
      length += norm(Vector3<double>{model.nodes.coordinates[rows[(i + 1) % corners]]} - Vector3<double>{model.nodes.coordinates[rows[i]]});
  }
  if (edges > 0) edge_ = reach_ = length / static_cast<double>(edges);
  join_edges(last + 1);
}

void MasterFaces::join_edges(std::size_t nodes) {
  faces_of_corner_.resize(nodes);
  ends_at_.assign(nodes, false);
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, int>> open;
  for (std::int32_t f = 0; f < size(); ++f) {
    auto& face = faces_[f];
    const auto corners = static_cast<int>(corners_of_face(face.nodes.size()));
    for (int edge = 0; edge < corners; ++edge) {
      faces_of_corner_[face.nodes[edge]].push_back(f);
      const auto ends = std::minmax(face.nodes[edge], face.nodes[(edge + 1) % corners]);
      const auto [place, fresh] = open.try_emplace(ends, f, edge);
      if (fresh) continue;
      face.neighbour[edge] = place->second.first;
      faces_[place->second.first].neighbour[place->second.second] = f;
      open.erase(place);
    }
  }
  for (const auto& [ends, side] : open) ends_at_[ends.first] = ends_at_[ends.second] = true;
}

std::size_t MasterFaces::CellHash::operator()(const Cell& cell) const {
  std::uint64_t hash = 0;
  for (const auto index : cell) hash = (hash ^ static_cast<std::uint32_t>(index)) * 0x9E3779B97F4A7C15U;
  return hash ^ hash >> 32;
}

MasterFaces::Cell MasterFaces::cell_of(const Vector3<double>& place) const {
  constexpr double far = 1e9;
  Cell cell{};
  for (int i = 0; i < 3; ++i) cell[i] = static_cast<std::int32_t>(std::floor(std::clamp(place[i] / (4.0 * reach_), -far, far)));
  return cell;
}

MasterFaces::Box MasterFaces::box_around(const double* position, const Face& face) const {
  Box box{place_of(position, face.nodes.front()), place_of(position, face.nodes.front())};
  for (const auto node : face.nodes)
    for (int i = 0; i < 3; ++i) {
      const double x = position[4 * static_cast<std::ptrdiff_t>(node) + i];
      box.low[i] = std::min(box.low[i], x);
      box.high[i] = std::max(box.high[i], x);
    }
  for (int i = 0; i < 3; ++i) {
    box.low[i] -= 2.0 * reach_;
    box.high[i] += 2.0 * reach_;
  }
  return box;
}

void MasterFaces::locate(const double* position) {
  cells_.clear();
  everywhere_.clear();
  radii_.assign(faces_.size(), 0.0);
  for (std::int32_t f = 0; f < size(); ++f) {
    constexpr double growth = 1.5;  // it may stretch, and bulge where it is quadratic
    for (const auto node : faces_[f].nodes)
      radii_[f] = std::max(radii_[f], growth * norm(place_of(position, node) - place_of(position, faces_[f].nodes.front())));
    const auto box = box_around(position, faces_[f]);
    const auto low = cell_of(box.low), high = cell_of(box.high);
    double cells = 1.0;
    for (int i = 0; i < 3; ++i) cells *= 1.0 + static_cast<double>(high[i]) - static_cast<double>(low[i]);
    if (!(cells <= most_cells)) {
      everywhere_.push_back(f);
      continue;
    }
    for (auto x = low[0]; x <= high[0]; ++x)
      for (auto y = low[1]; y <= high[1]; ++y)
        for (auto z = low[2]; z <= high[2]; ++z) cells_[{x, y, z}].push_back(f);
  }
}

Vector3<double> MasterFaces::at(const double* position, std::int32_t face, double xi, double eta) const {
  return sum(position, nodes(face), face_shapes(nodes(face).size(), xi, eta).value);
}

Vector3<double> MasterFaces::normal_at(const double* position, const Face& face, double xi, double eta) const {
  const auto shapes = face_shapes(face.nodes.size(), xi, eta);
  return unit(cross(sum(position, face.nodes, shapes.by_xi), sum(position, face.nodes, shapes.by_eta)));
}

/// Which side an edge or a corner is seen from is told by the sum of the faces' normals there, at a corner weighed with their angles.
Vector3<double> MasterFaces::mean_normal(const double* position, const FacePlace& foot, int edge, int corner) const {
  const auto& face = faces_[foot.face];
  if (corner < 0) {
    const auto& other = faces_[face.neighbour[edge]];
    const double middle = is_triangle(other.nodes.size()) ? 1.0 / 3.0 : 0.0;
    return unit(normal_at(position, face, foot.xi, foot.eta) + normal_at(position, other, middle, middle));
  }
  const auto node = face.nodes[corner];
  Vector3<double> total{};
  for (const auto f : faces_of_corner_[node]) {
    const auto& there = faces_[f];
    const auto corners = static_cast<int>(corners_of_face(there.nodes.size()));
    const auto here = static_cast<int>(std::ranges::find(there.nodes, node) - there.nodes.begin());
    const auto at = place_of(position, node);
    const auto next = place_of(position, there.nodes[(here + 1) % corners]) - at;
    const auto last = place_of(position, there.nodes[(here + corners - 1) % corners]) - at;
    const auto normal = cross(next, last);
    total = total + std::atan2(norm(normal), dot(next, last)) * unit(normal);
  }
  return unit(total);
}

/// The place of an extremum of the distance, by Newton's method.
bool MasterFaces::foot_within(const double* position, const Face& face, const Vector3<double>& place, FacePlace& foot) const {
  constexpr int most_iterations = 50;
  constexpr double far = 4.0;
  const auto count = face.nodes.size();
  foot.xi = foot.eta = is_triangle(count) ? 1.0 / 3.0 : 0.0;
  for (int iteration = 0;; ++iteration) {
    const auto shapes = face_shapes(count, foot.xi, foot.eta);
    const auto away = place - sum(position, face.nodes, shapes.value);
    const auto by_xi = sum(position, face.nodes, shapes.by_xi), by_eta = sum(position, face.nodes, shapes.by_eta);
    const double a = dot(by_xi, by_xi), b = dot(by_xi, by_eta), c = dot(by_eta, by_eta), determinant = a * c - b * b;
    if (!(determinant > 1e-14 * a * c) || iteration == most_iterations) return false;
    const double right_xi = dot(by_xi, away), right_eta = dot(by_eta, away);
    const double xi = (c * right_xi - b * right_eta) / determinant, eta = (a * right_eta - b * right_xi) / determinant;
    foot.xi += xi;
    foot.eta += eta;
    if (std::abs(foot.xi) + std::abs(foot.eta) > far) return false;
    if (std::abs(xi) + std::abs(eta) < 1e-13) break;
  }
  for (int edge = 0; edge < static_cast<int>(corners_of_face(count)); ++edge)
    if (beyond(count, edge, foot.xi, foot.eta) > (face.neighbour[edge] < 0 ? margin : overlap)) return false;
  return true;
}

/// The nearest place of an edge that two faces share, or of one of its corners.
void MasterFaces::foot_on_edge(const double* position, std::int32_t f, int edge, const Vector3<double>& place, FacePlace& best) const {
  constexpr int most_iterations = 50;
  const auto& face = faces_[f];
  const auto count = face.nodes.size();
  const int next = (edge + 1) % static_cast<int>(corners_of_face(count));
  const auto from = corner_coordinates(count, edge), to = corner_coordinates(count, next);
  const Coordinates way{to[0] - from[0], to[1] - from[1]};
  double along = 0.5;
  const auto shapes_there = [&] { return face_shapes(count, from[0] + along * way[0], from[1] + along * way[1]); };
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto shapes = shapes_there();
    const auto away = place - sum(position, face.nodes, shapes.value);
    const auto tangent = way[0] * sum(position, face.nodes, shapes.by_xi) + way[1] * sum(position, face.nodes, shapes.by_eta);
    const double before = along;
    along = std::clamp(along + dot(tangent, away) / dot(tangent, tangent), 0.0, 1.0);
    if (std::abs(along - before) < 1e-13) break;
  }
  const int corner = along == 0.0 ? edge : along == 1.0 ? next : -1;
  if (corner >= 0 && ends_at_[face.nodes[corner]]) return;
  const auto arm = place - sum(position, face.nodes, shapes_there().value);
  const double length = norm(arm);
  if (best.face >= 0 && length >= std::abs(best.distance)) return;
  best = {.face = f, .xi = from[0] + along * way[0], .eta = from[1] + along * way[1], .freedoms = corner < 0 ? 1 : 0};
  best.way[0] = way;
  const auto mean = mean_normal(position, best, edge, corner);
  best.distance = dot(arm, mean) < 0.0 ? -length : length;
  best.normal = length > no_direction * edge_ ? (1.0 / best.distance) * arm : mean;
}

FacePlace MasterFaces::foot(const double* position, std::int32_t f, const Vector3<double>& place) const {
  const auto& face = faces_[f];
  FacePlace within{.face = f}, best;
  if (foot_within(position, face, place, within)) {
    within.normal = normal_at(position, face, within.xi, within.eta);
    within.distance = dot(place - at(position, f, within.xi, within.eta), within.normal);
    return within;
  }
  for (int edge = 0; edge < static_cast<int>(corners_of_face(face.nodes.size())); ++edge)
    if (face.neighbour[edge] >= 0) foot_on_edge(position, f, edge, place, best);
  return best;
}

double MasterFaces::least_distance(const double* position, std::int32_t face, const Vector3<double>& place) const {
  return norm(place - place_of(position, faces_[face].nodes.front())) - radii_[face];
}

/// The candidate that may be nearest is looked at first: most others then cannot be.
FacePlace MasterFaces::nearest(const double* position, const Vector3<double>& place) const {
  FacePlace best;
  const auto found = cells_.find(cell_of(place));
  candidates_ = everywhere_;
  if (found != cells_.end()) candidates_.insert(candidates_.end(), found->second.begin(), found->second.end());
  if (candidates_.empty()) return best;
  away_.resize(candidates_.size());
  for (std::size_t i = 0; i < away_.size(); ++i) away_[i] = least_distance(position, candidates_[i], place);
  const auto first = static_cast<std::size_t>(std::ranges::min_element(away_) - away_.begin());
  double least = reach_;
  const auto look_at = [&](std::size_t i) {
    if (!(away_[i] <= least)) return;
    const auto here = foot(position, candidates_[i], place);
    const double distance = std::abs(here.distance);
    if (here.face < 0 || !(distance <= least) || (best.face >= 0 && distance == least && best.face < here.face)) return;
    least = distance;
    best = here;
  };
  look_at(first);
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    if (i != first) look_at(i);
  return best;
}

}  // namespace balocco
