// *BEAM SECTION *BEAM GENERAL SECTION.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/section_assignment.hpp"
#include "elements/element_type.hpp"
#include "sections/beam_section.hpp"

namespace balocco::deck {

namespace {

/// A profile, the names of the numbers on its data line, and what they must obey beyond being positive.
struct ProfileForm {
  const char* word;
  BeamProfile::Shape shape;
  std::vector<const char*> dimensions;
};

const std::vector<ProfileForm>& profile_forms() {
  static const std::vector<ProfileForm> forms{
      {"RECT", BeamProfile::Shape::rectangle, {"width a along n1", "height b along n2"}},
      {"CIRC", BeamProfile::Shape::circle, {"radius"}},
      {"PIPE", BeamProfile::Shape::pipe, {"outer radius", "wall thickness"}},
      {"BOX",
       BeamProfile::Shape::box,
       {"width a along n1", "height b along n2", "wall thickness t1", "wall thickness t2", "wall thickness t3",
        "wall thickness t4"}},
      {"I",
       BeamProfile::Shape::i_section,
       {"distance l of the node from the bottom", "height h", "width b1 of the bottom flange", "width b2 of the top flange",
        "thickness t1 of the bottom flange", "thickness t2 of the top flange", "thickness t3 of the web"}}};
  return forms;
}

/// What is wrong with the dimensions of a profile, or nothing.
std::string contradiction(const BeamProfile& profile) {
  const auto& d = profile.dimensions;
  switch (profile.shape) {
    case BeamProfile::Shape::pipe:
      return d[1] > d[0] ? "the wall is thicker than the outer radius" : "";
    case BeamProfile::Shape::box:
      return d[2] + d[4] >= d[0] || d[3] + d[5] >= d[1] ? "the walls fill the box; use SECTION=RECT or thinner walls" : "";
    case BeamProfile::Shape::i_section: {
      if (d[4] + d[5] >= d[1]) return "the flanges are thicker than the section is high";
      const double middle = centroid_height(profile);
      if (std::abs(d[0] - middle) > 5e-4 * d[1])  // what four digits leave
        return fmt::format("the node must lie at the centroid, l = {:.6g}; offsets of beams are not supported", middle);
      return "";
    }
    default: return "";
  }
}

/// The direction n1 of the second data line, without one (0, 0, -1); of a part, it turns with its instance.
bool read_beam_direction(Builder& builder, const Block& block, BeamProfile& profile) {
  Point given{0.0, 0.0, -1.0};
  if (block.lines.size() > 1) {
    Row row(builder, block, block.lines[1]);
    for (int i = 0; i < 3; ++i) given[i] = row.real_or(i, i == 2 && !row.has(0) && !row.has(1) ? -1.0 : 0.0, "direction n1");
    row.at_most(3);
    if (row.ok() && given == Point{}) row.error("the direction n1 has no length; give three components");
    if (!row.ok()) return false;
  }
  profile.n1 = builder.scope->turn(given);
  return true;
}

/// An element whose axis runs along n1 is told with its number.
bool check_direction(Builder& builder, const Block& block, const BeamProfile& profile, const std::vector<ElementRef>& elements) {
  for (const auto& element : elements) {
    const ElementTable& table = builder.model.elements[element.table];
    if (table.type->section != Section::Kind::beam) continue;  // told when the section is assigned
    const auto* const nodes = &table.connectivity[2 * static_cast<std::size_t>(element.row)];
    const Point &a = builder.model.nodes.coordinates[nodes[0]], &b = builder.model.nodes.coordinates[nodes[1]];
    std::array<Point, 3> frame;
    if (a == b || beam_frame(a, b, profile.n1, frame)) continue;
    builder.error(block, block.lines.size() < 2 ? block.location : block.lines[1].location,
                  fmt::format("the direction n1 ({:g}, {:g}, {:g}) runs along the axis of element {}; give one across it on the "
                              "second data line",
                              profile.n1[0], profile.n1[1], profile.n1[2], table.id[element.row]));
    return false;
  }
  return true;
}

void read_beam_section(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin_section(builder, block, elements);
  if (!section || !need_material(builder, block)) return;
  section->kind = Section::Kind::beam;
  const auto form = std::ranges::find(profile_forms(), block.value("SECTION"), &ProfileForm::word);
  section->beam.shape = form->shape;
  if (block.lines.empty()) return builder.error(block, block.location, "the dimensions are missing; add a data line");
  Row row(builder, block, block.lines[0]);
  for (std::size_t i = 0; i < form->dimensions.size(); ++i) {
    const double value = row.real(i, form->dimensions[i]);
    if (row.ok() && !(value > 0.0)) row.error(fmt::format("{} is {}; it must be positive", form->dimensions[i], value));
    section->beam.dimensions.push_back(value);
  }
  row.at_most(form->dimensions.size());
  if (!row.ok()) return;
  if (const auto wrong = contradiction(section->beam); !wrong.empty()) return row.error(wrong);
  if (!read_beam_direction(builder, block, section->beam) || !check_direction(builder, block, section->beam, elements)) return;
  assign_section(builder, block, *std::move(section), elements);
}

void read_general_beam_section(Builder& builder, const Block& block) {
  std::vector<ElementRef> elements;
  auto section = begin_section(builder, block, elements);
  if (!section) return;
  section->kind = Section::Kind::beam;
  auto& profile = section->beam;
  profile.density = block.real("DENSITY", 0.0);
  if (block.lines.size() < 3)
    return builder.error(block, block.location, "it needs three data lines: A, I11, I12, I22, J; direction n1; E, G");
  Row row(builder, block, block.lines[0]);
  constexpr std::array names{"area", "I11", "I12", "I22", "torsion constant J"};
  for (int i = 0; i < 5; ++i) {
    const double value = i == 2 ? row.real_or(i, 0.0, names[i]) : row.real(i, names[i]);
    if (row.ok() && i != 2 && !(value > 0.0)) row.error(fmt::format("{} is {}; it must be positive", names[i], value));
    profile.dimensions.push_back(value);
  }
  row.at_most(5);
  if (row.ok() && !(profile.dimensions[1] * profile.dimensions[3] > profile.dimensions[2] * profile.dimensions[2]))
    row.error("I11 I22 must be greater than I12^2; correct them");
  Row moduli(builder, block, block.lines[2]);
  profile.youngs_modulus = moduli.real(0, "Young's modulus");
  profile.shear_modulus = moduli.real(1, "shear modulus");
  moduli.at_most(2);
  if (moduli.ok() && !(profile.youngs_modulus > 0.0 && profile.shear_modulus > 0.0)) moduli.error("the moduli must be positive");
  if (!row.ok() || !moduli.ok()) return;
  if (!read_beam_direction(builder, block, profile) || !check_direction(builder, block, profile, elements)) return;
  assign_section(builder, block, *std::move(section), elements);
}

const RegisterKeyword beam_section{{"BEAM SECTION",
                                    Phase::sections,
                                    Place::model,
                                    {required(name("ELSET")), required(name("MATERIAL")),
                                     required(choice("SECTION", {"RECT", "CIRC", "PIPE", "BOX", "I"})), foreign("TEMPERATURE")},
                                    read_beam_section}};
const RegisterKeyword general_beam_section{{"BEAM GENERAL SECTION",
                                            Phase::sections,
                                            Place::model,
                                            {required(name("ELSET")), choice("SECTION", {"GENERAL"}), real("DENSITY")},
                                            read_general_beam_section}};

}  // namespace

}  // namespace balocco::deck
