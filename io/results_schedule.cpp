#include "results_schedule.hpp"

#include <algorithm>
#include <cmath>

#include "model/results.hpp"

namespace balocco {

namespace {

/// Between frames that nobody asked for: one costs as much as 20 to 60 increments.
constexpr std::int64_t increments_per_frame = 10 * regular_increments;

}  // namespace

Schedule Schedule::every(double interval, double duration) {
  Schedule schedule;
  schedule.duration_ = duration;
  schedule.tolerance_ = 1e-9 * duration;
  schedule.interval_ = interval > 0.0 ? std::max(interval, schedule.tolerance_) : 0.0;  // marks nearer than that are one
  return schedule;
}

Schedule Schedule::equal_intervals(std::int32_t count, double duration) {
  Schedule schedule = every(0.0, duration);
  schedule.count_ = count;
  return schedule;
}

Schedule Schedule::at_leisure(std::int32_t count, double duration, std::int64_t increments) {
  Schedule schedule = equal_intervals(count, duration);
  schedule.leisure_ = increments;
  return schedule;
}

Schedule Schedule::at(std::vector<double> times, double duration) {
  Schedule schedule = every(0.0, duration);
  std::sort(times.begin(), times.end());
  // Index 0 is the start of the step, which is served before the first increment.
  times.erase(times.begin(), std::upper_bound(times.begin(), times.end(), 0.0));
  times.insert(times.begin(), 0.0);
  schedule.times_ = std::move(times);
  return schedule;
}

Schedule Schedule::every_increments(std::int32_t count, double duration) {
  Schedule schedule = every(0.0, duration);
  schedule.increments_ = std::max(count, 1);
  return schedule;
}

Schedule Schedule::of(const FieldOutput& output, const Step& step) {
  if (output.time_interval) return every(*output.time_interval, step.duration());
  if (output.number_interval) return equal_intervals(*output.number_interval, step.duration());
  if (output.frequency) return every_increments(*output.frequency, step.duration());
  if (!output.time_points.empty()) return at(output.time_points, step.duration());
  return at_leisure(20, step.duration(), increments_per_frame);
}

Schedule Schedule::of(const HistoryOutput& output, const Step& step) {
  if (output.time_interval) return every(*output.time_interval, step.duration());
  if (output.frequency) return every_increments(*output.frequency, step.duration());
  if (!step.has_few_increments()) return at_leisure(200, step.duration(), regular_increments);
  return every_increments(1, step.duration());
}

double Schedule::mark(std::int64_t index) const {
  double time = duration_;
  if (interval_ > 0.0) {
    time = static_cast<double>(index) * interval_;
  } else if (count_ > 0) {
    time = duration_ * static_cast<double>(index) / static_cast<double>(count_);
  } else if (index < static_cast<std::int64_t>(times_.size())) {
    time = times_[index];
  }
  return std::min(time, duration_);
}

bool Schedule::due(double step_time, std::int64_t increment, bool finished) const {
  if (finished) return true;
  if (increments_ > 0) return increment % increments_ == 0;
  if (leisure_ > 0 && increment % leisure_ != 0) return false;
  return step_time >= mark(next_index_) - tolerance_;
}

void Schedule::pass(double step_time) {
  if (increments_ > 0) return;
  const double spacing = interval_ > 0.0 ? interval_ : count_ > 0 ? duration_ / static_cast<double>(count_) : 0.0;
  if (spacing > 0.0)  // a leap over most of what may be 1e9 marks
    next_index_ = std::max(next_index_, static_cast<std::int64_t>(step_time / spacing) - 1);
  while (mark(next_index_) <= step_time + tolerance_ && mark(next_index_) < duration_) ++next_index_;
}

double Schedule::next() const {
  if (increments_ > 0) return 0.0;
  return leisure_ > 0 ? duration_ : mark(next_index_) - tolerance_;
}

}  // namespace balocco
