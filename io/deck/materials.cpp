// *MATERIAL and its options. The laws and their parameters are those of the material register: nothing is listed here.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "deck/builder.hpp"
#include "deck/groups.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "materials/material_option.hpp"
#include "materials/rubber_stability.hpp"
#include "model/diagnostics.hpp"

namespace balocco::deck {

namespace {

Material& current_material(Builder& builder) {
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

/// Matter has one density, of which further lines may give the temperature alone.
void read_density(Builder& builder, const Block& block) {
  if (block.lines.empty()) return builder.error(block, block.location, "the density is missing; add a data line");
  double& density = current_material(builder).density;
  for (std::size_t line = 0; line < block.lines.size(); ++line) {
    Row row(builder, block, block.lines[line]);
    const double here = row.real(0, "density");
    if (line > 0 || row.has(1)) row.real(1, "temperature");
    row.at_most(2);
    if (!row.ok()) return;
    if (!(here > 0.0)) return row.error(fmt::format("density {} must be positive; correct it", here));
    if (line > 0 && here != density) return no_tables(builder, block, block.lines[line].location);
    density = here;
  }
}

void read_damping(Builder& builder, const Block& block) {
  current_material(builder).damping_alpha = block.real("ALPHA", 0.0);
  current_material(builder).damping_beta = block.real("BETA", 0.0);
  if (current_material(builder).damping_alpha < 0.0 || current_material(builder).damping_beta < 0.0) {
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

std::vector<const OptionSpec*> options_of(std::string_view keyword) {
  std::vector<const OptionSpec*> options;
  for (const auto* option : material_options()) {
    if (squeeze(option->keyword) == keyword) options.push_back(option);
  }
  return options;
}

/// Of the orders N that a variant exists in, the one that the keyword line asks for (1 if it does not say).
const MaterialLaw* of_order(Builder& builder, const Block& block, const std::vector<const MaterialLaw*>& variants) {
  if (variants.size() == 1 && variants[0]->order == 0 && !block.has("N")) return variants[0];
  const double order = block.real("N", 1.0);
  int greatest = 0;
  for (const auto* law : variants) {
    if (law->order == order) return law;
    greatest = std::max(greatest, law->order);
  }
  const std::string& name = variants[0]->variant.empty() ? variants[0]->keyword : variants[0]->variant;
  builder.error(block, block.location,
                greatest == 0 ? fmt::format("{} has no order; remove N", name)
                              : fmt::format("N = {} is not supported; {} takes N = 1 to {}", order, name, greatest));
  return nullptr;
}

/// The variant that the parameters choose: TYPE=VARIANT or the variant as a flag; the unnamed one without either.
const MaterialLaw* chosen_law(Builder& builder, const Block& block) {
  const auto laws = laws_of(block.keyword);
  std::vector<const MaterialLaw*> chosen;
  for (const auto* law : laws) {
    const std::string variant = squeeze(law->variant);
    if (!variant.empty() && (block.has(law->variant) || squeeze(block.value("TYPE")) == variant)) chosen.push_back(law);
  }
  const bool one_variant =
      std::ranges::all_of(chosen, [&](const auto* law) { return law->variant == chosen[0]->variant; });
  if (!chosen.empty() && one_variant) return of_order(builder, block, chosen);
  if (chosen.empty()) {
    std::vector<const MaterialLaw*> unnamed;
    for (const auto* law : laws)
      if (law->variant.empty() || squeeze(law->variant) == "ISOTROPIC") unnamed.push_back(law);
    if (!unnamed.empty()) return of_order(builder, block, unnamed);
    std::vector<std::string> names;
    for (const auto* law : laws)
      if (names.empty() || names.back() != law->variant) names.push_back(law->variant);
    builder.error(block, block.location, "the law is not chosen; add one of " + join(names));
    return nullptr;
  }
  builder.error(block, block.location, "two laws are chosen; keep one");
  return nullptr;
}

constexpr std::array one_for_all_temperatures{"temperature"};
/// Temperatures are not followed: the factor 1 - (temperature between transition and melting)^m stays 1.
constexpr std::array thermal_softening{"m", "melting temperature", "transition temperature"};

bool within(const ParameterSpec& spec, double value) {
  return value > spec.minimum && value < spec.maximum;
}

std::string out_of_range(const ParameterSpec& spec, double value) {
  return fmt::format("{} = {} is out of range: {} must lie between {} and {}; correct it", spec.name, value,
                     spec.description, spec.minimum, spec.maximum);
}

/// Reads the declared values from data line `line` on, eight to a line as Abaqus has them; `line` is then the next one.
/// What is left out at the end is zero where that is in range. Behind them may stand numbers that have no effect, called `unused`.
std::optional<std::vector<double>> read_values(Builder& builder, const Block& block, std::size_t& line,
                                               const std::vector<ParameterSpec>& specs, std::span<const char* const> unused) {
  std::vector<double> values;
  int field = 0;
  std::optional<Row> row;
  row.emplace(builder, block, block.lines[line++]);
  const auto advance = [&] {
    if (field < 8 || line >= block.lines.size()) return;
    row.emplace(builder, block, block.lines[line++]);
    field = 0;
  };
  for (const auto& spec : specs) {
    advance();
    const double value = row->has(field) || !within(spec, 0.0)
                             ? row->real(field, fmt::format("{}, {}", spec.name, spec.description).c_str())
                             : 0.0;
    if (!row->ok()) return std::nullopt;
    if (!within(spec, value)) {
      row->error(out_of_range(spec, value));
      return std::nullopt;
    }
    values.push_back(value);
    ++field;
  }
  for (const char* name : unused)
    if (row->has(field++)) row->real(field - 1, name);
  row->at_most(field);
  return row->ok() ? std::optional(values) : std::nullopt;
}

/// Abaqus takes D1 = 0 for incompressible; no element here is, so a bulk modulus is put in its place.
void warn_if_incompressible(Builder& builder, const Block& block, const MaterialLaw& law) {
  if (block.keyword != "HYPERELASTIC") return;
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const ParameterSpec& spec = law.parameters[i];
    if (spec.name == "D1" && current_material(builder).parameters[i] == 0.0) {
      builder.warning(block, block.location, fmt::format("{} is zero or left out ({})", spec.name, spec.description));
    }
  }
}

void warn_if_unstable(Builder& builder, const Block& block) {
  try {
    const std::string text = unstable_range(*make_law<PointKind::solid>(current_material(builder)));
    if (!text.empty()) builder.warning(block, block.location, text);
  } catch (const InputError&) {  // told when all of the material is known
  }
}

/// Further lines, each of another temperature: of isotropic *ELASTIC they become a table (materials/elastic_by_temperature.hpp), elsewhere
/// they must repeat the first one.
void read_temperatures(Builder& builder, const Block& block, const MaterialLaw& law, std::size_t line) {
  auto& parameters = current_material(builder).parameters;
  const auto constants = parameters;
  const auto temperature_of = [&](std::size_t at) {
    return Row(builder, block, block.lines[at]).real(static_cast<int>(constants.size()), "temperature");
  };
  const bool tabulates = law.name == "elastic";
  std::vector<double> table = constants;
  if (tabulates) table.push_back(temperature_of(0));
  bool varies = false;
  while (line < block.lines.size()) {
    const std::size_t first = line;
    const auto values = read_values(builder, block, line, law.parameters, one_for_all_temperatures);
    if (!values) return;
    varies |= *values != constants;
    if (varies && !tabulates) return no_tables(builder, block, block.lines[first].location);
    if (!tabulates) continue;
    const double before = table.back();
    table.insert(table.end(), values->begin(), values->end());
    table.push_back(temperature_of(first));
    if (!(table.back() > before))
      return Row(builder, block, block.lines[first])
          .error(fmt::format("temperature {} does not exceed that of the line before; list them rising", table.back()));
  }
  if (varies) parameters = table;
}

void read_law(Builder& builder, const Block& block) {
  const MaterialLaw* law = chosen_law(builder, block);
  if (law == nullptr) return;
  Material& material = current_material(builder);
  if (!material.law.empty()) {
    return builder.error(block, block.location,
                         fmt::format("material {} already has the law {}; keep one", material.name, material.law));
  }
  material.law = law->name;
  material.instantaneous = squeeze(block.value("MODULI")) == "INSTANTANEOUS";
  if (block.lines.empty()) return builder.error(block, block.location, "the parameters are missing; add a data line");
  std::size_t line = 0;
  const auto values = read_values(builder, block, line, law->parameters, one_for_all_temperatures);
  if (!values) return;
  material.parameters = *values;
  if (line < block.lines.size()) read_temperatures(builder, block, *law, line);
  warn_if_incompressible(builder, block, *law);
  if (block.keyword == "HYPERELASTIC") warn_if_unstable(builder, block);
}

const OptionSpec* chosen_option(Builder& builder, const Block& block) {
  const auto options = options_of(block.keyword);
  std::vector<std::string> variants;
  for (const auto* option : options) {
    if (option->selector.empty()) return option;
    const std::string chosen = squeeze(block.value(option->selector));
    if (chosen.empty() ? option->is_default : chosen == squeeze(option->variant)) return option;
    variants.push_back(option->variant);
  }
  builder.error(block, block.location, fmt::format("{} is missing; give one of {}", options[0]->selector, join(variants)));
  return nullptr;
}

/// The words that must stand as they are, and the numbers of the keyword line. @return false if something is wrong (told).
bool read_settings(Builder& builder, const Block& block, const OptionSpec& option, MaterialOption& result) {
  for (const auto& word : option.words) {
    if (block.has(word.name)) continue;
    builder.error(block, block.location,
                  word.value.empty() ? fmt::format("only the form with {} is supported; add it", word.name)
                                     : fmt::format("only {}={} is supported; add it", word.name, word.value));
    return false;
  }
  for (const auto& spec : option.settings) {
    const double value = block.has(spec.name) ? block.real(spec.name, 0.0) : 0.0;
    if (!within(spec, value)) {
      builder.error(block, block.location, out_of_range(spec, value));
      return false;
    }
    result.settings.push_back(value);
  }
  for (const auto* other : options_of(block.keyword)) {  // what belongs to another variant of the keyword
    for (const auto& spec : other->settings) {
      const bool known = std::ranges::any_of(option.settings, [&](const auto& own) { return own.name == spec.name; });
      if (known || !block.has(spec.name)) continue;
      builder.error(block, block.location,
                    fmt::format("{} has no meaning with {}={}; remove it", spec.name, option.selector, option.variant));
      return false;
    }
  }
  return true;
}

std::vector<ParameterSpec> columns_of(const OptionSpec& option, const MaterialOption& result) {
  std::vector<ParameterSpec> columns = option.columns;
  if (option.repeated_columns == 0) return columns;
  const auto first = columns.size() - option.repeated_columns;
  for (int group = 1; group < static_cast<int>(result.settings[0]); ++group)
    for (int i = 0; i < option.repeated_columns; ++i) columns.push_back(option.columns[first + i]);
  return columns;
}

void warn_of_softening(Builder& builder, const Block& block, std::size_t exponent) {
  Row row(builder, block, block.lines[0]);
  if (!row.has(static_cast<int>(exponent)) || row.real_or(static_cast<int>(exponent), 0.0, "m") == 0.0) return;
  builder.warning(block, row.location(), "temperatures are not followed: the factor of thermal softening, with m, is 1");
}

void read_option(Builder& builder, const Block& block) {
  const OptionSpec* option = chosen_option(builder, block);
  if (option == nullptr) return;
  MaterialOption result;
  result.name = option->name;
  if (!read_settings(builder, block, *option, result)) return;
  auto& present = current_material(builder).options;
  for (const auto& other : present) {
    const OptionSpec* spec = find_material_option(other.name);
    if (spec->keyword != option->keyword || (spec == option && option->repeatable)) continue;
    return builder.error(block, block.location, fmt::format("material {} has it already; keep one", current_material(builder).name));
  }
  if (block.lines.empty()) return builder.error(block, block.location, "the parameters are missing; add a data line");
  const auto columns = columns_of(*option, result);
  const bool softens = option->name == "plastic-johnson-cook";
  const auto unused = softens ? std::span<const char* const>(thermal_softening) : std::span<const char* const>(one_for_all_temperatures);
  if (softens) warn_of_softening(builder, block, columns.size());
  std::size_t line = 0;
  std::optional<double> temperature;
  do {
    const std::size_t first = line;
    const auto values = read_values(builder, block, line, columns, unused);
    if (!values) return;
    if (Row row(builder, block, block.lines[first]); !softens && row.has(static_cast<int>(columns.size()))) {
      const double here = row.real(static_cast<int>(columns.size()), "temperature");
      if (temperature.value_or(here) != here) return no_tables(builder, block, block.lines[first].location);
      temperature = here;
    }
    result.rows.push_back(*values);
  } while (option->table && line < block.lines.size());
  if (line < block.lines.size()) return no_tables(builder, block, block.lines[line].location);
  present.push_back(std::move(result));
}

const RegisterKeyword material{{"MATERIAL", Phase::definitions, Place::model, {required(name("NAME")), text("DESCRIPTION")}, read_material}};
const RegisterKeyword density{{"DENSITY", Phase::definitions, Place::model, {}, read_density, "MATERIAL"}};
const RegisterKeyword damping{
    {"DAMPING", Phase::definitions, Place::model, {real("ALPHA"), real("BETA")}, read_damping, "MATERIAL"}};

/// Parameters of a keyword line, each once though several variants declare it.
class Parameters {
 public:
  explicit Parameters(KeywordRule& rule) : rule_(rule) {}
  void add(ParameterRule parameter) {
    const bool known =
        std::ranges::any_of(rule_.parameters, [&](const auto& rule) { return rule.name == parameter.name; });
    if (!known) rule_.parameters.push_back(std::move(parameter));
  }

 private:
  KeywordRule& rule_;
};

KeywordRule rule_of_law(const std::string& keyword) {
  KeywordRule rule{keyword, Phase::definitions, Place::model, {}, read_law, "MATERIAL"};
  Parameters parameters(rule);
  std::vector<std::string> variants;
  for (const auto* law : laws_of(squeeze(keyword))) {
    if (law->order > 0) parameters.add(integer("N"));
    if (law->variant.empty()) continue;
    if (std::ranges::find(variants, law->variant) == variants.end()) variants.push_back(law->variant);
    parameters.add(flag(law->variant));
  }
  if (std::ranges::find(variants, "ISOTROPIC") == variants.end()) variants.push_back("ISOTROPIC");
  parameters.add(choice("TYPE", variants));
  parameters.add(choice("MODULI", {"LONG TERM", "INSTANTANEOUS"}));
  return rule;
}

KeywordRule rule_of_option(const std::string& keyword) {
  KeywordRule rule{keyword, Phase::definitions, Place::model, {}, read_option, "MATERIAL"};
  Parameters parameters(rule);
  std::vector<std::string> variants;
  for (const auto* option : options_of(squeeze(keyword))) variants.push_back(option->variant);
  for (const auto* option : options_of(squeeze(keyword))) {
    if (!option->selector.empty()) parameters.add(choice(option->selector, variants));
    for (const auto& word : option->words)
      parameters.add(word.value.empty() ? flag(word.name) : choice(word.name, {word.value}));
    for (const auto& setting : option->settings) parameters.add(real(setting.name));
  }
  return rule;
}

/// Several laws, or options, share a keyword, and its rule tells of them all.
std::vector<RegisterKeyword> register_laws_and_options() {
  std::set<std::string> of_laws, of_options;
  for (const auto* law : material_laws()) of_laws.insert(law->keyword);
  for (const auto* option : material_options()) of_options.insert(option->keyword);
  std::vector<RegisterKeyword> registered;
  for (const auto& keyword : of_laws) registered.emplace_back(rule_of_law(keyword));
  for (const auto& keyword : of_options) registered.emplace_back(rule_of_option(keyword));
  return registered;
}

}  // namespace

void register_material_laws() {
  static const auto once = register_laws_and_options();
}

}  // namespace balocco::deck
