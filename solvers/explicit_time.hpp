// When an explicit step goes where: the time increment, and the instants at which forces and motions are taken.
#pragma once

#include <cstdint>

#include "analysis.hpp"

namespace balocco {

/// Half-step central difference at one instant: forces act at `step_time`; velocities go from the middle of the
/// increment that led here (`previous`, 0 at the start of a step) to the middle of the one that follows (`next`, 0 at
/// its end).
struct Instant {
  double step_time = 0.0, total_time = 0.0;
  double previous = 0.0, next = 0.0;

  double average() const { return 0.5 * (previous + next); }
};

/// That of springs, dashpots and connectors, beside what they add to elements.
struct RestraintBound : FrequencyBound {
  std::int64_t element = -1;  // id of the one that bounds the increment most; -1: there is none, or the step goes on from a checkpoint

  double increment() const;
};

/// A limit combined with what acts on the same masses: the squares of frequencies and the damping rates add up at most.
double combined_limit(double stable, const FrequencyBound& added);

/// The stable increment of this rank's elements, and the id of the element that governs it.
struct LocalStability {
  double increment = 1e300;
  std::int64_t element = -1;

  /// Of equal increments the element of the smaller id governs.
  void merge(double other, std::int64_t id) {
    if (other < increment || (other == increment && id < element)) *this = {other, id};
  }
};

/// Chooses increments: the fixed one, or scale factor x 90 % of the stable increment of elements and contact springs together.
/// An increment that followed the vibrations of the mesh would pump energy into them (parametric resonance), and one that changed
/// in an impact would change the energy of the ringing. So it is looked at every 100 increments only, and then lowered, or raised
/// in steps, to 90 % of what was stable all through the increments since the last look. Between looks it is lowered only where more
/// than 98 % of the limit would be taken.
class TimeControl {
 public:
  explicit TimeControl(const Step& step);

  /// Increment that follows the state's instant when `previous` led there (0: none) and `stable` is the limit; 0 at the end of the
  /// step. It lands on the step's end exactly; the last hundred share out what remains, so that none is much shorter than those
  /// before: a change of increment changes what vibrations conserve. Keeps State::least_stable.
  double next_increment(State& state, double previous, double stable) const;
  /// Time at the end of an increment, exactly the step's duration at its end.
  double time_after(double step_time, double increment) const;

 private:
  double automatic(State& state, double previous, double stable) const;

  double duration_, scale_factor_;
  double fixed_ = 0.0;  // 0: automatic
};

}  // namespace balocco
