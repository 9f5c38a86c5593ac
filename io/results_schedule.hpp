// When something is due in a step. Marks are computed by multiplication, never accumulated, so that a restarted run finds the same.
#pragma once

#include <cstdint>
#include <vector>

#include "model/step.hpp"

namespace balocco {

/// The marks of one request within a step of `duration`. The end of the step is always a mark.
class Schedule {
 public:
  static Schedule of(const FieldOutput& output, const Step& step);
  /// Where nothing was said: every static increment, 200 intervals of an explicit step (Abaqus), at leisure.
  static Schedule of(const HistoryOutput& output, const Step& step);
  static Schedule every(double interval, double duration);
  static Schedule equal_intervals(std::int32_t count, double duration);
  /// As equal_intervals, but only at increments in which an explicit step calls its observer anyhow (regular_increments): what
  /// nobody asked for must cost nothing.
  static Schedule at_leisure(std::int32_t count, double duration);
  static Schedule at(std::vector<double> times, double duration);
  static Schedule every_increments(std::int32_t count, double duration);

  /// True when a mark has been reached since the last pass(); marks count as reached within 1e-9 of the duration.
  bool due(double step_time, std::int64_t increment, bool finished) const;
  /// Everything up to here has been served.
  void pass(double step_time);
  /// Step time from which on due() may be true.
  double next() const;

 private:
  double mark(std::int64_t index) const;

  double duration_ = 0.0, tolerance_ = 0.0;
  double interval_ = 0.0;           // time between marks, or
  std::int64_t count_ = 0;          // number of equal intervals, or
  std::vector<double> times_;       // marks, or
  std::int32_t increments_ = 0;     // increments between marks
  bool at_leisure_ = false;
  std::int64_t next_index_ = 1;
};

}  // namespace balocco
