// *FASTENER with *FASTENER PROPERTY: spot welds wherever their reference nodes are, on meshes that need not know of
// them. Every layer moves the reference node with itself (constraints/distributing_coupling.hpp, constraints/tie.hpp),
// so that the layers move as one there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "constraints/face_projection.hpp"
#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"
#include "elements/surface_nodes.hpp"
#include "elements/turning_nodes.hpp"

namespace balocco::deck {

namespace {

void read_property(Builder& builder, const Block& block) {
  if (block.lines.empty())
    return builder.error(block, block.location, "the radius is missing; add a data line with it");
  Row row(builder, block, block.lines[0]);
  const double radius = row.real(0, "radius");
  row.at_most(1);
  if (row.ok() && !(radius > 0.0)) row.error(fmt::format("radius {} must be positive; correct it", radius));
  if (row.ok()) builder.fastener_radius[block.value("NAME")] = radius;
}

/// How far from its node a weld looks for a surface, and why.
struct Reach {
  double length = 0.0;
  const char* reason = "";
};

/// A surface that welds join, and its nodes.
struct Layer {
  const Surface* surface = nullptr;
  FaceProjection faces;
  std::vector<std::int32_t> nodes;
  Reach reach;  // where no SEARCH RADIUS is given
};

/// Of the thickest sheet of a surface; 0: it has none.
double thickest_sheet(const Model& model, const Surface& surface) {
  double thickest = 0.0;
  for (const auto& face : surface.faces) {
    const auto& table = model.elements[face.element.table];
    if (table.type->section != Section::Kind::shell && table.type->section != Section::Kind::membrane) continue;
    const auto& section = model.sections[table.section[face.element.row]];
    double thickness = table.thickness.empty() ? 0.0 : table.thickness[face.element.row];
    if (section.shell.nodal_thickness && !model.nodes.thickness.empty())
      for (const auto node : face_nodes(model, face)) thickness = std::max(thickness, model.nodes.thickness[node]);
    thickest = std::max(thickest, thickness > 0.0 ? thickness : section.thickness);
  }
  return thickest;
}

/// A stack of sheets in contact lies within a few thicknesses of any of them; of solids, only the mesh tells a length.
Reach reach_of(const Model& model, const Surface& surface, double mean_edge, double weld_radius) {
  const double thickness = thickest_sheet(model, surface);
  const Reach of_faces = thickness > 0.0 ? Reach{5.0 * thickness, "5 times the thickness of its sheets"}
                                         : Reach{mean_edge, "the mean edge of its faces"};
  return of_faces.length >= weld_radius ? of_faces : Reach{weld_radius, "the radius of the weld"};
}

std::vector<Layer> read_layers(Builder& builder, const Block& block, double weld_radius) {
  std::vector<Layer> layers;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field) {
      if (!row.has(field)) continue;
      const auto surface = builder.require(builder.surfaces, row.name(field), block, row.location());
      if (!surface) return {};
      const auto& found = builder.model.surfaces[*surface];
      FaceProjection faces(builder.model, found);
      const auto reach = reach_of(builder.model, found, faces.mean_edge(), weld_radius);
      layers.push_back({&found, std::move(faces), surface_nodes(builder.model, found), reach});
    }
  }
  if (layers.size() < 2)
    builder.error(block, block.location, "a weld joins at least two surfaces; name them on data lines");
  return layers.size() < 2 ? std::vector<Layer>{} : std::move(layers);
}

/// The reference node moves with the mean of the layer's nodes within the radius of influence about a place, weighted
/// alike. Where there are too few to tell a rotation, it is held to the face there: of sheets by displacements and
/// rotations between the nodes, which leaves neighbouring welds free to turn unlike; of solids by the mean of the
/// face's nodes, weighted so that it is the place itself.
ConstraintKind held_by(const Model& model, const Layer& layer, std::int32_t reference, const FacePoint& place,
                       double influence, const std::vector<bool>& turns) {
  DistributingCoupling cloud{.reference = reference, .nodes = {}, .weights = {}};
  for (const auto node : layer.nodes)
    if (norm(subtract(model.nodes.coordinates[node], place.position)) <= influence) cloud.nodes.push_back(node);
  cloud.weights.assign(cloud.nodes.size(), 1.0);
  if (cloud.nodes.size() >= 3) return cloud;
  if (std::ranges::all_of(place.nodes, [&](std::int32_t node) { return turns[node]; }))
    return Tie{
        .node = reference, .others = place.nodes, .weights = place.weights, .others_turn = true, .rotations = true};
  cloud.nodes = place.nodes;
  cloud.weights.clear();
  constexpr double least = 1e-3;  // a weld at a node still has a face around it, whose rotation is its own
  for (const double weight : place.weights) cloud.weights.push_back(std::max(weight, least));
  return cloud;
}

/// What a *FASTENER says of all of its welds.
class Fastener {
 public:
  Fastener(Builder& builder, const Block& block, std::vector<Layer> layers, double radius)
      : builder_(builder),
        block_(block),
        layers_(std::move(layers)),
        influence_(block.real("RADIUS OF INFLUENCE", radius)),
        search_radius_(block.has("SEARCH RADIUS") ? std::optional(block.real("SEARCH RADIUS", 0.0)) : std::nullopt),
        turns_(turning_nodes(builder.model)) {}

  /// A node to which all layers are held.
  void add_weld(std::int32_t reference) {
    for (const auto& layer : layers_)
      if (!hold(reference, layer)) return;
  }

  /// A connector between two layers: each of its nodes is held to the one that is nearest, and the two to different
  /// ones.
  void add_connector(std::int32_t first, std::int32_t second) {
    for (const auto& [node, other] : {std::pair{first, second}, std::pair{second, first}}) {
      if (layer_of_.contains(node)) continue;
      const auto taken = layer_of_.find(other);
      const auto* layer = nearest_layer(node, taken == layer_of_.end() ? nullptr : taken->second);
      if (!hold(node, *layer)) return;
      layer_of_[node] = layer;
    }
  }

 private:
  void refuse(std::int32_t node, const Layer& layer) const {
    const auto within = search_radius_ ? fmt::format("its SEARCH RADIUS of {:.4g}", *search_radius_)
                                       : fmt::format("{:.4g}, which is {}", layer.reach.length, layer.reach.reason);
    const auto nearest = layer.faces.nearest(builder_.model.nodes.coordinates[node], HUGE_VAL);
    const auto cure = nearest ? fmt::format(": the nearest one is {:.4g} away; give SEARCH RADIUS={:.2g}, or move the node",
                                            nearest->distance, 1.1 * nearest->distance)
                              : std::string("; its faces have no area");
    builder_.error(block_, block_.location,
                   fmt::format("the weld at node {} finds no face of {} within {}{}", builder_.model.node_name(node),
                               layer.surface->name, within, cure));
  }

  const Layer* nearest_layer(std::int32_t node, const Layer* taken) const {
    const Layer* nearest = nullptr;
    double least = HUGE_VAL;
    for (const auto& layer : layers_) {
      if (&layer == taken) continue;
      const auto place = layer.faces.nearest(builder_.model.nodes.coordinates[node], HUGE_VAL);
      if (nearest != nullptr && !(place && place->distance < least)) continue;
      nearest = &layer;
      if (place) least = place->distance;
    }
    return nearest;
  }

  /// @return false, with an error, where no face is within reach
  bool hold(std::int32_t node, const Layer& layer) {
    const auto place = layer.faces.nearest(builder_.model.nodes.coordinates[node], search_radius_.value_or(layer.reach.length));
    if (!place) {
      refuse(node, layer);
      return false;
    }
    builder_.model.constraints.push_back({held_by(builder_.model, layer, node, *place, influence_, turns_), "*FASTENER",
                                          block_.location.file, block_.location.line});
    return true;
  }

  Builder& builder_;
  const Block& block_;
  const std::vector<Layer> layers_;
  const double influence_;
  const std::optional<double> search_radius_;
  const std::vector<bool> turns_;
  std::map<std::int32_t, const Layer*> layer_of_;  // of nodes of connectors
};

void add_connectors(Builder& builder, const Block& block, Fastener& fastener) {
  std::vector<ElementRef> elements;
  if (!builder.elements_of(block.value("ELSET"), block, block.location, elements)) return;
  for (const auto element : elements) {
    const auto& table = builder.model.elements[element.table];
    if (table.type->section != Section::Kind::connector)
      return builder.error(block, block.location,
                           fmt::format("element {} of {} is no connector; fasteners are made of CONN3D2",
                                       builder.model.element_name(element), block.value("ELSET")));
    const auto* nodes = &table.connectivity[2 * static_cast<std::size_t>(element.row)];
    if (builder.ground_nodes.contains(nodes[0]) || builder.ground_nodes.contains(nodes[1]))
      return builder.error(block, block.location,
                           fmt::format("element {} of {} joins the ground, which is no sheet; give it two nodes",
                                       builder.model.element_name(element), block.value("ELSET")));
    fastener.add_connector(nodes[0], nodes[1]);
  }
}

void read_fastener(Builder& builder, const Block& block) {
  const auto property = builder.fastener_radius.find(block.value("PROPERTY"));
  if (property == builder.fastener_radius.end()) {
    if (!builder.is_poisoned(block.value("PROPERTY")))
      builder.error(block, block.location,
                    fmt::format("fastener property {} is not defined; define *FASTENER PROPERTY, NAME={}",
                                block.value("PROPERTY"), block.value("PROPERTY")));
    return;
  }
  if (block.has("ELSET") == block.has("REFERENCE NODE SET"))
    return builder.error(block, block.location,
                         "welds are either the nodes of a REFERENCE NODE SET, which hold all surfaces together, or "
                         "connectors between two of them, an "
                         "ELSET; give one of the two");
  // An empty first line leaves the direction of the projection to the faces; empty lines are no lines here.
  if (!block.lines.empty() && parse_real(Row(builder, block, block.lines[0]).text(0)))
    return builder.error(block, block.lines[0].location,
                         "welds are projected along the normals of the faces; leave the line of the direction empty");
  auto layers = read_layers(builder, block, property->second);
  if (layers.empty()) return;
  Fastener fastener(builder, block, std::move(layers), property->second);
  if (block.has("ELSET")) return add_connectors(builder, block, fastener);
  std::vector<std::int32_t> references;
  if (!builder.nodes_of(block.value("REFERENCE NODE SET"), block, block.location, references)) return;
  for (const auto reference : references) fastener.add_weld(reference);
}

const RegisterKeyword property{
    {"FASTENER PROPERTY", Phase::definitions, Place::model, {required(name("NAME"))}, read_property}};
const RegisterKeyword fastener{
    {"FASTENER",
     Phase::constraints,
     Place::model,
     {required(name("PROPERTY")), name("REFERENCE NODE SET"), name("ELSET"), name("INTERACTION NAME"),
      real("RADIUS OF INFLUENCE"), real("SEARCH RADIUS"), foreign("NUMBER OF LAYERS")},
     read_fastener}};

}  // namespace

}  // namespace balocco::deck
