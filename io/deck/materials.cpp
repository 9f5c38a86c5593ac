// *MATERIAL and its options. The laws and their parameters are those of the material register: nothing is listed here.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/groups.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "materials/material_law.hpp"

namespace balocco::deck {

namespace {

Material& current(Builder& builder) {
  return builder.model.materials.back();
}

void read_material(Builder& builder, const Block& block) {
  const auto full = builder.define(builder.materials, block.value("NAME"),
                                   static_cast<std::int32_t>(builder.model.materials.size()), block);
  Material material;
  material.name = full.value_or(block.value("NAME"));
  material.location = block.location;
  builder.model.materials.push_back(std::move(material));
}

void no_tables(Builder& builder, const Block& block, Location location) {
  builder.error(block, location, "tables of temperature or field dependence are not supported; give one set of values");
}

void read_density(Builder& builder, const Block& block) {
  if (block.lines.empty()) return builder.error(block, block.location, "the density is missing; add a data line");
  Row row(builder, block, block.lines[0]);
  const double density = row.real(0, "density");
  if (row.has(1)) row.real(1, "temperature");  // one line holds for all temperatures
  row.at_most(2);
  if (block.lines.size() > 1) no_tables(builder, block, block.lines[1].location);
  if (row.ok() && !(density > 0.0)) row.error(fmt::format("density {} must be positive; correct it", density));
  current(builder).density = density;
}

void read_damping(Builder& builder, const Block& block) {
  current(builder).damping_alpha = block.real("ALPHA", 0.0);
  current(builder).damping_beta = block.real("BETA", 0.0);
  if (current(builder).damping_alpha < 0.0 || current(builder).damping_beta < 0.0) {
    builder.error(block, block.location, "ALPHA and BETA must not be negative; correct them");
  }
}

std::vector<const MaterialLaw*> laws_of(std::string_view keyword) {
  std::vector<const MaterialLaw*> laws;
  for (const auto* law : material_laws()) {
    if (squeeze(law->keyword) == keyword) laws.push_back(law);
  }
  return laws;
}

/// The variant that the parameters choose: TYPE=VARIANT or the variant as a flag; the unnamed one without either.
const MaterialLaw* chosen_law(Builder& builder, const Block& block) {
  const auto laws = laws_of(block.keyword);
  std::vector<const MaterialLaw*> chosen;
  for (const auto* law : laws) {
    const std::string variant = squeeze(law->variant);
    if (!variant.empty() && (block.has(law->variant) || squeeze(block.value("TYPE")) == variant)) chosen.push_back(law);
  }
  if (chosen.size() == 1) return chosen[0];
  if (chosen.empty()) {
    for (const auto* law : laws) {
      if (law->variant.empty() || squeeze(law->variant) == "ISOTROPIC") return law;
    }
    std::vector<std::string> names;
    for (const auto* law : laws) names.push_back(law->variant);
    builder.error(block, block.location, "the law is not chosen; add one of " + join(names));
    return nullptr;
  }
  builder.error(block, block.location, "two laws are chosen; keep one");
  return nullptr;
}

bool within(const ParameterSpec& spec, double value) {
  return value > spec.minimum && value < spec.maximum;
}

/// Abaqus takes D1 = 0 for incompressible; no element here is, so a bulk modulus is put in its place.
void warn_if_incompressible(Builder& builder, const Block& block, const MaterialLaw& law) {
  if (block.keyword != "HYPERELASTIC") return;
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const ParameterSpec& spec = law.parameters[i];
    if (spec.name.starts_with('D') && current(builder).parameters[i] == 0.0) {
      builder.warning(block, block.location, fmt::format("{} is zero or left out ({})", spec.name, spec.description));
    }
  }
}

void read_law(Builder& builder, const Block& block) {
  const MaterialLaw* law = chosen_law(builder, block);
  if (law == nullptr) return;
  Material& material = current(builder);
  if (!material.law.empty()) {
    return builder.error(block, block.location,
                         fmt::format("material {} already has the law {}; keep one", material.name, material.law));
  }
  material.law = law->name;
  if (block.lines.empty()) return builder.error(block, block.location, "the parameters are missing; add a data line");
  std::size_t line = 0;
  int field = 0;
  std::optional<Row> row;
  row.emplace(builder, block, block.lines[0]);
  const auto advance = [&] {  // Abaqus data lines hold eight values
    if (field < 8 || line + 1 >= block.lines.size()) return;
    row.emplace(builder, block, block.lines[++line]);
    field = 0;
  };
  for (const auto& spec : law->parameters) {
    advance();
    // What is left out is zero, as in Abaqus, where the law allows that.
    const double value = row->has(field) || !within(spec, 0.0)
                             ? row->real(field, fmt::format("{}, {}", spec.name, spec.description).c_str())
                             : 0.0;
    if (!row->ok()) return;
    if (!within(spec, value)) {
      return row->error(fmt::format("{} = {} is out of range: {} must lie between {} and {}; correct it", spec.name,
                                    value, spec.description, spec.minimum, spec.maximum));
    }
    material.parameters.push_back(value);
    ++field;
  }
  advance();
  if (row->has(field)) row->real(field, "temperature");  // one set holds for all temperatures
  row->at_most(field + 1);
  if (line + 1 < block.lines.size()) no_tables(builder, block, block.lines[line + 1].location);
  warn_if_incompressible(builder, block, *law);
}

const RegisterKeyword material{{"MATERIAL", Phase::definitions, Place::model, {required(name("NAME"))}, read_material}};
const RegisterKeyword density{{"DENSITY", Phase::definitions, Place::model, {}, read_density, "MATERIAL"}};
const RegisterKeyword damping{
    {"DAMPING", Phase::definitions, Place::model, {real("ALPHA"), real("BETA")}, read_damping, "MATERIAL"}};

}  // namespace

void register_material_laws() {
  std::vector<std::string> keywords;
  for (const auto* law : material_laws()) {
    if (std::find(keywords.begin(), keywords.end(), law->keyword) == keywords.end()) keywords.push_back(law->keyword);
  }
  for (const auto& keyword : keywords) {
    KeywordRule rule{keyword, Phase::definitions, Place::model, {}, read_law, "MATERIAL"};
    std::vector<std::string> variants;
    for (const auto* law : laws_of(squeeze(keyword))) {
      if (law->variant.empty()) continue;
      variants.push_back(law->variant);
      rule.parameters.push_back(flag(law->variant));
    }
    if (std::find(variants.begin(), variants.end(), "ISOTROPIC") == variants.end()) variants.push_back("ISOTROPIC");
    rule.parameters.push_back(choice("TYPE", variants));
    const RegisterKeyword registered{std::move(rule)};
  }
}

}  // namespace balocco::deck
