#include "materials/material_law.hpp"

#include <functional>
#include <map>

namespace balocco {

namespace {

// A function-local table: registrations run before main, in any order of translation units.
std::map<std::string, MaterialLaw, std::less<>>& table() {
  static std::map<std::string, MaterialLaw, std::less<>> laws;
  return laws;
}

}  // namespace

const MaterialLaw* find_material_law(std::string_view name) {
  const auto found = table().find(name);
  return found == table().end() ? nullptr : &found->second;
}

std::vector<const MaterialLaw*> material_laws() {
  std::vector<const MaterialLaw*> laws;
  for (const auto& entry : table()) laws.push_back(&entry.second);
  return laws;
}

RegisterLaw::RegisterLaw(MaterialLaw law) {
  const std::string name = law.name;
  table().insert_or_assign(name, std::move(law));
}

}  // namespace balocco
