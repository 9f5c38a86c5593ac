// *CONNECTOR STOP, *CONNECTOR LOCK; in steps *CONNECTOR MOTION, *CONNECTOR LOAD.
#include "deck/connector_guides.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "constraints/nodal_directions.hpp"
#include "deck/joint_angles.hpp"
#include "deck/load_magnitude.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

std::array<std::array<double, 3>, 3> axes_at(const Model& model, const Connector& connector, int end, std::int32_t node) {
  const auto row = connector.orientation[end] >= 0 ? connector.orientation[end] : connector.orientation[0];
  if (row < 0) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto axes = local_axes(model.orientations[row], model.nodes.coordinates[node]);
  std::array<std::array<double, 3>, 3> result{};
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) result[i][c] = axes(i, c);
  return result;
}

std::optional<int> component_of(Builder& builder, const Block& block) {
  const auto component = block.integer("COMPONENT", 0);
  if (component >= 1 && component <= 6) return static_cast<int>(component) - 1;
  builder.error(block, block.location, fmt::format("COMPONENT={} is out of range; translations are 1 to 3, rotations 4 to 6", component));
  return std::nullopt;
}

namespace {

/// Row of Model::constraints of an element's guide, or where it would come.
std::size_t find_guide(const Model& model, ElementRef element) {
  const auto is_it = [&](const ConstraintDefinition& definition) {
    return definition.element == element && std::holds_alternative<Guide>(definition.kind);
  };
  return static_cast<std::size_t>(std::ranges::find_if(model.constraints, is_it) - model.constraints.begin());
}

std::size_t guide_of(Builder& builder, const Connector& connector, ElementRef element) {
  auto& model = builder.model;
  const auto place = find_guide(model, element);
  if (place < model.constraints.size()) return place;
  const auto& table = model.elements[element.table];
  const auto* nodes = &table.connectivity[2 * static_cast<std::size_t>(element.row)];
  Guide guide{.nodes = {nodes[0], nodes[1]}};
  guide.axes = axes_at(model, connector, 0, nodes[0]);
  guide.second_axes = axes_at(model, connector, 1, nodes[1]);
  guide.kind = connector;
  const auto is_joint = [&](const ConstraintDefinition& definition) { return definition.element == element; };
  const auto joint = std::ranges::find_if(model.constraints, is_joint);
  if (joint != model.constraints.end()) guide.joint = static_cast<std::int32_t>(joint - model.constraints.begin());
  const auto location = table.location[element.row];
  model.constraints.push_back({std::move(guide), fmt::format("*CONNECTOR SECTION ({})", connector.type), location.file, location.line, element});
  return place;
}

int row_of_component(Guide& guide, int component) {
  const auto found = std::ranges::find(guide.rows, component, &Guide::Row::component);
  const auto row = static_cast<int>(found - guide.rows.begin());
  if (found == guide.rows.end()) guide.rows.push_back({.component = component});
  return row;
}

/// Limits of a position; a blank one is none.
std::optional<Guide::Range> read_range(Builder& builder, const Block& block) {
  if (block.lines.empty()) {
    builder.error(block, block.location, "the limits are missing; add a data line: lower limit, upper limit of the position, one of which may be blank");
    return std::nullopt;
  }
  Row row(builder, block, block.lines[0]);
  Guide::Range range = Guide::everywhere;
  for (int side = 0; side < 2; ++side) range[side] = row.real_or(side, range[side], side == 0 ? "lower limit" : "upper limit");
  row.at_most(2);
  if (row.ok() && !(range[0] < range[1]))
    row.error(fmt::format("the lower limit {} is not below the upper one, {}; correct them", range[0], range[1]));
  return row.ok() ? std::optional(range) : std::nullopt;
}

void read_stop(Builder& builder, const Block& block) {
  const auto component = component_of(builder, block);
  const auto range = read_range(builder, block);
  if (component && range) guide_of_behavior(builder, *component).stop = *range;
}

void read_lock(Builder& builder, const Block& block) {
  const auto component = component_of(builder, block);
  const auto range = read_range(builder, block);
  const std::string locked = block.value("LOCK", "ALL");
  if (locked != "ALL" && component && locked != std::to_string(*component + 1))
    return builder.error(block, block.location,
                         fmt::format("LOCK={} is not supported; lock ALL components, or the one whose limits these are, {}", locked, *component + 1));
  if (!component || !range) return;
  auto& row = guide_of_behavior(builder, *component);
  row.lock = *range;
  row.locks_all = locked == "ALL";
}

/// Row of the guide that a data line "element or set, component, ..." speaks of, for each of its elements.
struct Actuated {
  std::int32_t guide = -1;
  int row = 0;
};

std::vector<Actuated> read_actuated(Builder& builder, const Block& block, Row& row) {
  std::vector<ElementRef> elements;
  const auto component = row.integer(1, "component");
  if (row.ok() && (component < 1 || component > 6))
    row.error(fmt::format("component {} does not exist; translations are 1 to 3, rotations 4 to 6", component));
  if (!row.ok() || !builder.elements_of(row.text(0), block, row.location(), elements)) return {};
  std::vector<Actuated> result;
  auto& model = builder.model;
  for (const auto element : elements) {
    const auto& table = model.elements[element.table];
    const auto section = table.section[element.row];
    const auto index = section >= 0 ? model.sections[section].connector : -1;
    if (index < 0) {
      row.error(fmt::format("element {} is no connector; name elements of type CONN3D2", model.element_name(element)));
      return {};
    }
    const auto& connector = model.connectors[index];
    if (!connector.available[component - 1]) {
      row.error(fmt::format("component {} of element {} is not left free by {}; name one that is", component, model.element_name(element), connector.type));
      return {};
    }
    const auto guide = guide_of(builder, connector, element);
    const int place = row_of_component(std::get<Guide>(model.constraints[guide].kind), static_cast<int>(component) - 1);
    result.push_back({static_cast<std::int32_t>(guide), place});
  }
  return result;
}

void read_motion(Builder& builder, const Block& block) {
  auto& motions = current_step(builder).connector_motions;
  if (block.value("OP") == "NEW") std::erase_if(motions, [&](const auto& motion) { return motion.course.propagated && !is_of_angle(builder.model, motion); });
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    ConnectorMotion motion;
    motion.course.kind = kind_of_motion(block);
    motion.course.amplitude = *amplitude;
    motion.course.fixed = block.has("FIXED");
    motion.course.file = line.location.file;
    motion.course.line = line.location.line;
    const double magnitude = row.real_or(2, 0.0, "magnitude");
    row.at_most(3);
    if (motion.course.fixed && magnitude != 0.0) row.error("FIXED takes no magnitude; remove field 3");
    motion.course.magnitude = scaled(builder, *amplitude, magnitude);
    for (const auto& actuated : read_actuated(builder, block, row)) {
      motion.guide = actuated.guide;
      motion.row = actuated.row;
      const auto same = std::ranges::find_if(motions, [&](const auto& other) { return other.guide == motion.guide && other.row == motion.row; });
      if (same != motions.end())
        *same = motion;
      else
        motions.push_back(motion);
    }
  }
}

void read_load(Builder& builder, const Block& block) {
  auto& loads = current_step(builder).connector_loads;
  if (block.value("OP") == "NEW") take_away(builder, loads, [&](const auto& load) { return !is_of_angle(builder.model, load); });
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const double magnitude = row.real(2, "magnitude");
    row.at_most(3);
    for (const auto& actuated : read_actuated(builder, block, row)) {
      auto same =
          std::ranges::find_if(loads, [&](const auto& other) { return other.guide == actuated.guide && other.row == actuated.row; });
      if (same == loads.end()) same = loads.insert(loads.end(), {.guide = actuated.guide, .row = actuated.row});
      same->magnitude = scaled(builder, *amplitude, magnitude);
      same->amplitude = *amplitude;
      same->file = line.location.file;
      same->line = line.location.line;
      builder.draft.said.insert({same->file, same->line});
    }
  }
}

const RegisterKeyword stop{{"CONNECTOR STOP", Phase::definitions, Place::model, {required(integer("COMPONENT"))}, read_stop, "CONNECTOR BEHAVIOR"}};
const RegisterKeyword lock{
    {"CONNECTOR LOCK", Phase::definitions, Place::model, {required(integer("COMPONENT")), text("LOCK")}, read_lock, "CONNECTOR BEHAVIOR"}};
const RegisterKeyword motion{{"CONNECTOR MOTION",
                              Phase::history,
                              Place::step,
                              {choice("OP", {"MOD", "NEW"}), choice("TYPE", {"DISPLACEMENT", "VELOCITY", "ACCELERATION"}), name("AMPLITUDE"),
                               real("TIME DELAY"), flag("FIXED")},
                              read_motion}};
const RegisterKeyword load{{"CONNECTOR LOAD",
                            Phase::history,
                            Place::step,
                            {choice("OP", {"MOD", "NEW"}), name("AMPLITUDE"), real("TIME DELAY")},
                            read_load}};

}  // namespace

Guide::Row& guide_of_behavior(Builder& builder, int component) {
  auto& row = builder.connector_behavior->component[component].guide;
  if (!row) row = Guide::Row{.component = component};
  return *row;
}

Guide::Row& guide_row(Builder& builder, const Connector& connector, ElementRef element, int component) {
  auto& guide = std::get<Guide>(builder.model.constraints[guide_of(builder, connector, element)].kind);
  return guide.rows[row_of_component(guide, component)];
}

}  // namespace balocco::deck
