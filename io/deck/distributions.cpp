// *DISTRIBUTION TABLE *DISTRIBUTION.
#include "deck/distributions.hpp"

#include <fmt/format.h>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"

namespace balocco::deck {

namespace {

void read_distribution_table(Builder& builder, const Block& block) {
  auto& kinds = builder.distribution_tables[block.value("NAME")];
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field)
      if (row.has(field)) kinds.push_back(row.name(field));
  }
  if (kinds != std::vector<std::string>{"COORD3D", "COORD3D"} && kinds != std::vector<std::string>{"LENGTH"})
    builder.error(block, block.location,
                  "directions are distributed, whose table is COORD3D, COORD3D, and thicknesses of shells, whose table is LENGTH; give one of these");
}

std::optional<std::array<Point, 3>> read_directions(Builder& builder, Row& row) {
  const Point a = row.point(1, "point a"), b = row.point(4, "point b");
  row.at_most(7);
  if (!row.ok()) return std::nullopt;
  auto axes = axes_of_points({}, a, b);
  if (!axes) row.error("points a and b define no axes; give points that do not lie on a line with the origin");
  if (axes)
    for (auto& axis : *axes) axis = builder.scope->turn(axis);
  return axes;
}

std::optional<double> read_length(Row& row) {
  const double length = row.real(1, "length");
  row.at_most(2);
  if (row.ok() && !(length > 0.0)) row.error(fmt::format("length {} must be positive; correct it", length));
  return row.ok() ? std::optional(length) : std::nullopt;
}

/// What a line says of an element, of a set, or, where its first field is empty, of all others.
template <class Value>
void distribute(Builder& builder, const Block& block, Row& row, const Value& value, Distributed<Value>& distributed) {
  if (!row.has(0)) {
    distributed.otherwise = value;
    return;
  }
  std::vector<ElementRef> elements;
  if (!builder.elements_of(row.text(0), block, row.location(), elements)) return;
  for (const auto element : elements)
    if (!distributed.own.emplace(element, value).second)
      return row.error(fmt::format("element {} has its own already; name it once", builder.model.element_name(element)));
}

/// CalculiX's decks name no table: theirs are directions.
void read_distribution(Builder& builder, const Block& block) {
  const auto full = builder.define(builder.distributions, block.value("NAME"), static_cast<std::int32_t>(builder.distribution.size()), block);
  if (!full) return;
  auto& distribution = builder.distribution.emplace_back();
  if (block.has("TABLE")) {
    const auto table = builder.distribution_tables.find(block.value("TABLE"));
    if (table == builder.distribution_tables.end())
      return builder.error(block, block.location,
                           fmt::format("table {} is not defined; define it under *DISTRIBUTION TABLE", block.value("TABLE")));
    distribution.of_lengths = table->second.size() == 1;
  }
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    if (distribution.of_lengths) {
      if (const auto length = read_length(row)) distribute(builder, block, row, *length, distribution.lengths);
    } else if (const auto axes = read_directions(builder, row)) {
      distribute(builder, block, row, *axes, distribution.directions);
    }
  }
}

const RegisterKeyword distribution_table_keyword{
    {"DISTRIBUTION TABLE", Phase::definitions, Place::model, {required(name("NAME"))}, read_distribution_table}};
const RegisterKeyword distribution_keyword{{"DISTRIBUTION",
                                            Phase::surfaces,
                                            Place::model,
                                            {required(name("NAME")), choice("LOCATION", {"ELEMENT"}), name("TABLE")},
                                            read_distribution}};

}  // namespace

}  // namespace balocco::deck
