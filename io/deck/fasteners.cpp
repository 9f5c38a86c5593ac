// *FASTENER with *FASTENER PROPERTY: spot welds wherever their reference nodes are, on meshes that need not know of them. Every layer
// moves the reference node with itself (constraints/distributing_coupling.hpp, constraints/tie.hpp), so that the layers move as one there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/face_projection.hpp"
#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/surface_nodes.hpp"
#include "elements/turning_nodes.hpp"

namespace balocco::deck {

namespace {

void read_property(Builder& builder, const Block& block) {
  if (block.lines.empty()) return builder.error(block, block.location, "the radius is missing; add a data line with it");
  Row row(builder, block, block.lines[0]);
  const double radius = row.real(0, "radius");
  row.at_most(1);
  if (row.ok() && !(radius > 0.0)) row.error(fmt::format("radius {} must be positive; correct it", radius));
  if (row.ok()) builder.fastener_radius[block.value("NAME")] = radius;
}

/// A surface that welds join, and its nodes.
struct Layer {
  const Surface* surface = nullptr;
  FaceProjection faces;
  std::vector<std::int32_t> nodes;
};

std::vector<Layer> read_layers(Builder& builder, const Block& block) {
  std::vector<Layer> layers;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field) {
      if (!row.has(field)) continue;
      const auto surface = builder.require(builder.surfaces, row.name(field), block, row.location());
      if (!surface) return {};
      const auto& found = builder.model.surfaces[*surface];
      layers.push_back({&found, FaceProjection(builder.model, found), surface_nodes(builder.model, found)});
    }
  }
  if (layers.size() < 2)
    builder.error(block, block.location, "a weld joins at least two surfaces; name them on data lines");
  return layers.size() < 2 ? std::vector<Layer>{} : std::move(layers);
}

/// The reference node moves with the mean of the layer's nodes within the radius of influence about a place, weighted alike. Where there
/// are too few to tell a rotation, it is held to the face there: of sheets by displacements and rotations between the nodes, which
/// leaves neighbouring welds free to turn unlike; of solids by the mean of the face's nodes, weighted so that it is the place itself.
ConstraintKind held_by(const Model& model, const Layer& layer, std::int32_t reference, const FacePoint& place, double influence,
                       const std::vector<bool>& turns) {
  DistributingCoupling cloud{.reference = reference, .nodes = {}, .weights = {}};
  for (const auto node : layer.nodes)
    if (norm(subtract(model.nodes.coordinates[node], place.position)) <= influence) cloud.nodes.push_back(node);
  cloud.weights.assign(cloud.nodes.size(), 1.0);
  if (cloud.nodes.size() >= 3) return cloud;
  if (std::ranges::all_of(place.nodes, [&](std::int32_t node) { return turns[node]; }))
    return Tie{.node = reference, .others = place.nodes, .weights = place.weights, .others_turn = true, .rotations = true};
  cloud.nodes = place.nodes;
  cloud.weights.clear();
  constexpr double least = 1e-3;  // a weld at a node still has a face around it, whose rotation is its own
  for (const double weight : place.weights) cloud.weights.push_back(std::max(weight, least));
  return cloud;
}

void add_weld(Builder& builder, const Block& block, std::int32_t reference, const std::vector<Layer>& layers, double radius,
              const std::vector<bool>& turns) {
  const double influence = block.real("RADIUS OF INFLUENCE", radius), reach = block.real("SEARCH RADIUS", HUGE_VAL);
  const auto& at = builder.model.nodes.coordinates[reference];
  for (const auto& layer : layers) {
    const auto place = layer.faces.nearest(at, reach);
    if (!place)
      return builder.error(block, block.location,
                           fmt::format("the weld at node {} finds no face of {} within its SEARCH RADIUS of {:.4g}; give a greater one, or move the node",
                                       builder.model.node_name(reference), layer.surface->name, reach));
    builder.model.constraints.push_back({held_by(builder.model, layer, reference, *place, influence, turns), "*FASTENER", block.location.file, block.location.line});
  }
}

void read_fastener(Builder& builder, const Block& block) {
  const auto property = builder.fastener_radius.find(block.value("PROPERTY"));
  if (property == builder.fastener_radius.end()) {
    if (!builder.is_poisoned(block.value("PROPERTY")))
      builder.error(block, block.location, fmt::format("fastener property {} is not defined; define *FASTENER PROPERTY, NAME={}", block.value("PROPERTY"),
                                                       block.value("PROPERTY")));
    return;
  }
  std::vector<std::int32_t> references;
  if (!builder.nodes_of(block.value("REFERENCE NODE SET"), block, block.location, references)) return;
  // An empty first line leaves the direction of the projection to the faces; empty lines are no lines here.
  if (!block.lines.empty() && parse_real(Row(builder, block, block.lines[0]).text(0)))
    return builder.error(block, block.lines[0].location, "welds are projected along the normals of the faces; leave the line of the direction empty");
  const auto layers = read_layers(builder, block);
  if (layers.empty()) return;
  const auto turns = turning_nodes(builder.model);
  for (const auto reference : references) add_weld(builder, block, reference, layers, property->second, turns);
}

const RegisterKeyword property{{"FASTENER PROPERTY", Phase::definitions, Place::model, {required(name("NAME"))}, read_property}};
const RegisterKeyword fastener{{"FASTENER",
                                Phase::constraints,
                                Place::model,
                                {required(name("PROPERTY")), required(name("REFERENCE NODE SET")), name("INTERACTION NAME"),
                                 real("RADIUS OF INFLUENCE"), real("SEARCH RADIUS"), foreign("NUMBER OF LAYERS")},
                                read_fastener}};

}  // namespace

}  // namespace balocco::deck
