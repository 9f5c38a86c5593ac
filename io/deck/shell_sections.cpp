// *SHELL SECTION *SHELL GENERAL SECTION *NODAL THICKNESS *NORMAL.
#include "deck/shell_sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "deck/register.hpp"
#include "deck/section_assignment.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"
#include "elements/shells/shell_normals.hpp"

namespace balocco::deck {

namespace {

constexpr int most_points = 15;

/// OFFSET: a fraction of the thickness from the middle surface to the nodes, or the side that the nodes lie on.
bool read_offset(Builder& builder, const Block& block, ShellOptions& shell) {
  const std::string text = block.value("OFFSET", "0");
  if (text == "SPOS" || text == "SNEG") {
    shell.offset = text == "SPOS" ? 0.5 : -0.5;
    return true;
  }
  const auto value = parse_real(text);
  if (value)
    shell.offset = *value;
  else
    builder.error(block, block.location,
                  fmt::format("OFFSET={} is no number; write SPOS, SNEG or a fraction of the thickness", text));
  return value.has_value();
}

/// Integration points through a thickness, checked.
int points_of(Row& row, int field, int otherwise, bool gauss) {
  const auto points = row.integer_or(field, otherwise, "number of integration points");
  const bool good =
      gauss ? points >= 2 && points <= most_points : points >= 3 && points <= most_points && points % 2 == 1;
  if (row.ok() && !good) {
    row.error(fmt::format("{} integration points through the thickness; {}", points,
                          gauss
                              ? "Gauss's rule takes 2 to 15"
                              : "Simpson's rule takes an odd number from 3 to 15 (or say SECTION INTEGRATION=GAUSS)"));
  }
  return static_cast<int>(points);
}

void check_thickness(Row& row, double thickness) {
  if (row.ok() && !(thickness > 0.0)) row.error(fmt::format("thickness {} must be positive; correct it", thickness));
}

/// Lines "thickness, points, material, angle", from SNEG to SPOS.
bool read_shell_plies(Builder& builder, const Block& block, Section& section) {
  if (block.has("MATERIAL")) {
    builder.error(block, block.location, "a composite names its materials on the data lines; remove MATERIAL");
    return false;
  }
  section.thickness = 0.0;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    Ply ply;
    ply.thickness = row.real(0, "thickness of the ply");
    check_thickness(row, ply.thickness);
    ply.points = points_of(row, 1, 3, section.shell.gauss);
    if (row.has(3) && row.ok() && !parse_real(row.text(3)))
      row.error(fmt::format("'{}' is no angle; write the ply's angle in degrees from the section's ORIENTATION",
                            row.text(3)));
    if (row.ok()) ply.angle = row.real_or(3, 0.0, "angle in degrees") * std::numbers::pi / 180.0;
    row.at_most(5);  // the fifth is the ply's name
    if (!row.ok()) return false;
    const auto material = builder.require(builder.materials, row.name(2), block, line.location);
    if (!material) return false;
    ply.material = *material;
    section.thickness += ply.thickness;
    section.plies.push_back(ply);
  }
  if (section.plies.empty())
    builder.error(block, block.location, "it has no plies; add lines thickness, points, material, angle");
  return !section.plies.empty();
}

/// SHELL THICKNESS, where it is said: a *DISTRIBUTION of lengths gives each element its own; the section has their mean, to which all else
/// of it relates. @return false, told, where an element has none
bool read_distributed_thickness(Builder& builder, const Block& block, Section& section, const std::vector<ElementRef>& elements) {
  if (!block.has("SHELL THICKNESS")) return true;
  const std::string name = block.value("SHELL THICKNESS");
  const auto place = builder.require(builder.distributions, name, block, block.location);
  if (!place) return false;
  const auto& distribution = builder.distribution[*place];
  const auto refuse = [&](const std::string& text) {
    builder.error(block, block.location, text);
    return false;
  };
  if (!distribution.of_lengths) return refuse(fmt::format("distribution {} has directions; name one whose table is LENGTH", name));
  if (!section.shell.stiffness.empty()) return refuse("stiffnesses that are given hold for one thickness; name a MATERIAL or plies, or leave SHELL THICKNESS out");
  if (block.has("NODAL THICKNESS")) return refuse("NODAL THICKNESS and SHELL THICKNESS both give thicknesses; keep one of them");
  double sum = 0.0;
  for (const auto element : elements) {
    const auto length = distribution.lengths.of(element);
    if (!length)
      return refuse(fmt::format("distribution {} gives element {} no thickness; name it there, or give a line with an empty first field for all others",
                                name, builder.model.element_name(element)));
    auto& table = builder.model.elements[element.table];
    table.thickness.resize(table.id.size(), 0.0);
    table.thickness[element.row] = *length;
    sum += *length;
  }
  const double mean = sum / static_cast<double>(elements.size());
  for (auto& ply : section.plies) ply.thickness *= mean / section.thickness;  // parts of the whole
  section.thickness = mean;
  return true;
}

/// "thickness, points" of a homogeneous section.
bool read_thickness(Builder& builder, const Block& block, Section& section, bool with_points) {
  if (block.lines.empty() && block.has("SHELL THICKNESS")) return true;
  if (block.lines.empty()) {
    builder.error(block, block.location, "the thickness is missing; add a data line");
    return false;
  }
  Row row(builder, block, block.lines[0]);
  const bool distributed = block.has("SHELL THICKNESS");
  section.thickness = distributed ? row.real_or(0, 1.0, "thickness") : row.real(0, "thickness");
  check_thickness(row, section.thickness);
  if (with_points) section.shell.points = points_of(row, 1, 5, section.shell.gauss);
  row.at_most(with_points ? 2 : 1);
  return row.ok();
}

/// What both keywords share.
std::optional<Section> begin(Builder& builder, const Block& block, std::vector<ElementRef>& elements) {
  auto section = begin_section(builder, block, elements);
  if (!section || !read_offset(builder, block, section->shell)) return std::nullopt;
  section->kind = Section::Kind::shell;
  section->shell.nodal_thickness = block.has("NODAL THICKNESS");
  section->shell.mass_per_area = block.real("DENSITY", 0.0);
  if (section->shell.mass_per_area < 0.0) {
    builder.error(block, block.location, "DENSITY is mass per area and must not be negative; correct it");
    return std::nullopt;
  }
  return section;
}

void read_shell_section(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin(builder, block, elements);
  if (!section) return;
  section->shell.gauss = block.value("SECTION INTEGRATION") == "GAUSS";
  const bool good = block.has("COMPOSITE")
                        ? read_shell_plies(builder, block, *section)
                        : need_material(builder, block) && read_thickness(builder, block, *section, true);
  if (good && read_distributed_thickness(builder, block, *section, elements)) assign_section(builder, block, *std::move(section), elements);
}

/// The 21 constants, 8 a line, and the thickness for which they hold: what *TRANSVERSE SHEAR STIFFNESS and contact ask
/// for.
bool read_constants(Builder& builder, const Block& block, Section& section) {
  constexpr std::size_t count = 21;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field) section.shell.stiffness.push_back(row.real(field, "stiffness"));
    if (!row.ok()) return false;
  }
  if (section.shell.stiffness.size() == count) {
    // A homogeneous sheet of the same membrane and bending stiffness has this thickness; only mass and output ask for
    // it.
    section.thickness = std::sqrt(12.0 * section.shell.stiffness[9] / section.shell.stiffness[0]);
    if (section.thickness > 0.0) return true;
    builder.error(block, block.location, "D11 and D44 must be positive; correct the constants");
    return false;
  }
  builder.error(
      block, block.location,
      fmt::format("it has {} constants; give D11, D12, D22, D13, ... D66, 21 in all, or MATERIAL and a thickness",
                  section.shell.stiffness.size()));
  return false;
}

void read_general_shell_section(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin(builder, block, elements);
  if (!section) return;
  section->shell.general = true;
  const bool good = block.has("COMPOSITE")  ? read_shell_plies(builder, block, *section)
                    : block.has("MATERIAL") ? read_thickness(builder, block, *section, false)
                                            : read_constants(builder, block, *section);
  if (good && read_distributed_thickness(builder, block, *section, elements)) assign_section(builder, block, *std::move(section), elements);
}

void read_nodal_thickness(Builder& builder, const Block& block) {
  auto& thickness = builder.model.nodes.thickness;
  thickness.resize(builder.model.nodes.size(), 0.0);
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    std::vector<std::int32_t> nodes;
    const bool known = builder.nodes_of(row.text(0), block, line.location, nodes);
    const double value = row.real(1, "thickness");
    row.at_most(2);
    check_thickness(row, value);
    if (row.ok() && known)
      for (const auto node : nodes) thickness[node] = value;
  }
}

/// Lines "element or set, node or set, n1, n2, n3".
void read_normals(Builder& builder, const Block& block) {
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    std::vector<ElementRef> elements;
    std::vector<std::int32_t> nodes;
    const bool known = builder.elements_of(row.text(0), block, line.location, elements) &
                       builder.nodes_of(row.text(1), block, line.location, nodes);
    Point normal{};
    for (int c = 0; c < 3; ++c) normal[c] = row.real_or(2 + c, 0.0, "component of the normal");
    row.at_most(5);
    const double size = std::hypot(normal[0], normal[1], normal[2]);
    if (row.ok() && !(size > 0.0)) row.error("the normal has no length; give its direction");
    if (!row.ok() || !known) continue;
    for (double& component : normal) component /= size;
    for (const auto element : elements)
      for (const auto node : nodes) builder.normals.at_corner[{element, node}] = builder.scope->turn(normal);
  }
}

const RegisterKeyword shell_section{
    {"SHELL SECTION",
     Phase::sections,
     Place::model,
     {required(name("ELSET")), name("MATERIAL"), name("ORIENTATION"), name("CONTROLS"), flag("COMPOSITE"),
      name("OFFSET"), flag("NODAL THICKNESS"), name("SHELL THICKNESS"), choice("SECTION INTEGRATION", {"SIMPSON", "GAUSS"}), real("DENSITY")},
     read_shell_section}};
const RegisterKeyword general_section{{"SHELL GENERAL SECTION",
                                       Phase::sections,
                                       Place::model,
                                       {required(name("ELSET")), name("MATERIAL"), name("ORIENTATION"), name("CONTROLS"),
                                        flag("COMPOSITE"), name("OFFSET"), flag("NODAL THICKNESS"), name("SHELL THICKNESS"), real("DENSITY")},
                                       read_general_shell_section}};
const RegisterKeyword thickness{{"NODAL THICKNESS", Phase::surfaces, Place::model, {}, read_nodal_thickness}};
const RegisterKeyword normal{{"NORMAL", Phase::surfaces, Place::model, {choice("TYPE", {"ELEMENT"})}, read_normals}};

void check_nodal_thickness(Builder& builder) {
  const Model& model = builder.model;
  for (const ElementTable& table : model.elements)
    for (std::size_t corner = 0; corner < table.connectivity.size(); ++corner) {
      const auto section = table.section[corner / table.type->nodes];
      if (section < 0 || !model.sections[section].shell.nodal_thickness) continue;
      const auto node = table.connectivity[corner];
      if (!model.nodes.thickness.empty() && model.nodes.thickness[node] > 0.0) continue;
      return builder.diagnostics.error(
          model.sections[section].location, "SHELL SECTION",
          fmt::format("node {} has no thickness; give it one under *NODAL THICKNESS", model.nodes.id[node]));
    }
}

}  // namespace

void finish_shells(Builder& builder) {
  check_nodal_thickness(builder);
  const auto opposed = set_corner_normals(builder.model, builder.normals);
  if (opposed.empty()) return;
  const auto& [first, second] = opposed.front();
  const std::string others = opposed.size() > 1 ? fmt::format(" ({} more pairs like them)", opposed.size() - 1) : "";
  builder.diagnostics.warning(
      builder.model.elements[second.table].location[second.row], "ELEMENT",
      fmt::format("the normals of shells {} and {} point to opposite sides of one smooth surface{}; "
                  "turn round the node order of one, or SPOS and SNEG change sides there",
                  builder.element_id(first), builder.element_id(second), others));
}

}  // namespace balocco::deck
