#include "builders/car/linkage_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "builders/car/body_deck.hpp"

namespace balocco::car {

void LinkageText::rigid(const RigidPart& part, const std::vector<std::int64_t>& points) {
  const auto& name = part.name;
  const auto node = deck_.named_node(name, part.centre);
  if (part.mass > 0.0) write_mass(name, node, part.mass, part.size, deck_);
  const auto surface = part.surface.empty() ? std::string() : fmt::format(", ANALYTICAL SURFACE={}", part.surface);
  if (points.empty()) return deck_.line("*RIGID BODY, REF NODE={}{}", node, surface);
  deck_.line("*NSET, NSET=P_{}", name);
  deck_.numbers(points);
  deck_.line("*RIGID BODY, REF NODE={}, TIE NSET=P_{}{}", node, name, surface);
}

void LinkageText::curve(const char* kind, const Characteristic& characteristic) {
  deck_.line("*CONNECTOR {}, COMPONENT={}{}", kind, characteristic.component, characteristic.table.empty() ? "" : ", NONLINEAR");
  if (characteristic.table.empty()) return deck_.line("{:g}", characteristic.slope);
  for (const auto& [force, at] : characteristic.table) deck_.line("{:.6g}, {:.6g}", force, at);
}

void LinkageText::behaviour(const Behaviour& behaviour) {
  deck_.line("*CONNECTOR BEHAVIOR, NAME={}", behaviour.name);
  for (const auto& elasticity : behaviour.elasticity) curve("ELASTICITY", elasticity);
  for (const auto& damping : behaviour.damping) curve("DAMPING", damping);
  if (behaviour.free_length > 0.0) deck_.line("*CONNECTOR CONSTITUTIVE REFERENCE\n{:.6f}", behaviour.free_length);
}

void LinkageText::connector(const std::string& name, const std::string& type, std::int64_t first, std::int64_t second,
                            const std::string& orientation, const std::string& behaviour) {
  deck_.line("*ELEMENT, TYPE=CONN3D2, ELSET={}\n{}, {}, {}", name, deck_.next_element(), first, second);
  deck_.line("*CONNECTOR SECTION, ELSET={}{}\n{}", name, behaviour.empty() ? "" : ", BEHAVIOR=" + behaviour, type);
  if (!orientation.empty()) deck_.line("{}", orientation);
}

void LinkageText::orientation(const std::string& name, const Vector& axis) {
  const auto along = unit(axis);
  const auto aside = unit(cross(along, std::abs(along[0]) < 0.9 ? Vector{1.0, 0.0, 0.0} : Vector{0.0, 1.0, 0.0}));
  deck_.line("*ORIENTATION, NAME={}\n{:.9f}, {:.9f}, {:.9f}, {:.9f}, {:.9f}, {:.9f}", name, along[0], along[1], along[2], aside[0],
             aside[1], aside[2]);
}

}  // namespace balocco::car
