#include "restart_read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "checkpoint_file.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

/// What says of a load or motion when it acts.
template <class Load>
const Load& course_of(const Load& load) {
  return load;
}
const BoundaryCondition& course_of(const ConnectorMotion& motion) { return motion.course; }

class Preparation {
 public:
  Preparation(const std::string& path, Model& model) : path_(path), model_(model), read_(*model.restart_read) {}  // has one

  void run() {
    const CheckpointPlace place(*open_checkpoint(path_));
    check_step(place);
    check_times(place);
    if (read_.end_step) end_step(place);
    read_.step = static_cast<std::int32_t>(place.number());
  }

 private:
  [[noreturn]] void refuse(const std::string& text) const {
    throw InputError(fmt::format("{}: error: *RESTART, READ: {}", model_.where(read_.location), text));
  }

  void check_step(const CheckpointPlace& place) const {
    if (read_.step != 0 && read_.step != place.number())
      refuse(fmt::format(
          "{} stands {} step {}, not of step {}; give STEP={}, or let that job keep its states (*RESTART, WRITE without "
          "OVERLAY)",
          path_, place.within_step() ? "within" : "at the end of", place.number(), read_.step, place.number()));
    const auto steps = static_cast<std::int64_t>(model_.steps.size());
    if (place.number() > steps)
      refuse(fmt::format(
          "{} stands in step {}, but this deck has {} steps; say the steps of the first deck again, and then the new ones", path_,
          place.number(), steps));
    const bool ends_here = read_.end_step || !place.within_step();
    if (ends_here && place.number() == steps) refuse("nothing is left to do behind that step; add a *STEP");
  }

  void check_times(const CheckpointPlace& place) const {
    double before = 0.0;
    for (std::int64_t row = 0; row < place.step; ++row) before += model_.steps[row].duration();
    constexpr double rounding = 1e-9;  // of times that were summed up over increments
    const double there = place.total_time - place.step_time;
    if (std::abs(before - there) > rounding * std::max(before, there))
      refuse(
          fmt::format("the steps before end at time {:.9g} in {}, in this deck at {:.9g}; say them as they were. A step can be "
                      "made longer where the "
                      "checkpoint stands within it",
                      there, path_, before));
    if (place.within_step() && !read_.end_step && place.step_time > model_.steps[place.step].duration())
      refuse(fmt::format(
          "{} stands at time {:.9g} of step {}, which takes {:.9g} in this deck; make it longer, or end it there with END STEP",
          path_, place.step_time, place.number(), model_.steps[place.step].duration()));
  }

  /// The increment to come, which velocities are ahead by the half of, is the last of the step.
  void end_step(const CheckpointPlace& place) {
    if (!place.within_step()) return;
    auto* const procedure = std::get_if<ExplicitProcedure>(&model_.steps[place.step].procedure);
    if (procedure == nullptr)
      refuse(fmt::format(
          "step {} is no explicit step: its loads may grow with its time, so that it cannot end early; leave END STEP out",
          place.number()));
    const auto& next = model_.steps[place.step + 1];
    if (next.ramps_loads())
      refuse(
          fmt::format("the loads of step {} start from what they reach at the end of step {}, so that it cannot end early; leave "
                      "END STEP out, or "
                      "put a dynamic step between",
                      place.number() + 1, place.number()));
    refuse_held_curves(model_.steps[place.step], next);
    procedure->duration = place.step_time + place.time_increment;
  }

  /// What the next step holds of a curve over step time is known to the reader for the whole step alone.
  void refuse_held_curves(const Step& ended, const Step& next) const {
    const auto is_held = [&](const auto& course, const auto& later) {
      return course.amplitude >= 0 && !model_.amplitudes[course.amplitude].total_time && later.amplitude < 0 &&
             later.file == course.file && later.line == course.line;
    };
    const auto check = [&](const auto& loads, const auto& later) {
      for (const auto& load : loads) {
        const auto& course = course_of(load);
        if (std::ranges::any_of(later, [&](const auto& other) { return is_held(course, course_of(other)); }))
          refuse(fmt::format("the step behind it holds what the amplitude of {} reaches at its end, so that it cannot end early; leave END STEP "
                             "out, or say the load or motion again in the new step",
                             model_.where({course.file, course.line})));
      }
    };
    check(ended.boundary, next.boundary);
    check(ended.concentrated_loads, next.concentrated_loads);
    check(ended.surface_loads, next.surface_loads);
    check(ended.temperatures, next.temperatures);
    check(ended.body_loads, next.body_loads);
    check(ended.connector_loads, next.connector_loads);
    check(ended.connector_motions, next.connector_motions);
  }

  const std::string& path_;
  Model& model_;
  RestartRead& read_;
};

}  // namespace

void prepare_restart(const std::string& path, const Communicator& communicator, Model& model) {
  communicator.together([&] { Preparation(path, model).run(); });
}

void resume_ended_step(const std::string& path, const Communicator& communicator, Model& model) {
  if (!model.restart_read->end_step) return;
  communicator.together([&] {
    const auto file = open_checkpoint(path);
    if (!file->has_attribute("/", ended_step)) return;  // of another deck, which its reader tells
    const auto row = static_cast<std::size_t>(file->integer_attribute("/", ended_step) - 1);
    model.restart_read->step = static_cast<std::int32_t>(row + 1);
    if (auto* const procedure = row < model.steps.size() ? std::get_if<ExplicitProcedure>(&model.steps[row].procedure) : nullptr)
      procedure->duration = file->number_attribute("/", duration_of_ended_step);
  });
}

}  // namespace balocco
