#include "procedures.hpp"

#include <fmt/format.h>

#include "model/diagnostics.hpp"

namespace balocco {

namespace {

std::size_t end_of_steps(const Model& model, const std::string& last) {
  if (last.empty()) return model.steps.size();
  for (std::size_t step = 0; step < model.steps.size(); ++step)
    if (model.steps[step].name == last) return step + 1;
  throw InputError(fmt::format("{}: error: --until {}: no step of that name; name one of the deck's *STEP, NAME=", model.name, last));
}

}  // namespace

std::array<RunStep, std::variant_size_v<Procedure>>& procedure_runners() {
  static std::array<RunStep, std::variant_size_v<Procedure>> runners{};
  return runners;
}

Outcome run_steps(Analysis& analysis, Observer& observer, const std::string& last) {
  const auto& steps = analysis.model.steps;
  auto& state = analysis.current;
  for (const auto end = end_of_steps(analysis.model, last); static_cast<std::size_t>(state.step) < end;) {
    const auto& step = steps[state.step];
    // A checkpoint written when a step ended stands at its end: the next step is due.
    const bool done = state.increment > 0 && state.step_time >= step.duration();
    if (!done) {
      const auto outcome = procedure_runners()[step.procedure.index()](analysis, step, observer);
      if (outcome == Outcome::stopped) return outcome;
    }
    ++state.step;
    state.step_time = 0.0;
    state.increment = 0;
  }
  return Outcome::finished;
}

}  // namespace balocco
