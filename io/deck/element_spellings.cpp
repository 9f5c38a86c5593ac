#include "deck/element_spellings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "elements/element_type.hpp"
#include "elements/solids/solid_reference.hpp"
#include "model/diagnostics.hpp"

namespace balocco::deck {

namespace {

struct Spelling {
  const char* name;
  const char* stands_for;
  const char* note;
  bool locks = false;  // hybrids: the displacement form, where the material hardly changes its volume
};

constexpr const char* mean_dilatation = "whose mean dilatation does what the pressure of the hybrid does";
constexpr const char* no_pressure = "with displacements alone: the material is compressible enough";

constexpr std::array spellings{
    Spelling{"C3D10M", "C3D10", "the modified form exists for contact of Abaqus's own"},
    Spelling{"STRI3", "S3R", "a thick shell: its transverse shear is not left out"},
    Spelling{"C3D8H", "C3D8", mean_dilatation},
    Spelling{"C3D6H", "C3D6", mean_dilatation},
    Spelling{"C3D8RH", "C3D8R", "whose one point has one pressure, as the hybrid has"},
    Spelling{"C3D20RH", "C3D20R", "whose eight points do not lock"},
    Spelling{"C3D4H", "C3D4", no_pressure, true},
    Spelling{"C3D10H", "C3D10", no_pressure, true},
    Spelling{"C3D10MH", "C3D10", no_pressure, true},
    Spelling{"C3D20H", "C3D20", no_pressure, true},
    Spelling{"C3D8IH", "C3D8I", no_pressure, true},
};

/// Poisson's ratio at rest, as the moduli against sideways strain and shear tell it; 0 for what has no such law.
double poisson_ratio(const Model& model, std::int32_t section) {
  if (section < 0 || model.sections[section].material < 0) return 0.0;
  try {
    const auto stiffness = SolidMaterial::of_section(model, model.sections[section]).stiffness;
    const double lame = stiffness[1], shear = stiffness[21];
    return 0.5 * lame / (lame + shear);
  } catch (const InputError&) {
    return 0.0;  // told elsewhere
  }
}

}  // namespace

std::string computed_as(Builder& builder, const Block& block, const std::string& name) {
  const auto found = std::ranges::find_if(spellings, [&](const Spelling& spelling) { return name == spelling.name; });
  if (found == spellings.end()) return name;
  if (builder.spellings_told.insert(name).second)
    builder.warning(block, block.location,
                    fmt::format("{} is computed as {}, {}", name, found->stands_for, found->note));
  return found->stands_for;
}

bool can_lock(const std::string& name) {
  return std::ranges::any_of(spellings,
                             [&](const Spelling& spelling) { return name == spelling.name && spelling.locks; });
}

void check_hybrids(Builder& builder) {
  constexpr double nearly_incompressible = 0.49;
  const Model& model = builder.model;
  for (const auto& [block, table, first, last] : builder.locking_hybrids) {
    const auto& section = model.elements[table].section;
    const std::set<std::int32_t> sections(section.begin() + first, section.begin() + last);
    for (const auto row : sections) {
      const double poisson = poisson_ratio(model, row);
      if (poisson < nearly_incompressible) continue;
      builder.error(
          *block, block->location,
          fmt::format(
              "material {} hardly changes its volume (Poisson's ratio {:.4g} at rest), and {} with displacements "
              "alone locks; use C3D8H, C3D8RH, C3D6H or C3D20RH",
              model.materials[model.sections[row].material].name, poisson, model.elements[table].type->name));
      break;
    }
  }
}

}  // namespace balocco::deck
