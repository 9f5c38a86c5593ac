// *SURFACE of element faces, of nodes, and analytical.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/groups.hpp"
#include "deck/profile.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

/// Sorted nodes of a face, three or four, to recognise the same face from its other side.
using FaceKey = std::array<std::int32_t, 4>;

FaceKey key_of(const ElementTable& table, std::int32_t row, const std::vector<int>& face) {
  FaceKey key{-1, -1, -1, -1};
  for (std::size_t i = 0; i < face.size() && i < key.size(); ++i)
    key[i] = table.connectivity[row * table.type->nodes + face[i]];
  std::sort(key.begin(), key.end());
  return key;
}

bool is_solid(const ElementType& type) {
  return type.section == Section::Kind::solid;
}

/// All faces of solid elements in the model, sorted: one that occurs twice is inside the body.
const std::vector<FaceKey>& solid_faces(Builder& builder) {
  auto& faces = builder.sorted_solid_faces;
  if (faces.empty()) {
    for (const auto& table : builder.model.elements) {
      if (!is_solid(*table.type)) continue;
      for (std::int32_t row = 0; row < table.size(); ++row) {
        for (const auto& face : table.type->faces) faces.push_back(key_of(table, row, face));
      }
    }
    std::sort(faces.begin(), faces.end());
  }
  return faces;
}

/// Faces of solids that no other solid shares; the positive side of membranes.
void add_free_faces(Builder& builder, const std::vector<ElementRef>& elements, Surface& surface) {
  for (const auto element : elements) {
    const auto& table = builder.model.elements[element.table];
    if (!is_solid(*table.type)) {
      if (!table.type->faces.empty()) surface.faces.push_back({element, 0});
      continue;
    }
    const auto& all = solid_faces(builder);
    for (std::size_t face = 0; face < table.type->faces.size(); ++face) {
      const auto [first, last] =
          std::equal_range(all.begin(), all.end(), key_of(table, element.row, table.type->faces[face]));
      if (last - first == 1) surface.faces.push_back({element, static_cast<std::int32_t>(face)});
    }
  }
}

void sort_nodes(std::vector<std::int32_t>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

void read_element_faces(Builder& builder, const Block& block, Surface& surface) {
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    row.at_most(2);
    std::vector<ElementRef> elements;
    if (!row.ok() || !builder.elements_of(row.text(0), block, line.location, elements)) continue;
    if (!row.has(1)) {
      add_free_faces(builder, elements, surface);
      continue;
    }
    for (const auto element : elements) {
      const ElementType& type = *builder.model.elements[element.table].type;
      if (const int edge = edge_of_label(type, row.name(1)); edge >= 0) {
        surface.edges.push_back({element, edge});
        continue;
      }
      const int face = face_of_label(type, row.name(1));
      if (face < 0) {
        row.error(fmt::format("element {} of type {} has no face {}; {}", builder.model.element_name(element), type.name,
                              row.name(1),
                              is_solid(type)       ? fmt::format("it has S1 to S{}", type.faces.size())
                              : type.faces.empty() ? "it has no faces"
                                                   : "it has SPOS and SNEG, and edges E1 ..."));
        break;
      }
      surface.faces.push_back({element, face});
    }
  }
  if (!surface.edges.empty() && !surface.faces.empty())
    builder.error(block, block.location, "a surface is made of faces or of edges E1 to E4, not of both; make two of it");
  settle_edges(builder.model, surface);
  if (surface.faces.empty() && surface.edges.empty() && !builder.elements_incomplete && !builder.is_poisoned(block.value("NAME"))) {
    builder.error(block, block.location,
                  "the surface has no faces; name element sets that have free faces, or a face label");
  }
}

void read_nodes_of_surface(Builder& builder, const Block& block, Surface& surface) {
  surface.kind = Surface::Kind::nodes;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    if (row.has(1) && row.real(1, "area of a node") != 1.0)  // the default, which Abaqus/CAE writes out
      row.error("areas of node-based surfaces are not supported; they are found from the mesh: remove field 2");
    row.at_most(2);
    if (row.ok()) builder.nodes_of(row.text(0), block, line.location, surface.nodes);
  }
  sort_nodes(surface.nodes);
}

/// Local axes of an extruded profile: a the origin, b on the first axis, c on the generator, which is the NEGATIVE
/// third axis.
bool read_extruded_axes(Builder& builder, const Block& block, AnalyticalSurface& surface) {
  Row first(builder, block, block.lines[0]), second(builder, block, block.lines[1]);
  const Point a = first.point(0, "point a"), b = first.point(3, "point b"), c = second.point(0, "point c");
  first.at_most(6);
  second.at_most(3);
  if (!first.ok() || !second.ok()) return false;
  const auto axes = axes_of_points(a, b, c);
  if (!axes) {
    first.error("points a, b and c lie on a line; b gives the first axis of the profile, c the generator");
    return false;
  }
  surface.origin = a;
  const auto& [x, generator, normal] = *axes;  // normal = x cross generator = second axis of the profile
  surface.axes = {x, normal, {-generator[0], -generator[1], -generator[2]}};
  return true;
}

bool read_revolved_axes(Builder& builder, const Block& block, AnalyticalSurface& surface) {
  Row row(builder, block, block.lines[0]);
  const Point a = row.point(0, "point a"), b = row.point(3, "point b");
  row.at_most(6);
  Point axis = subtract(b, a);
  const double size = norm(axis);
  if (row.ok() && !(size > 0.0)) row.error("points a and b of the axis coincide; correct them");
  if (!row.ok()) return false;
  for (double& component : axis) component /= size;
  const auto [first, second, third] = axes_about(axis);
  surface.origin = a;
  surface.axes = {second, axis, first};  // second x third = first axis of a right-handed triad (first, second, axis)
  return true;
}

void read_analytical(Builder& builder, const Block& block, Surface& surface) {
  surface.kind = Surface::Kind::analytical;
  const std::string type = block.value("TYPE");
  AnalyticalSurface analytical;
  analytical.kind = type == "REVOLUTION" ? AnalyticalSurface::Kind::revolved : AnalyticalSurface::Kind::extruded;
  analytical.axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const bool local = block.lines.empty() || upper(block.lines[0].text).starts_with("START");  // inside a part
  std::size_t axis_lines = 0;
  if (!local && type != "SEGMENTS") axis_lines = type == "CYLINDER" ? 2 : 1;
  if (block.lines.size() <= axis_lines)
    return builder.error(block, block.location, "the profile is missing; add START and LINE or CIRCL lines");
  if (axis_lines == 2 && !read_extruded_axes(builder, block, analytical)) return;
  if (axis_lines == 1 && !read_revolved_axes(builder, block, analytical)) return;
  analytical.profile = read_profile(builder, block, std::span(block.lines).subspan(axis_lines));
  if (analytical.profile.empty()) return;
  try {
    analytical.profile = round_corners(analytical.profile, block.real("FILLET RADIUS", 0.0));
  } catch (const std::invalid_argument& trouble) {
    return builder.error(
        block, block.location,
        fmt::format("FILLET RADIUS {}: {}; give a smaller radius", block.value("FILLET RADIUS"), trouble.what()));
  }
  analytical.origin = builder.scope->place(analytical.origin);
  for (auto& axis : analytical.axes) axis = builder.scope->turn(axis);
  surface.analytical = std::move(analytical);
}

void read_surface(Builder& builder, const Block& block) {
  Surface surface;
  surface.location = block.location;
  const auto full = builder.define(builder.surfaces, block.value("NAME"),
                                   static_cast<std::int32_t>(builder.model.surfaces.size()), block);
  if (!full) return;
  surface.name = *full;
  const std::string type = block.value("TYPE", "ELEMENT");
  if (type == "ELEMENT" || type == "NODE") {
    if (block.has("FILLET RADIUS"))
      builder.error(block, block.location, "FILLET RADIUS belongs to analytical surfaces; remove it");
    type == "NODE" ? read_nodes_of_surface(builder, block, surface) : read_element_faces(builder, block, surface);
  } else {
    read_analytical(builder, block, surface);
  }
  builder.model.surfaces.push_back(std::move(surface));
}

const RegisterKeyword surface{
    {"SURFACE",
     Phase::surfaces,
     Place::anywhere,
     {required(name("NAME")), choice("TYPE", {"ELEMENT", "NODE", "CYLINDER", "REVOLUTION", "SEGMENTS"}),
      real("FILLET RADIUS"), flag("INTERNAL")},
     read_surface}};

}  // namespace

void settle_edges(const Model& model, Surface& surface) {
  if (surface.edges.empty()) return;
  surface.kind = Surface::Kind::nodes;
  for (const auto& [element, edge] : surface.edges) {
    const ElementTable& table = model.elements[element.table];
    const int count = table.type->nodes;
    for (const int local : {edge, (edge + 1) % count}) surface.nodes.push_back(table.connectivity[element.row * count + local]);
  }
  sort_nodes(surface.nodes);
}

int edge_of_label(const ElementType& type, std::string_view label) {
  const bool sheet = type.section == Section::Kind::shell || type.section == Section::Kind::membrane;
  const int edge = label.size() == 2 && label[0] == 'E' ? label[1] - '1' : -1;
  return sheet && edge < type.nodes ? edge : -1;
}

int face_of_label(const ElementType& type, std::string_view label) {
  const auto count = static_cast<int>(type.faces.size());
  if (type.section == Section::Kind::membrane || type.section == Section::Kind::shell || type.section == Section::Kind::rigid) {
    if (label == "SPOS" && count > 0) return 0;
    return label == "SNEG" && count > 1 ? 1 : -1;
  }
  if (!is_solid(type) || label.size() != 2 || label[0] != 'S') return -1;
  const int face = label[1] - '1';
  return face >= 0 && face < count ? face : -1;
}

}  // namespace balocco::deck
