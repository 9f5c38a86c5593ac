#include "guide_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/joint.hpp"
#include "explicit_motion.hpp"
#include "implicit_prescribed.hpp"
#include "model/bounding_box.hpp"
#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

using Status = GuideLaw::Status;

double GuideLaw::held_at() const {
  return status == Status::at_upper_stop ? stop[1] : status == Status::at_lower_stop ? stop[0] : anchor;
}

double GuideLaw::force() const {
  return status == Status::slips_on ? load + friction : status == Status::slips_back ? load - friction : load;
}

void GuideLaw::guess(double motion, double force, double resolution) {
  constexpr double nearly = 1.0 - 1e-9;
  status = Status::inside;
  if (friction == unbounded) return;
  if (motion >= stop[1] - resolution && force > load + friction)
    status = Status::at_upper_stop;
  else if (motion <= stop[0] + resolution && force < load - friction)
    status = Status::at_lower_stop;
  else if (friction > 0.0 && std::abs(force - load) >= nearly * friction)
    status = force > load ? Status::slips_on : Status::slips_back;
}

bool GuideLaw::settle(double motion, double force, double resolution) {
  const auto before = status;
  const bool rubs = friction > 0.0;
  switch (status) {
    case Status::at_upper_stop:
      if (force < load + friction) status = rubs ? Status::slips_on : Status::inside;
      break;
    case Status::at_lower_stop:
      if (force > load - friction) status = rubs ? Status::slips_back : Status::inside;
      break;
    case Status::slips_on:
      if (motion > stop[1] + resolution) status = Status::at_upper_stop;
      if (motion < anchor - resolution) status = Status::inside;
      break;
    case Status::slips_back:
      if (motion < stop[0] - resolution) status = Status::at_lower_stop;
      if (motion > anchor + resolution) status = Status::inside;
      break;
    case Status::inside:
      if (friction == unbounded) break;
      if (rubs ? force > load + friction : motion > stop[1] + resolution) status = rubs ? Status::slips_on : Status::at_upper_stop;
      if (rubs ? force < load - friction : motion < stop[0] - resolution) status = rubs ? Status::slips_back : Status::at_lower_stop;
  }
  return status != before;
}

GuideLaws::GuideLaws(const Analysis& analysis, const Step& step) : step_(step), resolution_(0.0) {
  for (const auto index : analysis.local_constraints) {
    const auto* guide = analysis.constraints[index]->guide();
    if (guide == nullptr) continue;
    if (place_.empty()) place_.assign(analysis.current.multiplier.size(), -1);
    for (int row = 0; row < guide->rows(); ++row) {
      place_[analysis.first_constraint_row[index] + row] = static_cast<std::int32_t>(rows_.size());
      rows_.push_back({.constraint = index, .row = row, .definition = &guide->definition().rows[row]});
      auto& law = rows_.back().law;
      law.stop = guide->of_motion(row, guide->definition().rows[row].stop);
      law.anchor = analysis.current.guide_motion[analysis.first_constraint_row[index] + row];
    }
  }
  if (rows_.empty()) return;
  resolution_ = 64.0 * std::numeric_limits<double>::epsilon() * model_size(analysis.model);
  const auto of = [&](std::int32_t guide, int row) {
    const auto place = place_[analysis.first_constraint_row[guide] + row];
    return place < 0 ? nullptr : &rows_[place];
  };
  for (const auto& motion : step.connector_motions)
    if (auto* row = of(motion.guide, motion.row)) {
      row->motion = &motion;
      row->law.friction = GuideLaw::unbounded;
    }
  for (const auto& load : step.connector_loads)
    if (auto* row = of(load.guide, load.row)) row->load = &load;
}

double GuideLaws::motion(const Analysis& analysis, std::int32_t constraint, int row, double measured) const {
  return analysis.constraints[constraint]->guide()->nearest(row, measured,
                                                            analysis.current.guide_motion[analysis.first_constraint_row[constraint] + row]);
}

double GuideLaws::friction_of(const Analysis& analysis, const Row& row) const {
  const auto& friction = row.definition->friction;
  if (row.motion != nullptr || analysis.current.guide_locked[analysis.first_constraint_row[row.constraint] + row.row] != 0.0)
    return GuideLaw::unbounded;
  if (!friction) return 0.0;
  double pressed = friction->internal;
  if (const auto joint = guide(analysis, row).definition().joint; joint >= 0 && !friction->terms.empty()) {
    const auto& held = static_cast<const JointConstraint&>(*analysis.constraints[joint]);
    const auto force = held.component_forces(
        std::span(analysis.current.multiplier).subspan(analysis.first_constraint_row[joint], static_cast<std::size_t>(held.rows())));
    for (const auto& arms : friction->terms) {
      double square = 0.0;
      for (int c = 0; c < 6; ++c) square += arms[c] * force[c] * arms[c] * force[c];
      pressed += std::sqrt(square);
    }
  }
  return friction->coefficient * pressed / guide(analysis, row).lever(row.row);
}

void GuideLaws::begin_increment(Analysis& analysis) {
  auto& state = analysis.current;
  for (std::size_t first = 0; first < rows_.size();) {
    const auto index = rows_[first].constraint;
    const auto at = analysis.first_constraint_row[index];
    const auto& constraint = *analysis.constraints[index];
    analysis.find_places(index, places_);
    constraint.gaps(places_, measured_);
    for (int row = 0; row < constraint.rows(); ++row) {
      const auto& definition = *rows_[first + row].definition;
      const double before = state.guide_motion[at + row];
      state.guide_motion[at + row] = motion(analysis, index, row, measured_[row]);
      rows_[first + row].change = state.guide_motion[at + row] - before;
      const auto range = constraint.guide()->of_motion(row, definition.lock);
      const bool locks = state.guide_motion[at + row] < range[0] || state.guide_motion[at + row] > range[1];
      for (int other = 0; locks && other < constraint.rows(); ++other)
        if (definition.locks_all || other == row) state.guide_locked[at + other] = 1.0;
    }
    for (int row = 0; row < constraint.rows(); ++row) {
      auto& law = rows_[first + row].law;
      law.anchor = state.guide_motion[at + row];
      rows_[first + row].old_load = law.load;
      law.friction = friction_of(analysis, rows_[first + row]);
    }
    first += static_cast<std::size_t>(constraint.rows());
  }
}

void GuideLaws::guess(const Analysis& analysis) {
  for (auto& row : rows_) {
    const auto at = analysis.first_constraint_row[row.constraint] + row.row;
    row.law.guess(analysis.current.guide_motion[at], analysis.current.multiplier[at], resolution_);
  }
}

void GuideLaws::start_motions(const Analysis& analysis) {
  const auto& state = analysis.current;
  for (auto& row : rows_) {
    if (row.motion == nullptr) continue;
    const double lever = guide(analysis, row).lever(row.row);
    const double reached = state.guide_motion[analysis.first_constraint_row[row.constraint] + row.row] / lever;
    const auto law = motion_law(analysis.model, step_, row.motion->course, state.step_time, state.total_time);
    const bool begun = state.step_time > 0.0 && law.persistence > 0.0;
    row.start = begun ? (reached - law.motion) / law.persistence : reached;
  }
}

void GuideLaws::aim(const Analysis& analysis, double step_time, double total_time, bool initial_loads) {
  for (auto& row : rows_) {
    const double lever = guide(analysis, row).lever(row.row);
    if (row.motion != nullptr) {
      const auto law = motion_law(analysis.model, step_, row.motion->course, step_time, total_time);
      row.law.anchor = lever * (law.persistence * row.start + law.motion);
    }
    const auto* load = row.load;
    if (load == nullptr) continue;
    const double magnitude =
        initial_loads ? load->previous
                      : load_magnitude(analysis.model, step_, load->previous, load->magnitude, load->amplitude, step_time, total_time);
    row.law.load = -magnitude / lever;
  }
}

void GuideLaws::aim(const Analysis& analysis, const Instant& instant) {
  aim(analysis, instant.step_time, instant.total_time, false);
  for (auto& row : rows_) {
    if (row.motion == nullptr) continue;
    const double lever = guide(analysis, row).lever(row.row);
    const double now = analysis.current.guide_motion[analysis.first_constraint_row[row.constraint] + row.row];
    const auto& course = row.motion->course;
    const double old_rate = instant.previous > 0.0 ? row.change / instant.previous : 0.0;
    row.law.rate = lever * prescribed_velocity(analysis.model, step_, course, instant, {now / lever, old_rate / lever});
    row.law.anchor = now + instant.next * row.law.rate;
  }
  for (auto& row : rows_) row.old_load = row.law.load;
}

void GuideLaws::refuse_jumps(const Analysis& analysis) const {
  for (const auto& row : rows_) {
    if (row.motion == nullptr) continue;
    const auto& course = row.motion->course;
    if (course.kind != BoundaryCondition::Kind::displacement || course.fixed || course.propagated || course.amplitude >= 0) continue;
    constexpr double tolerance = 1e-6;  // of the motion: rounding of the steps before
    const auto at = analysis.first_constraint_row[row.constraint] + row.row;
    const double now = analysis.current.guide_motion[at] / guide(analysis, row).lever(row.row);
    if (course.magnitude == 0.0 || std::abs(course.magnitude - now) <= tolerance * std::abs(course.magnitude)) continue;
    throw InputError(fmt::format(
        "{}: error: *CONNECTOR MOTION: a motion of {} without AMPLITUDE would make the connector jump from {} at the start of an explicit step; "
        "give it an AMPLITUDE or prescribe a velocity",
        analysis.model.where({course.file, course.line}), course.magnitude, now));
  }
}

void GuideLaws::add_work(std::int32_t constraint_row, double force, double motion, NodalWork& work) const {
  const auto& row = rows_[place_[constraint_row]];
  const double by_load = row.motion != nullptr ? force * motion : 0.5 * (row.old_load + row.law.load) * motion;
  work.external -= by_load;
  (row.definition->friction && !row.law.is_stopped() ? work.friction : work.damping) += force * motion - by_load;
}

}  // namespace balocco
