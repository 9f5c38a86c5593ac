// Options of a *MATERIAL beside its elastic law: hardening, rate dependence, viscosity. Each is declared once; the deck
// reader, its messages, the deck writer and the laws' constructors all use that declaration.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "materials/material_law.hpp"

namespace balocco {

struct MaterialOption;

/// A word of the keyword line that must stand as it is: TIME=PRONY, or a flag where the value is empty.
struct FixedWord {
  std::string name, value;
};

struct OptionSpec {
  std::string name;      // "plastic-kinematic"
  std::string keyword;   // "PLASTIC"
  std::string selector;  // parameter of the keyword line that chooses among options of one keyword: "HARDENING"
  std::string variant;   // its value, "KINEMATIC"
  bool is_default = false;  // the one that is meant where the selector is left out
  std::vector<FixedWord> words;
  std::vector<ParameterSpec> settings;  // numbers on the keyword line, zero where left out
  std::vector<ParameterSpec> columns;   // of a data line; zero where it ends early and zero is in range
  int repeated_columns = 0;             // the last so many columns stand as often as the first setting says
  bool table = false;                   // any number of data lines, else exactly one
  bool repeatable = false;              // the keyword may stand more than once: RATE=
};

const OptionSpec* find_material_option(std::string_view name);
std::vector<const OptionSpec*> material_options();

/// The option of that name among those of a material, or nullptr.
const MaterialOption* find_option(const Material& material, std::string_view name);

struct RegisterOption {
  explicit RegisterOption(OptionSpec option);
};

}  // namespace balocco
