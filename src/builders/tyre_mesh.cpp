#include "builders/tyre_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "builders/rim_profile.hpp"
#include "builders/tyre_lamina.hpp"
#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

constexpr std::int32_t inward_side = 1;  // SNEG of a membrane
constexpr std::int32_t outer_face = 1;   // S2 of a brick: nodes 5-8

std::string upper(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
  return name;
}

std::int32_t add_material(Model& model, Material material) {
  model.materials.push_back(std::move(material));
  return static_cast<std::int32_t>(model.materials.size()) - 1;
}

std::int32_t add_lamina(Model& model, const std::string& name, const Lamina& lamina) {
  return add_material(model, {.name = name,
                              .density = lamina.density,
                              .law = "lamina",
                              .parameters = {lamina.modulus_1, lamina.modulus_2, lamina.poisson_12, lamina.shear_12,
                                             lamina.shear_12, lamina.shear_23}});
}

std::int32_t add_rubber(Model& model, const RubberSpec& rubber) {
  return add_material(model, {.name = "RUBBER_" + upper(rubber.name),
                              .density = rubber.density,
                              .damping_alpha = rubber.damping_alpha,
                              .damping_beta = rubber.damping_beta,
                              .law = "mooney-rivlin",
                              .parameters = {rubber.c10, rubber.c01, 2.0 / rubber.bulk_modulus()}});
}

std::int32_t add_section(Model& model, Section section) {
  model.sections.push_back(std::move(section));
  return static_cast<std::int32_t>(model.sections.size()) - 1;
}

/// Composite membranes of the four regions. In model 1 the sidewall's rubber is the outermost ply.
struct MembraneSections {
  std::array<std::int32_t, region_count> line{};
  std::int32_t turn_up = -1;
};

MembraneSections add_membrane_sections(const TyreSpec& spec, const TyreSection& section, Model& model) {
  Orientation wheel{.system = Orientation::System::cylindrical, .name = "WHEEL_AXIS"};
  wheel.axes = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  model.orientations.push_back(wheel);
  std::map<std::string, std::int32_t> ply_materials;
  const auto material_of = [&](int ply, int region) {
    const auto& described = spec.plies[ply];
    const auto name = "PLY_" + upper(described.name) + (described.gathers ? "_" + upper(region_names[region]) : "");
    const auto [entry, is_new] = ply_materials.try_emplace(name, -1);
    const double ratio = mean_radius(section, static_cast<Region>(region)) / spec.crown_radius;
    if (is_new) entry->second = add_lamina(model, name, make_lamina(ply_at(described, ratio), spec));
    return entry->second;
  };
  const auto stack = [&](const std::string& element_set, const std::vector<int>& plies, int region) {
    Section membrane{.kind = Section::Kind::membrane, .element_set = element_set, .orientation = 0};
    for (const int ply : plies)
      membrane.plies.push_back({spec.plies[ply].thickness, material_of(ply, region), spec.plies[ply].angle});
    return membrane;
  };
  const auto add = [&](Section membrane) {
    membrane.thickness = 0.0;
    for (const auto& ply : membrane.plies) membrane.thickness += ply.thickness;
    return add_section(model, std::move(membrane));
  };
  MembraneSections rows;
  for (int r = 0; r < region_count; ++r) {
    auto membrane = stack("CARCASS_" + upper(region_names[r]), spec.regions[r].plies, r);
    if (static_cast<Region>(r) == Region::sidewall && spec.model == 1) {
      PlySpec rubber{.name = "sidewall_rubber", .rubber = spec.part_rubbers[static_cast<int>(SolidPart::sidewall)]};
      const auto material = add_lamina(model, "PLY_SIDEWALL_RUBBER", make_lamina(rubber, spec));
      membrane.plies.insert(membrane.plies.begin(), {section.sidewall_rubber, material, 0.0});
    }
    rows.line[r] = add(std::move(membrane));
  }
  rows.turn_up = add(stack("TURN_UP", spec.turn_up, static_cast<int>(Region::bead)));
  return rows;
}

std::array<std::int32_t, solid_part_count> add_solid_sections(const TyreSpec& spec, Model& model) {
  std::vector<std::int32_t> materials(spec.rubbers.size(), -1);
  std::array<std::int32_t, solid_part_count> rows{};
  for (int part = 0; part < solid_part_count; ++part) {
    if (static_cast<SolidPart>(part) == SolidPart::sidewall && spec.model == 1) continue;
    auto& material = materials[spec.part_rubbers[part]];
    if (material < 0) material = add_rubber(model, spec.rubbers[spec.part_rubbers[part]]);
    rows[part] =
        add_section(model, {.kind = Section::Kind::solid, .element_set = solid_part_names[part], .material = material});
  }
  return rows;
}

void add_tyre_nodes(const TyreSection& section, const TyreMesh& mesh, Model& model) {
  std::vector<std::int32_t> all;
  for (const double angle : mesh.angles)
    for (const auto& [radius, axial] : section.nodes)
      all.push_back(add_node(model, {radius * std::sin(angle), axial, -radius * std::cos(angle)}));
  add_node_set(model, "TYRE", all);
}

/// Corners of a membrane between two section nodes: across the tyre first, then forwards, so that the normal points
/// outwards.
std::vector<std::int32_t> quadrilateral(const TyreMesh& mesh, int sector, int right, int left) {
  return {mesh.node(sector, right), mesh.node(sector, left), mesh.node(sector + 1, left), mesh.node(sector + 1, right)};
}

/// The folded-back plies lie on the outside of the apex.
void add_turn_up(const TyreSection& section, std::int32_t section_row, Model& model, const TyreMesh& mesh) {
  std::vector<ElementRef> elements;
  for (int sector = 0; sector < mesh.sectors(); ++sector)
    for (const auto& quad : section.quads)
      if (quad.part == SolidPart::apex)
        elements.push_back(
            {mesh.membranes, add_element(model, mesh.membranes,
                                         quadrilateral(mesh, sector, quad.nodes[3], quad.nodes[2]), section_row)});
  add_element_set(model, "TURN_UP", std::move(elements));
}

void add_membranes(const TyreSpec& spec, const TyreSection& section, Model& model, TyreMesh& mesh) {
  const auto sections = add_membrane_sections(spec, section, model);
  mesh.membranes = add_element_table(model, spec.membrane_type);
  std::array<std::vector<ElementRef>, region_count> sets;
  std::vector<ElementRef> all;
  Surface liner{.kind = Surface::Kind::element_faces, .name = "LINER"}, strike{.kind = Surface::Kind::element_faces, .name = "STRIKE"};
  const auto may_strike = [&](int node) { return strikes_rim(spec) && section.nodes[node][0] > strike_radius(spec); };
  const auto& line = section.layers[0];
  for (int sector = 0; sector < mesh.sectors(); ++sector) {
    for (std::size_t j = 0; j < section.line_regions.size(); ++j) {
      const int region = static_cast<int>(section.line_regions[j]);
      const auto nodes = quadrilateral(mesh, sector, line[j], line[j + 1]);
      const ElementRef element{mesh.membranes, add_element(model, mesh.membranes, nodes, sections.line[region])};
      sets[region].push_back(element);
      all.push_back(element);
      liner.faces.push_back({element, inward_side});
      if (may_strike(line[j]) && may_strike(line[j + 1])) strike.faces.push_back({element, inward_side});
    }
  }
  add_element_set(model, "BELT", sets[static_cast<int>(Region::belt)]);
  for (int r = 0; r < region_count; ++r)
    add_element_set(model, model.sections[sections.line[r]].element_set, std::move(sets[r]));
  add_turn_up(section, sections.turn_up, model, mesh);
  add_element_set(model, "CARCASS", std::move(all));
  mesh.liner_surface = static_cast<std::int32_t>(model.surfaces.size());
  model.surfaces.push_back(std::move(liner));
  if (strike.faces.empty()) return;
  mesh.strike_surface = static_cast<std::int32_t>(model.surfaces.size());
  model.surfaces.push_back(std::move(strike));
}

void add_solids(const TyreSpec& spec, const TyreSection& section, Model& model, TyreMesh& mesh) {
  const auto sections = add_solid_sections(spec, model);
  mesh.solids = add_element_table(model, spec.solid_type);
  std::array<std::vector<ElementRef>, solid_part_count> sets;
  std::vector<ElementRef> tread, bead;
  Surface contact{.kind = Surface::Kind::element_faces, .name = "TREAD"};
  for (int sector = 0; sector < mesh.sectors(); ++sector) {
    for (const auto& quad : section.quads) {
      const auto [a, b, c, d] = quad.nodes;
      const auto near = [&](int node) { return mesh.node(sector, node); };
      const auto far = [&](int node) { return mesh.node(sector + 1, node); };
      const std::vector<std::int32_t> nodes{near(a), near(b), far(b), far(a), near(d), near(c), far(c), far(d)};
      const int part = static_cast<int>(quad.part);
      const ElementRef element{mesh.solids, add_element(model, mesh.solids, nodes, sections[part])};
      sets[part].push_back(element);
      if (quad.part == SolidPart::tread_cap && quad.outermost) contact.faces.push_back({element, outer_face});
      if (quad.part == SolidPart::tread_cap || quad.part == SolidPart::tread_base) tread.push_back(element);
      if (quad.part == SolidPart::apex || quad.part == SolidPart::rim_strip) bead.push_back(element);
    }
  }
  for (int part = 0; part < solid_part_count; ++part)
    if (!sets[part].empty()) add_element_set(model, solid_part_names[part], std::move(sets[part]));
  add_element_set(model, "TREAD_SOLID", std::move(tread));
  add_element_set(model, "BEAD_SOLID", std::move(bead));
  mesh.tread_surface = static_cast<std::int32_t>(model.surfaces.size());
  model.surfaces.push_back(std::move(contact));
}

void add_bead_wires(const TyreSpec& spec, const TyreSection& section, Model& model, TyreMesh& mesh) {
  const auto steel = add_material(model, {.name = "BEAD_STEEL",
                                          .density = spec.bead.density,
                                          .law = "elastic",
                                          .parameters = {spec.bead.modulus, spec.bead.poisson}});
  const double share = 2.0 * spec.bead.area / static_cast<double>(section.wire_nodes.size());
  const auto row =
      add_section(model, {.kind = Section::Kind::truss, .element_set = "BEAD_WIRE", .material = steel, .area = share});
  mesh.wires = add_element_table(model, "T3D2");
  std::vector<ElementRef> wires;
  for (const int node : section.wire_nodes)
    for (int sector = 0; sector < mesh.sectors(); ++sector)
      wires.push_back(
          {mesh.wires, add_element(model, mesh.wires, {mesh.node(sector, node), mesh.node(sector + 1, node)}, row)});
  add_element_set(model, "BEAD_WIRE", std::move(wires));
}

/// Sets on the rim, and single nodes at the top of the wheel from which the growth of section and diameter is read.
void add_tyre_node_sets(const TyreSection& section, const TyreMesh& mesh, Model& model) {
  const auto around = [&](const std::vector<int>& section_nodes) {
    std::vector<std::int32_t> rows;
    for (int sector = 0; sector < mesh.sectors(); ++sector)
      for (const int node : section_nodes) rows.push_back(mesh.node(sector, node));
    return rows;
  };
  add_node_set(model, "BEAD_LEFT", around(section.bead_left));
  add_node_set(model, "BEAD_RIGHT", around(section.bead_right));
  int top = 0;
  for (int sector = 0; sector < mesh.sectors(); ++sector)
    if (std::cos(mesh.angles[sector]) < std::cos(mesh.angles[top])) top = sector;
  const auto greatest = [&](auto measure) {
    int best = 0;
    for (std::size_t i = 1; i < section.nodes.size(); ++i)
      if (measure(section.nodes[i]) > measure(section.nodes[best])) best = static_cast<int>(i);
    return mesh.node(top, best);
  };
  add_node_set(model, "CROWN_TOP", {greatest([](const auto& node) { return node[0]; })});
  add_node_set(model, "SIDE_LEFT", {greatest([](const auto& node) { return node[1]; })});
  add_node_set(model, "SIDE_RIGHT", {greatest([](const auto& node) { return -node[1]; })});
}

}  // namespace

std::vector<double> sector_angles(const TyreSpec& spec) {
  constexpr double turn = 2.0 * std::numbers::pi;
  std::vector<double> angles;
  if (spec.model < 3) {
    for (int i = 0; i < spec.mesh.sectors; ++i) angles.push_back(turn * i / spec.mesh.sectors);
    return angles;
  }
  const auto& mesh = spec.mesh;
  const int coarse = std::max(1, static_cast<int>(std::lround(mesh.sectors * (turn - mesh.arc_angle) / turn)));
  const double start = mesh.arc_center - 0.5 * mesh.arc_angle;
  for (int i = 0; i < mesh.arc_sectors; ++i) angles.push_back(start + mesh.arc_angle * i / mesh.arc_sectors);
  for (int i = 0; i < coarse; ++i) angles.push_back(start + mesh.arc_angle + (turn - mesh.arc_angle) * i / coarse);
  return angles;
}

TyreMesh add_tyre(const TyreSpec& spec, const TyreSection& section, Model& model) {
  TyreMesh mesh;
  mesh.angles = sector_angles(spec);
  mesh.nodes_per_meridian = static_cast<std::int32_t>(section.nodes.size());
  add_tyre_nodes(section, mesh, model);
  add_membranes(spec, section, model, mesh);
  add_solids(spec, section, model, mesh);
  add_bead_wires(spec, section, model, mesh);
  add_tyre_node_sets(section, mesh, model);
  return mesh;
}

std::int32_t add_element_table(Model& model, const std::string& type_name) {
  const auto* type = find_element_type(type_name);
  if (type == nullptr) throw SystemError(fmt::format("element type {} is not registered", type_name));
  model.elements.push_back({.type = type});
  return static_cast<std::int32_t>(model.elements.size()) - 1;
}

std::int32_t add_element(Model& model, std::int32_t table, const std::vector<std::int32_t>& nodes,
                         std::int32_t section) {
  std::int64_t id = 1;
  for (const auto& other : model.elements) id += other.size();
  auto& elements = model.elements[table];
  elements.id.push_back(id);
  elements.connectivity.insert(elements.connectivity.end(), nodes.begin(), nodes.end());
  elements.section.push_back(section);
  elements.location.push_back({});
  return elements.size() - 1;
}

std::int32_t add_node(Model& model, const Point& coordinates) {
  const auto row = model.nodes.size();
  model.nodes.id.push_back(row + 1);
  model.nodes.coordinates.push_back(coordinates);
  model.nodes.location.push_back({});
  model.nodes.row_of_id[row + 1] = row;
  return row;
}

void add_node_set(Model& model, const std::string& name, std::vector<std::int32_t> nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  model.node_sets.push_back({name, std::move(nodes)});
}

void add_element_set(Model& model, const std::string& name, std::vector<ElementRef> elements) {
  std::sort(elements.begin(), elements.end());
  model.element_sets.push_back({name, std::move(elements)});
}

}  // namespace balocco
