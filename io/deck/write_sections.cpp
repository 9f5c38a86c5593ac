// The sections of a deck being written.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "deck/writer.hpp"

namespace balocco::deck {

double degrees_of(double radians) {
  const double plain = radians * 180.0 / std::numbers::pi;
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double candidate :
       {std::round(plain * 1e9) / 1e9, plain, std::nextafter(plain, infinity), std::nextafter(plain, -infinity)}) {
    if (candidate * std::numbers::pi / 180.0 == radians) return candidate;
  }
  return plain;
}

void Writer::section_line(const char* keyword, const Section& section, std::size_t row, const std::string& set) {
  std::string parameters = ", ELSET=" + quoted(set);
  if (section.material >= 0) parameters += ", MATERIAL=" + quoted(model_.materials[section.material].name);
  if (section.orientation >= 0) parameters += ", ORIENTATION=" + quoted(model_.orientations[section.orientation].name);
  if (section.hourglass != HourglassControl::enhanced || section.hourglass_scale != 1.0 || section.pointwise_dilatation) {
    line("*SECTION CONTROLS, NAME=CONTROLS-{}, HOURGLASS={}{}\n{}", row + 1,
         section.hourglass == HourglassControl::enhanced ? "ENHANCED" : "STIFFNESS",
         section.pointwise_dilatation ? ", DILATATION=POINTWISE" : "", section.hourglass_scale);
    parameters += fmt::format(", CONTROLS=CONTROLS-{}", row + 1);
  }
  line("*{}{}{}", keyword, parameters, section.plies.empty() ? "" : ", COMPOSITE");
}

void Writer::spring(const char* keyword, const Section& section, std::size_t row, const std::string& set) {
  const auto& [freedom, slope, table] = section.spring;
  section_line(fmt::format("{}{}", keyword, table.empty() ? "" : ", NONLINEAR").c_str(), section, row, set);
  if (freedom[0] >= 0 && freedom[1] >= 0) line("{}, {}", freedom[0] + 1, freedom[1] + 1);
  if (freedom[0] >= 0 && freedom[1] < 0) line("{}", freedom[0] + 1);
  if (table.empty()) line("{}", slope);
  for (const auto& [at, force] : table) line("{}, {}", force, at);
}

void Writer::beam_section(const Section& section, std::size_t row, const std::string& set) {
  const BeamProfile& profile = section.beam;
  const char* const words[] = {"GENERAL", "RECT", "CIRC", "PIPE", "BOX", "I"};
  const bool general = profile.shape == BeamProfile::Shape::general;
  const auto keyword = general ? fmt::format("BEAM GENERAL SECTION, SECTION=GENERAL, DENSITY={}", profile.density)
                               : fmt::format("BEAM SECTION, SECTION={}", words[static_cast<int>(profile.shape)]);
  section_line(keyword.c_str(), section, row, set);
  values(profile.dimensions);
  values(profile.n1);
  if (general) line("{}, {}", profile.youngs_modulus, profile.shear_modulus);
  if (profile.shear_stiffness)
    line("*TRANSVERSE SHEAR STIFFNESS\n{}, {}", (*profile.shear_stiffness)[1], (*profile.shear_stiffness)[0]);
}

/// Name of the distribution of a section's thicknesses, which is written; empty: its elements have no own ones.
std::string Writer::distributed_thickness(std::size_t row) {
  const auto name = fmt::format("_THICKNESS-{}", row);
  bool begun = false;
  for (const auto& table : model_.elements)
    for (std::size_t element = 0; element < table.thickness.size(); ++element) {
      if (table.section[element] != static_cast<std::int32_t>(row) || table.thickness[element] == 0.0) continue;
      if (!std::exchange(begun, true))
        line("*DISTRIBUTION TABLE, NAME={}-TABLE\nLENGTH\n*DISTRIBUTION, NAME={}, LOCATION=ELEMENT, TABLE={}-TABLE", name, name, name);
      line("{}, {}", table.id[element], table.thickness[element]);
    }
  return begun ? name : "";
}

void Writer::shell(const Section& section, std::size_t row, const std::string& set) {
  const auto distribution = distributed_thickness(row);
  const ShellOptions& shell = section.shell;
  std::string keyword = shell.general ? "SHELL GENERAL SECTION" : "SHELL SECTION";
  if (shell.offset != 0.0) keyword += fmt::format(", OFFSET={}", shell.offset);
  if (shell.nodal_thickness) keyword += ", NODAL THICKNESS";
  if (!distribution.empty()) keyword += ", SHELL THICKNESS=" + distribution;
  if (shell.gauss) keyword += ", SECTION INTEGRATION=GAUSS";
  if (shell.mass_per_area > 0.0) keyword += fmt::format(", DENSITY={}", shell.mass_per_area);
  section_line(keyword.c_str(), section, row, set);
  for (const auto& ply : section.plies)
    line("{}, {}, {}, {}", ply.thickness, ply.points, quoted(model_.materials[ply.material].name), degrees_of(ply.angle));
  if (!shell.stiffness.empty())
    values(shell.stiffness);
  else if (section.plies.empty())
    shell.general ? line("{}", section.thickness) : line("{}, {}", section.thickness, shell.points);
  if (shell.transverse_shear.empty()) return;
  line("*TRANSVERSE SHEAR STIFFNESS");
  values(shell.transverse_shear);
}

void Writer::section(std::size_t row) {
  const Section& section = model_.sections[row];
  std::vector<ElementRef> elements;
  for (std::size_t t = 0; t < model_.elements.size(); ++t) {
    const auto& owner = model_.elements[t].section;
    for (std::size_t e = 0; e < owner.size(); ++e) {
      if (owner[e] == static_cast<std::int32_t>(row))
        elements.push_back({static_cast<std::int32_t>(t), static_cast<std::int32_t>(e)});
    }
  }
  const auto named = std::find_if(model_.element_sets.begin(), model_.element_sets.end(), [&](const ElementSet& set) {
    return set.name == section.element_set && set.elements == elements;
  });
  const std::string set =
      named != model_.element_sets.end() ? named->name : element_set_of(elements, fmt::format("_SECTION-{}", row + 1));
  switch (section.kind) {
    case Section::Kind::solid:
      return section_line("SOLID SECTION", section, row, set);
    case Section::Kind::truss:
      section_line("SOLID SECTION", section, row, set);
      return line("{}", section.area);
    case Section::Kind::beam:
      return beam_section(section, row, set);
    case Section::Kind::mass:
      section_line("MASS", section, row, set);
      return line("{}", section.mass);
    case Section::Kind::rotary_inertia:
      section_line("ROTARY INERTIA", section, row, set);
      return values(section.inertia);
    case Section::Kind::spring:
      return spring("SPRING", section, row, set);
    case Section::Kind::dashpot:
      return spring("DASHPOT", section, row, set);
    case Section::Kind::shell:
      return shell(section, row, set);
    case Section::Kind::connector:
      return;  // no builder makes connectors
    case Section::Kind::rigid:
      return;  // *RIGID BODY names its elements
    case Section::Kind::membrane:
      section_line("MEMBRANE SECTION", section, row, set);
      if (section.plies.empty()) return line("{}", section.thickness);
      for (const auto& ply : section.plies) {
        line("{}, , {}, {}", ply.thickness, quoted(model_.materials[ply.material].name), degrees_of(ply.angle));
      }
  }
}

void Writer::sections() {
  comment("Sections");
  for (std::size_t row = 0; row < model_.sections.size(); ++row) section(row);
}

}  // namespace balocco::deck
