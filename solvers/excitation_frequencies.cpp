#include "excitation_frequencies.hpp"

#include <algorithm>
#include <cmath>

namespace balocco {

namespace {

constexpr double alike = 1e-6;  // relative: frequencies nearer than that are one

using Range = SteadyStateProcedure::Range;

/// Ends of the intervals of a range.
std::vector<double> marks_of(const SteadyStateProcedure& procedure, const Range& range, std::span<const double> eigenfrequencies) {
  std::vector<double> marks{range.lower};
  if (procedure.interval == SteadyStateProcedure::Interval::eigenfrequency)
    for (const double frequency : eigenfrequencies)
      if (frequency > marks.back() * (1.0 + alike) && frequency < range.upper * (1.0 - alike)) marks.push_back(frequency);
  marks.push_back(range.upper);
  return marks;
}

/// Between two marks, without these.
void add_points_between(double first, double last, const Range& range, bool logarithmic, std::vector<double>& frequencies) {
  if (logarithmic) {
    first = std::log(first);
    last = std::log(last);
  }
  for (std::int32_t k = 1; k + 1 < range.points; ++k) {
    const double y = -1.0 + 2.0 * k / (range.points - 1);
    const double f = 0.5 * (first + last) + 0.5 * (last - first) * std::copysign(std::pow(std::abs(y), 1.0 / range.bias), y);
    frequencies.push_back(logarithmic ? std::exp(f) : f);
  }
}

void add_range(const SteadyStateProcedure& procedure, const Range& range, std::span<const double> eigenfrequencies,
               std::vector<double>& frequencies) {
  frequencies.push_back(range.lower);
  if (range.upper <= range.lower) return;
  const auto marks = marks_of(procedure, range, eigenfrequencies);
  std::vector<double> inside;
  for (std::size_t mark = 0; mark + 1 < marks.size(); ++mark) {
    if (mark > 0) inside.push_back(marks[mark]);
    add_points_between(marks[mark], marks[mark + 1], range, procedure.logarithmic, inside);
  }
  for (const double frequency : inside)
    if (const double scaled = range.scale * frequency; scaled > range.lower && scaled < range.upper) frequencies.push_back(scaled);
  frequencies.push_back(range.upper);
}

}  // namespace

std::vector<double> excitation_frequencies(const SteadyStateProcedure& procedure, std::span<const double> eigenfrequencies) {
  std::vector<double> sorted(eigenfrequencies.begin(), eigenfrequencies.end()), frequencies;
  std::ranges::sort(sorted);
  for (const auto& range : procedure.ranges) add_range(procedure, range, sorted, frequencies);
  // Ranges may touch.
  frequencies.erase(std::unique(frequencies.begin(), frequencies.end()), frequencies.end());
  return frequencies;
}

}  // namespace balocco
