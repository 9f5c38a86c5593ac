// *SPRING *DASHPOT.
#include <fmt/format.h>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/section_assignment.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

bool is_axial(const ElementType& type) { return type.name.back() == 'A'; }

/// The line "degree of freedom of the first node, of the second node" of elements that act in a fixed direction.
bool read_spring_freedoms(Builder& builder, const Block& block, const DataLine& line, const ElementType& type, SpringProperty& spring) {
  Row row(builder, block, line);
  for (int end = 0; end < type.nodes; ++end) {
    const std::int64_t freedom = row.integer(end, "degree of freedom of a node");
    if (row.ok() && (freedom < 1 || freedom > 6))
      row.error(fmt::format("degree of freedom {} of node {} of {} is out of range; displacements are 1 to 3, rotations 4 to 6",
                            freedom, end + 1, type.name));
    spring.freedom[end] = static_cast<std::int32_t>(freedom) - 1;
  }
  if (row.ok() && type.nodes == 2 && spring.freedom[0] / 3 != spring.freedom[1] / 3)
    row.error("one degree of freedom is a displacement and the other a rotation; give two of one kind");
  // Preprocessors write both for elements with one node, or a 0 for what is not there.
  if (type.nodes == 1 && row.has(1)) row.integer(1, "degree of freedom of a node");
  row.at_most(2);
  return row.ok();
}

/// Lines "force, relative displacement (velocity)", rising.
bool read_table(Builder& builder, const Block& block, std::span<const DataLine> lines, const char* argument,
                SpringProperty& spring) {
  for (const auto& line : lines) {
    Row row(builder, block, line);
    const double force = row.real(0, "force"), at = row.real(1, argument);
    row.at_most(2);
    if (row.ok() && !spring.table.empty() && !(at > spring.table.back()[0]))
      row.error(fmt::format("the {} {} does not rise above the one before, {}; list them in rising order", argument, at,
                            spring.table.back()[0]));
    if (!row.ok()) return false;
    spring.table.push_back({at, force});
  }
  if (spring.table.size() >= 2) return true;
  builder.error(block, block.location,
                fmt::format("NONLINEAR needs at least two lines: force, {}; add them or leave NONLINEAR out", argument));
  return false;
}

bool read_slope(Builder& builder, const Block& block, std::span<const DataLine> lines, const char* what,
                SpringProperty& spring) {
  if (lines.empty()) {
    builder.error(block, block.location, fmt::format("the {} is missing; add a data line", what));
    return false;
  }
  if (lines.size() > 1) {
    builder.error(block, lines[1].location,
                  fmt::format("a linear one has one line with its {}; remove this line or add NONLINEAR", what));
    return false;
  }
  Row row(builder, block, lines[0]);
  spring.slope = row.real(0, what);
  row.at_most(1);
  return row.ok();
}

void read(Builder& builder, const Block& block, Section::Kind kind, const char* slope, const char* argument) {
  std::vector<ElementRef> elements;
  auto section = begin_section(builder, block, elements);
  if (!section) return;
  section->kind = kind;
  const ElementType& type = *builder.model.elements[elements[0].table].type;
  if (type.section != kind) return assign_section(builder, block, *std::move(section), elements);  // refused there
  for (const auto element : elements)
    if (builder.model.elements[element.table].type != &type)
      return builder.error(block, block.location,
                           fmt::format("the set holds elements of types {} and {}, whose data lines differ; give each "
                                       "type a set of its own",
                                       type.name, builder.model.elements[element.table].type->name));
  std::span<const DataLine> lines = block.lines;
  if (!is_axial(type)) {
    if (lines.empty())
      return builder.error(block, block.location, "the degrees of freedom are missing; add a data line with them");
    if (!read_spring_freedoms(builder, block, lines[0], type, section->spring)) return;
    lines = lines.subspan(1);
  } else if (section->orientation >= 0) {
    return builder.error(block, block.location,
                         fmt::format("{} acts along the line of its nodes; remove ORIENTATION", type.name));
  }
  const bool good = block.has("NONLINEAR") ? read_table(builder, block, lines, argument, section->spring)
                                           : read_slope(builder, block, lines, slope, section->spring);
  if (good) assign_section(builder, block, *std::move(section), elements);
}

void read_spring(Builder& builder, const Block& block) {
  read(builder, block, Section::Kind::spring, "stiffness", "relative displacement");
}

void read_dashpot(Builder& builder, const Block& block) {
  read(builder, block, Section::Kind::dashpot, "damping coefficient", "relative velocity");
}

// RTOL tells Abaqus how coarsely it may resample a table; here tables are used as they are.
const std::vector<ParameterRule> spring_parameters{required(name("ELSET")), flag("NONLINEAR"), name("ORIENTATION"), real("RTOL")};
const RegisterKeyword spring{{"SPRING", Phase::sections, Place::model, spring_parameters, read_spring}};
const RegisterKeyword dashpot{{"DASHPOT", Phase::sections, Place::model, spring_parameters, read_dashpot}};

}  // namespace

}  // namespace balocco::deck
