// *SOLID SECTION *MEMBRANE SECTION *SECTION CONTROLS *MASS *ROTARY INERTIA.
#include <fmt/format.h>

#include <numbers>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

const char* describe(Section::Kind kind) {
  switch (kind) {
    case Section::Kind::solid:
      return "*SOLID SECTION";
    case Section::Kind::membrane:
      return "*MEMBRANE SECTION";
    case Section::Kind::truss:
      return "*SOLID SECTION with an area";
    case Section::Kind::mass:
      return "*MASS";
    case Section::Kind::rotary_inertia:
      return "*ROTARY INERTIA";
  }
  return "";
}

/// Gives the section to the elements of its set; what has one already, or needs another kind, is told once.
void assign(Builder& builder, const Block& block, Section section, const std::vector<ElementRef>& elements) {
  const auto row = static_cast<std::int32_t>(builder.model.sections.size());
  for (const auto element : elements) {
    ElementTable& table = builder.model.elements[element.table];
    std::int32_t& owner = table.section[element.row];
    if (table.type->section != section.kind) {
      return builder.error(block, block.location,
                           fmt::format("element {} of type {} cannot have this section; it needs {}",
                                       table.id[element.row], table.type->name, describe(table.type->section)));
    }
    if (owner >= 0) {
      return builder.error(
          block, block.location,
          fmt::format("element {} already has the section of {}; take it out of one of the sets", table.id[element.row],
                      builder.model.where(builder.model.sections[owner].location)));
    }
    owner = row;
  }
  builder.model.sections.push_back(std::move(section));
}

/// What all sections have in common. Returns nothing if a reference is undefined (told).
std::optional<Section> begin(Builder& builder, const Block& block, std::vector<ElementRef>& elements) {
  Section section;
  section.location = block.location;
  const std::string set = block.value("ELSET");
  bool good = builder.elements_of(set, block, block.location, elements);
  if (const auto row = builder.find(builder.element_sets, set))
    section.element_set = builder.model.element_sets[*row].name;
  if (block.has("MATERIAL")) {
    const auto material = builder.require(builder.materials, block.value("MATERIAL"), block, block.location);
    section.material = material.value_or(-1);
    good = good && material;
  }
  if (block.has("ORIENTATION")) {
    const auto orientation = builder.require(builder.orientations, block.value("ORIENTATION"), block, block.location);
    section.orientation = orientation.value_or(-1);
    good = good && orientation;
  }
  if (block.has("CONTROLS")) {
    const std::string name = block.value("CONTROLS");
    const auto controls = builder.section_controls.find(name);
    if (controls == builder.section_controls.end()) {
      if (!builder.is_poisoned(name)) {
        builder.error(block, block.location,
                      fmt::format("section controls {} are not defined; define them under *SECTION CONTROLS", name));
      }
      good = false;
    } else {
      section.hourglass = controls->second.hourglass;
      section.hourglass_scale = controls->second.hourglass_scale;
    }
  }
  // An empty set has been told, or is what is left of refused elements.
  return good && !elements.empty() ? std::optional(section) : std::nullopt;
}

bool need_material(Builder& builder, const Block& block) {
  if (block.has("MATERIAL")) return true;
  builder.error(block, block.location, "the material is not named; add MATERIAL=...");
  return false;
}

void read_solid_section(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin(builder, block, elements);
  if (!section || !need_material(builder, block)) return;
  const auto kind = builder.model.elements[elements[0].table].type->section;
  section->kind = kind == Section::Kind::truss ? kind : Section::Kind::solid;
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
  assign(builder, block, *std::move(section), elements);
}

/// Lines "thickness, , material, angle" of a composite membrane.
bool read_plies(Builder& builder, const Block& block, Section& section) {
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
  auto section = begin(builder, block, elements);
  if (!section) return;
  section->kind = Section::Kind::membrane;
  if (block.real("OFFSET", 0.0) != 0.0) {
    return builder.error(block, block.location,
                         fmt::format("OFFSET={}: the nodes of a membrane lie on its middle surface; move the nodes there "
                                     "and leave OFFSET out or 0",
                                     block.value("OFFSET")));
  }
  if (block.has("COMPOSITE")) {
    if (!read_plies(builder, block, *section)) return;
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
  assign(builder, block, *std::move(section), elements);
}

void read_mass(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin(builder, block, elements);
  if (!section) return;
  section->kind = Section::Kind::mass;
  if (block.lines.empty()) return builder.error(block, block.location, "the mass is missing; add a data line");
  Row row(builder, block, block.lines[0]);
  section->mass = row.real(0, "mass");
  row.at_most(1);
  if (row.ok() && !(section->mass > 0.0)) row.error(fmt::format("mass {} must be positive; correct it", section->mass));
  if (row.ok()) assign(builder, block, *std::move(section), elements);
}

void read_rotary_inertia(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin(builder, block, elements);
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
  if (row.ok()) assign(builder, block, *std::move(section), elements);
}

void read_section_controls(Builder& builder, const Block& block) {
  SectionControls controls;
  if (block.value("HOURGLASS") == "STIFFNESS") controls.hourglass = HourglassControl::stiffness;
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
// SECOND ORDER ACCURACY chooses nothing here: the kinematics are exact either way.
const RegisterKeyword controls{{"SECTION CONTROLS",
                                Phase::definitions,
                                Place::model,
                                {required(name("NAME")), choice("HOURGLASS", {"ENHANCED", "STIFFNESS"}),
                                 choice("SECOND ORDER ACCURACY", {"YES", "NO"})},
                                read_section_controls}};

}  // namespace

}  // namespace balocco::deck
