// *CONNECTOR FRICTION and *CONNECTOR DERIVED COMPONENT; the coefficient follows as *FRICTION.
#include <fmt/format.h>

#include "deck/connector_guides.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// A line of components and one of their factors: the norm of the products. Given again under one name, norms add up.
void read_derived(Builder& builder, const Block& block) {
  if (block.lines.empty()) return builder.error(block, block.location, "the components are missing; add a line of them, and one of their factors");
  Row components(builder, block, block.lines[0]);
  std::array<double, 6> arms{};
  std::vector<int> listed;
  for (int field = 0; field < components.size(); ++field) {
    if (!components.has(field)) continue;
    const auto component = components.integer(field, "component");
    if (components.ok() && (component < 1 || component > 6))
      components.error(fmt::format("component {} does not exist; translations are 1 to 3, rotations 4 to 6", component));
    if (!components.ok()) return;
    listed.push_back(static_cast<int>(component) - 1);
  }
  for (const int component : listed) arms[component] = 1.0;
  if (block.lines.size() > 1) {
    Row factors(builder, block, block.lines[1]);
    for (std::size_t i = 0; i < listed.size(); ++i) arms[listed[i]] = factors.real_or(static_cast<int>(i), 1.0, "factor");
    factors.at_most(static_cast<int>(listed.size()));
  }
  builder.derived_components[block.value("NAME")].push_back(arms);
}

/// The force that presses the parts together: an internal one, and those of held components.
void read_connector_friction(Builder& builder, const Block& block) {
  if (block.has("PREDEFINED"))
    return builder.error(block, block.location,
                         "PREDEFINED is not supported; say COMPONENT=, and CONTACT FORCE= with a *CONNECTOR DERIVED COMPONENT or an internal force");
  const auto component = component_of(builder, block);
  if (!component) return;
  Guide::Friction friction;
  if (!block.lines.empty()) {
    Row row(builder, block, block.lines[0]);
    friction.internal = row.real_or(0, 0.0, "internal contact force");
    row.at_most(1);
    if (row.ok() && friction.internal < 0.0) row.error(fmt::format("internal contact force {} must not be negative; correct it", friction.internal));
  }
  if (block.has("CONTACT FORCE")) {
    const std::string pressed = block.value("CONTACT FORCE");
    const auto derived = builder.derived_components.find(pressed);
    const auto number = parse_integer(pressed);
    if (derived != builder.derived_components.end()) {
      friction.terms = derived->second;
    } else if (number && *number >= 1 && *number <= 6) {
      friction.terms.emplace_back()[static_cast<std::size_t>(*number) - 1] = 1.0;
    } else {
      return builder.error(block, block.location,
                           fmt::format("CONTACT FORCE={} is neither a component, 1 to 6, nor a *CONNECTOR DERIVED COMPONENT of this behavior; define it above",
                                       pressed));
    }
  }
  auto& row = guide_of_behavior(builder, *component);
  row.friction = std::move(friction);
  builder.connector_friction = &*row.friction;
}

const RegisterKeyword derived{
    {"CONNECTOR DERIVED COMPONENT", Phase::definitions, Place::model, {required(name("NAME")), choice("OPERATOR", {"NORM"})}, read_derived, "CONNECTOR BEHAVIOR"}};
const RegisterKeyword connector_friction{{"CONNECTOR FRICTION",
                                          Phase::definitions,
                                          Place::model,
                                          {required(integer("COMPONENT")), name("CONTACT FORCE"), flag("PREDEFINED")},
                                          read_connector_friction,
                                          "CONNECTOR BEHAVIOR"}};

}  // namespace

}  // namespace balocco::deck
