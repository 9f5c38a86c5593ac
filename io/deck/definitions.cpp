// *HEADING *UNITS *PREPRINT *AMPLITUDE *ORIENTATION *TRANSFORM *TIME POINTS, and the structure keywords that the
// schedule handles.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

void read_heading(Builder& builder, const Block& block) {
  for (const auto& line : block.lines) {
    if (!builder.model.heading.empty()) builder.model.heading += '\n';
    builder.model.heading += line.text;
  }
}

void read_units(Builder& builder, const Block& block) {
  const auto raw = [&](const char* parameter) {
    return block.has(parameter) ? block.find(parameter)->raw : std::string();
  };
  builder.model.units = {raw("LENGTH"), raw("MASS"), raw("TIME")};
}

/// All numbers of a block's lines, in order.
bool numbers_of(Builder& builder, const Block& block, const char* what, std::vector<double>& numbers,
                std::vector<Location>& locations) {
  bool good = true;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field) {
      numbers.push_back(row.real(field, what));
      locations.push_back(line.location);
    }
    good = good && row.ok();
  }
  return good;
}

void fill_tabular(Builder& builder, const Block& block, Amplitude& amplitude, const std::vector<double>& numbers,
                  const std::vector<Location>& locations) {
  if (squeeze(block.value("DEFINITION")) == "EQUALLYSPACED") {
    const double interval = block.real("FIXED INTERVAL", 0.0), begin = block.real("BEGIN", 0.0);
    if (!(interval > 0.0))
      return builder.error(block, block.location, "FIXED INTERVAL must be positive; add FIXED INTERVAL=...");
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      amplitude.points.push_back({begin + interval * static_cast<double>(k), numbers[k]});
    }
    return;
  }
  if (numbers.size() % 2 != 0) {
    return builder.error(block, locations.back(), "times and values must come in pairs; one value is missing");
  }
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) {
    if (k > 0 && !(numbers[k] > numbers[k - 2])) {
      return builder.error(
          block, locations[k],
          fmt::format("time {} does not come after {}; times must increase", numbers[k], numbers[k - 2]));
    }
    amplitude.points.push_back({numbers[k], numbers[k + 1]});
  }
}

void fill_periodic(Builder& builder, const Block& block, Amplitude& amplitude) {
  Row first(builder, block, block.lines[0]);
  const std::int64_t terms = first.integer(0, "number of terms");
  amplitude.circular_frequency = first.real(1, "circular frequency");
  amplitude.start = first.real_or(2, 0.0, "start time");
  amplitude.initial = first.real_or(3, 0.0, "initial value");
  first.at_most(4);
  std::vector<double> numbers;
  for (std::size_t line = 1; line < block.lines.size(); ++line) {
    Row row(builder, block, block.lines[line]);
    for (int field = 0; field < row.size(); ++field) numbers.push_back(row.real(field, "Fourier coefficient"));
    if (!row.ok()) return;
  }
  if (!first.ok()) return;
  if (terms < 1 || static_cast<std::int64_t>(numbers.size()) != 2 * terms) {
    return first.error(
        fmt::format("{} terms need {} coefficients A1, B1, A2, B2 ..., but {} follow; correct one of them", terms,
                    2 * terms, numbers.size()));
  }
  for (std::size_t k = 0; k < numbers.size(); k += 2) amplitude.harmonics.push_back({numbers[k], numbers[k + 1]});
}

void read_amplitude(Builder& builder, const Block& block) {
  const auto full = builder.define(builder.amplitudes, block.value("NAME"),
                                   static_cast<std::int32_t>(builder.model.amplitudes.size()), block);
  if (!full) return;
  Amplitude amplitude;
  amplitude.name = *full;
  amplitude.total_time = block.value("TIME").starts_with("TOTAL");
  const std::string definition = squeeze(block.value("DEFINITION", "TABULAR"));
  if (definition == "SMOOTHSTEP") amplitude.kind = Amplitude::Kind::smooth_step;
  if (definition == "PERIODIC") amplitude.kind = Amplitude::Kind::periodic;
  if (block.value("VALUE") == "ABSOLUTE") {
    builder.absolute_amplitudes.insert(static_cast<std::int32_t>(builder.model.amplitudes.size()));
  }
  if (block.lines.empty()) {
    builder.error(block, block.location, "it has no data; add lines of time, value");
  } else if (amplitude.kind == Amplitude::Kind::periodic) {
    fill_periodic(builder, block, amplitude);
  } else {
    std::vector<double> numbers;
    std::vector<Location> locations;
    if (numbers_of(builder, block, "time or value", numbers, locations)) {
      fill_tabular(builder, block, amplitude, numbers, locations);
    }
  }
  builder.model.amplitudes.push_back(std::move(amplitude));
}

/// Point of fields `first`.. of a row.
Point point_of(Row& row, int first, const char* what) {
  Point point;
  for (int i = 0; i < 3; ++i) point[i] = row.real_or(first + i, 0.0, what);
  return point;
}

/// Axes of a cylindrical system about the line from a to b.
std::optional<std::array<Point, 3>> cylindrical_axes(const Point& a, const Point& b) {
  Point axis = subtract(b, a);
  const double length = norm(axis);
  if (!(length > 0.0)) return std::nullopt;
  for (double& component : axis) component /= length;
  return axes_about(axis);
}

void read_orientation(Builder& builder, const Block& block) {
  Orientation orientation;
  const auto full = builder.define(builder.orientations, block.value("NAME"),
                                   static_cast<std::int32_t>(builder.model.orientations.size()), block);
  if (!full) return;
  orientation.name = *full;
  if (block.lines.empty()) {
    builder.error(block, block.location, "it has no data; add the points a, b (and c)");
  } else {
    Row row(builder, block, block.lines[0]);
    const bool cylindrical = block.value("SYSTEM") == "CYLINDRICAL";
    const Point a = point_of(row, 0, "point a"), b = point_of(row, 3, "point b"), c = point_of(row, 6, "point c");
    row.at_most(cylindrical ? 6 : 9);
    orientation.system = cylindrical ? Orientation::System::cylindrical : Orientation::System::rectangular;
    // Rectangular: c is the origin (default: the global one), a on the first axis, b in the plane of the first two.
    const auto axes = cylindrical ? cylindrical_axes(a, b) : axes_of_points(c, a, b);
    orientation.origin = builder.scope->place(cylindrical ? a : c);
    if (row.ok() && !axes) row.error("the points define no axes; give points that do not lie on a line");
    if (axes) {
      for (int k = 0; k < 3; ++k) orientation.axes[k] = builder.scope->turn((*axes)[k]);
    }
  }
  if (block.lines.size() > 1) {
    Row row(builder, block, block.lines[1]);
    const std::int64_t axis = row.integer_or(0, 1, "axis of the additional rotation");
    orientation.additional_rotation = row.real_or(1, 0.0, "angle in degrees") * std::numbers::pi / 180.0;
    row.at_most(2);
    if (row.ok() && (axis < 1 || axis > 3)) row.error(fmt::format("axis {} does not exist; give 1, 2 or 3", axis));
    orientation.rotation_axis = static_cast<int>(axis) - 1;
  }
  builder.model.orientations.push_back(std::move(orientation));
}

void read_transform(Builder& builder, const Block& block) {
  NodalTransform transform;
  if (!builder.nodes_of(block.value("NSET"), block, block.location, transform.nodes)) return;
  if (block.lines.empty()) return builder.error(block, block.location, "it has no data; add the points a and b");
  Row row(builder, block, block.lines[0]);
  const Point a = point_of(row, 0, "point a"), b = point_of(row, 3, "point b");
  row.at_most(6);
  if (!row.ok()) return;
  auto& directions = transform.directions;
  std::optional<std::array<Point, 3>> axes;
  if (block.value("TYPE", "R") == "C") {
    directions.system = Orientation::System::cylindrical;
    directions.origin = builder.scope->place(a);
    axes = cylindrical_axes(a, b);
  } else {
    axes = axes_of_points({}, a, b);
  }
  if (!axes) return row.error("points a and b define no axes; correct them");
  for (int k = 0; k < 3; ++k) directions.axes[k] = builder.scope->turn((*axes)[k]);
  builder.model.transforms.push_back(std::move(transform));
}

void read_time_points(Builder& builder, const Block& block) {
  auto& points = builder.time_points[block.value("NAME")];
  if (!points.empty()) {
    return builder.error(block, block.location,
                         fmt::format("time points {} are defined twice; rename one", block.value("NAME")));
  }
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    if (block.has("GENERATE")) {
      const double first = row.real(0, "first time"), last = row.real(1, "last time"), step = row.real(2, "increment");
      row.at_most(3);
      if (row.ok() && !(step > 0.0 && last >= first))
        row.error("it generates nothing; give first <= last and a positive increment");
      if (!row.ok()) continue;
      // Half an increment of slack, so that round-off does not lose the last point.
      for (int k = 0; first + k * step <= last + 0.5 * step; ++k) points.push_back(first + k * step);
    } else {
      for (int field = 0; field < row.size(); ++field) points.push_back(row.real(field, "time"));
    }
  }
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (!(points[k] > points[k - 1])) {
      return builder.error(
          block, block.location,
          fmt::format("time {} does not come after {}; times must increase", points[k], points[k - 1]));
    }
  }
  if (points.empty()) builder.error(block, block.location, "it has no times; add data lines");
}

const RegisterKeyword heading{{"HEADING", Phase::definitions, Place::model, {}, read_heading}};
const RegisterKeyword units{
    {"UNITS", Phase::definitions, Place::model, {text("LENGTH"), text("MASS"), text("TIME")}, read_units}};
// *PREPRINT chooses what Abaqus's preprocessor prints to a file that does not exist here.
const RegisterKeyword preprint{{.keyword = "PREPRINT", .place = Place::model, .any_parameter = true}};
const RegisterKeyword amplitude{
    {"AMPLITUDE",
     Phase::definitions,
     Place::anywhere,
     {required(name("NAME")), choice("DEFINITION", {"TABULAR", "SMOOTH STEP", "EQUALLY SPACED", "PERIODIC"}),
      choice("TIME", {"STEP TIME", "TOTAL TIME", "STEP", "TOTAL"}), choice("VALUE", {"RELATIVE", "ABSOLUTE"}),
      real("FIXED INTERVAL"), real("BEGIN")},
     read_amplitude}};
const RegisterKeyword orientation{
    {"ORIENTATION",
     Phase::definitions,
     Place::model,
     {required(name("NAME")), choice("SYSTEM", {"RECTANGULAR", "CYLINDRICAL"}), choice("DEFINITION", {"COORDINATES"})},
     read_orientation}};
const RegisterKeyword transform{
    {"TRANSFORM", Phase::surfaces, Place::model, {required(name("NSET")), choice("TYPE", {"R", "C"})}, read_transform}};
const RegisterKeyword time_points{
    {"TIME POINTS", Phase::definitions, Place::anywhere, {required(name("NAME")), flag("GENERATE")}, read_time_points}};

const RegisterKeyword part{{.keyword = "PART", .parameters = {required(name("NAME"))}}};
const RegisterKeyword end_part{{.keyword = "END PART"}};
const RegisterKeyword assembly{{.keyword = "ASSEMBLY", .parameters = {name("NAME")}}};
const RegisterKeyword end_assembly{{.keyword = "END ASSEMBLY"}};
const RegisterKeyword instance{{.keyword = "INSTANCE",
                                .parameters = {required(name("NAME")), name("PART"), name("NSET"), name("ELSET")}}};
const RegisterKeyword end_instance{{.keyword = "END INSTANCE"}};

}  // namespace

}  // namespace balocco::deck
