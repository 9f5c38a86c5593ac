#include "deck/surface_loads.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "deck/geometry.hpp"
#include "deck/load_magnitude.hpp"
#include "deck/steady_state.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

using Kind = SurfaceLoad::Kind;

struct SurfaceLabel {
  const char* name;
  Kind kind;
  bool has_direction = false, may_stay = false;  // a direction is given; FOLLOWER=NO may keep it
};

constexpr std::array surface_labels{SurfaceLabel{"P", Kind::pressure},
                                    SurfaceLabel{"TRVEC", Kind::traction, true, true},
                                    SurfaceLabel{"TRSHR", Kind::shear, true},
                                    SurfaceLabel{"EDLD", Kind::edge_traction, true, true},
                                    SurfaceLabel{"EDNOR", Kind::edge_normal},
                                    SurfaceLabel{"EDSHR", Kind::edge_shear},
                                    SurfaceLabel{"EDTRA", Kind::edge_transverse}};

const SurfaceLabel& label_of(Kind kind) { return *std::ranges::find(surface_labels, kind, &SurfaceLabel::kind); }

/// What the keyword's parameters say of a load. @return false, told, if they do not belong to its kind.
bool read_parameters(const Block& block, Row& row, const SurfaceLabel& label, SurfaceLoad& load) {
  if (block.has("FOLLOWER") && !label.may_stay) {
    row.error(fmt::format("FOLLOWER belongs to TRVEC and EDLD; {} always follows its surface: remove FOLLOWER, or give this line a keyword of "
                          "its own",
                          label.name));
    return false;
  }
  if (block.has("CONSTANT RESULTANT") && load.kind == Kind::pressure) {
    row.error("CONSTANT RESULTANT belongs to tractions; remove it, or give P a keyword of its own");
    return false;
  }
  load.follows = block.value("FOLLOWER", "YES") == "YES";
  load.of_reference = block.value("CONSTANT RESULTANT", "NO") == "YES";
  return true;
}

void place(Builder& builder, const SurfaceLoad& said) {
  auto& loads = current_step(builder).surface_loads;
  for (auto& other : loads) {
    if (other.surface != said.surface || other.kind != said.kind || acts_alike(other, said) || builder.draft.said_here(other)) continue;
    other.magnitude = 0.0;
    other.amplitude = -1;
  }
  auto found = std::ranges::find_if(loads, [&](const SurfaceLoad& load) { return acts_alike(load, said); });
  const double previous = found == loads.end() ? 0.0 : found->previous;
  if (found == loads.end()) found = loads.insert(loads.end(), said);
  *found = said;
  found->previous = previous;
  builder.draft.said.insert({said.file, said.line});
}

}  // namespace

std::optional<Kind> surface_load_kind(std::string_view label) {
  const auto found = std::ranges::find_if(surface_labels, [&](const SurfaceLabel& each) { return label == each.name; });
  return found == surface_labels.end() ? std::nullopt : std::optional(found->kind);
}

std::string surface_load_labels() {
  std::vector<std::string> names;
  std::ranges::transform(surface_labels, std::back_inserter(names), &SurfaceLabel::name);
  return join(names);
}

void read_surface_load_line(Builder& builder, const Block& block, Row& row, Kind kind, std::int32_t surface, std::int32_t amplitude) {
  const SurfaceLabel& label = label_of(kind);
  SurfaceLoad load{.kind = kind, .surface = surface};
  if (!read_parameters(block, row, label, load)) return;
  load.magnitude = scaled(builder, amplitude, row.real(2, kind == Kind::pressure ? "pressure" : "traction"));
  if (label.has_direction) load.direction = row.point(3, "direction");
  row.at_most(label.has_direction ? 6 : 3);
  if (!row.ok()) return;
  if (label.has_direction) {
    const double size = norm(load.direction);
    if (!(size > 0.0)) return row.error(fmt::format("the direction of {} has no length; give its three components after the magnitude", label.name));
    for (double& component : load.direction) component /= size;
  }
  load.imaginary = is_imaginary(builder, block);
  load.amplitude = amplitude;
  load.file = row.location().file;
  load.line = row.location().line;
  place(builder, load);
}

std::string surface_load_parameters(const SurfaceLoad& load) {
  return fmt::format("{}{}{}", load.follows ? "" : ", FOLLOWER=NO", load.of_reference ? ", CONSTANT RESULTANT=YES" : "",
                     part_parameter(load.imaginary));
}

std::string surface_load_text(const SurfaceLoad& load) {
  const SurfaceLabel& label = label_of(load.kind);
  return label.has_direction ? fmt::format("{}, {}, {}", label.name, load.magnitude, fmt::join(load.direction, ", "))
                             : fmt::format("{}, {}", label.name, load.magnitude);
}

}  // namespace balocco::deck
