// What holds of the guided components of connectors over an increment, for both procedures: a law between the relative motion m of a
// row and its force f, which counts like that of a spring that is pulled. It never falls:
//
//   lower stop | slips back, f = load - friction | sticks, m = anchor | slips on, f = load + friction | upper stop
//
// Without friction a row is free between its stops, where f = load; what is driven or locked sticks whatever the force. At a stop, and
// where it sticks, m is given and f a multiplier; elsewhere f is given. Which of them holds is told by the sign of what is left over.
#pragma once

#include <limits>
#include <vector>

#include "analysis.hpp"
#include "constraints/guide.hpp"
#include "explicit_time.hpp"

namespace balocco {

struct GuideLaw {
  enum class Status { at_lower_stop = -2, slips_back = -1, inside = 0, slips_on = 1, at_upper_stop = 2 };
  static constexpr double unbounded = std::numeric_limits<double>::infinity();

  Guide::Range stop = Guide::everywhere;  // of motions
  double anchor = 0.0;                    // where it sticks
  double friction = 0.0;                  // greatest friction; unbounded: driven or locked
  double load = 0.0;                      // force of a load
  double rate = 0.0;                      // of the anchor, where it is driven
  Status status = Status::inside;

  bool sticks() const { return status == Status::inside && friction > 0.0; }
  bool is_stopped() const { return status == Status::at_lower_stop || status == Status::at_upper_stop; }
  /// Whether the motion is given, and the force a multiplier.
  bool holds() const { return sticks() || is_stopped(); }
  double held_at() const;
  /// The force where it does not hold.
  double force() const;
  /// The status that a force and a motion of the last increment tell.
  void guess(double motion, double force, double resolution);
  /// Goes on to another status where the force, or the motion, of this one has the wrong sign. @return whether it did.
  bool settle(double motion, double force, double resolution);
};

/// Of the rows of guides among the constraints of this rank.
class GuideLaws {
 public:
  GuideLaws(const Analysis& analysis, const Step& step);

  bool empty() const { return rows_.empty(); }
  bool contains(std::int32_t constraint_row) const { return !empty() && place_[constraint_row] >= 0; }
  GuideLaw& of(std::int32_t constraint_row) { return rows_[place_[constraint_row]].law; }
  const GuideLaw& of(std::int32_t constraint_row) const { return rows_[place_[constraint_row]].law; }
  /// Motion of a row, from measured ones of its constraint.
  double motion(const Analysis& analysis, std::int32_t constraint, int row, double measured) const;

  /// Where an increment begins: remembers motions in the state, locks what has gone too far, finds friction.
  void begin_increment(Analysis& analysis);
  /// What holds first, from the forces of the last increment; after aim().
  void guess(const Analysis& analysis);
  /// Implicit: friction from the forces of the trial.
  void renew_friction(const Analysis& analysis, std::int32_t constraint_row) {
    auto& row = rows_[place_[constraint_row]];
    row.law.friction = friction_of(analysis, row);
  }
  /// @return whether a row goes over to another status with these.
  bool settle(std::int32_t constraint_row, double motion, double force) { return of(constraint_row).settle(motion, force, resolution_); }
  /// Implicit: where prescribed motions start; the state stands at the start of the step, or was taken up inside it.
  void start_motions(const Analysis& analysis);
  /// Anchors and loads, implicit: at a time of the step;
  void aim(const Analysis& analysis, double step_time, double total_time, bool initial_loads);
  /// explicit: over the next increment, of loads at its start.
  void aim(const Analysis& analysis, const Instant& instant);
  /// @throws InputError where a motion without amplitude would begin with a jump.
  void refuse_jumps(const Analysis& analysis) const;
  /// Adds the work of a row's force over a motion: of drivers and loads, and what friction and hits of stops dissipate.
  void add_work(std::int32_t constraint_row, double force, double motion, NodalWork& work) const;

 private:
  struct Row {
    std::int32_t constraint = -1;
    int row = 0;
    const Guide::Row* definition = nullptr;
    const ConnectorMotion* motion = nullptr;
    const ConnectorLoad* load = nullptr;
    double start = 0.0;   // implicit: of the motion
    double old_load = 0.0;  // where the increment began
    double change = 0.0;  // of the motion over the last increment
    GuideLaw law;
  };
  double friction_of(const Analysis& analysis, const Row& row) const;
  const GuideConstraint& guide(const Analysis& analysis, const Row& row) const { return *analysis.constraints[row.constraint]->guide(); }

  const Step& step_;
  double resolution_ = 0.0;          // what motions are as exact as
  std::vector<Row> rows_;
  std::vector<std::int32_t> place_;  // in rows_, of rows of State::multiplier
  std::vector<NodePlace> places_;    // scratch
  std::array<double, 6> measured_{};
};

}  // namespace balocco
