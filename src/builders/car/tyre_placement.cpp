#include "builders/car/tyre_placement.hpp"

#include <fmt/format.h>

#include "builders/rim_profile.hpp"
#include "builders/road_profile.hpp"
#include "builders/tyre_mesh.hpp"
#include "builders/tyre_report.hpp"

namespace balocco::car {
namespace {

struct FirstIds {
  std::int64_t node = 0, element = 0;
};

void number_last_node(std::int64_t id, Model& model) {
  const auto node = model.nodes.size() - 1;
  model.nodes.row_of_id.erase(model.nodes.id[node]);
  model.nodes.id[node] = id;
  model.nodes.row_of_id[id] = node;
}

/// Appends a copy of the tyre, moved to a wheel's place. Left and right tyres are alike, as they are when they come from one mould.
void append(const Model& tyre, const Vector& centre, const std::string& suffix, const FirstIds& first, Model& model) {
  const auto moved = [&](const Point& p) { return Point{p[0] + centre[0], p[1] + centre[1], p[2] + centre[2]}; };
  const auto first_node = model.nodes.size();
  for (std::int32_t row = 0; row < tyre.nodes.size(); ++row) {
    add_node(model, moved(tyre.nodes.coordinates[row]));
    number_last_node(first.node + row, model);
  }
  const auto first_section = static_cast<std::int32_t>(model.sections.size()),
             first_orientation = static_cast<std::int32_t>(model.orientations.size());
  for (auto orientation : tyre.orientations) {
    orientation.name += suffix;
    orientation.origin = moved(orientation.origin);
    model.orientations.push_back(orientation);
  }
  for (auto section : tyre.sections) {
    section.element_set += suffix;
    if (section.orientation >= 0) section.orientation += first_orientation;
    model.sections.push_back(section);
  }
  std::vector<std::int32_t> first_row;  // by table: where this copy's elements begin
  std::vector<ElementRef> all;
  auto id = first.element;
  for (std::size_t table = 0; table < tyre.elements.size(); ++table) {
    const auto& from = tyre.elements[table];
    if (table == model.elements.size()) model.elements.push_back({.type = from.type});
    auto& to = model.elements[table];
    first_row.push_back(to.size());
    for (std::int32_t row = 0; row < from.size(); ++row) all.push_back({static_cast<std::int32_t>(table), to.size() + row});
    for (const auto node : from.connectivity) to.connectivity.push_back(first_node + node);
    for (const auto section : from.section) to.section.push_back(first_section + section);
    for (std::int32_t row = 0; row < from.size(); ++row) to.id.push_back(id++);
    to.location.insert(to.location.end(), from.location.begin(), from.location.end());
  }
  add_element_set(model, "TYRE" + suffix, std::move(all));
  for (auto set : tyre.node_sets) {
    set.name += suffix;
    for (auto& node : set.nodes) node += first_node;
    model.node_sets.push_back(set);
  }
  for (auto set : tyre.element_sets) {
    set.name += suffix;
    for (auto& element : set.elements) element.row += first_row[element.table];
    model.element_sets.push_back(set);
  }
  for (auto surface : tyre.surfaces) {
    surface.name += suffix;
    for (auto& face : surface.faces) face.element.row += first_row[face.element.table];
    model.surfaces.push_back(surface);
  }
}

std::int32_t add_surface(const std::string& name, AnalyticalSurface analytical, Model& model) {
  model.surfaces.push_back({.kind = balocco::Surface::Kind::analytical, .name = name, .analytical = std::move(analytical)});
  return static_cast<std::int32_t>(model.surfaces.size()) - 1;
}

RigidBody& add_body(const std::string& name, const Point& place, std::int64_t first_id, Model& model) {
  const auto node = add_node(model, place);
  number_last_node(first_id + node + 1, model);
  add_node_set(model, name, {node});
  RigidBody body;
  body.name = fmt::format("RIGID-{}", model.nodes.id[node]);
  body.reference_node = node;
  return model.rigid_bodies.emplace_back(body);
}

std::int32_t add_road(const RoadSpec& road, const std::string& name, const Point& foot, std::int64_t first_id, Model& model) {
  const auto row = add_surface(name + "_SURFACE", road_surface(road, foot), model);
  add_body(name, foot, first_id, model).analytical_surface = row;
  return row;
}

void add_pair(std::int32_t slave, std::int32_t master, Model& model) {
  ContactPair pair;
  pair.slave = slave;
  pair.master = master;
  pair.interaction = 0;
  model.contact_pairs.push_back(pair);
}

std::int32_t surface_row(const Model& model, const std::string& name) {
  for (std::size_t row = 0; row < model.surfaces.size(); ++row)
    if (model.surfaces[row].name == name) return static_cast<std::int32_t>(row);
  return -1;
}

/// One tyre about its wheel's centre.
struct OneTyre {
  Model model;
  TyreFacts facts;
};

OneTyre make_tyre(const TyreSpec& spec) {
  OneTyre tyre;
  const auto section = make_section(spec);
  const auto mesh = add_tyre(spec, section, tyre.model);
  auto& facts = tyre.facts;
  facts.outer_radius = section.outer_radius();
  facts.seat_shift = section.seat_shift;
  for (const auto& node : section.nodes) facts.half_width = std::max(facts.half_width, node[1]);
  for (const auto& part : tyre_masses(spec, mesh, tyre.model)) facts.mass += part.mass;
  facts.nodes = tyre.model.nodes.size();
  for (const auto& table : tyre.model.elements) facts.elements += table.size();
  return tyre;
}

/// The first so many wheels get theirs.
void place(const OneTyre& tyre, const WheelPlaces& places, std::size_t wheels, std::int64_t first_id, Model& model) {
  model.units = {"mm", "g", "ms"};
  model.materials = tyre.model.materials;
  for (std::size_t wheel = 0; wheel < wheels; ++wheel) {
    const auto behind = static_cast<std::int64_t>(wheel);
    append(tyre.model, places.centre[wheel], std::string("_") + wheel_names[wheel],
           {first_id + 1 + behind * tyre.facts.nodes, first_id + 1 + behind * tyre.facts.elements}, model);
  }
}

}  // namespace

TyreFacts add_tyres(const TyreSpec& spec, const RoadSpec& road, const WheelPlaces& places, std::int64_t first_id, Model& model) {
  const auto tyre = make_tyre(spec);
  place(tyre, places, wheel_names.size(), first_id, model);
  const auto& facts = tyre.facts;
  model.interactions.push_back({.name = "GRIP", .friction = road.friction});
  for (const auto* side : {"LEFT", "RIGHT"}) {
    const Point foot{places.centre[0][0], side[0] == 'L' ? places.centre[0][1] : places.centre[1][1],
                     places.centre[0][2] - facts.outer_radius - places.clearance};
    auto below = road;
    if (side[0] == 'R') below.pothole.depth = 0.0;  // only the left wheels go through it
    const auto master = add_road(below, std::string("ROAD_") + side, foot, first_id, model);
    for (const auto* axle : {"FRONT_", "REAR_"}) add_pair(surface_row(model, std::string("TREAD_") + axle + side), master, model);
  }
  for (std::size_t wheel = 0; wheel < wheel_names.size() && strikes_rim(spec); ++wheel) {
    const std::string name = wheel_names[wheel];
    add_pair(surface_row(model, "STRIKE_" + name), add_surface("RIM_" + name, rim_surface(spec, places.centre[wheel].component), model), model);
  }
  return facts;
}

void add_first_tyre(const TyreSpec& spec, const WheelPlaces& places, std::int64_t first_id, Model& model) {
  place(make_tyre(spec), places, 1, first_id, model);
  add_body(std::string("HUB_") + wheel_names[0], places.centre[0].component, first_id, model);
}

}  // namespace balocco::car
