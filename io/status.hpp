// JOB.sta, JOB.log and the terminal: how far the run is, for people. The only place where wall-clock time is written.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "model/model.hpp"
#include "model/results.hpp"

namespace balocco {

/// Belongs to the root rank; on others it does nothing.
class Status {
 public:
  Status(const std::string& status_path, const std::string& log_path, const Model& model, bool restarted, bool root);
  ~Status();
  Status(const Status&) = delete;
  Status& operator=(const Status&) = delete;

  void start_step(std::int32_t step, const State& state);
  /// A line of .sta.
  void static_line(const Progress& progress, double work, double internal);
  void harmonic_line(const Progress& progress);
  void explicit_line(const Progress& progress, const State& state, const EnergyBalance& energies);
  /// One line on a terminal, rewritten in place; elsewhere a line each 5 % of the step. `now`: whatever was shown before.
  void show(const Progress& progress, bool now);

  /// A line of .log; warnings and errors also go to the terminal.
  void log(const std::string& line);
  /// Last line of .sta and .log.
  void finish(const std::string& line);

  double seconds() const;  // since the run started

 private:
  /// Fraction of the step done and seconds it will still take, from the speed since the step started or was resumed.
  struct Outlook {
    double fraction = 0.0, remaining = 0.0, elements_per_second = 0.0;
  };
  Outlook outlook(const Progress& progress) const;
  void line(std::FILE* file, const std::string& text);

  const Model* model_;
  bool root_, terminal_;
  std::FILE* status_ = nullptr;
  std::FILE* log_ = nullptr;
  std::chrono::steady_clock::time_point begin_;
  std::int64_t element_count_ = 0;
  bool can_fail_ = false;              // a material has *SHEAR FAILURE: one more column
  bool scales_masses_ = false;         // a step has mass scaling: one more column
  std::int64_t deleted_elements_ = 0;  // told in .log

  std::int32_t step_ = 0;
  double step_begin_seconds_ = 0.0, step_begin_time_ = 0.0;
  std::int64_t step_begin_increment_ = 0;
  int shown_twentieth_ = 0;
  double shown_seconds_ = -1e300;
  bool line_open_ = false;  // a progress line waits to be overwritten
};

/// "12.3 s", "4 min 5 s", "3 h 20 min".
std::string duration_text(double seconds);

}  // namespace balocco
