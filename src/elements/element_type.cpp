#include "elements/element_type.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

namespace balocco {

namespace {

// A function-local table: registrations run before main, in any order of translation units.
std::map<std::string, ElementType, std::less<>>& table() {
  static std::map<std::string, ElementType, std::less<>> types;
  return types;
}

}  // namespace

const ElementType* find_element_type(std::string_view name) {
  const auto found = table().find(name);
  return found == table().end() ? nullptr : &found->second;
}

std::vector<const ElementType*> element_types() {
  std::vector<const ElementType*> types;
  for (const auto& entry : table()) types.push_back(&entry.second);
  return types;
}

std::vector<int> nodes_of_face(const ElementType& type, int face) {
  std::vector<int> nodes = type.faces[face];
  if (!type.face_midsides.empty()) nodes.insert(nodes.end(), type.face_midsides[face].begin(), type.face_midsides[face].end());
  return nodes;
}

bool is_rigid(const Model& model, const Surface& surface) {
  if (surface.kind == Surface::Kind::analytical) return true;
  return !surface.faces.empty() && std::ranges::all_of(surface.faces, [&](const FaceRef& face) {
    return model.elements[face.element.table].type->section == Section::Kind::rigid;
  });
}

bool deforms(const Model& model, const Surface& surface) { return !surface.faces.empty() && !is_rigid(model, surface); }

RegisterElement::RegisterElement(ElementType type) {
  const std::string name = type.name;
  if (!table().emplace(name, std::move(type)).second) throw std::logic_error("element type " + name + " is registered twice");
}

}  // namespace balocco
