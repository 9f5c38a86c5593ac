#include "deck/section_assignment.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "deck/orientations.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

const char* describe(Section::Kind kind) {
  switch (kind) {
    case Section::Kind::solid:
      return "*SOLID SECTION";
    case Section::Kind::membrane:
      return "*MEMBRANE SECTION";
    case Section::Kind::shell:
      return "*SHELL SECTION or *SHELL GENERAL SECTION";
    case Section::Kind::truss:
      return "*SOLID SECTION with an area";
    case Section::Kind::beam:
      return "*BEAM SECTION or *BEAM GENERAL SECTION";
    case Section::Kind::mass:
      return "*MASS";
    case Section::Kind::rotary_inertia:
      return "*ROTARY INERTIA";
    case Section::Kind::spring:
      return "*SPRING";
    case Section::Kind::dashpot:
      return "*DASHPOT";
    case Section::Kind::connector:
      return "*CONNECTOR SECTION";
    case Section::Kind::rigid:
      return "*RIGID BODY with its ELSET";
  }
  return "";
}

const char* describe(Shape shape) {
  switch (shape) {
    case Shape::point:
      return "a point";
    case Shape::line:
      return "a line";
    case Shape::triangle:
    case Shape::quadrilateral:
      return "a surface";
    case Shape::tetrahedron:
    case Shape::wedge:
    case Shape::hexahedron:
    case Shape::quadratic_tetrahedron:
    case Shape::quadratic_wedge:
    case Shape::quadratic_hexahedron:
      return "a solid";
  }
  return "";
}

/// The element of the set that cannot have a section of this kind, what it is beside the others, and the way out.
std::string misfit(const Model& model, const Block& block, ElementRef element, const std::vector<ElementRef>& all,
                   Section::Kind kind) {
  const ElementTable& table = model.elements[element.table];
  const ElementType& type = *table.type;
  const std::string what = fmt::format("element {} ({}) of type {} is {} and cannot have this section",
                                       model.element_name(element), model.where(table.location[element.row]), type.name,
                                       describe(type.shape));
  const auto fits =
      std::ranges::find_if(all, [&](ElementRef other) { return model.elements[other.table].type->section == kind; });
  if (fits == all.end()) return fmt::format("{}; it needs {}", what, describe(type.section));
  return fmt::format("{}, while element {} is of type {}; take the {} elements of type {} out of set {}: they need {}", what,
                     model.element_name(*fits), model.elements[fits->table].type->name,
                     std::ranges::count(all, element.table, &ElementRef::table), type.name, block.value("ELSET"),
                     describe(type.section));
}

}  // namespace

void assign_section(Builder& builder, const Block& block, Section section, const std::vector<ElementRef>& elements) {
  const auto row = static_cast<std::int32_t>(builder.model.sections.size());
  for (const auto element : elements) {
    ElementTable& table = builder.model.elements[element.table];
    std::int32_t& owner = table.section[element.row];
    if (table.type->section != section.kind) {
      return builder.error(block, block.location, misfit(builder.model, block, element, elements, section.kind));
    }
    if (section.pointwise_dilatation && table.type->name != "C3D8" && table.type->name != "C3D20R") {
      return builder.error(block, block.location,
                           fmt::format("DILATATION=POINTWISE of its section controls chooses how a C3D8 or C3D20R is integrated, but "
                                       "element {} is a {}; give those a section of their own",
                                       builder.model.element_name(element), table.type->name));
    }
    if (owner >= 0) {
      return builder.error(
          block, block.location,
          fmt::format("element {} already has the section of {}; take it out of one of the sets",
                      builder.model.element_name(element), builder.model.where(builder.model.sections[owner].location)));
    }
    owner = row;
  }
  builder.model.sections.push_back(std::move(section));
}

std::optional<Section> begin_section(Builder& builder, const Block& block, std::vector<ElementRef>& elements) {
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
    good = good && orientation && give_directions(builder, block, *orientation, elements);
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
      section.pointwise_dilatation = controls->second.pointwise_dilatation;
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

}  // namespace balocco::deck
