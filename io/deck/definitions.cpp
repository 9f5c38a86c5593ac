// *HEADING *UNITS *PREPRINT *AMPLITUDE *TIME POINTS, and the structure keywords that the
// schedule handles.
#include <fmt/format.h>

#include "deck/builder.hpp"
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
