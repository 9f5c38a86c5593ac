#include "results_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "results_index.hpp"

namespace balocco {

namespace {

/// Where a variable has its largest difference, or files part first.
struct Place {
  std::int64_t step_number = 0;
  double time = 0.0;
  std::string step;      // "step 2 (ROLL)"
  std::string moment;    // "frame 3, time 0.01, increment 40"; histories: "time 0.01"
  std::string variable;  // "U", "S of C3D8R", "ALLKE of history ENERGY"
  std::string where;     // "node 27, component 2"
  double a = 0.0, b = 0.0, difference = 0.0, scale = 0.0;
};

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

double magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// Not a number on one side only, or infinite, counts as an infinite difference.
double difference(double a, double b) {
  if (same_bits(a, b) || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double d = std::abs(a - b);
  return std::isfinite(d) ? d : HUGE_VAL;
}

/// Rows of values that differ: the first, and the one that differs most.
struct Spread {
  std::size_t first, largest;
};

/// Nothing if all agree within `tolerance`.
std::optional<Spread> spread(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  std::optional<Spread> found;
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = difference(a[i], b[i]);
    if (d <= tolerance) continue;
    if (!found) found = Spread{i, i};
    if (d <= most) continue;
    most = d;
    found->largest = i;
  }
  return found;
}

class Comparison {
 public:
  Comparison(const Hdf5File& a, const Hdf5File& b, double relative) : a_(a), b_(b), relative_(relative) {}

  ResultsDifference run() {
    if (compare_mesh()) compare_steps();
    return {told_.empty() && !first_, text()};
  }

 private:
  bool compare_mesh();
  void compare_steps();
  void compare_step(const std::string& step);
  void compare_frames(const std::string& step);
  void compare_frame(const std::string& frame);
  void compare_fields(const std::string& group, const std::string& type);
  void compare_history(const std::string& step);
  void compare_rows(const std::string& group, const std::string& name);
  void compare_values(const std::string& path, const std::vector<std::int64_t>& ids, const char* what);
  std::vector<std::string> common(const std::string& group, const std::string& prefix);
  bool in_both(const std::string& path, const std::string& what);
  void part(Place place);
  void tell(std::string text) { told_.push_back(std::move(text)); }
  std::string text() const;
  std::string describe(const Place& place) const;

  const Hdf5File& a_;
  const Hdf5File& b_;
  double relative_;
  int steps_ = 0, frames_ = 0, rows_ = 0;
  std::vector<std::string> told_;  // what one of them lacks
  std::optional<Place> first_;
  std::map<std::string, Place> largest_;  // by variable
  Place here_;                            // step, moment and variable being compared
};

bool Comparison::in_both(const std::string& path, const std::string& what) {
  const bool in_a = a_.exists(path), in_b = b_.exists(path);
  if (in_a != in_b) tell(fmt::format("{} stands only in {}", what, in_a ? "A" : "B"));
  return in_a && in_b;
}

/// Children of a group that both files have; what only one has is told.
std::vector<std::string> Comparison::common(const std::string& group, const std::string& prefix) {
  std::vector<std::string> names, both;
  for (const Hdf5File* file : {&a_, &b_}) {
    for (const auto& name : file->exists(group) ? file->children(group) : std::vector<std::string>{}) {
      const bool known = std::ranges::find(names, name) != names.end();
      if (!known && (prefix.empty() || number_in(name, prefix) >= 0)) names.push_back(name);
    }
  }
  for (const auto& name : names) {
    const std::string path = (group == "/" ? "" : group) + "/" + name;
    if (in_both(path, path.substr(1))) both.push_back(name);
  }
  return both;
}

/// @return false if rows cannot be set side by side.
bool Comparison::compare_mesh() {
  std::vector<std::string> tables{"/mesh/node/id"};
  for (const auto& type : common("/mesh/element", "")) {
    tables.push_back("/mesh/element/" + type + "/id");
    tables.push_back("/mesh/element/" + type + "/connectivity");
  }
  for (const auto& path : tables) {
    if (a_.read_integers(path) != b_.read_integers(path)) tell(fmt::format("the meshes differ: {}", path.substr(1)));
  }
  if (!told_.empty()) return false;
  here_ = {.step = "mesh", .moment = "undeformed", .variable = "coordinates"};
  compare_values("/mesh/node/coordinates", a_.read_integers("/mesh/node/id"), "node");
  return true;
}

void Comparison::compare_steps() {
  here_ = {};
  for (const auto& step : common("/", "step_")) compare_step("/" + step);
}

void Comparison::compare_step(const std::string& step) {
  ++steps_;
  const auto number = number_in(step.substr(1), "step_");
  here_ = {.step_number = number, .step = fmt::format("step {} ({})", number, a_.text_attribute(step, "name"))};
  for (const char* attribute : {"name", "procedure"}) {
    const auto left = a_.text_attribute(step, attribute), right = b_.text_attribute(step, attribute);
    if (left != right) tell(fmt::format("{}: {} is {} in A, {} in B", step.substr(1), attribute, left, right));
  }
  compare_frames(step);
  compare_history(step);
}

void Comparison::compare_frames(const std::string& step) {
  here_.moment.clear();
  for (const auto& name : common(step, "frame_")) compare_frame(step + "/" + name);
}

void Comparison::compare_frame(const std::string& frame) {
  ++frames_;
  const auto number = number_in(frame.substr(frame.rfind('/') + 1), "frame_");
  const double time = a_.number_attribute(frame, "time"), other = b_.number_attribute(frame, "time");
  here_.moment = fmt::format("frame {}, time {:.10g}, increment {}", number, time, a_.integer_attribute(frame, "increment"));
  here_.time = time;
  here_.variable = "time";
  if (difference(time, other) > relative_ * std::abs(time))
    part({.where = "frame", .a = time, .b = other, .difference = difference(time, other), .scale = std::abs(time)});
  compare_fields(frame + "/node", "");
  for (const auto& type : common(frame + "/element", "")) compare_fields(frame + "/element/" + type, type);
}

void Comparison::compare_fields(const std::string& group, const std::string& type) {
  const auto ids = a_.read_integers(type.empty() ? "/mesh/node/id" : "/mesh/element/" + type + "/id");
  for (const auto& name : common(group, "")) {
    here_.variable = type.empty() ? name : fmt::format("{} of {}", name, type);
    compare_values(group + "/" + name, ids, type.empty() ? "node" : "element");
  }
}

void Comparison::compare_values(const std::string& path, const std::vector<std::int64_t>& ids, const char* what) {
  const Extent shape = a_.extent(path);
  if (shape != b_.extent(path)) return tell(fmt::format("{} has another shape in B", path.substr(1)));
  const auto a = a_.read(path), b = b_.read(path);
  const double scale = std::max(magnitude(a), magnitude(b));
  const std::size_t columns = shape[0] > 0 ? a.size() / shape[0] : 1;
  const std::size_t last = shape.size() > 2 ? shape[2] : columns;
  const auto found = spread(a, b, relative_ * scale);
  if (!found) return;
  for (const auto i : {found->first, found->largest}) {
    Place place{.a = a[i], .b = b[i], .difference = difference(a[i], b[i]), .scale = scale};
    place.where = fmt::format("{} {}", what, ids[i / columns]);
    if (shape.size() > 2) place.where += fmt::format(", point {}", i % columns / last + 1);
    if (last > 1) place.where += fmt::format(", component {}", i % last + 1);
    part(std::move(place));
  }
}

void Comparison::compare_history(const std::string& step) {
  here_.moment.clear();
  const std::string history = step + "/history";
  for (const auto& name : common(history, "")) {
    for (const auto& variable : common(history + "/" + name, "")) compare_rows(history + "/" + name, variable);
  }
}

void Comparison::compare_rows(const std::string& group, const std::string& name) {
  const std::string path = group + "/" + name, label = group.substr(group.rfind('/') + 1);
  const Extent left = a_.extent(path), right = b_.extent(path);
  if (left[0] != right[0]) {
    tell(fmt::format("{} has {} rows in A, {} in B", path.substr(1), left[0], right[0]));
    return;
  }
  here_.variable = fmt::format("{} of history {}", name, label);
  const std::string axis = history_axis(a_, group);
  const auto marks = a_.read(group + "/" + axis), a = a_.read(path), b = b_.read(path);
  if (a.size() != b.size()) return tell(fmt::format("{} has another shape in B", path.substr(1)));
  rows_ += name == axis ? static_cast<int>(left[0]) : 0;
  const double scale = std::max(magnitude(a), magnitude(b));
  const std::size_t columns = left[0] > 0 ? a.size() / left[0] : 1;
  const auto found = spread(a, b, relative_ * scale);
  if (!found) return;
  for (const auto i : {found->first, found->largest}) {
    here_.time = marks[i / columns];
    here_.moment = fmt::format("{} {:.10g}", axis, here_.time);
    Place place{.a = a[i], .b = b[i], .difference = difference(a[i], b[i]), .scale = scale};
    place.where = fmt::format("row {}", i / columns + 1);
    if (columns > 1) place.where += fmt::format(", component {}", i % columns + 1);
    part(std::move(place));
  }
}

/// Completes a place where the files part with what is being compared, and keeps it if it is the first or the largest.
void Comparison::part(Place place) {
  place.step_number = here_.step_number;
  place.time = here_.time;
  place.step = here_.step;
  place.moment = here_.moment;
  place.variable = here_.variable;
  const auto when = [](const Place& p) { return std::pair(p.step_number, p.time); };
  if (!first_ || when(place) < when(*first_)) first_ = place;
  const auto [known, is_new] = largest_.emplace(place.variable, place);
  if (!is_new && place.difference > known->second.difference) known->second = place;
}

std::string Comparison::describe(const Place& place) const {
  return fmt::format("{}, {}: {} of {} is {:.17g} in A, {:.17g} in B (difference {:.3g})", place.step, place.moment,
                     place.variable, place.where, place.a, place.b, place.difference);
}

std::string Comparison::text() const {
  std::string result = fmt::format("compared {} steps, {} frames, {} rows of history{}\n", steps_, frames_, rows_,
                                   relative_ > 0.0 ? fmt::format(", relative tolerance {:g}", relative_) : ", bit by bit");
  auto out = std::back_inserter(result);
  if (told_.empty() && !first_) return result + "the results are the same\n";
  for (const auto& line : told_) fmt::format_to(out, "{}\n", line);
  if (!first_) return result;
  fmt::format_to(out, "they part first at {}\n", describe(*first_));
  fmt::format_to(out, "{:<24} {:>12} {:>12}  {}\n", "largest difference of", "absolute", "relative", "at");
  for (const auto& [variable, place] : largest_) {
    const double share = place.scale > 0.0 ? place.difference / place.scale : HUGE_VAL;
    fmt::format_to(out, "{:<24} {:>12.4g} {:>12.4g}  {}, {}, {}\n", variable, place.difference, share, place.step,
                   place.moment, place.where);
  }
  return result;
}

}  // namespace

ResultsDifference compare_results(const std::string& path_a, const std::string& path_b, double relative) {
  const auto a = open_results(path_a), b = open_results(path_b);
  ResultsDifference result = Comparison(*a, *b, relative).run();
  result.text = fmt::format("A {}\nB {}\n{}", path_a, path_b, result.text);
  return result;
}

}  // namespace balocco
