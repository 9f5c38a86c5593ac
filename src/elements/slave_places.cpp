#include "elements/slave_places.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "elements/any_face.hpp"
#include "elements/surface_nodes.hpp"
#include "math/tensor.hpp"

namespace balocco {

namespace {

Vector3<double> sum(const Model& model, const std::vector<std::int32_t>& nodes, const std::array<double, most_face_nodes>& weights) {
  Vector3<double> total{};
  for (std::size_t i = 0; i < nodes.size(); ++i) total = total + weights[i] * Vector3<double>{model.nodes.coordinates[nodes[i]]};
  return total;
}

/// The places of a face's quadrature, each with its share of the area.
std::vector<SlavePlace> places_of(const Model& model, const FaceRef& face) {
  const auto nodes = face_nodes(model, face);
  std::vector<SlavePlace> places;
  for (const auto& station : face_stations(nodes.size())) {
    const auto shapes = face_shapes(nodes.size(), station.xi, station.eta);
    const auto normal = cross(sum(model, nodes, shapes.by_xi), sum(model, nodes, shapes.by_eta));
    places.push_back({.nodes = nodes,
                      .weights = {shapes.value.begin(), shapes.value.begin() + static_cast<std::ptrdiff_t>(nodes.size())},
                      .area = station.weight * std::sqrt(dot(normal, normal))});
  }
  return places;
}

}  // namespace

std::vector<SlavePlace> slave_places(const Model& model, const ContactPair& pair) {
  const auto& slave = model.surfaces[pair.slave];
  std::vector<SlavePlace> places;
  if (pair.of_faces) {
    for (const auto& face : slave.faces) std::ranges::move(places_of(model, face), std::back_inserter(places));
    return places;
  }
  std::map<std::int32_t, double> area;
  for (const auto& face : slave.faces) {
    double whole = 0.0;
    for (const auto& place : places_of(model, face)) whole += place.area;
    const auto nodes = face_nodes(model, face);
    for (const auto node : nodes) area[node] += whole / static_cast<double>(nodes.size());
  }
  for (const auto node : surface_nodes(model, slave)) {
    const auto found = area.find(node);
    places.push_back({.nodes = {node}, .weights = {1.0}, .area = found == area.end() ? 1.0 : found->second});
  }
  return places;
}

std::vector<std::int32_t> homes_of_places(const Model& model, const ContactPair& pair) {
  const auto& slave = model.surfaces[pair.slave];
  if (!pair.of_faces) return surface_nodes(model, slave);
  std::vector<std::int32_t> homes;
  for (const auto& face : slave.faces) {
    const auto nodes = face_nodes(model, face);
    homes.insert(homes.end(), face_stations(nodes.size()).size(), nodes.front());
  }
  return homes;
}

}  // namespace balocco
