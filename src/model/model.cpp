#include "model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/diagnostics.hpp"

namespace balocco {

std::string Model::where(Location location) const {
  if (location.file < 0) return name;
  return fmt::format("{}:{}", files[location.file], location.line);
}

std::int32_t Model::general_step_before(std::int32_t step) const {
  do --step;
  while (step >= 0 && steps[step].is_perturbation());
  return step;
}

const ImportedCopy* StateImport::copy_of(std::int32_t node_row) const {
  const auto holds = [&](const ImportedCopy& copy) { return std::ranges::binary_search(copy.nodes, node_row); };
  const auto found = std::ranges::find_if(copies, holds);
  return found == copies.end() ? nullptr : &*found;
}

const ImportedCopy* StateImport::copy_of(ElementRef element) const {
  const auto holds = [&](const ImportedCopy& copy) { return std::ranges::binary_search(copy.elements, element); };
  const auto found = std::ranges::find_if(copies, holds);
  return found == copies.end() ? nullptr : &*found;
}

std::string Model::node_name(std::int32_t row) const {
  if (nodes.instance.empty()) return fmt::format("{}", nodes.id[row]);
  const Instance& instance = instances[nodes.instance[row]];
  return instance.name + (instance.name.empty() ? "" : ".") + fmt::format("{}", nodes.id[row] - instance.node_offset);
}

std::string Model::element_name(ElementRef element) const {
  const ElementTable& table = elements[element.table];
  if (table.instance.empty()) return fmt::format("{}", table.id[element.row]);
  const Instance& instance = instances[table.instance[element.row]];
  return instance.name + (instance.name.empty() ? "" : ".") + fmt::format("{}", table.id[element.row] - instance.element_offset);
}

namespace {

/// The interval of `points` that holds `time`, and the fraction of it that has passed; clamped at both ends.
struct Interval {
  std::size_t index;
  double fraction;
};

Interval locate(const std::vector<std::array<double, 2>>& points, double time) {
  if (time <= points.front()[0]) return {0, 0.0};
  if (time >= points.back()[0]) return {points.size() - 2, 1.0};
  const auto after = std::upper_bound(points.begin(), points.end(), time, [](double t, const auto& p) { return t < p[0]; });
  const auto index = static_cast<std::size_t>(after - points.begin()) - 1;
  return {index, (time - points[index][0]) / (points[index + 1][0] - points[index][0])};
}

}  // namespace

double Amplitude::value(double time) const {
  if (kind == Kind::periodic) {
    if (time < start) return initial;
    double sum = initial;
    for (std::size_t n = 0; n < harmonics.size(); ++n) {
      const double phase = static_cast<double>(n + 1) * circular_frequency * (time - start);
      sum += harmonics[n][0] * std::cos(phase) + harmonics[n][1] * std::sin(phase);
    }
    return sum;
  }
  if (points.size() == 1) return points[0][1];
  const auto [index, s] = locate(points, time);
  const double weight = kind == Kind::smooth_step ? s * s * s * (10.0 - s * (15.0 - 6.0 * s)) : s;
  return points[index][1] + weight * (points[index + 1][1] - points[index][1]);
}

Orientation Orientation::of(ElementRef element) const {
  Orientation own{.system = system, .name = {}, .origin = origin, .axes = axes, .rotation_axis = rotation_axis,
                  .additional_rotation = additional_rotation};
  const auto found = std::ranges::lower_bound(of_element, element, {}, [](const auto& entry) { return entry.first; });
  if (found != of_element.end() && found->first == element) own.axes = found->second;
  return own;
}

const ImplicitIncrements* Step::implicit_increments() const {
  if (const auto* statics = std::get_if<StaticProcedure>(&procedure)) return statics;
  return std::get_if<DynamicProcedure>(&procedure);
}

InputError::InputError(std::vector<std::string> messages)
    : std::runtime_error(messages.empty() ? "bad input" : messages.front()), messages_(std::move(messages)) {}

}  // namespace balocco
