#include "materials/material_option.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "model/model.hpp"

namespace balocco {

namespace {

std::map<std::string, OptionSpec, std::less<>>& options_by_name() {
  static std::map<std::string, OptionSpec, std::less<>> options;
  return options;
}

}  // namespace

const OptionSpec* find_material_option(std::string_view name) {
  const auto found = options_by_name().find(name);
  return found == options_by_name().end() ? nullptr : &found->second;
}

std::vector<const OptionSpec*> material_options() {
  std::vector<const OptionSpec*> options;
  for (const auto& entry : options_by_name()) options.push_back(&entry.second);
  return options;
}

const MaterialOption* find_option(const Material& material, std::string_view name) {
  const auto found = std::ranges::find(material.options, name, &MaterialOption::name);
  return found == material.options.end() ? nullptr : &*found;
}

RegisterOption::RegisterOption(OptionSpec option) {
  const std::string name = option.name;
  if (!options_by_name().emplace(name, std::move(option)).second) throw std::logic_error("material option " + name + " is registered twice");
}

}  // namespace balocco
