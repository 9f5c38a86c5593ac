// *SOLID SECTION *MEMBRANE SECTION *SECTION CONTROLS *MASS *ROTARY INERTIA.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/section_assignment.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

void read_solid_section(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin_section(builder, block, elements);
  if (!section || !need_material(builder, block)) return;
  const auto is_solid = [&](ElementRef element) {
    return builder.model.elements[element.table].type->section == Section::Kind::solid;
  };
  // Bars only if there is no solid: of both in one set it is the lines that a mesher left there.
  const auto kind = builder.model.elements[elements[0].table].type->section;
  const bool bars = kind == Section::Kind::truss && std::ranges::none_of(elements, is_solid);
  section->kind = bars ? Section::Kind::truss : Section::Kind::solid;
  if (!block.lines.empty()) {
    Row row(builder, block, block.lines[0]);
    const double attribute = row.real_or(0, 1.0, "cross-section area");
    row.at_most(1);
    if (row.ok() && !(attribute > 0.0)) row.error(fmt::format("area {} must be positive; correct it", attribute));
    if (!row.ok()) return;
    if (section->kind == Section::Kind::truss) {
      section->area = attribute;
    } else if (row.has(0) && attribute != 1.0) {
      return row.error("solid elements have no area or thickness; remove the data line");
    }
  }
  assign_section(builder, block, *std::move(section), elements);
}

/// Lines "thickness, , material, angle" of a composite membrane.
bool read_membrane_plies(Builder& builder, const Block& block, Section& section) {
  if (block.has("MATERIAL")) {
    builder.error(block, block.location, "a composite names its materials on the data lines; remove MATERIAL");
    return false;
  }
  section.thickness = 0.0;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    Ply ply;
    ply.thickness = row.real(0, "thickness of the ply");
    ply.angle = row.real_or(3, 0.0, "angle in degrees") * std::numbers::pi / 180.0;
    row.at_most(4);
    if (row.ok() && !(ply.thickness > 0.0))
      row.error(fmt::format("thickness {} must be positive; correct it", ply.thickness));
    if (row.ok() && row.has(1)) row.error("a membrane ply has no integration points; leave field 2 empty");
    if (!row.ok()) return false;
    const auto material = builder.require(builder.materials, row.name(2), block, line.location);
    if (!material) return false;
    ply.material = *material;
    section.thickness += ply.thickness;
    section.plies.push_back(ply);
  }
  if (section.plies.empty())
    builder.error(block, block.location, "it has no plies; add lines thickness, , material, angle");
  return !section.plies.empty();
}

void read_membrane_section(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin_section(builder, block, elements);
  if (!section) return;
  section->kind = Section::Kind::membrane;
  if (block.real("OFFSET", 0.0) != 0.0) {
    return builder.error(block, block.location,
                         fmt::format("OFFSET={}: the nodes of a membrane lie on its middle surface; move the nodes there "
                                     "and leave OFFSET out or 0",
                                     block.value("OFFSET")));
  }
  if (block.has("COMPOSITE")) {
    if (!read_membrane_plies(builder, block, *section)) return;
  } else {
    if (!need_material(builder, block)) return;
    if (block.lines.empty()) return builder.error(block, block.location, "the thickness is missing; add a data line");
    Row row(builder, block, block.lines[0]);
    section->thickness = row.real(0, "thickness");
    row.at_most(1);
    if (row.ok() && !(section->thickness > 0.0)) {
      row.error(fmt::format("thickness {} must be positive; correct it", section->thickness));
    }
    if (!row.ok()) return;
  }
  assign_section(builder, block, *std::move(section), elements);
}

void read_mass(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin_section(builder, block, elements);
  if (!section) return;
  section->kind = Section::Kind::mass;
  if (block.lines.empty()) return builder.error(block, block.location, "the mass is missing; add a data line");
  Row row(builder, block, block.lines[0]);
  section->mass = row.real(0, "mass");
  row.at_most(1);
  if (row.ok() && !(section->mass > 0.0)) row.error(fmt::format("mass {} must be positive; correct it", section->mass));
  if (row.ok()) assign_section(builder, block, *std::move(section), elements);
}

void read_rotary_inertia(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin_section(builder, block, elements);
  if (!section) return;
  section->kind = Section::Kind::rotary_inertia;
  if (block.lines.empty())
    return builder.error(block, block.location, "the inertia is missing; add I11, I22, I33, I12, I13, I23");
  Row row(builder, block, block.lines[0]);
  for (int i = 0; i < 6; ++i) {
    section->inertia[i] =
        i < 3 ? row.real(i, "principal moment of inertia") : row.real_or(i, 0.0, "product of inertia");
    if (row.ok() && i < 3 && section->inertia[i] < 0.0) row.error("a moment of inertia is negative; correct it");
  }
  row.at_most(6);
  if (row.ok()) assign_section(builder, block, *std::move(section), elements);
}

void read_section_controls(Builder& builder, const Block& block) {
  SectionControls controls;
  if (block.value("HOURGLASS") == "STIFFNESS") controls.hourglass = HourglassControl::stiffness;
  if (block.value("DISTORTION CONTROL") == "YES" || (block.has("LENGTH RATIO") && !block.has("DISTORTION CONTROL")))
    builder.warning(block, block.location, "DISTORTION CONTROL is not supported: elements that are squeezed flat end the run");
  controls.pointwise_dilatation = block.value("DILATATION") == "POINTWISE";
  if (!block.lines.empty()) {
    Row row(builder, block, block.lines[0]);
    controls.hourglass_scale = row.real_or(0, 1.0, "scale of the hourglass stiffness");
    // Abaqus/CAE writes the scales of rotations, out-of-plane motion and bulk viscosity behind it, all 1.
    for (int field = 1; field < 5; ++field) {
      if (row.real_or(field, 1.0, "scale") != 1.0) {
        row.error(fmt::format("field {} ('{}') is not supported; leave it empty or 1", field + 1, row.text(field)));
      }
    }
    row.at_most(5);
    if (row.ok() && !(controls.hourglass_scale > 0.0)) row.error("the scale must be positive; correct it");
  }
  if (!builder.section_controls.emplace(block.value("NAME"), controls).second) {
    builder.error(block, block.location,
                  fmt::format("section controls {} are defined twice; rename one", block.value("NAME")));
  }
}

const RegisterKeyword solid{{"SOLID SECTION",
                             Phase::sections,
                             Place::model,
                             {required(name("ELSET")), name("MATERIAL"), name("ORIENTATION"), name("CONTROLS")},
                             read_solid_section}};
const RegisterKeyword membrane{
    {"MEMBRANE SECTION",
     Phase::sections,
     Place::model,
     {required(name("ELSET")), name("MATERIAL"), name("ORIENTATION"), name("CONTROLS"), flag("COMPOSITE"),
      real("OFFSET")},
     read_membrane_section}};
const RegisterKeyword mass{{"MASS", Phase::sections, Place::model, {required(name("ELSET"))}, read_mass}};
const RegisterKeyword rotary{
    {"ROTARY INERTIA", Phase::sections, Place::model, {required(name("ELSET"))}, read_rotary_inertia}};
// SECOND ORDER ACCURACY chooses nothing here, for the kinematics are exact either way; nor does ELEMENT DELETION=YES, for what fails is deleted.
const RegisterKeyword section_controls{{"SECTION CONTROLS",
                                        Phase::definitions,
                                        Place::model,
                                        {required(name("NAME")), choice("HOURGLASS", {"ENHANCED", "STIFFNESS"}),
                                         choice("SECOND ORDER ACCURACY", {"YES", "NO"}), choice("DILATATION", {"MEAN", "POINTWISE"}),
                                         choice("ELEMENT DELETION", {"YES"}), choice("DISTORTION CONTROL", {"YES", "NO"}), real("LENGTH RATIO")},
                                        read_section_controls}};

}  // namespace

}  // namespace balocco::deck
