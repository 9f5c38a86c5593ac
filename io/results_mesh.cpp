#include "results_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/element_type.hpp"
#include "results_index.hpp"

namespace balocco {

namespace {

constexpr std::int64_t results_version = 1;

const char* word(Section::Kind kind) {
  switch (kind) {
    case Section::Kind::solid: return "solid";
    case Section::Kind::membrane: return "membrane";
    case Section::Kind::shell: return "shell";
    case Section::Kind::truss: return "truss";
    case Section::Kind::beam: return "beam";
    case Section::Kind::mass: return "mass";
    case Section::Kind::rotary_inertia: return "rotary inertia";
    case Section::Kind::spring: return "spring";
    case Section::Kind::dashpot: return "dashpot";
    case Section::Kind::connector: return "connector";
    case Section::Kind::rigid: return "rigid";
  }
  return "";
}

template <class T, std::size_t N>
std::vector<T> flat(const std::vector<std::array<T, N>>& rows) {
  std::vector<T> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

/// What the deck calls the rows of a table: the instance of a part (index in /mesh/instance) and the id there.
void write_origin(const Hdf5File& file, const Model& model, const std::string& group, const std::vector<std::int32_t>& instance,
                  const std::vector<std::int64_t>& id, std::int64_t Instance::*offset) {
  if (instance.empty()) return;
  std::vector<std::int64_t> part_id;
  for (std::size_t row = 0; row < id.size(); ++row)
    part_id.push_back(id[row] - model.instances[instance[row]].*offset);
  file.write(group + "/instance", {id.size()}, instance);
  file.write(group + "/part_id", {id.size()}, part_id);
}

void write_instances(const Hdf5File& file, const Model& model) {
  if (model.instances.empty()) return;
  file.create_group("/mesh/instance");
  for (std::size_t i = 0; i < model.instances.size(); ++i) {
    const std::string group = fmt::format("/mesh/instance/{}", i);
    file.create_group(group);
    file.set_attribute(group, "name", model.instances[i].name);
    file.set_attribute(group, "part", model.instances[i].part);
  }
}

void write_mesh_tables(const Hdf5File& file, const Model& model) {
  const auto nodes = static_cast<hsize_t>(model.nodes.size());
  file.create_group("/mesh/node");
  file.write("/mesh/node/id", {nodes}, model.nodes.id);
  file.write("/mesh/node/coordinates", {nodes, 3}, flat(model.nodes.coordinates));
  write_origin(file, model, "/mesh/node", model.nodes.instance, model.nodes.id, &Instance::node_offset);
  file.create_group("/mesh/element");
  for (const ElementTable& table : model.elements) {
    if (table.size() == 0) continue;
    const std::string group = "/mesh/element/" + table.type->name;
    const auto rows = static_cast<hsize_t>(table.size());
    file.create_group(group);
    file.write(group + "/id", {rows}, table.id);
    file.write(group + "/connectivity", {rows, static_cast<hsize_t>(table.type->nodes)}, table.connectivity);
    file.write(group + "/part", {rows}, table.section);
    write_origin(file, model, group, table.instance, table.id, &Instance::element_offset);
  }
}

void write_parts(const Hdf5File& file, const Model& model) {
  file.create_group("/mesh/part");
  for (std::size_t i = 0; i < model.sections.size(); ++i) {
    const Section& section = model.sections[i];
    const std::string part = fmt::format("/mesh/part/{}", i);
    std::string material = section.plies.empty() ? "" : "composite";
    if (section.material >= 0) material = model.materials[section.material].name;
    file.create_group(part);
    file.set_attribute(part, "name", section.element_set);
    file.set_attribute(part, "material", material);
    file.set_attribute(part, "section", std::string(word(section.kind)));
  }
}

void write_sets(const Hdf5File& file, const Model& model) {
  file.create_group("/mesh/set/node");
  for (const NodeSet& set : model.node_sets) {
    file.write("/mesh/set/node/" + hdf5_name(set.name), {set.nodes.size()}, set.nodes);
  }
  file.create_group("/mesh/set/element");
  for (const ElementSet& set : model.element_sets) {
    const std::string group = "/mesh/set/element/" + hdf5_name(set.name);
    file.create_group(group);
    for (std::int32_t table = 0; table < static_cast<std::int32_t>(model.elements.size()); ++table) {
      std::vector<std::int32_t> rows;
      for (const ElementRef& element : set.elements) {
        if (element.table == table) rows.push_back(element.row);
      }
      if (!rows.empty()) file.write(group + "/" + model.elements[table].type->name, {rows.size()}, rows);
    }
  }
}

/// Points along a segment behind its start; arcs in steps of at most 5 degrees.
void append_points(const ProfileSegment& segment, std::vector<std::array<double, 2>>& points) {
  if (segment.kind == ProfileSegment::Kind::arc) {
    const auto angle = [&](const std::array<double, 2>& p) { return std::atan2(p[1] - segment.centre[1], p[0] - segment.centre[0]); };
    const double radius = std::hypot(segment.start[0] - segment.centre[0], segment.start[1] - segment.centre[1]);
    const double first = angle(segment.start);
    double sweep = angle(segment.end) - first;
    if (segment.counter_clockwise && sweep <= 0.0) sweep += 2.0 * std::numbers::pi;
    if (!segment.counter_clockwise && sweep >= 0.0) sweep -= 2.0 * std::numbers::pi;
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / (std::numbers::pi / 36.0))));
    for (int i = 1; i < pieces; ++i) {
      const double a = first + sweep * i / pieces;
      points.push_back({segment.centre[0] + radius * std::cos(a), segment.centre[1] + radius * std::sin(a)});
    }
  }
  points.push_back(segment.end);
}

/// Analytical surfaces, to be drawn: profile points in the plane of the first two axes, and the body that carries them.
void write_surfaces(const Hdf5File& file, const Model& model) {
  file.create_group("/mesh/analytical_surface");
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    const auto& surface = model.surfaces[s].analytical;
    if (!surface || surface->profile.empty()) continue;
    std::vector<std::array<double, 2>> points{surface->profile.front().start};
    for (const ProfileSegment& segment : surface->profile) append_points(segment, points);
    const std::string group = "/mesh/analytical_surface/" + hdf5_name(model.surfaces[s].name);
    file.create_group(group);
    const bool revolved = surface->kind == AnalyticalSurface::Kind::revolved;
    file.set_attribute(group, "kind", std::string(revolved ? "revolved" : "extruded"));
    for (const RigidBody& body : model.rigid_bodies) {
      if (body.analytical_surface != static_cast<std::int32_t>(s)) continue;
      file.set_attribute(group, "reference_node", model.nodes.id[body.reference_node]);
    }
    file.write(group + "/profile", {points.size(), 2}, flat(points));
    file.write(group + "/origin", {3}, surface->origin);
    file.write(group + "/axes", {3, 3}, flat(std::vector<Point>(surface->axes.begin(), surface->axes.end())));
  }
}

}  // namespace

void write_mesh(const Hdf5File& file, const Model& model) {
  file.set_attribute("/", "format", std::string("balocco"));
  file.set_attribute("/", "format_version", results_version);
  file.set_attribute("/", "code_version", std::string(BALOCCO_VERSION));
  file.set_attribute("/", "deck_sha256", model.deck_sha256);
  file.set_attribute("/", "name", model.name);
  file.set_attribute("/", "heading", model.heading);
  const Units& units = model.units;
  file.set_attribute("/", "units", units.length.empty() ? "" : fmt::format("{} {} {}", units.length, units.mass, units.time));
  file.create_group("/mesh");
  write_instances(file, model);
  write_mesh_tables(file, model);
  write_parts(file, model);
  write_sets(file, model);
  write_surfaces(file, model);
}

}  // namespace balocco
