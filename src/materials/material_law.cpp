#include "materials/material_law.hpp"

#include <functional>
#include <map>
#include <stdexcept>

#include "model/model.hpp"

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

template <PointKind kind>
std::unique_ptr<Law<kind>> make_law(const Material& material) {
  const MaterialLaw* law = find_material_law(material.law);
  const LawMaker<kind> make = law == nullptr ? nullptr : law->maker<kind>();
  return make == nullptr ? nullptr : make(material);
}

template std::unique_ptr<Law<PointKind::solid>> make_law<PointKind::solid>(const Material&);
template std::unique_ptr<Law<PointKind::plane>> make_law<PointKind::plane>(const Material&);
template std::unique_ptr<Law<PointKind::line>> make_law<PointKind::line>(const Material&);
template std::unique_ptr<Law<PointKind::fibre>> make_law<PointKind::fibre>(const Material&);

RegisterLaw::RegisterLaw(MaterialLaw law) {
  const std::string name = law.name;
  if (!table().emplace(name, std::move(law)).second) throw std::logic_error("material law " + name + " is registered twice");
}

}  // namespace balocco
