// *DLOAD *DSLOAD.
#include <fmt/format.h>

#include <algorithm>

#include "deck/body_loads.hpp"
#include "deck/builder.hpp"
#include "deck/load_magnitude.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

void renew_distributed(Builder& builder, const Block& block) {
  if (block.value("OP") != "NEW" || builder.draft.distributed_renewed) return;
  builder.draft.distributed_renewed = true;
  take_away(builder, current_step(builder).pressures);
  take_away(builder, current_step(builder).body_loads);
}

void set_pressure(Builder& builder, std::int32_t surface, double magnitude, std::int32_t amplitude, Location location) {
  auto& pressures = current_step(builder).pressures;
  auto found = std::find_if(pressures.begin(), pressures.end(),
                            [&](const PressureLoad& load) { return load.surface == surface; });
  if (found == pressures.end()) found = pressures.insert(pressures.end(), PressureLoad{surface});
  found->magnitude = scaled(builder, amplitude, magnitude);
  found->amplitude = amplitude;
  found->file = location.file;
  found->line = location.line;
  builder.draft.said.insert({location.file, location.line});
}

void read_surface_load(Builder& builder, const Block& block) {
  renew_distributed(builder, block);
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const auto surface = builder.require(builder.surfaces, row.name(0), block, line.location);
    if (row.name(1) != "P") {
      row.error(fmt::format("load type '{}' is not supported; allowed: P", row.text(1)));
      continue;
    }
    const double magnitude = row.real(2, "pressure");
    row.at_most(3);
    if (!row.ok() || !surface) continue;
    if (builder.model.surfaces[*surface].kind != Surface::Kind::element_faces) {
      row.error(fmt::format("surface {} has no element faces to press on; use a surface of TYPE=ELEMENT", row.name(0)));
      continue;
    }
    set_pressure(builder, *surface, magnitude, *amplitude, line.location);
  }
}

/// Face that Pn or P presses on; P on a membrane or shell acts along its normal, so on the negative side.
int pressed_face(const ElementType& type, const std::string& label) {
  if (type.section == Section::Kind::membrane || type.section == Section::Kind::shell) return label == "P" && type.faces.size() > 1 ? 1 : -1;
  if (type.section != Section::Kind::solid || label.size() != 2) return -1;
  const int face = label[1] - '1';
  return face >= 0 && face < static_cast<int>(type.faces.size()) ? face : -1;
}

/// Surface of the faces that a *DLOAD line presses on, made when first needed.
std::optional<std::int32_t> pressed_surface(Builder& builder, const Block& block, Row& row) {
  const std::string label = row.name(1), key = fmt::format("_DLOAD-{}-{}", row.name(0), label);
  if (const auto known = builder.find(builder.surfaces, key)) return known;
  std::vector<ElementRef> elements;
  if (!builder.elements_of(row.text(0), block, row.location(), elements)) return std::nullopt;
  Surface surface;
  surface.name = key;
  surface.location = row.location();
  for (const auto element : elements) {
    const ElementType& type = *builder.model.elements[element.table].type;
    const int face = pressed_face(type, label);
    if (face < 0) {
      row.error(fmt::format("element {} of type {} cannot take the load {}; solids take P1 to P6 by face, membranes and shells P, "
                            "beams PX, PY and PZ along global axes",
                            builder.model.element_name(element), type.name, label));
      return std::nullopt;
    }
    surface.faces.push_back({element, face});
  }
  const auto number = static_cast<std::int32_t>(builder.model.surfaces.size());
  builder.surfaces.rows.emplace(key, number);
  builder.model.surfaces.push_back(std::move(surface));
  return number;
}

void read_distributed(Builder& builder, const Block& block) {
  renew_distributed(builder, block);
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const std::string label = row.name(1);
    if (is_body_load(label)) {
      read_body_load(builder, block, row, *amplitude);
      continue;
    }
    if (label != "P" && !(label.size() == 2 && label[0] == 'P')) {
      row.error(fmt::format("load type '{}' is not supported; allowed: P, P1 to P6, {}", row.text(1), body_load_labels()));
      continue;
    }
    const double magnitude = row.real(2, "pressure");
    row.at_most(3);
    if (!row.ok()) continue;
    if (const auto surface = pressed_surface(builder, block, row)) {
      set_pressure(builder, *surface, magnitude, *amplitude, line.location);
    }
  }
}

const RegisterKeyword dload{
    {"DLOAD", Phase::history, Place::step, {choice("OP", {"MOD", "NEW"}), name("AMPLITUDE"), real("TIME DELAY")}, read_distributed}};
const RegisterKeyword dsload{
    {"DSLOAD", Phase::history, Place::step, {choice("OP", {"MOD", "NEW"}), name("AMPLITUDE"), real("TIME DELAY")}, read_surface_load}};

}  // namespace

}  // namespace balocco::deck
