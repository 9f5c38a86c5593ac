// *DLOAD *DSLOAD.
#include <fmt/format.h>

#include "deck/body_loads.hpp"
#include "deck/builder.hpp"
#include "deck/groups.hpp"
#include "deck/load_magnitude.hpp"
#include "deck/register.hpp"
#include "deck/surface_loads.hpp"
#include "deck/text.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

void renew_distributed(Builder& builder, const Block& block) {
  if (block.value("OP") != "NEW" || builder.draft.distributed_renewed) return;
  builder.draft.distributed_renewed = true;
  take_away(builder, current_step(builder).surface_loads);
  take_away(builder, current_step(builder).body_loads);
}

/// Whether a surface has what a load of its kind acts on; told if not.
bool takes(const Surface& surface, SurfaceLoad::Kind kind, Row& row) {
  if (acts_on_edges(kind) ? !surface.edges.empty() : surface.kind == Surface::Kind::element_faces) return true;
  row.error(acts_on_edges(kind)
                ? fmt::format("surface {} has no edges of sheets; make one of element sets and their edges E1 to E4", row.name(0))
                : fmt::format("surface {} has no element faces to press on; use a surface of TYPE=ELEMENT", row.name(0)));
  return false;
}

void read_surface_loads(Builder& builder, const Block& block) {
  renew_distributed(builder, block);
  const auto amplitude = amplitude_of(builder, block);
  if (!amplitude) return;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const auto surface = builder.require(builder.surfaces, row.name(0), block, line.location);
    const auto kind = surface_load_kind(row.name(1));
    if (!kind) {
      row.error(fmt::format("load type '{}' is not supported; allowed: {}", row.text(1), surface_load_labels()));
      continue;
    }
    if (surface && takes(builder.model.surfaces[*surface], *kind, row))
      read_surface_load_line(builder, block, row, *kind, *surface, *amplitude);
  }
}

/// A label of *DLOAD: the kind, and the number of the face or edge, if any, from 0 on.
struct ElementLabel {
  SurfaceLoad::Kind kind;
  std::optional<int> number;
};

std::optional<ElementLabel> element_label(std::string_view text) {
  std::optional<int> number;
  if (!text.empty() && text.back() >= '1' && text.back() <= '6') {
    number = text.back() - '1';
    text.remove_suffix(1);
  }
  const auto kind = surface_load_kind(text);
  return kind ? std::optional(ElementLabel{*kind, number}) : std::nullopt;
}

/// Adds the face or edge of an element that a label means to a surface: a solid's by number; a sheet's edge by number, its face without:
/// P on it acts along its normal, so on the negative side. @return false if the element has none.
bool add_part(const Model& model, ElementRef element, const ElementLabel& label, Surface& surface) {
  const ElementType& type = *model.elements[element.table].type;
  const bool sheet = type.section == Section::Kind::membrane || type.section == Section::Kind::shell;
  if (acts_on_edges(label.kind)) {
    if (!sheet || !label.number || *label.number >= type.nodes) return false;
    surface.edges.push_back({element, *label.number});
    return true;
  }
  const int face = sheet ? (label.number ? -1 : label.kind == SurfaceLoad::Kind::pressure ? 1 : 0)
                         : type.section == Section::Kind::solid ? label.number.value_or(-1) : -1;
  if (face < 0 || face >= static_cast<int>(type.faces.size())) return false;
  surface.faces.push_back({element, face});
  return true;
}

/// Surface of the faces or edges that a *DLOAD line acts on, made when first needed.
std::optional<std::int32_t> loaded_surface(Builder& builder, const Block& block, Row& row, const ElementLabel& label) {
  const std::string key = fmt::format("_DLOAD-{}-{}", row.name(0), row.name(1));
  if (const auto known = builder.find(builder.surfaces, key)) return known;
  std::vector<ElementRef> elements;
  if (!builder.elements_of(row.text(0), block, row.location(), elements)) return std::nullopt;
  Surface surface;
  surface.name = key;
  surface.location = row.location();
  for (const auto element : elements) {
    if (add_part(builder.model, element, label, surface)) continue;
    const ElementType& type = *builder.model.elements[element.table].type;
    row.error(fmt::format("element {} of type {} cannot take the load {}; solids take P1 to P6, TRVEC1 and TRSHR1 ... by face, membranes "
                          "and shells P, TRVEC and TRSHR, and EDNOR1 ... by edge, beams PX, PY and PZ along global axes",
                          builder.model.element_name(element), type.name, row.name(1)));
    return std::nullopt;
  }
  settle_edges(builder.model, surface);
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
    if (is_body_load(row.name(1))) {
      read_body_load(builder, block, row, *amplitude);
      continue;
    }
    const auto label = element_label(row.name(1));
    if (!label) {
      row.error(fmt::format("load type '{}' is not supported; allowed: P1 to P6, {}, {}", row.text(1), surface_load_labels(),
                            body_load_labels()));
      continue;
    }
    if (const auto surface = loaded_surface(builder, block, row, *label))
      read_surface_load_line(builder, block, row, label->kind, *surface, *amplitude);
  }
}

const std::vector<ParameterRule> distributed_parameters{choice("OP", {"MOD", "NEW"}), name("AMPLITUDE"), real("TIME DELAY"),
                                                        choice("FOLLOWER", {"YES", "NO"}), choice("CONSTANT RESULTANT", {"YES", "NO"}),
                                                        integer("LOAD CASE"), flag("REAL"), flag("IMAGINARY")};

const RegisterKeyword dload{{"DLOAD", Phase::history, Place::step, distributed_parameters, read_distributed}};
const RegisterKeyword dsload{{"DSLOAD", Phase::history, Place::step, distributed_parameters, read_surface_loads}};

}  // namespace

}  // namespace balocco::deck
