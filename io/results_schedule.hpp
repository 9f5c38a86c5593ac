// When something is due in a step. Marks are computed by multiplication, never accumulated, so that a restarted run finds the same.
#pragma once

#include <cstdint>
#include <vector>

#include "model/step.hpp"

namespace balocco {

/// The marks of one request within a step of `duration`. The end of the step is always a mark.
class Schedule {
 public:
  /// Where nothing was said, an explicit step has 20 intervals of frames and 200 of histories (Abaqus), at leisure: frames in
  /// increments that are multiples of 1000, rows in multiples of regular_increments. A static step: all increments.
  static Schedule of(const FieldOutput& output, const Step& step);
  static Schedule of(const HistoryOutput& output, const Step& step);
  static Schedule every(double interval, double duration);
  static Schedule equal_intervals(std::int32_t count, double duration);
  /// As equal_intervals, but only in increments that are multiples of `increments`, itself a multiple of regular_increments, in which
  /// an explicit step calls its observer anyhow: what nobody asked for must cost nothing.
  static Schedule at_leisure(std::int32_t count, double duration, std::int64_t increments);
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
  std::int64_t leisure_ = 0;        // increments of which those that serve a mark are multiples; 0: all are
  std::int64_t next_index_ = 1;
};

}  // namespace balocco
